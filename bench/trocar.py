"""Prints docs/measured/trocar.md: how late ticks are, what they cost, and what the hand feels.

    python bench/trocar.py [--seconds 10] [--write]

Needs a machine that has nothing else to do; the rows beside busy processes start these by
themselves. Whether SCHED_FIFO and locked memory are granted stands in the table.
"""

from __future__ import annotations

import argparse
import multiprocessing
import runpy
import time
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line
from tissu.trocar import kinematics
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel, across
from tissu.trocar.run import Trocars
from tissu.trocar.touch import Touch

PRESSED = (-0.046, 0.006, 0.075)
"""m: where the organ is palpated"""
ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "trocar.md"
US = 1e6
HEAD = """# The active trocar

Are the ticks of a trocar on time, and does the hand feel the force of the tissue? [The
guide](../guide/trocar.md) explains the terms. Ticks are those of the simulated device, at 1 kHz.

"""


def trocar(hand: Any = None, **device: Any) -> ts.Trocar:
    """A trocar whose hand stays 20 cm deep."""
    hand = hand or ts.Hand(times=(0.0, 1.0), points=((0, 0, 0.2), (0, 0, 0.2)))
    return ts.Trocar(
        port=ts.Port(at=(0, 0, 0), axis=(0, 0, -1)), device=ts.SimulatedDevice(hand=hand, **device)
    )


def patch(contacts: int, joints: Any) -> LocalModel:
    """Contacts with friction on a ring of 2 mm around the tip, in soft tissue."""
    angles = 2.0 * np.pi * np.arange(contacts) / contacts
    points = 2e-3 * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(contacts)])
    normals = np.tile([0.0, 0.0, -1.0], (contacts, 1))
    return LocalModel(
        joints=joints,
        points=points,
        anchors=np.add(points, (0.0, 0.0, 0.198)),
        normals=normals,
        tangents=np.array([across(n) for n in normals]),
        friction=np.full(contacts, 0.2),
        forces=np.zeros((contacts, 3)),
        compliance=np.eye(3 * contacts) / 300.0,
    )


def busy(until: float) -> None:
    """Takes a core."""
    while time.monotonic() < until:
        sum(range(1000))


def lateness(seconds: float, others: int) -> tuple[list[str], list[str]]:
    """A row of ticks in real time beside so many busy processes, and what was granted."""
    until = time.monotonic() + seconds + 2.0
    tasks = [multiprocessing.Process(target=busy, args=(until,)) for _ in range(others)]
    for task in tasks:
        task.start()
    with Controller(trocar(), mode="threaded") as controller:
        begin, ticks = time.monotonic(), 0
        while time.monotonic() < begin + seconds:
            report = controller.report()
            controller.publish(patch(8, report.q))
            time.sleep(0.04)
        timing = controller.timing()
        ticks = timing.ticks
    for task in tasks:
        task.join()
    late, compute = timing.lateness, timing.compute
    row = [
        f"{others} busy processes" if others else "nothing else runs",
        f"{US * late.p50:.0f}, {US * late.p99:.0f}, {US * late.p999:.0f}",
        f"{timing.missed} of {ticks + timing.missed:,}",
        f"{US * compute.p50:.0f}, {US * compute.p99:.0f}",
    ]
    return row, [str(grant) for grant in timing.grants]


def workspace() -> tuple[float, float]:
    """Largest relative error of the force at the tip: of ours, and of the printed one."""
    worst = 0.0
    for pitch in np.radians((-45, -20, 0, 20, 45)):
        for roll in np.radians((-45, 0, 45)):
            q = np.array([pitch, roll, 0.0, 0.2])
            tip, d = kinematics.position(q), kinematics.axis(q)
            force = np.array([1.0, -0.5, 0.7]) - 2.0 * d
            tau = kinematics.torques(q, tip[None], force[None])
            J = kinematics.jacobian(q, tip)
            back = np.linalg.lstsq(J.T, tau, rcond=None)[0]
            worst = max(worst, float(np.linalg.norm(back - force) / np.linalg.norm(force)))
    printed = 0.0
    for angle in np.radians((10, 20, 30, 45)):
        q = np.array([0.0, angle, 0.0, 0.2])
        tip = kinematics.position(q)
        for turn in np.linspace(0, 2 * np.pi, 36, endpoint=False):
            force = np.array([np.cos(turn), np.sin(turn), 0.0])
            tau = kinematics.printed_torques(q, force)
            wanted = kinematics.torques(q, tip[None], force[None])[:2]
            J = kinematics.jacobian(q, tip)[:, :2]
            made = np.linalg.lstsq(J.T, np.asarray(tau)[:2], rcond=None)[0]
            right = np.linalg.lstsq(J.T, wanted, rcond=None)[0]
            printed = max(printed, float(np.linalg.norm(made - right) / np.linalg.norm(right)))
    return worst, printed


