"""How late the ticks of a trocar are, with and without privileges, alone and beside a tissue."""

from __future__ import annotations

import contextlib
import multiprocessing
import resource
import runpy
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel, across
from tissu.trocar.run import Trocars

ROOT = Path(__file__).resolve().parents[1]
US = 1e6
DISPLAY = 0.04
"""Period of the display's loop [s]."""
BUSY = "import sys, time\nwhile time.monotonic() < float(sys.argv[1]): sum(range(1000))"
"""A program that takes a core until a time."""


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


def lateness(seconds: float, others: int, *, privileged: bool) -> tuple[list[str], list[str]]:
    """A row of ticks in real time beside so many busy processes, and what was granted.

    A process of its own takes the ticks, since locked memory stays locked.
    """
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        return pool.apply(_lateness, (seconds, others, privileged))


def _lateness(seconds: float, others: int, privileged: bool) -> tuple[list[str], list[str]]:
    start: dict[str, Any] = {}
    if not privileged:
        start = {"priority": 0, "lock_memory": False, "pin": False}
        for limit in (resource.RLIMIT_RTPRIO, resource.RLIMIT_MEMLOCK):
            with contextlib.suppress(ValueError, OSError):
                resource.setrlimit(limit, (0, 0))
    until = time.monotonic() + seconds + 1.0
    tasks = [subprocess.Popen([sys.executable, "-c", BUSY, str(until)]) for _ in range(others)]
    controller = Controller(trocar(), mode="threaded")
    controller.start(**start)
    begin = time.monotonic()
    while time.monotonic() < begin + seconds:
        controller.publish(patch(8, controller.report().q))
        time.sleep(DISPLAY)
    timing = controller.timing()
    controller.stop()
    for task in tasks:
        task.wait()
    late, compute = timing.lateness, timing.compute
    row = [
        f"{others} busy processes" if others else "nothing else runs",
        "all" if privileged else "none",
        f"{US * late.p50:.0f}, {US * late.p99:.0f}, {US * late.p999:.0f}",
        f"{timing.missed} of {timing.ticks + timing.missed:,}",
        f"{timing.held}",
        f"{US * compute.p50:.0f}, {US * compute.p99:.0f}",
    ]
    return row, [str(grant) for grant in timing.grants]


class Display:
    """A loop of 25 Hz that packs the newest shape and report as a page takes them."""

    def __init__(self) -> None:
        self.late: list[float] = []
        self.sent = 0
        self._newest: tuple[Any, ...] | None = None
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> Display:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.set()
        self._thread.join()

    def give(self, positions: Any, felt: Any) -> None:
        """The newest state, between two steps of the tissue."""
        self._newest = (np.array(positions), felt.tip, felt.fast)

    def _run(self) -> None:
        begin, number = time.monotonic(), 0
        while not self._ends.is_set():
            number += 1
            time.sleep(max(0.0, begin + number * DISPLAY - time.monotonic()))
            self.late.append(time.monotonic() - begin - number * DISPLAY)
            newest = self._newest
            if newest is not None:
                self.sent += len(np.concatenate(newest, axis=None).astype(np.float32).tobytes())


def together(dt: str) -> list[str]:
    """The organ in real time: ticks at 1 kHz, steps, a display at 25 Hz, on the machine's cores."""
    example = runpy.run_path(str(ROOT / "examples" / "palpate.py"))
    simulation = example["scene"]().replace(step=ts.ImplicitEuler(dt)).compile()
    with Trocars(simulation, realtime=True) as trocars, Display() as display:
        for _ in trocars.along(iter(simulation.run())):
            display.give(simulation.positions["organ"], trocars.felt["right"][-1])
        found = trocars.summary()["right"]
    steps = len(trocars.felt["right"])
    late = np.array(display.late)
    return [
        dt,
        f"{found['late_steps']} of {steps}",
        f"{found['missed_ticks']}",
        f"{US * found['lateness_p99']:.0f}",
        f"{1e3 * np.percentile(late, 99):.1f}",
        f"{int((late > DISPLAY).sum())} of {len(late)}",
    ]
