"""The slow side of a trocar: tissue moves its tool, and is handed to the ticks.

    simulation = scene.compile()
    with Controller(scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(100):
            felt = touch.step()
            print(felt.time, felt.force, felt.fast)

In each step the tool goes to where the ticks have their proxy, the scene takes its step, and its
contacts become the model that the ticks feel until the next one:

    x = anchor - W lambda,   W = h^2 H (M + h C + h^2 K)^-1 H^T

with the rows H of the contacts' points of the tissue, of the matrices at the end of the step. The
anchor is where the points go in the next step without the forces lambda of the tool on them. The
proxy is that of Zilles and Salisbury 1995.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from tissu.errors import ParameterError
from tissu.reading import written
from tissu.trocar import kinematics
from tissu.trocar.model import MOST_CONTACTS, Blade, LocalModel, across
from tissu.trocar.pressed import Pressing
from tissu.trocar.touched import compliance, merged, met_by, nearest, pressing

if TYPE_CHECKING:
    from tissu.simulation import Simulation
    from tissu.trocar.controller import Controller
    from tissu.trocar.kinematics import Array

OUT = 0.1
"""s in which the obstacle of a tool that was taken out goes back to where the scene has it."""
IN = 0.3
"""s in which the obstacle of a tool that has come in goes to where the ticks have their proxy: the
ramp of the coupling."""
_LEAST_SHARE = 1e-6
"""of K_c, below which the ticks have no proxy"""


@dataclass(frozen=True, slots=True)
class Felt:
    """What a step of the scene and its ticks felt.

    Attributes:
        time: of the scene at the end [s].
        joints: (4,) of the proxy that the tool was led to.
        tip: (3,) where the tip of the tool is in the scene [m].
        force: (3,) on the tool by the contacts of the slow step [N].
        fast: (3,) on the tool by contacts and blade, as the last tick had it, before limits [N].
        contacts: how many the ticks were given.
        tool: name of the obstacle or instrument; None: none that the scene knows was in.
        state: of the trocar, by name.
        limited: whether a limit cut the torques of the last tick.
    """

    time: float
    joints: Array
    tip: Array
    force: Array
    fast: Array
    contacts: int
    tool: str | None
    state: str
    limited: bool = False


class Touch:
    """One trocar in one simulation; its obstacles are drawn with the tool straight in the port.

    The tip is the point of an obstacle that lies deepest along the port's axis. Ticks are taken
    between the steps where the controller is stepped; a threaded controller goes on by itself.

    Attributes:
        simulation: of the scene.
        controller: of the trocar.
        compliance: how the tissue's compliance is found, and how well.
        largest_error: of the compliance so far, as its bound says.
    """

    def __init__(self, simulation: Simulation, controller: Controller) -> None:
        """Find the tools of the trocar among the obstacles and instruments of the scene.

        Raises:
            ParameterError: none of the tools is in the scene; a way of compliance that the scene
                does not allow; something else than a simulation and a controller.
        """
        _refuse_others(simulation, controller)
        self.simulation, self.controller = simulation, controller
        port = controller.trocar.port
        self._turn, self._at = port.frame(), np.array(port.at)
        scene, tools = simulation.scene, controller.trocar.tools.values()
        self._instruments = [name for name in tools if name in scene.instruments]
        self._depths: dict[str, float] = {}
        for name in tools:
            if name in scene.obstacles:
                places = simulation.obstacle_surface(name).points
                self._depths[name] = float(((places - self._at) @ self._turn[:, 2]).max())
        if not self._depths and not self._instruments:
            names = ", ".join(tools) or "none"
            text = f"found no obstacle and no instrument among the tools of the trocar ({names}); "
            raise ParameterError(text + "name one of the scene in `tools`")
        self._dt = simulation.dt
        controller.expect_models(every=self._dt)
        self._led: str | None = None
        self._due = 0.0
        self._tool: str | None = None
        self._joints: Array = np.zeros(4)
        self._given: LocalModel | None = None
        self._held = False
        self._left = 0.0  # s of the way in
        self._behind: Array = np.zeros(4)  # joints from the tool to the proxy, on the way in
        self._aimed: Array = np.zeros(4)  # where the proxy was
        self._out: dict[str, tuple[Array, float]] = {}  # where and when a tool went out
        self.largest_error = 0.0
        met = met_by(simulation, list(self._depths))
        self.compliance = simulation.compliance(by=controller.trocar.compliance, bodies=met)

    def step(self) -> Felt:
        """One step of the scene with the tool where the ticks have it, a new model, and its ticks.

        Raises:
            Diverged: the scene's step failed.
        """
        self.lead()
        self.simulation.step()
        return self.hand_on()

    def lead(self) -> None:
        """Before a step of the scene: the tool goes to where the ticks have their proxy."""
        joints, tool = self._proxy()
        self._aimed = joints
        if self._led in self._depths and tool != self._led:
            self._out[self._led] = (self._joints, self.simulation.time)
            self.simulation.obstacle(self._led).release(over=OUT)
        elif self._led is not None and tool != self._led:
            self.simulation.instruments[self._led].place(self._at, self._turn)
        if tool in self._depths:
            joints = self._on_the_way_in(tool, joints)
            self._lead(tool, joints)
        elif tool is not None:
            turn = self._turn @ kinematics.rotation(joints)
            tip = self._at + self._turn @ kinematics.position(joints)
            instrument = self.simulation.instruments[tool]
            (instrument.move if tool == self._led else instrument.place)(tip, turn)
        self._joints, self._tool, self._led = joints, tool, tool

    def hand_on(self) -> Felt:
        """After a step of the scene: its contacts go to the ticks, which run where stepped."""
        joints, tool = self._joints, self._tool
        model, force = self._model(tool, joints)
        self._given = model if tool in self._depths else None
        self.controller.publish(model)
        if self.controller.mode != "threaded":
            # What is left of a tick counts in the next step, so that both clocks go on together.
            self._due += self.controller.trocar.rate * self._dt
            ticks = int(self._due + 1e-9)
            self._due -= ticks
            if ticks > 0:
                self.controller.step(ticks)
        report = self.controller.report()
        return Felt(
            time=self.simulation.time,
            joints=joints,
            tip=self._at + self._turn @ kinematics.position(joints),
            force=force,
            fast=report.force,
            contacts=len(model.points),
            tool=tool,
            state=report.state.name,
            limited=report.limited,
        )

    def _proxy(self) -> tuple[Array, str | None]:
        """Joints of the proxy, and the tool that is led: one that is in, while the tissue is felt.

        At end stops it stands there. Where a limit cuts the torque the hand is stronger than the
        device and goes on; the tool stays where the tissue gives the limit's force back.
        """
        report = self.controller.report()
        known = report.tool in self._depths or report.tool in self._instruments
        tool = report.tool if known and report.state.gives_force else None
        limits = self.controller.trocar.limits
        stiffness = report.coupling * self.controller.stiffness()
        if report.coupling > _LEAST_SHARE:
            joints = report.q + report.torque / stiffness
        else:  # nothing pulls the tool: it stays
            joints = self._aimed.copy() if tool is not None and tool == self._led else report.q
        joints[:2] = np.clip(joints[:2], -limits.tilt, limits.tilt)
        joints[3] = min(joints[3], limits.depth)
        held = report.limited or self._held
        self._held = False
        if held and self._given is not None and tool == self._led:
            wanted = joints
            joints = Pressing(self._given, stiffness, limits).held(self._aimed, wanted)
            self._held = joints is not wanted
        return joints, tool

    def _on_the_way_in(self, tool: str, wanted: Array) -> Array:
        """Joints of a tool: a tool that came in goes from its place to the proxy's in a while.

        The way that is left is behind the hand: the contacts go to the ticks as if they were that
        much deeper, so that hand and tissue feel one force, which rises from nothing.
        """
        if tool != self._led:
            home = np.array([0.0, 0.0, 0.0, self._depths[tool]])
            place, since = self._out.pop(tool, (home, -np.inf))
            back = min(1.0, (self.simulation.time - since) / OUT)
            self._left, self._behind = IN, _way(place + back * _way(place, home), wanted)
        self._left, self._behind = self._left_then()
        return wanted - self._behind

    def _left_then(self) -> tuple[float, Array]:
        """What will be left of the way in after a step: time [s], and joints (4,)."""
        left = max(0.0, self._left - self._dt)
        if left < 0.5 * self._dt:
            return 0.0, np.zeros(4)
        return left, self._behind * (left / self._left)

    def _lead(self, tool: str, joints: Array) -> None:
        """The obstacle goes to the tool's pose: x = at + Q (X - at) + R (r - r0)."""
        own = kinematics.rotation(joints)
        Q = self._turn @ own @ self._turn.T
        way = self._turn @ own @ np.array([0.0, 0.0, joints[3] - self._depths[tool]])
        angle, axis = _angle_axis(Q)
        self.simulation.obstacle(tool).move(way, angle=angle, axis=axis, center=self._at)

    def _model(self, tool: str | None, joints: Array) -> tuple[LocalModel, Array]:
        """The contacts of the tool at the end of the step, and the force on the tool [N]."""
        if tool is None:
            return LocalModel(joints), np.zeros(3)
        if tool in self._instruments:
            return self._bladed(tool, joints)
        touched = pressing(self.simulation, tool) or nearest(self.simulation, tool)
        if not touched:
            return LocalModel(joints), np.zeros(3)
        kept = merged(touched, MOST_CONTACTS)
        normals = self.controller.turned_into_port(np.array([one.normal for one in kept]))
        tangents = np.array([across(n) for n in normals])
        axes = np.stack([normals, tangents, np.cross(normals, tangents)], axis=1)
        directions = np.einsum("mij,kj->mik", axes, self._turn)
        W = compliance(self.compliance, kept, directions)
        self.largest_error = max(self.largest_error, self.compliance.error)
        forces = self.controller.turned_into_port(np.array([one.force for one in kept]))
        local = np.einsum("mij,mj->mi", axes, forces)
        places = self.controller.into_port(np.array([one.point for one in kept]))
        back = self.compliance.drift + W @ local.ravel()
        given = np.einsum("mi,mij->mj", back.reshape(-1, 3), axes)
        points = places @ kinematics.rotation(joints) - np.array([0.0, 0.0, joints[3]])
        proxy = joints + self._behind
        # In the next step the tool will be nearer to a proxy on its way in.
        then = proxy - self._left_then()[1]
        moved = np.array(
            [kinematics.position(proxy, at) - kinematics.position(then, at) for at in points]
        )
        model = LocalModel(
            joints=proxy,
            points=points,
            anchors=places + moved - np.array([o.gap for o in kept])[:, None] * normals + given,
            normals=normals,
            tangents=tangents,
            friction=np.array([one.friction for one in kept]),
            forces=local,
            compliance=W,
        )
        return model, np.sum([one.force for one in kept], axis=0)

    def _bladed(self, tool: str, joints: Array) -> tuple[LocalModel, Array]:
        """What a blade has to overcome: at most its force of the slow step, against its way."""
        instrument = self.simulation.scene.instruments[tool]
        if getattr(instrument, "toughness", None) is None:
            return LocalModel(joints), np.zeros(3)
        force = self.simulation.instruments[tool].force
        size = float(np.linalg.norm(force))
        if not size > 0.0:
            return LocalModel(joints), np.zeros(3)
        way = self._turn.T @ (-force / size)
        place = kinematics.position(joints)
        blade = Blade((0.0, 0.0, 0.0), way, place, 0.0, size)
        return LocalModel(joints, blade=blade), np.asarray(force)


