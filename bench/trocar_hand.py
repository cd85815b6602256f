"""What the hand on a trocar feels: over the workspace, while it palpates, on changing tissue."""

from __future__ import annotations

import itertools
import runpy
from pathlib import Path
from typing import Any

import numpy as np
from trocar_cases import COMPENSATED, DEPTH, LOSSES, TAG, Trial, contacts, floor, joined

import tissu as ts
from tissu.trocar import kinematics
from tissu.trocar.controller import Controller
from tissu.trocar.ticking import in_core
from tissu.trocar.touch import Touch

ROOT = Path(__file__).resolve().parents[1]
GRID = tuple(
    itertools.product(np.radians((-42, -20, 0, 20, 42)), np.radians((-42, 0, 42)), (0.1, 0.2, 0.28))
)
"""Pitch, roll [rad] and depth [m]: near the end stops, which would carry a part of the force."""
PRESSED = 6e-3
"""How far beyond the wall the hand wants to be [m]."""
WALL = 1000.0
"""Its stiffness [N/m]."""
SETTLES = 1.6
"""Time in which a hand comes to rest [s]."""
EXACT = {"count_size": [1e-7] * 5, "torque_bits": 0}
NO_FRICTION = {"coulomb": [0.0] * 4}
DEVICES: tuple[tuple[str, dict[str, Any]], ...] = (
    (
        "no friction, fine counts and torques",
        {"mechanism": NO_FRICTION, "line": EXACT, "count_size": [1e-7] * 4},
    ),
    ("no friction", {"mechanism": NO_FRICTION}),
    ("friction", {}),
    ("friction and efficiency", {"mechanism": LOSSES}),
    ("the same, compensated", {"mechanism": LOSSES, **COMPENSATED}),
)


def at_pose(pose: tuple[float, ...], device: Any, *, moves: bool) -> tuple[Any, Any, Any]:
    """Forces of the contact and of the hand on the tool, and the speed into the wall, in rows.

    The wall is oblique, so that pitch, roll and depth carry. A hand at rest gives one row; one that
    moves goes 6 mm to and fro once a second.
    """
    pitch, roll, depth = pose
    q = np.array([pitch, roll, 0.0, depth])
    tip, d = kinematics.position(q), kinematics.axis(q)
    side = np.cross(d, (0.3, 1.0, 0.2))
    n = -d + 0.6 * side / np.linalg.norm(side)
    n /= np.linalg.norm(n)
    wall = contacts([(0, 0, 0)], [tip], [n], WALL, 0.0)
    path = [(0.0, *tip), (0.3, *(tip - PRESSED * n)), (SETTLES, *(tip - PRESSED * n))]
    if moves:
        ends = (2.0 * PRESSED, PRESSED, 2.0 * PRESSED, PRESSED)
        path += [(SETTLES + 0.5 * (k + 1), *(tip - end * n)) for k, end in enumerate(ends)]
    trial = Trial(path, model=wall, **device)
    trial.run(SETTLES)
    rows = []
    for _ in range(400 if moves else 1):
        if moves:
            trial.publish(in_core(wall(trial.device.joints), TAG))
        row = trial.loop.run(5)
        speed = (
            -n
            @ kinematics.jacobian(trial.device.joints, kinematics.position(trial.device.joints))
            @ trial.device.rates
        )
        rows.append((row["force"][-1], trial.device.hand_force, speed))
    contact, hand, speeds = (np.array(column) for column in zip(*rows, strict=True))
    return contact, hand, speeds


def pushed(device: Any) -> tuple[float, float]:
    """Felt force over that of the contact, less one: of a hand that goes in, and that goes out."""
    ways: tuple[list[Any], list[Any]] = ([], [])
    for pose in GRID[::4]:
        contact, hand, speeds = at_pose(pose, device, moves=True)
        n = contact / np.linalg.norm(contact, axis=1)[:, None]
        ratio = -np.einsum("ij,ij->i", hand, n) / np.linalg.norm(contact, axis=1) - 1.0
        ways[0].append(ratio[speeds > 0.6 * speeds.max()].mean())
        ways[1].append(ratio[speeds < 0.6 * speeds.min()].mean())
    return float(np.median(ways[0])), float(np.median(ways[1]))