def felt(dt: str) -> list[str]:
    """Fast and slow force on the palpated organ while the hand stays deep."""
    example = runpy.run_path(str(ROOT / "examples" / "palpate.py"))
    scene = example["scene"]().replace(step=ts.ImplicitEuler(dt))
    simulation = scene.compile()
    steps = round(1.7 / float(scene.step.dt))
    begin = time.perf_counter()
    found = example["felt"](simulation, steps)
    spent = (time.perf_counter() - begin) / steps
    times = np.array([one.time for one in found])
    slow = np.array([np.linalg.norm(one.force) for one in found])
    fast = np.array([np.linalg.norm(one.fast) for one in found])
    on = (times > 0.7) & (times < 1.38)
    means = abs(fast[on].mean() / slow[on].mean() - 1.0)
    each = np.abs(fast[on] - slow[on]).mean() / slow[on].mean()
    return [
        dt,
        f"{slow[on].mean():.3f}",
        f"{100 * means:.2g} %",
        f"{100 * each:.2g} %",
        f"{1e3 * spent:.1f}",
    ]


def together(dt: str) -> list[str]:
    """The organ in real time: ticks at 1 kHz, steps, a look at 25 Hz, on the machine's cores."""
    example = runpy.run_path(str(ROOT / "examples" / "palpate.py"))
    simulation = example["scene"]().replace(step=ts.ImplicitEuler(dt)).compile()
    with Trocars(simulation, realtime=True) as trocars:
        for _ in trocars.along(iter(simulation.run())):
            pass
        found = trocars.summary()["right"]
    steps = len(trocars.felt["right"])
    return [
        dt,
        f"{found['late_steps']} of {steps}",
        f"{found['missed_ticks']}",
        f"{US * found['lateness_p99']:.0f}",
    ]


def give(contacts: int) -> list[str]:
    """What the compliance of so many contacts takes, while the organ is pressed deeper."""
    example = runpy.run_path(str(ROOT / "examples" / "palpate.py"))
    row = [str(contacts)]
    for way in ("factor", "cg"):
        simulation = example["scene"]().compile()
        found = simulation.compliance(by=way)
        near = np.linalg.norm(simulation.positions["organ"] - PRESSED, axis=1)
        nodes = [[node] for node in np.argsort(near)[:contacts]]
        axes = np.tile(np.eye(3), (contacts, 1, 1))
        steps, kept, made, errors = [], [], [], []
        with Controller(simulation.scene.trocars["right"]) as controller:
            touch = Touch(simulation, controller)
            for number in range(70):
                touch.lead()
                begin = time.perf_counter()
                simulation.step()
                steps.append(time.perf_counter() - begin)
                before = found.factors
                begin = time.perf_counter()
                found.of(["organ"] * contacts, nodes, [[1.0]] * contacts, axes)
                spent = time.perf_counter() - begin
                if number:
                    (kept if found.factors == before else made).append(spent)
                    errors.append(found.error)
                touch.hand_on()
        row.append(f"{1e3 * np.median(kept):.2f}" if kept else "none")
        if way == "factor":
            row.append(f"{1e3 * np.median(made):.1f}, {len(made)} of 69" if made else "none of 69")
            row.append(f"{max(errors):.1e}")
            row.append(f"{1e3 * np.median(steps):.1f}")
    return row


