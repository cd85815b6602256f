"""What instruments, tears and contacts came to in a run, in lines for a reader."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.counted import counted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tissu.simulation import Simulation


def cut_lines(simulation: Simulation, cuts: Sequence[dict[str, Any]]) -> list[str]:
    """For each edited body: by what, when, how much was opened, the pieces now, the time.

    Args:
        simulation: at the end of the run.
        cuts: `StepTally.cuts`.
    """
    lines = []
    for body in dict.fromkeys(cut["body"] for cut in cuts):
        of_body = [cut for cut in cuts if cut["body"] == body]
        first, last = of_body[0]["time"], of_body[-1]["time"]
        when = f"at {first:.4g} s" if first == last else f"from {first:.4g} s to {last:.4g} s"
        area = 1e4 * sum(cut["area"] for cut in of_body)
        taken = -1e3 * sum(cut["mass_change"] for cut in of_body)
        pieces = simulation.pieces(body)
        free = sum(not piece.held for piece in pieces)
        words = [f"{area:.3g} cm2 opened"] + [f"{taken:.3g} g removed"] * (taken > 1e-9)
        words.append(f"{counted(len(pieces), 'piece')}, {free} of them not held on all axes")
        if bridges := sum(cut["bridges"] for cut in of_body):
            words.append(f"walls of a blade may have left bridges in {counted(bridges, 'cell')}")
        seconds = sum(cut["milliseconds"] for cut in of_body) / 1e3
        spent = f"{counted(len(of_body), 'edit')} took {seconds:.2f} s of the steps"
        lines.append(f"{body} was {_done(of_body)} {when}: {', '.join(words)}; {spent}")
    return lines


def _done(cuts: Sequence[dict[str, Any]]) -> str:
    """What the instruments did: "cut by scalpel and ablated by hook"."""
    done = []
    for what, ablated in (("cut", False), ("ablated", True)):
        tools = dict.fromkeys(cut["by"] for cut in cuts if cut["ablated"] == ablated)
        done += [f"{what} by {', '.join(tools)}"] * bool(tools)
    return " and ".join(done)


def contact_line(record: dict[str, Any] | None) -> list[str]:
    """The largest force on each thing that was touched, of `ContactTally.record`."""
    if record is None:
        return []
    forces = record["forces"].items()
    felt = [f"{name} {one['largest']:.3g} N" for name, one in forces if one["largest"] > 0.0]
    return [f"largest contact forces: {', '.join(felt)}" if felt else "nothing touched anything"]
