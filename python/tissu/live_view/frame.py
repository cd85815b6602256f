"""What the page is given of the simulations: one moment, copied, of what is seen only."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError
from tissu.live_view.fields import FIELDS
from tissu.live_view.layers import LAYERS
from tissu.live_view.ration import Ration
from tissu.live_view.surface import Seen, places_of, seen_of

if TYPE_CHECKING:
    from tissu.live_view.gizmo import Gizmo
    from tissu.live_view.layers.layer import Draw, Layer
    from tissu.live_view.marks import Marks
    from tissu.live_view.runner import Runner
    from tissu.live_view.touch import Touch
    from tissu.live_view.trocars.frame import TrocarFrame
    from tissu.live_view.trocars.trocars import LiveTrocars
    from tissu.simulation import Profile, Simulation

SHARE = 0.015
"""Of the thread's time, that a field may take where there is none to spare."""
_LONGEST = 5.0
"""The longest that a dear field stays as it is [s]."""
_NUMBERS = 0.25
"""Wall time between two looks at the profile [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class BodyFrame:
    """A body at one moment.

    Attributes:
        seen: what is seen of it.
        positions: (k, 3) float32 of the nodes that are seen [m].
        values: (k,) what is coloured, in SI units; None: the body does not have the field.
    """

    seen: Seen
    positions: NDArray[np.float32]
    values: NDArray[np.float64] | None


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """All bodies at one moment; of several simulations one lane each.

    Attributes:
        time: simulated [s].
        bodies: lane and name of a body -> the body.
        field: name of the field that is coloured; empty: none.
        marks: lane and name of a layer, or `tool` -> its marks.
        profiles: of each simulation.
        error: between two simulations; see `error_between`.
        message: what went wrong; empty: nothing.
        playing: whether it runs, and
        achieved: simulated time for wall time then.
        said: what the tool in hand feels.
        gizmos: of the tool in hand.
        trocars: of all simulations.
    """

    time: float
    bodies: Mapping[tuple[int, str], BodyFrame]
    field: str
    marks: Mapping[tuple[int, str], Sequence[Marks]]
    profiles: Sequence[Profile]
    error: tuple[float, float] | None
    message: str
    playing: bool
    achieved: float
    said: str
    gizmos: list[Gizmo]
    trocars: Sequence[TrocarFrame] = ()


@dataclass(frozen=True, slots=True)
class Wanted:
    """What the page shows now.

    Attributes:
        field: name of the field that is coloured; empty: none.
        layers: names of the layers that are shown.
    """

    field: str = ""
    layers: frozenset[str] = frozenset()


class FrameTaker:
    """Takes frames, in the thread that owns the simulations.

    Attributes:
        wanted: what the page shows now; another thread may put another one there.
        ration: of the time for the field that is coloured.
        cost: processor time of the latest frame without that field [s].
        layers: that can be shown.
    """

    def __init__(self, trocars: LiveTrocars | None = None) -> None:
        """Nothing was taken yet; `trocars`: of the simulations, where they have any."""
        self._trocars = trocars
        self.layers = LAYERS if trocars is None else (*LAYERS, trocars.layer)
        self.wanted = Wanted()
        self.ration = Ration(SHARE, longest=_LONGEST)
        self.cost = 0.0
        self._values: dict[tuple[int, str], tuple[Seen, NDArray[np.float64] | None]] = {}
        self._layers: dict[tuple[int, str], tuple[tuple[object, ...], Draw]] = {}
        self._values_of = ""
        self._profiles: list[Profile] = []
        self._profiles_due = 0.0

    def take(self, runner: Runner, touch: Touch | None = None) -> Frame:
        """The present moment of the simulations, and of the tool that is in hand."""
        begin = time.thread_time()
        frame, field = self._take(runner, touch)
        self.cost = time.thread_time() - begin - field
        return frame

    def _take(self, runner: Runner, touch: Touch | None) -> tuple[Frame, float]:
        """The present moment, and what its field cost [s]."""
        simulations = runner.simulations
        wanted, now = self.wanted, time.monotonic()
        drawn = [] if touch is None else touch.draw(simulations)
        self._look_at_profiles(simulations, now)
        found = {
            (lane, name): (simulation, seen_of(simulation, name))
            for lane, simulation in enumerate(simulations)
            for name in simulation.meshes
        }
        cost = self._colour(found, wanted.field)
        frame = Frame(
            time=simulations[0].time,
            bodies={
                (lane, name): BodyFrame(
                    of_body,
                    places_of(simulation, name, of_body).astype(np.float32),
                    self._values.get((lane, name), (of_body, None))[1],
                )
                for (lane, name), (simulation, of_body) in found.items()
            },
            field=wanted.field,
            marks={
                (lane, layer.name): self._drawn(lane, layer, simulation)()
                for lane, simulation in enumerate(simulations)
                for layer in self.layers
                if layer.name in wanted.layers and layer.offered(simulation)
            }
            | {(lane, "tool"): marks for lane, marks in enumerate(drawn)},
            profiles=tuple(self._profiles),
            error=error_between(*simulations) if len(simulations) == 2 else None,
            message=runner.error,
            playing=runner.playing,
            achieved=runner.achieved,
            said="" if touch is None else touch.say(simulations),
            gizmos=[] if touch is None else touch.gizmos(simulations),
            trocars=() if self._trocars is None else self._trocars.frames(),
        )
        return frame, cost

    def _look_at_profiles(self, simulations: Sequence[Simulation], now: float) -> None:
        """A few times a second; they are dear."""
        if now >= self._profiles_due or len(self._profiles) != len(simulations):
            self._profiles = [simulation.profile() for simulation in simulations]
            self._profiles_due = now + _NUMBERS

    def _drawn(self, lane: int, layer: Layer, simulation: Simulation) -> Draw:
        """What makes the marks of a layer, begun anew where the scene or its cells have changed."""
        now = (simulation.scene, *simulation.meshes.values())
        known = self._layers.get((lane, layer.name))
        if known is not None and all(a is b for a, b in zip(known[0], now, strict=True)):
            return known[1]
        draw = layer.begin(simulation)
        self._layers[lane, layer.name] = (now, draw)
        return draw

    def _colour(
        self, found: Mapping[tuple[int, str], tuple[Simulation, Seen]], field: str
    ) -> float:
        """Compute what is coloured, if it is due, or nodes or field are others than before.

        Gives the processor time that it took [s].
        """
        if not field:
            self._values.clear()
        same = field == self._values_of and all(
            key in self._values and self._values[key][0] is of_body
            for key, (_, of_body) in found.items()
        )
        self._values_of = field
        begun, before = time.monotonic(), time.thread_time()
        if not field or (same and not self.ration.is_due(begun)):
            return 0.0
        for (lane, body), (simulation, of_body) in found.items():
            try:
                values = FIELDS[field].values(simulation, body, of_body)
            except ParameterError:  # of a body that does not have it
                values = None
            self._values[lane, body] = (of_body, values)
        cost = time.thread_time() - before
        self.ration.spent(cost, begun=begun)
        return cost


def error_between(one: Simulation, other: Simulation) -> tuple[float, float] | None:
    """Mean and largest distance [m] of the nodes of one from those of the other.

    None where they have other nodes.
    """
    mine, others = one.positions, other.positions
    if {n: len(p) for n, p in mine.items()} != {n: len(p) for n, p in others.items()}:
        return None
    apart = np.concatenate([np.linalg.norm(mine[name] - others[name], axis=1) for name in mine])
    return float(apart.mean()), float(apart.max())