def table(head: tuple[str, ...], rows: list[list[str]]) -> str:
    """In Markdown."""
    lines = [head, tuple("---" for _ in head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def page(seconds: float) -> str:
    """The whole page."""
    rows, grants = [], []
    for others in (0, 2, 4):
        row, grants = lateness(seconds, others)
        rows.append(row)
    text = HEAD + "## How late ticks are\n\n"
    text += f"Each row is a run of {seconds:g} s, in which a new model of 8 contacts with friction "
    text += "arrives every 40 ms. The settings requested of the machine are "
    text += "; ".join(grants) + ".\n\n"
    head = ("beside", "late [us], p50, p99, p99.9", "missed ticks", "computing [us], p50, p99")
    text += table(head, rows) + "\n"
    exact, printed = workspace()
    text += "## What the hand feels\n\n"
    text += "For pitch and roll of up to 45 degrees, the torques give the force at the tip "
    text += f"to {exact:.0e}. Those printed in the thesis (5.6, 5.10) are wrong by up to "
    text += f"{100 * printed:.0f} %.\n\n"
    text += "An organ of 1,063 nodes is palpated 4 cm deep by a hand that trembles "
    text += "(`examples/palpate.py`). The table compares the forces of the tissue's steps with "
    text += "those of the last tick of each step, from 0.7 to 1.38 s, while the hand stays "
    text += "deep.\n\n"
    head = (
        "step",
        "mean force [N]",
        "means differ by",
        "from step to step by",
        "ms a step and its ticks",
    )
    text += table(head, [felt(dt) for dt in ("10 ms", "20 ms", "40 ms")]) + "\n"
    text += "## The compliance of the tissue\n\n"
    text += "The table gives the time to compute the compliance, in milliseconds, while the same "
    text += "organ is pressed deeper in steps of 10 ms: with a factor that is kept and corrected, "
    text += "with a new factor, and with conjugate gradients. It also gives the largest error "
    text += "bound, and the time of a step.\n\n"
    head = ("contacts", "kept", "made anew, how often", "error", "a step", "cg")
    text += table(head, [give(contacts) for contacts in (1, 3, 8)]) + "\n"
    text += "## All together in real time\n\n"
    text += "The same scene runs in real time: ticks in their own thread, steps of the tissue with "
    text += "the compliance, and a report after each step.\n\n"
    head = ("step", "steps that were late", "missed ticks", "ticks late [us], p99")
    text += table(head, [together(dt) for dt in ("10 ms", "20 ms", "40 ms")]) + "\n"
    return text + THESIS + f"Printed by `python bench/trocar.py --write`; {machine_line()}\n"


THESIS = """## What the thesis asked and reached

The table lists the requirements of Chendeb 2007 (5.3.3), the results in its table 5.4.5, and those
of the simulated device here, which has the encoder counts of that table. No real device was
available.

| | asked | table 5.4.5 | here |
| --- | --- | --- | --- |
| translation, step | 0.05 mm | 0.1 mm | 0.1 mm, by scene |
| translation, travel and force | 400 mm | 300 mm, 5 N | 300 mm, 5 N, by scene |
| own rotation, step | 0.05 degrees | 0.05 degrees | 0.05 degrees, by scene |
| own rotation, range and torque | 360 degrees | 360 degrees, 0.2 N m | any, 0.2 N m, by scene |
| pitch and roll | 70 degrees, step 0.05 | 45 degrees, step 0.01 | 45 degrees, up to 75 by scene |
| pitch and roll, torque | | 6 N m: 20 N at 0.3 m, 60 N at 0.1 m | 6 N m, by scene |
| cradle, between axes | 100 mm | 100 mm | 100 mm at least |
| rate | 300 Hz to 10 kHz | 1000 Hz | 300 Hz to 10 kHz |
| forces felt | all axes | pitch and roll, qualitatively | all four axes, to the figures above |
| tool recognition | wanted | not built | by tag |

"""


def main() -> None:
    """Prints or writes the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=10.0, help="of each row of ticks")
    parser.add_argument("--write", action="store_true", help="into docs/measured/trocar.md")
    given = parser.parse_args()
    text = page(given.seconds)
    if given.write:
        PAGE.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
