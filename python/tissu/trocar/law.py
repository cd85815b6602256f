"""One tick of a trocar, in NumPy: the readable statement, and the oracle of the C++ tick.

From a sample of the device and the newest model of the tissue to torques:

    g = g0 + G (q_d - q_ref) + A lambda,   A = W + G K_c^-1 G^T,   tau = G^T lambda

with end stops as rows of their own, through the energy tank, the limits and the transmission. It
computes what `tissu._haptic` computes, to 1e-12, for devices that know their zero: driving to the
end stops is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tissu.trocar import kinematics, motors
from tissu.trocar.kinematics import AXES, Array
from tissu.trocar.law_states import change_state, model_age
from tissu.trocar.patch import Block, Patch
from tissu.trocar.sample import Motion, Offered, Sample
from tissu.trocar.states import Flag, Reason, State, Status
from tissu.trocar.tank import Tank
from tissu.trocar.velocity import WINDOW, speed

_LEAST_SCALE = 1e-6
"""Share of K_c below which nothing is felt."""
_STOPPED = (0, 1, 3)
"""Axes with end stops: pitch, roll, depth."""


class Law:
    """A trocar between two ticks: what it remembers, and the tick that changes it."""

    def __init__(self, settings: Mapping[str, Any]) -> None:
        """Begin, off.

        Args:
            settings: what the controller decides, by the names of `tissu._haptic.Run.settings`.
        """
        self.settings = dict(settings)
        self.state, self.reason = State.off, Reason.none
        self.acknowledged = self.settings["acknowledged"]
        self.sample: Sample | None = None
        self.failed_reads = self.failed_writes = self.other_tag = self.bad_models = 0
        self.tag, self.turn = 0, 0
        self.homed = self.device_homed = False
        self.q: Array = np.zeros(AXES)
        self.limited = False
        self.window: list[Array] = []
        self.model: Offered | None = None
        self.refused = 0
        self.G: Array = np.zeros((0, AXES))
        self.g0: Array = np.zeros(0)
        self.force_sum: Array = np.zeros(3)
        self.force_ticks, self.disagreement = 0, 0.0
        self.tank = Tank(
            self.settings["tank_start"],
            self.settings["tank_cap"],
            self.settings["tank_reserve"],
            self.settings["tank_credit"],
            self.settings["tank_gate"],
        )
        self.ramp = self.age = 0.0
        self.torque: Array = np.zeros(AXES)
        self.paid: Array = np.zeros(AXES)
        self._drop()

    def _drop(self) -> None:
        """No force any more."""
        rows = len(self.g0) + len(_STOPPED)
        self.forces: Array = np.zeros(rows)
        self.slip: Array = np.zeros(rows)
        self.shift: Array = np.zeros(rows)
        self.scale, self.share, self.stored = 0.0, 1.0, 0.0
        self.force_sum, self.force_ticks = np.zeros(3), 0

    def tick(
        self,
        sample: Sample | None,
        offered: Offered | None,
        *,
        now_ns: int,
        late: int = 0,
        read: Status = Status.ok,
        written: Status = Status.ok,
    ) -> Array:
        """One tick.

        Args:
            sample: what was read; None, or another status than ok: nothing was.
            offered: the newest model.
            now_ns: time of the tick [ns].
            late: ticks that were missed before this one.
            read: how reading went.
            written: how writing the last command went.

        Returns:
            The torques (4,) of the motors [N m, N m, N m, N].
        """
        motion = self._take(sample if read is Status.ok else None, late, written)
        age = self.age = model_age(offered or self.model, now_ns)
        change_state(self, motion, age, late, read, written)
        wanted = self._model_torques(motion, offered, age)
        if self.state in (State.off, State.fault):
            self.torque, self.paid, self.window = np.zeros(AXES), np.zeros(AXES), []
            return np.zeros(AXES)
        slewed = motors.felt(self.settings, self.q, self.torque, wanted)
        command, self.paid = motors.command(self.settings, self.q, slewed, motion.speed)
        cut = motors.saturated(self.settings, self.q, wanted) != wanted
        self.limited = bool(np.any(cut | (np.abs(command) >= self.settings["torque_limit"])))
        self.torque = slewed
        return command

    def felt(self) -> dict[str, Any]:
        """What the tissue does to the tool: its force (3,) in the port [N], contacts, age."""
        model, force, borne = self.model, np.zeros(3), 0
        if model is not None:
            for D, own in zip(model.model.directions(), self._cones(), strict=True):
                force, borne = force + D.T @ own, borne + int(own[0] > 0.0)
            blade = model.model.blade
            if blade is not None:
                force = force + np.asarray(blade.way) * self.forces[3 * len(model.model.friction)]
        return {
            "force": force,
            "contacts": borne,
            "model_age": self.age,
            "limited": self.limited,
            "disagreement": self.disagreement,
        }

    def _contact_force(self) -> Array:
        """Of all contacts on the tool, without a blade (3,) [N]."""
        force: Array = np.zeros(3)
        if self.model is not None:
            for D, own in zip(self.model.model.directions(), self._cones(), strict=True):
                force = force + D.T @ own
        return force

    def _cones(self) -> Array:
        """Forces (m, 3) of the contacts along their directions [N]."""
        count = 0 if self.model is None else len(self.model.model.friction)
        return np.reshape(self.forces[: 3 * count], (-1, 3))

    # ---- sample

    def _take(self, sample: Sample | None, late: int, written: Status) -> Motion:
        """Counts to q, windows, speeds."""
        self.failed_writes = 0 if written is Status.ok else self.failed_writes + 1
        motion = Motion()
        if sample is None:
            self.failed_reads += 1
            return motion
        s, before, was_homed = self.settings, self.sample, self.homed
        turned = 0 if before is None else sample.counts[2] - before.counts[2]
        turned = (turned + 2**31) % 2**32 - 2**31  # counts are 32 bits wide, and wrap
        if s["turn_counts"] > 0:
            turned -= round(turned / s["turn_counts"]) * s["turn_counts"]
        self.turn = sample.counts[2] if before is None else self.turn + turned
        counts = np.array([*sample.counts[:2], self.turn, sample.counts[3]], dtype=float)
        self.sample, motion.fresh = sample, True
        # A device that knew its zero and does not any more has lost it.
        if sample.has(Flag.homed) or self.device_homed:
            self.homed = sample.has(Flag.homed)
        self.device_homed = sample.has(Flag.homed)
        q = counts * s["count_size"]
        gap, self.failed_reads = self.failed_reads + late, 0
        if before is None or self.homed != was_homed:
            self.window = []
        else:
            motion.step = q - self.q
            least = np.maximum(0.0, np.abs(motion.step) - 2.0 * s["count_size"])
            tip = kinematics.jacobian(q, kinematics.position(q)) @ (least * np.sign(motion.step))
            motion.fast = self.homed and bool(
                np.linalg.norm(tip) > s["speed_limit"] * s["period"] * (1 + gap)
            )
            self.window = [] if gap > 0 else self.window
        self.q = q
        self.window = [*self.window, q][-WINDOW:]
        columns = zip(np.transpose(self.window), s["count_size"], strict=True)
        motion.speed = np.array([speed(list(c), size, s["period"]) for c, size in columns])
        return motion

    # ---- tissue

    def _model_torques(self, motion: Motion, offered: Offered | None, age: float) -> Array:
        """Torques (4,) of tissue, stops and dampers on the joints, through the tank."""
        s = self.settings
        if not self.state.gives_force:
            if self.state is not State.homing:  # the tank does not pay what drives the axes
                self._settle(motion, 0.0)
            self._drop()
            return np.zeros(AXES)
        self._solve_current(motion)
        self.tank.observe(s["period"])
        scale = self._wanted_scale(age)
        if self._take_model(offered) or scale != self.scale or self.share != 1.0:
            self._adopt(scale)
        self.force_sum = self.force_sum + self._contact_force()
        self.force_ticks += 1
        self.state = State.contact if np.any(self.forces) else State.free
        damping = self.tank.damping(
            s["viscous"], motion.speed, 2.0 * s["count_size"] / s["period"], s["period"]
        )
        rows = np.vstack([self.G, self._stops()[0]])
        return np.asarray(rows.T @ self.forces + damping - s["damping"] * motion.speed)

    def _stops(self) -> tuple[Array, Array]:
        """Rows (3, 4) of the end stops and their gaps (3,), at the end that is nearer."""
        G, gaps = np.zeros((len(_STOPPED), AXES)), np.zeros(len(_STOPPED))
        low, high = self.settings["joint_low"], self.settings["joint_high"]
        for row, axis in enumerate(_STOPPED):
            at_low = axis != 3 and self.q[axis] < 0.5 * (low[axis] + high[axis])
            G[row, axis] = 1.0 if at_low else -1.0
            end = low[axis] if at_low else high[axis]
            gaps[row] = G[row, axis] * (self.q[axis] - end)
        return G, gaps

    def _patch(self, scale: float, shift: Array) -> Patch:
        """Contacts, blade and stops at this tick's joints, on K_c times a scale."""
        stops, gaps = self._stops()
        G = np.vstack([self.G, stops])
        A = G @ np.diag(1.0 / (scale * self.settings["stiffness"])) @ G.T
        b = np.concatenate([self.g0, gaps]) + shift
        blocks = []
        if self.model is not None:
            model, count = self.model.model, len(self.model.model.friction)
            b[: len(self.g0)] += self.G @ (self.q - model.joints)
            A[: 3 * count, : 3 * count] += model.settled()
            blocks = [Block("cone", 3 * k, float(model.friction[k])) for k in range(count)]
            if model.blade is not None:
                A[3 * count, 3 * count] += model.blade.compliance
                blocks.append(Block("bounded", 3 * count, model.blade.limit))
        blocks += [Block("push", len(self.g0) + k) for k in range(len(_STOPPED))]
        return Patch(b, A, blocks)

    def _solve(self, scale: float, shift: Array, start: Array) -> tuple[Patch, Array, float]:
        """The forces; what slips takes its tangential rest along, in `shift` and in the patch."""
        s = self.settings
        patch = self._patch(scale, shift)
        forces, _ = patch.solve(start, sweeps=s["sweeps"], tolerance=s["tolerance"])
        stored, rest = patch.stored(forces), patch.gaps(forces)
        for block in patch.blocks:
            if block.kind == "push":
                continue
            at = slice(block.row + 1, block.row + 3) if block.kind == "cone" else block.rows
            borne = np.linalg.norm(forces[at])
            most = block.bound * (forces[block.row] if block.kind == "cone" else 1.0)
            if borne >= (1.0 - 1e-9) * most:
                shift[at] -= rest[at]
                patch.b[at] -= rest[at]
        return patch, forces, stored

    def _solve_current(self, motion: Motion) -> None:
        """The forces of the model in use, and the tank after them."""
        stored = 0.0
        if self.scale > _LEAST_SCALE:
            _, self.forces, stored = self._solve(self.scale, self.shift, self.forces)
            if self.share == 1.0:
                self.slip = self.shift.copy()
        else:
            self.forces = np.zeros_like(self.forces)
        self._settle(motion, stored)

    def _settle(self, motion: Motion, stored: float) -> None:
        s, v = self.settings, motion.speed
        power = float(np.sum(s["viscous"] * v**2 + s["coulomb"] * np.abs(v)))
        work = 0.0 if motion.fast else float(self.paid @ motion.step)
        lost = power * s["period"] if motion.fresh else 0.0
        self.tank.settle(work, stored - self.stored, lost)
        self.stored = stored

    def _wanted_scale(self, age: float) -> float:
        """The share of K_c: it ramps up after an entry, and fades while the tissue is stalled."""
        s = self.settings
        self.ramp = min(1.0, self.ramp + s["period"] / s["ramp"]) if s["ramp"] > 0.0 else 1.0
        late = age - s["stall"]
        fading = 1.0 if late <= 0.0 else max(0.0, 1.0 - late / s["fade"])
        return float(self.ramp * self.tank.stiffness * fading)

    def _take_model(self, offered: Offered | None) -> bool:
        """Takes the newest model where it is new, and meant for this tool."""
        known = 0 if self.model is None else self.model.stamp
        if offered is None or offered.stamp in (0, known, self.refused):
            return False
        tag = self.settings["tag"] if offered.model.tag is None else offered.model.tag
        if tag != self.tag:
            return False
        self.model = offered
        self.G, self.g0 = offered.model.rows()
        rows = len(self.g0) + len(_STOPPED)
        self.slip, self.forces = np.zeros(rows), np.zeros(rows)
        self.forces[: offered.model.forces.size] = np.ravel(offered.model.forces)
        if self.force_ticks:
            mean = self.force_sum / self.force_ticks
            self.disagreement = float(np.linalg.norm(mean - self._contact_force()))
        self.force_sum, self.force_ticks = np.zeros(3), 0
        return True

    def _adopt(self, scale: float) -> None:
        """The newest model and stiffness, as much of them as the tank pays."""
        self.scale = scale
        if scale <= _LEAST_SCALE:
            self.tank.pay(-self.stored)
            self._drop()
            return
        patch, full, stored = self._solve(scale, self.slip, self.forces)
        more = stored - self.stored
        paid = self.tank.pay(more)
        shown = self.stored + paid * more
        self.share = 1.0 if paid == 1.0 else float(np.sqrt(shown / stored))
        self._show(patch, full)
        self.stored = shown

    def _show(self, patch: Patch, full: Array) -> None:
        """The share of the full forces: gaps of what bears are scaled, and so are its forces."""
        self.forces = self.share * full
        self.shift = self.slip.copy()
        if self.share == 1.0:
            return
        gaps = patch.gaps(self.forces)
        for block in patch.blocks:
            if block.kind == "bounded" or full[block.row] > 0.0:
                self.shift[block.rows] -= (1.0 - self.share) * patch.b[block.rows]
            else:
                self.shift[block.row] += max(0.0, -float(gaps[block.row]))
