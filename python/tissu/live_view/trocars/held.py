"""A simulated device and what holds it: the hand of the scene, or that of the browser."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Literal

import numpy as np

from tissu.errors import ParameterError
from tissu.live_view.trocars.browser_hand import BrowserHand
from tissu.scene.trocar.hand import Hand
from tissu.scene.trocar.tool import tag_of
from tissu.trocar import kinematics
from tissu.trocar.opened import hand_of, simulated

if TYPE_CHECKING:
    from tissu import _haptic
    from tissu.scene.trocar.device import SimulatedDevice
    from tissu.scene.trocar.trocar import Trocar
    from tissu.trocar.kinematics import Array

HandKind = Literal["scene", "browser"]

FOLLOW = 0.05
"""s in which a hand follows the page."""
FASTEST = 0.25
"""Of the trocar's limit of speed, at which a hand follows the page at most."""
BACK = 0.5
"""s in which the hand goes back to the path of the scene, at least."""
_HAND = Hand(times=(0.0,), points=((0.0, 0.0, 0.1),))
"""The hand of the browser on a device whose scene has none."""


class HeldDevice:
    """Between two ticks, in the thread that takes them.

    Attributes:
        device: what is read and written.
        hand: what holds it.
        wanted: where the hand of the browser wants the tool.
        tool: name of the tool that is in; None: none.
        next_tool: of the one that is to be in; None: none.
    """

    def __init__(self, trocar: Trocar, device: SimulatedDevice, hand: HandKind) -> None:
        """A device of the scene, with its first tool in."""
        self._trocar, self._part = trocar, device
        self.hand: HandKind = hand
        self._aimed: Array | None = None
        self.open()

    def open(self) -> None:
        """Another device, as the scene begins."""
        self.tool = self.next_tool = next(iter(self._trocar.tools.values()), None)
        self._make(None, 0.0)

    def open_at(self, joints: Array, since: float, tool: str | None) -> None:
        """Another device, at joints (4,) and a time of the scene's path [s]."""
        self.tool = self.next_tool = tool
        self._make(np.array(joints), since)

    def _make(self, joints: Array | None, since: float) -> None:
        part = self._part
        hand = (part.hand or _HAND).replace(lets_go=None) if self.hand == "browser" else None
        tag = self._tag(self.tool)
        self.device: _haptic.SimulatedDevice = simulated(
            self._trocar, part, tag, joints=joints, since=since, hand=hand
        )
        if self.tool is None:
            self.device.set_tool(0, False)
        self._since, self._follow_at = since, np.inf
        self._want_what_is()

    @property
    def path_time(self) -> float:
        """Where the hand of the scene is on its path [s]."""
        return self._since + self.device.time

    def before_ticks(self, seconds: float, *, out: bool) -> None:
        """Lead the hand, and go on with a change of the tool.

        Args:
            seconds: that the ticks will take.
            out: whether the ticks know that no tool is in.
        """
        if self.next_tool != self.tool:
            self._change_tool(out=out)
        if self.hand == "browser":
            self.wanted.pass_time(seconds, time.monotonic())
            if self._aimed is not self.wanted.joints:
                self._aim()
        elif self.device.time >= self._follow_at - 1e-9:
            self.device.follow()
            self._follow_at = np.inf

    def hold(self, hand: HandKind) -> bool:
        """Take another hand; the tool stays where it is meanwhile.

        Gives whether another device is needed: where the scene has no hand, or one that lets go.
        """
        before, self.hand = self.hand, hand
        part = self._part.hand
        if hand == before:
            return False
        if part is None or part.lets_go is not None:
            return True
        if hand == "browser":
            self._want_what_is()
        else:
            self._go_back(part)
        return False

    def take(self, tool: str | None) -> None:
        """Put another tool in, or none; the one that is in is taken out first.

        Raises:
            ParameterError: the trocar has no such tool.
        """
        known = self._trocar.tools.values()
        if tool is not None and tool not in known:
            raise ParameterError(f"found the tool '{tool}'; accepted: {', '.join(known)}, none")
        self.next_tool = tool

    def _change_tool(self, *, out: bool) -> None:
        if self.tool is not None:
            self.device.set_tool(0, False)
            self.tool = None
        elif out:
            self.device.set_tool(self._tag(self.next_tool), True)
            self.tool = self.next_tool

    def _aim(self) -> None:
        self._aimed = q = self.wanted.joints
        tip = kinematics.position(q)
        fastest = FASTEST * self._trocar.limits.speed
        self.device.aim(tip, q[2], max(FOLLOW, self._way_to(tip) / fastest))

    def _go_back(self, hand: Hand) -> None:
        """To where the path will be, and along it from then on."""
        path, now = hand_of(hand, self._part.seed, since=self._since), self.device.time
        easy = 0.5 * FASTEST * self._trocar.limits.speed
        over = max(BACK, self._way_to(path.wanted(now)[0]) / easy)
        tip, _, psi, _ = path.wanted(now + over)
        self.device.aim(tip, psi, over)
        self._follow_at = now + over

    def _way_to(self, tip: Array) -> float:
        return float(np.linalg.norm(tip - kinematics.position(self.device.joints)))

    def _want_what_is(self) -> None:
        self.wanted = BrowserHand(self._trocar.limits, self.device.joints)
        self._aimed = None

    def _tag(self, tool: str | None) -> int:
        tags = (tag_of(tag) for tag, name in self._trocar.tools.items() if name == tool)
        return next(tags, 0)