def workspace() -> list[list[str]]:
    """Error of the force that a hand at rest feels, and of one that moves, of the contact's."""
    rows = []
    for name, device in DEVICES:
        errors = []
        for pose in GRID:
            contact, hand, _ = at_pose(pose, device, moves=False)
            errors.append(np.linalg.norm(contact[0] + hand[0]) / np.linalg.norm(contact[0]))
        inwards, outwards = pushed(device)
        rest = [f"{100 * np.median(errors):.2g} %", f"{100 * max(errors):.2g} %"]
        rows.append([name, *rest, f"{100 * inwards:+.1f} %", f"{100 * outwards:+.1f} %"])
    return rows


BASE = 0.14
"""Depth that the hand palpates from [m]."""


def palpated(dt: str) -> list[str]:
    """Agreement of the ticks with the tissue's steps while the hand palpates 5 mm at 1 Hz."""
    example = runpy.run_path(str(ROOT / "examples" / "palpate.py"))
    times = [0.0, 0.1, 0.5, *(1.0 + 0.5 * np.arange(6))]
    depths = [0.1, 0.1, BASE, *(BASE + 0.005 * (np.arange(6) % 2 == 0))]
    hand = ts.Hand(times=times, points=[(0, 0, depth) for depth in depths])
    scene = example["scene"]()
    right = scene.trocars["right"].replace(device=ts.SimulatedDevice(hand=hand))
    scene = scene.replace(step=ts.ImplicitEuler(dt), trocars={"right": right})
    simulation = scene.compile()
    differ, slow, depth = [], [], []
    with Controller(right) as controller:
        touch = Touch(simulation, controller)
        while simulation.time < times[-1]:
            felt = touch.step()
            if simulation.time > 1.0:
                differ.append(controller.report().disagreement)
                slow.append(np.linalg.norm(felt.force))
                depth.append(controller.device.joints[3])
    mean, largest = float(np.mean(slow)), float(np.max(slow))
    return [
        dt,
        f"{1e3 * np.ptp(depth):.1f}",
        f"{mean:.3f}",
        f"{largest:.3f}",
        f"{100 * np.mean(differ) / mean:.2g} %",
        f"{100 * np.max(differ) / mean:.2g} %",
    ]


def swing(stiffness: float, *, tank: bool) -> tuple[float, float]:
    """Swing within 80 ms [m, rms], and mean share of the force that is not shown.

    The tissue's stiffness changes by +-30 % every 40 ms, under a push of 1 N on 0.2 kg (the tool's
    0.15 and the cradle's 0.05).
    """
    friction = [6e-3, 6e-3, 1e-3, 0.05]
    coupling = 790.0
    push = {"mass": 0.15, "coulomb": friction, "gravity": [0.0, 0.0, 1.0 / 0.15]}
    trial = Trial(
        holds=False,
        mechanism=push,
        stiffness=[48.0, 48.0, 1.6, coupling],
        coulomb=friction,
        tank_gate=tank,
    )
    rows = []
    for number in range(150):
        k = stiffness * (0.7 if number % 2 else 1.3)
        wall = floor(DEPTH, 1.0 / max(1e-12, 1.0 / k - 1.0 / coupling))
        trial.publish(in_core(wall(trial.device.joints), TAG))
        rows.append(trial.loop.run(40))
    late = joined(rows[100:])
    depth = late["joints"][:, 3]
    turns = depth[: len(depth) // 80 * 80].reshape(-1, 80)
    return float(np.sqrt(turns.var(axis=1).mean())), float(1.0 - late["share"].mean())


def swings() -> str:
    """The table of docs/guide/trocar-methods.md."""
    head = (
        "| stiffness | swing within each 80 ms, without a tank | with it | mean share of the force "
        "that is not shown |\n|---|---|---|---|\n"
    )
    for stiffness in (300.0, 500.0, 700.0):
        without, _ = swing(stiffness, tank=False)
        with_it, lag = swing(stiffness, tank=True)
        head += f"| {stiffness:.0f} N/m | {1e3 * without:.2f} mm rms | {1e3 * with_it:.2f} mm rms "
        head += f"| {100 * lag:.0f} % |\n"
    return head