def _refuse_others(simulation: object, controller: object) -> None:
    """What is not a simulation, or not a controller."""
    from tissu.scene.scene import SceneData
    from tissu.trocar.controller import Controller

    if not isinstance(getattr(simulation, "scene", None), SceneData):
        text = f"found the simulation {written(simulation)}; a compiled scene is accepted: "
        raise ParameterError(text + "scene.compile()")
    if not isinstance(controller, Controller):
        text = f"found the controller {written(controller)}; the one of a trocar is accepted: "
        raise ParameterError(text + 'Controller(scene.trocars["right"])')


def _way(joints: Array, to: Array) -> Array:
    """From joints to others (4,), with the shorter turn of the own rotation."""
    way = to - joints
    way[2] = np.remainder(way[2] + np.pi, 2.0 * np.pi) - np.pi
    return np.asarray(way)


def _angle_axis(Q: Array) -> tuple[float, Array]:
    """Of a rotation matrix."""
    axis = np.array([Q[2, 1] - Q[1, 2], Q[0, 2] - Q[2, 0], Q[1, 0] - Q[0, 1]])
    sine = 0.5 * float(np.linalg.norm(axis))
    angle = float(np.arctan2(sine, 0.5 * (np.trace(Q) - 1.0)))
    if sine > 1e-12:
        return angle, axis / (2.0 * sine)
    if angle < 1.0:
        return 0.0, np.array([0.0, 0.0, 1.0])
    values, vectors = np.linalg.eigh(0.5 * (Q + Q.T))
    return angle, np.asarray(vectors[:, np.argmax(values)])
