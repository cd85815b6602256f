"""One trocar of one simulation that is shown: its controller, its touch, and what holds it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.errors import ParameterError
from tissu.live_view.trocars.frame import COLUMNS, TrocarFrame
from tissu.live_view.trocars.held import HandKind, HeldDevice
from tissu.live_view.trocars.history import History
from tissu.scene.trocar.device import SimulatedDevice
from tissu.trocar import kinematics
from tissu.trocar.controller import Controller
from tissu.trocar.states import State
from tissu.trocar.touch import Felt, Touch

if TYPE_CHECKING:
    from tissu.simulation import Simulation
    from tissu.trocar.kinematics import Array

Moment = tuple["Array", float, "str | None"]
"""Of a trocar: joints (4,), time of the path of its hand [s], and its tool."""

UNTOUCHED = 0.5
"""s of simulated time without a force, after which another touch begins."""
CUT_MOMENT = 1.0
"""s of simulated time from one moment of a knife to the next."""
_SOON = 100
"""Ticks within which a tool that is in gives force."""


class LiveTrocar:
    """A trocar in the thread that owns the simulations.

    Attributes:
        name: of the trocar.
        lane: number of its simulation.
        simulation: whose scene has it.
        trocar: that part of the scene.
        held: its device with what holds it, where that is simulated; else None.
        controller: that holds its device.
        touch: that couples it with the tissue.
        joints: (4,) where the hand had the device when the tool was led last.
        felt: what the latest step felt; None: none was taken.
        touch_begun: whether a touch has begun that is to be remembered; set back by the reader.
    """

    def __init__(
        self,
        simulation: Simulation,
        name: str,
        lane: int,
        *,
        hand: HandKind = "scene",
        trust_plugins: bool = False,
    ) -> None:
        """Open the device and switch it on.

        Raises:
            TissuError: the device is not there, does not answer, or has another controller.
            ParameterError: what `Controller` and `Touch` refuse; the hand of the browser on a
                device that is not simulated.
        """
        self.name, self.lane, self.simulation = name, lane, simulation
        self.trocar = simulation.scene.trocars[name]
        self._trust = trust_plugins
        device = self.trocar.device
        self.held: HeldDevice | None = None
        if isinstance(device, SimulatedDevice):
            self.held = HeldDevice(self.trocar, device, hand)
        elif hand == "browser":
            self._simulated("the hand of the browser")
        self._history = History(len(COLUMNS) - 1)
        self.felt: Felt | None = None
        self._touched = -np.inf
        self.controller = self._opened()
        self._begin()

    @property
    def hand(self) -> str:
        """What leads it: scene, browser or device."""
        return "device" if self.held is None else self.held.hand

    # ---- around a step of its simulation

    def before_step(self) -> None:
        """The tool goes to where the ticks have it."""
        report = self.controller.report()
        if self.held is not None:
            out = not report.state.gives_force and report.state is not State.held
            self.held.before_ticks(self.simulation.dt, out=out)
        self.joints = np.array(report.q)
        self.touch.lead()

    def after_step(self) -> None:
        """The ticks feel the contacts of the step."""
        self.felt = felt = self.touch.hand_on()
        report = self.controller.report()
        slow, fast = (float(np.linalg.norm(force)) for force in (felt.force, felt.fast))
        self._history.add(felt.time, (slow, fast, *report.torque, *report.q))
        cuts = felt.tool in self.simulation.scene.instruments
        if cuts and felt.time - self._touched >= CUT_MOMENT:
            self._touched, self.touch_begun = felt.time, True
        elif not cuts and felt.state == "contact":
            self.touch_begun |= felt.time - self._touched >= UNTOUCHED
            self._touched = felt.time

    # ---- what a page asks for, between two steps

    def hold(self, hand: HandKind) -> None:
        """Take the hand of the scene or of the browser; the tool stays where it is meanwhile.

        Raises:
            ParameterError: the device is not simulated.
        """
        held = self._simulated("another hand")
        if held.hold(hand):
            self._again(held.device.joints, held.path_time, held.tool)

    def take(self, tool: str | None) -> None:
        """Put another tool in, or none; the one that is in is taken out first.

        Raises:
            ParameterError: the device is not simulated, or has no such tool.
        """
        self._simulated("another tool").take(tool)

    def want(self, axis: int, value: float) -> None:
        """Want a joint [rad or m] there, as far as the limits let it.

        Raises:
            ParameterError: the device is not simulated.
        """
        wanted = self._simulated("another hand").wanted
        joints = wanted.joints.copy()
        joints[axis] = value
        wanted.to(joints)

    def want_pose(self, tip: Array, turn: Array) -> None:
        """Want the tip (3,) [m] there, and the tool turned about its axis; both in the scene.

        Raises:
            ParameterError: the device is not simulated.
        """
        inwards = self.trocar.port.frame().T
        place = inwards @ (tip - np.array(self.trocar.port.at))
        self._simulated("another hand").wanted.to_tip(place, inwards @ turn)

    def hear(self, sticks: Array, now: float) -> None:
        """What a gamepad says; see `BrowserHand.hear`.

        Raises:
            ParameterError: the device is not simulated.
        """
        self._simulated("another hand").wanted.hear(sticks, now)

    def cure(self) -> None:
        """Go on after the trocar was held; after a fault begin again with homing."""
        state, held = self.controller.report().state, self.held
        if state is State.held:
            self.controller.acknowledge()
        elif state is State.fault and held is not None:
            self._again(held.device.joints, held.path_time, held.tool)
        elif state is State.fault:
            self.controller.stop()
            self.controller.start()

    def moment(self) -> Moment:
        """Where it is now, to come back to."""
        held = self.held
        if held is None:
            return np.array(self.controller.report().q), 0.0, None
        return np.array(held.device.joints), held.path_time, held.tool

    def come_back(self, moment: Moment) -> None:
        """Go on from a moment after the simulation did; only a simulated device can."""
        self._touched, self.touch_begun = self.simulation.time, False
        if self.held is None:
            return
        self._again(*moment)
        for _ in range(_SOON):  # the tissue keeps the tool where it is meanwhile
            if self.held.tool is None or self.controller.report().state.gives_force:
                return
            self.controller.step(1)

    def begin_again(self) -> None:
        """After the simulation has begun again."""
        if self.held is not None:
            self.held.open()
            self.controller.stop()
            self.controller = self._opened()
        self._history.clear()
        self._begin(started=self.held is None)

    def close(self) -> None:
        """Switch the motors off."""
        self.controller.stop()

    # ---- what it says

    def wanted_pose(self) -> tuple[Array, Array]:
        """Where the hand of the browser wants the tip (3,) [m], and its rotation, in the scene."""
        port, q = self.trocar.port, self.wanted
        turn = port.frame()
        return np.array(port.at) + turn @ kinematics.position(q), turn @ kinematics.rotation(q)

    @property
    def wanted(self) -> Array:
        """Joints (4,) that the hand of the browser wants."""
        return self.joints if self.held is None else self.held.wanted.joints

    def frame(self, length: float) -> TrocarFrame:
        """The present moment; `length` of the arrow of 1 N [m]."""
        report, felt = self.controller.report(), self.felt
        slow, fast, ahead, contacts = 0.0, 0.0, 0.0, 0
        if felt is not None:
            slow, fast = (float(np.linalg.norm(force)) for force in (felt.force, felt.fast))
            here, there = kinematics.position(felt.joints), kinematics.position(self.joints)
            ahead, contacts = float(np.linalg.norm(there - here)), felt.contacts
        return TrocarFrame(
            name=self.name,
            lane=self.lane,
            state=report.state.name,
            problem=report.problem,
            tool=report.tool,
            next_tool=None if self.held is None else self.held.next_tool,
            hand=self.hand,
            slow=slow,
            fast=fast,
            torque=np.array(report.torque),
            joints=np.array(report.q),
            wanted=self.wanted,
            ahead=ahead,
            contacts=contacts,
            length=length,
            history=self._history.shown(),
        )

    # ---- its device

    def _opened(self) -> Controller:
        """A controller of its device that is not on yet."""
        if self.held is None:
            return Controller(self.trocar, mode="threaded", trust_plugins=self._trust)
        return Controller(self.trocar, device=self.held.device)

    def _begin(self, *, started: bool = False) -> None:
        """At the beginning of the simulation: with the tools where the scene has them."""
        self.touch = Touch(self.simulation, self.controller)
        self.felt = None
        self.touch_begun, self._touched = False, -np.inf
        if not started:
            self.controller.start()
        now = self.controller.report().q if self.held is None else self.held.device.joints
        self.joints = np.array(now)

    def _again(self, joints: Array, since: float, tool: str | None) -> None:
        """Another simulated device, with the tool at joints (4,)."""
        assert self.held is not None
        self.controller.stop()
        self.held.open_at(joints, since, tool)
        self.controller = self.touch.controller = self._opened()
        self.controller.start()

    def _simulated(self, what: str) -> HeldDevice:
        """Its device with what holds it; refuses where that is not simulated."""
        if self.held is None:
            text = f"found {what} for trocars.{self.name}, a device of type "
            text += f"{self.trocar.device.type}; only a simulated one takes it: its own hand leads "
            raise ParameterError(f"{text}it")
        return self.held
