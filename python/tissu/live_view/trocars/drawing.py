"""A trocar on the page: its port, its tool, the hand where it is elsewhere, and the force on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.marks import Marks
from tissu.trocar import kinematics

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tissu.live_view.trocars.live import LiveTrocar

    Floats = NDArray[np.float64]

SHAFT = 2.5e-3
"""Radius of a tool [m]: that of the thesis has a diameter of 5 mm."""
SLEEVE, SLEEVE_LENGTH = 5e-3, 24e-3
RING = 11e-3
GRIP, GRIP_LENGTH = 7e-3, 30e-3
ABOVE = 0.07
"""m of the tool outside the port at first."""
APART = 2e-4
"""m between the tips of the hand and of the tool, from which on the hand is drawn."""
STATES = {
    "off": (130, 130, 130),
    "homing": (150, 90, 190),
    "empty": (130, 130, 130),
    "free": (40, 150, 80),
    "contact": (20, 110, 200),
    "held": (225, 140, 0),
    "fault": (200, 30, 30),
}
"""Colour of the port's ring in each state."""
STEEL, PORT, GRIP_COLOUR = (196, 202, 208), (90, 100, 112), (60, 66, 74)
_HAND, _WANTED, FORCE, _EDGE = (20, 110, 200), (230, 120, 20), (200, 30, 60), (40, 40, 40)
_SIDES = 16


class TrocarDrawing:
    """Draws one trocar; its marks have the same order in every frame."""

    def __init__(self, live: LiveTrocar) -> None:
        """Look at where it begins."""
        port = live.trocar.port
        self.live = live
        self._turn, self._at = port.frame(), np.array(port.at)
        self._length = float(live.joints[3]) + ABOVE
        self._sleeve = self._in_scene(tube(-SLEEVE_LENGTH / 2, SLEEVE_LENGTH / 2, SLEEVE))
        self._ring = self._in_scene(ring(RING))
        self._unit = tube(0.0, 1.0, 1.0)

    @property
    def _end(self) -> float:
        """Of the grip, before the tip [m]."""
        return self._length + GRIP_LENGTH

    def first_points(self, arrow: float) -> Floats:
        """The port and the end of the tool with its arrow of a length [m] (2, 3) [m]."""
        top = kinematics.position(self.live.joints, (0.0, 0.0, -self._end - arrow))
        return np.array([self._at, self._in_scene(top)])

    def marks(self, arrow: float) -> list[Marks]:
        """Everything, with an arrow of a length [m] for 1 N."""
        live, felt = self.live, self.live.felt
        tool = live.joints if felt is None else felt.joints
        self._length = max(self._length, float(tool[3]) + GRIP_LENGTH)
        inside = live.controller.tool if felt is None else felt.tool
        state = live.controller.report().state.name
        shown = tool if inside is not None else live.joints
        top = self._place(shown, -self._end)
        force = np.zeros(3) if felt is None else felt.fast
        size = float(np.linalg.norm(force))
        words = f"{live.name}: {state}" + ("" if inside is None else f", {inside}")
        words += f", {size:.2f} N" if inside is not None else ""
        label = ((self._at + RING * self._turn[:, 0], words),)
        return [
            *(self._ring_of(name, state, colour) for name, colour in STATES.items()),
            Marks(PORT, surface=self._sleeve, opacity=0.45, labels=label),
            Marks(STEEL, surface=self._tube(shown, SHAFT, (2.0 * SHAFT, self._length))),
            Marks(GRIP_COLOUR, surface=self._tube(shown, GRIP, (self._length, self._end))),
            Marks(FORCE, arrows=_arrow(top, force, arrow)),
            self._hand(tool, inside is not None),
            self._wanted(),
            self._edges(inside),
        ]

    def _ring_of(self, name: str, state: str, colour: tuple[int, int, int]) -> Marks:
        return Marks(colour, lines=self._ring if name == state else np.empty((0, 2, 3)))

    def _hand(self, tool: Floats, inside: bool) -> Marks:
        """The hand as a line beside the tool, where they are apart."""
        mine = self.live.joints
        apart = float(np.linalg.norm(kinematics.position(mine) - kinematics.position(tool)))
        if not inside or apart < APART:
            return Marks(_HAND)
        ends = [self._place(mine, -self._end), self._place(mine, 0.0)]
        return Marks(_HAND, lines=np.array([ends]), points=np.array([ends[1]]))

    def _wanted(self) -> Marks:
        """Where a page wants the tip."""
        if self.live.hand != "browser":
            return Marks(_WANTED)
        return Marks(_WANTED, points=self._place(self.live.wanted, 0.0)[None])

    def _edges(self, tool: str | None) -> Marks:
        """The edge of an instrument."""
        simulation = self.live.simulation
        if tool is None or tool not in simulation.scene.instruments:
            return Marks(_EDGE)
        edge = simulation.instruments[tool].edge
        return Marks(_EDGE, lines=np.stack([edge[:-1], edge[1:]], axis=1))

    def _place(self, q: Floats, along: float) -> Floats:
        """Place in the scene (3,) of a point of the tool's axis."""
        return self._in_scene(kinematics.position(q, (0.0, 0.0, along)))

    def _tube(self, q: Floats, radius: float, span: tuple[float, float]) -> Floats:
        """A part of the tool in the scene, from and to a distance before its tip [m]."""
        before = span[0] + self._unit[..., 2:] * (span[1] - span[0])
        local = np.concatenate([radius * self._unit[..., :2], q[3] - before], axis=-1)
        return self._in_scene(local @ kinematics.rotation(q).T)

    def _in_scene(self, places: Floats) -> Floats:
        return np.asarray(self._at + places @ self._turn.T)


def _arrow(foot: Floats, force: Floats, length: float) -> Floats:
    """From a foot along a force, of a length [m] for 1 N; nothing where it is too short."""
    along = length * force
    if float(np.linalg.norm(along)) < 1e-4:
        return np.empty((0, 2, 3))
    return np.array([[foot, foot + along]])


def ring(radius: float) -> Floats:
    """A circle about the axis as lines (s, 2, 3)."""
    angles = np.linspace(0.0, 2.0 * np.pi, 2 * _SIDES + 1)
    at = radius * np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=1)
    return np.stack([at[:-1], at[1:]], axis=1)


def tube(low: float, high: float, radius: float) -> Floats:
    """A closed cylinder along the axis as triangles (t, 3, 3), facing out."""
    angles = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    circle = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    one, two = circle[:-1], circle[1:]
    z = np.ones((_SIDES, 1))
    a, b = np.hstack([one, low * z]), np.hstack([two, low * z])
    c, d = np.hstack([one, high * z]), np.hstack([two, high * z])
    foot, head = np.array([0.0, 0.0, low]), np.array([0.0, 0.0, high])
    sides = [np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)]
    caps = [
        np.stack([np.broadcast_to(foot, a.shape), b, a], axis=1),
        np.stack([np.broadcast_to(head, c.shape), c, d], axis=1),
    ]
    return np.concatenate([*sides, *caps])
