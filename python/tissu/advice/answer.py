"""The sentence at the end: the cheapest setting that is good enough, or what cannot be met."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tissu.advice.goal import Goal, length_words
from tissu.advice.rows import Row

if TYPE_CHECKING:
    from tissu.advice.reference import Reference
    from tissu.advice.richardson import Estimate


def cheapest(rows: Sequence[Row]) -> Row | None:
    """The row that meets error and rate in the least time for an update; None: no row does."""
    good = [row for row in rows if row.meets_error and row.meets_rate]
    return min(good, key=_cost, default=None)


def nearest(rows: Sequence[Row]) -> Row | None:
    """The row that misses what is asked by the least."""
    return min(rows, key=lambda row: (row.missed, _cost(row)), default=None)


def sentence(rows: Sequence[Row], goal: Goal) -> str:
    """What to take, or which of error and rate cannot be met and by how much."""
    best = cheapest(rows)
    if best is not None:
        return f"take {_with_numbers(best, goal)}: the cheapest that meets {_asked(goal)}"
    exact = min(rows, key=lambda row: row.error_excess, default=None)
    fast = min(rows, key=lambda row: row.rate_excess, default=None)
    near = nearest(rows)
    if exact is None or fast is None or near is None or near.error is None:
        return (
            f"of nothing that ran is the error known, so {_asked(goal)} stays unanswered; a larger "
            "--budget affords more"
        )
    parts = []
    if not exact.meets_error:
        parts.append(
            f"the error of {goal.error_words()} cannot be met: the least found is "
            f"{error_words(exact, goal)}, {_times(exact.error_excess)} as much, of {exact.name}"
        )
    if not fast.meets_rate:
        parts.append(
            f"the rate of {goal.rate:g} updates a second cannot be met: the highest found is "
            f"{fast.rate:.3g}, {_times(fast.rate_excess)} too few, of {fast.name}"
        )
    if not parts:
        parts = _not_together(rows, goal)
    return f"{'; '.join(parts)}; nearest to both comes {_with_numbers(near, goal)}"


def reference_words(reference: Reference, row: Row, largest: float) -> str:
    """What errors are measured against, and what is known of its own error."""
    if not reference.richer:
        return (
            f"{row.name}: the scene's own setting, since nothing richer fitted in the budget; its "
            "own error is not known"
        )
    parts = ["the cells are as they are"]
    if reference.meshes_change:
        parts = [_order_words("cells", reference.space, largest)]
    if reference.dynamic:
        parts.append(_order_words("steps", reference.time, largest))
    whole = reference.error
    own = (
        "its own error is not known"
        if whole is None
        else f"its own error is about {_share(whole, largest)}"
    )
    return f"{row.name}; {own} ({', '.join(parts)})"


def doubts(reference: Reference, goal: Goal, largest: float) -> str:
    """Why the errors may say less than they seem to; empty: no sign of it."""
    measured = reference.tried.measured
    texts = []
    if not reference.richer:
        texts.append("errors are distances from the scene's own setting; give a larger --budget")
    elif reference.error is None:
        texts.append("the reference's own error is not known, so that of the others may be larger")
    if reference.richer and reference.meshes_change and not reference.finer:
        texts.append("no richer mesh fitted in the budget, so the errors lack those of the cells")
    if reference.error is not None and goal.share_of(reference.error, largest) > 1.0:
        texts.append(
            f"the reference's own error of about {_share(reference.error, largest)} is more than "
            "the one asked for; a larger --budget affords a better one"
        )
    if measured is not None and measured.unconverged:
        texts.append(
            f"{measured.unconverged} of the reference's {measured.steps} steps did not converge"
        )
    return "; ".join(texts)


def error_words(row: Row, goal: Goal) -> str:
    """An error in the unit in which it was asked for."""
    if row.error is None:
        return "of no known error"
    if goal.is_length or row.error_percent is None:
        return length_words(row.error)
    return f"{row.error_percent:.3g} %"


def _order_words(of: str, found: Estimate | None, largest: float) -> str:
    if found is None:
        return f"of the {of}: no order seen"
    return f"of the {of}: {_share(found.error, largest)}, observed order {found.order:.2f}"


def _share(error: float, largest: float) -> str:
    return f"{100.0 * error / largest:.2g} %" if largest > 0.0 else length_words(error)


def _asked(goal: Goal) -> str:
    return f"{goal.error_words()} at {goal.rate:g} updates a second"


def _not_together(rows: Sequence[Row], goal: Goal) -> list[str]:
    exact = min((r for r in rows if r.meets_error), key=lambda row: row.rate_excess)
    fast = min((r for r in rows if r.meets_rate), key=lambda row: row.error_excess)
    return [
        f"the error of {goal.error_words()} and the rate of {goal.rate:g} updates a second cannot "
        "be met together",
        f"with the error met the highest rate is {exact.rate:.3g}, {_times(exact.rate_excess)} "
        f"too few, of {exact.name}",
        f"with the rate met the least error is {error_words(fast, goal)}, "
        f"{_times(fast.error_excess)} as much, of {fast.name}",
    ]


def _with_numbers(row: Row, goal: Goal) -> str:
    cost = f"{row.ms_per_update:.3g} ms an update" if row.ms_per_update is not None else ""
    return f"{row.name} ({error_words(row, goal)}, {cost}, {row.rate:.3g} updates a second)"


def _times(factor: float) -> str:
    return f"{factor:.3g} times"


def _cost(row: Row) -> float:
    return float("inf") if row.ms_per_update is None else row.ms_per_update
