"""Prints docs/measured/trocar.md: how late ticks are, what they cost, and what the hand feels.

    python bench/trocar.py [--seconds 10] [--write]

Needs a machine that has nothing else to do; the rows beside busy processes start these by
themselves. Whether SCHED_FIFO and locked memory are granted stands in the table. With --write, it
also prints the table of swings into docs/guide/trocar-methods.md.
"""

from __future__ import annotations

import argparse
import runpy
import time
from pathlib import Path

import numpy as np
from section import put_between
from trocar_cases import rows_of_cases
from trocar_hand import palpated, swings, workspace
from trocar_time import lateness, together

import tissu as ts
from tissu.cli.info import machine_line
from tissu.trocar import kinematics
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Touch

PRESSED = (-0.046, 0.006, 0.075)
"""m: where the organ is palpated"""
ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "trocar.md"
METHODS = ROOT / "docs" / "guide" / "trocar-methods.md"
SWINGS = "swings, printed by bench/trocar.py --write"
HEAD = """# The active trocar

Are the ticks of a trocar on time, and does the hand feel the force of the tissue? [The
guide](../guide/trocar.md) explains the terms. Ticks are those of the simulated device, at 1 kHz.

"""


def printed() -> float:
    """Largest relative error of the force at the tip by the torques that the thesis prints."""
    worst = 0.0
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
            worst = max(worst, float(np.linalg.norm(made - right) / np.linalg.norm(right)))
    return worst


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


def on_time(seconds: float) -> str:
    """How late ticks are."""
    rows, grants = [], []
    for others in (0, 2, 4):
        for privileged in (True, False):
            row, asked = lateness(seconds, others, privileged=privileged)
            rows.append(row)
            grants = asked or grants
    text = "## How late ticks are\n\n"
    text += f"Each row is a run of {seconds:g} s, in which a new model of 8 contacts with friction "
    text += "arrives every 40 ms. The settings requested of the machine are "
    text += "; ".join(grants) + ". In the rows without privileges nothing is requested: the thread "
    text += "is one like any other. A trocar is held after more than five missed ticks in a row.\n"
    head = (
        *("beside", "privileges", "late [us], p50, p99, p99.9", "missed ticks", "held, times"),
        "computing [us], p50, p99",
    )
    return text + "\n" + table(head, rows) + "\n"


def on_the_hand() -> str:
    """Force over the workspace, and agreement with the tissue."""
    text = "## What the hand feels\n\n"
    text += "A hand presses an oblique wall at 45 places of the workspace, pitch and roll up to 42 "
    text += "degrees and 10 to 28 cm deep, and stays there. The table compares the force that it "
    text += "feels with that of the contact: ticks, motors, encoders and friction of the simulated "
    text += "device lie between the two. The last two columns are medians for a hand that moves "
    text += "by 6 mm to and fro once a second. Efficiencies are 0.95, 0.95, 0.98 and 0.7, the "
    text += "compensation is that of `compensation: {friction: 80 %}` and `efficiency`. It acts "
    text += "with a part that grows with the speed, up to two counts in the longest window of "
    text += "speeds (6.5 mm/s of depth), so a hand at rest feels little of it.\n\n"
    head = ("device", "error, median", "largest", "going in", "going out")
    text += table(head, workspace()) + "\n"
    text += "The torques printed in the thesis (5.6, 5.10) give a force at the tip that is wrong "
    text += f"by up to {100 * printed():.0f} %.\n\n"
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
    text += "The same organ is palpated by a hand whose path goes 5 mm up and down once a second, "
    text += "for 2.5 s in contact. In each step, `Report.disagreement` is the size of the "
    text += "difference between the mean force of the ticks and that of the tissue's step. The "
    text += "last two columns give its mean and its largest value, of the mean force.\n\n"
    head = (
        *("step", "way of the tool [mm]", "mean force [N]", "largest force [N]"),
        *("mean disagreement", "largest"),
    )
    return text + table(head, [palpated(dt) for dt in ("10 ms", "40 ms")]) + "\n"


def of_hard_cases() -> str:
    """What happens when things go wrong."""
    text = "## Hard cases\n\n"
    text += "A hand presses into soft tissue for 0.6 s; then the case happens. From then on, the "
    text += "energy given out is the largest work of the motors on the tool. Its bound at that "
    text += "time is the energy that was stored, that of the tank, and what the device has "
    text += "dissipated since. The swing is how far the tool moves within the last 0.1 s of 1.5 s. "
    text += "The last three columns are of a device whose transmissions have losses (efficiencies "
    text += "of 0.95, 0.95, 0.98 and 0.7), which its motors make up for, with 80 % of the "
    text += "friction.\n\n"
    each = ("given out, of its bound [mJ]", "within it", "swing [counts]")
    head = ("case", "ends in", *each, *(f"{name}, compensated" for name in each))
    return text + table(head, rows_of_cases()) + "\n"


def of_compliance() -> str:
    """What the compliance takes."""
    text = "## The compliance of the tissue\n\n"
    text += "The table gives the time to compute the compliance, in milliseconds, while the same "
    text += "organ is pressed deeper in steps of 10 ms: with a factor that is kept and corrected, "
    text += "with a new factor, and with conjugate gradients. It also gives the largest error "
    text += "bound, and the time of a step.\n\n"
    head = ("contacts", "kept", "made anew, how often", "error", "a step", "cg")
    return text + table(head, [give(contacts) for contacts in (1, 3, 8)]) + "\n"


def all_together() -> str:
    """Three loops at once."""
    text = "## All together in real time\n\n"
    text += "The same scene runs in real time in one process: ticks at 1 kHz in their own thread, "
    text += "steps of the tissue with the compliance and a report after each step, and a display "
    text += "loop of 25 Hz that packs the newest shape and forces as a page takes them.\n\n"
    head = (
        *("step", "steps that were late", "missed ticks", "ticks late [us], p99"),
        *("display late [ms], p99", "displays left out"),
    )
    return text + table(head, [together(dt) for dt in ("10 ms", "20 ms", "40 ms")]) + "\n"


def page(seconds: float) -> str:
    """The whole page."""
    text = HEAD + on_time(seconds) + on_the_hand() + of_hard_cases()
    text += of_compliance() + all_together()
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
        put_between(METHODS, SWINGS, swings())
    print(text)


if __name__ == "__main__":
    main()
