"""The Pareto front of error and time, and what is cheapest for an error."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

from tissu import pareto
from tissu.accuracy.study import Run, Study


def front(runs: Sequence[Run]) -> list[Run]:
    """Runs that no other beats in both error and time to the result, fastest first."""
    known = [run for run in runs if run.counts]
    return pareto.front(known, lambda run: run.seconds or 0.0, lambda run: run.share or 0.0)


def cheapest(runs: Sequence[Run], error: float) -> Run | None:
    """The fastest run whose mean error is at most this share of the reference; None: none is."""
    good = [run for run in runs if run.counts and run.share is not None and run.share <= error]
    return min(good, key=_cost) if good else None


def reached(runs: Sequence[Run], error: float) -> float | None:
    """Time in which a curve of runs comes to an error [s]; None: it does not.

    Between the first run that is good enough and the last before it, fastest first, the error is
    taken for a power of the time.

    Args:
        runs: of one curve.
        error: share of the reference's largest displacement.
    """
    known = sorted((run for run in runs if run.counts), key=_cost)
    before: Run | None = None
    for run in known:
        seconds, share = _cost(run)
        if share > error:
            before = run
            continue
        if before is None or share <= 0.0:
            return seconds
        start, worse = _cost(before)
        part = log(worse / error) / log(worse / share)
        return float(start * (seconds / start) ** part)
    return None


def sentence(study: Study) -> str:
    """What is cheapest for each of the case's goals; goals with one answer share a sentence."""
    goals: dict[str, list[str]] = {}
    nearest = min((r for r in study.runs if r.counts), key=lambda r: r.share or 0.0, default=None)
    if nearest is None or nearest.share is None:
        return "No run came to its end."
    parts = []
    for goal in study.case.goals:
        run = cheapest(study.runs, goal)
        if run is not None:
            goals.setdefault(f"{_named(run)}, {_ms(run)}", []).append(_percent(goal))
            continue
        parts.append(
            f"No run reaches {_percent(goal)}. Nearest: {_named(nearest)}, with "
            f"{_percent(nearest.share)}, {_ms(nearest)}."
        )
    found = [f"Cheapest for {_joined(shares)}: {answer}." for answer, shares in goals.items()]
    return " ".join([*found, *parts])


def _named(run: Run) -> str:
    """The label of a run, with a comma before its mesh; a number stands after its noun."""
    value = run.label.removeprefix(run.curve).strip()
    mesh = value != run.label and ("x" in value or ".vtu" in value)
    return f"{run.curve}, {value}" if mesh else run.label


def _joined(words: list[str]) -> str:
    """Words as a list: "3 %, 1 % and 0.1 %"."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _cost(run: Run) -> tuple[float, float]:
    return run.seconds or 0.0, run.share or 0.0


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %"


def _ms(run: Run) -> str:
    seconds = run.seconds or 0.0
    return f"{1e3 * seconds:.3g} ms" if seconds < 1.0 else f"{seconds:.3g} s"
