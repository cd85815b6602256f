"""What may be shown on a page: simulations that are stepped together, and their trocars."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.live_view.tools import Tool
    from tissu.live_view.trocars.trocars import LiveTrocars
    from tissu.simulation import Simulation


def trocars_of(
    simulations: Sequence[Simulation], *, hand: str, trust_plugins: bool
) -> LiveTrocars | None:
    """The trocars of simulations, on; what they are made of is loaded only where there are any."""
    if hand not in ("scene", "browser"):
        raise ParameterError(f"found the hand '{hand}'; scene and browser are accepted")
    if not any(simulation.scene.trocars for simulation in simulations):
        if hand == "browser":
            text = "found the hand of the browser for a scene without trocars, which has nothing "
            raise ParameterError(f"{text}to hold; add `trocars`, or leave `hand` out")
        return None
    from tissu.live_view.trocars.trocars import LiveTrocars

    return LiveTrocars(
        simulations, hand="browser" if hand == "browser" else "scene", trust_plugins=trust_plugins
    )


def holding(simulations: Sequence[Simulation], trocars: LiveTrocars) -> Tool:
    """The tool that leads the hands of the browser."""
    from tissu.live_view.tools.hold_trocar import HoldTrocar

    return HoldTrocar(simulations, trocars)


def require_simulations(given: Sequence[object]) -> None:
    """Refuses what was not compiled from a scene, such as the name of a model."""
    for one in given:
        if not hasattr(one, "allow_touch"):
            raise ParameterError(
                f"found {one!r} to view; a simulation is accepted, as `scene.compile()` makes it"
            )


def require_together(simulations: Sequence[Simulation]) -> None:
    """Refuse simulations that cannot be stepped by the same time."""
    steps = [getattr(simulation.scene.step, "dt", None) for simulation in simulations]
    if len({*steps}) > 1 or (len(steps) > 1 and steps[0] == "auto"):
        shown = " and ".join("none" if dt is None else str(dt) for dt in steps)
        raise ParameterError(
            f"found simulations side by side with the time steps {shown}; the same step, in "
            "seconds, is accepted"
        )
