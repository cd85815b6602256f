"""Programs beside each other, some steps each in turn, so that a drift of the machine meets all."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

WORKER = Path(__file__).resolve().parent / "peer_worker.py"
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")


@dataclass(frozen=True)
class Subject:
    """A way of a program."""

    program: str
    way: str


@dataclass
class Taken:
    """What came of a subject.

    Attributes:
        version: of the program.
        making: seconds for all before the first step.
        ms: CPU time of each step [ms].
        seen: what is compared after each (peer_work.Running.seen).
        unsolved: steps of which it says itself that they are not solved; None: it does not say.
        why: why there is nothing; empty: there is.
    """

    version: str = ""
    making: float = float("nan")
    ms: list[float] = field(default_factory=list)
    seen: list[list[float]] = field(default_factory=list)
    unsolved: int | None = None
    why: str = ""

    @property
    def first(self) -> float:
        """The first step [ms]."""
        return self.ms[0]

    def p(self, percent: float) -> float:
        """That percentile of the steps after the first [ms]."""
        return float(np.percentile(self.ms[1:], percent))

    def errors(self, reference: Any) -> tuple[float, float]:
        """At the end, and over all steps (root mean square), in shares of the largest reference.

        Args:
            reference: displacements (k, 3) [m] at the same times, k at least the steps taken.
        """
        known = np.asarray(reference)[: len(self.seen)]
        away = np.linalg.norm(np.asarray(self.seen) - known, axis=1)
        size = float(np.linalg.norm(known, axis=1).max())
        return float(away[-1]) / size, float(np.sqrt(np.mean(away**2))) / size


class Worker:
    """A subject in a process of its own."""

    def __init__(self, subject: Subject, python: str, folder: Path) -> None:
        """Started in `folder`, where a program may leave its logs."""
        self.taken = Taken()
        self._subject = subject
        self._process = subprocess.Popen(
            [python, str(WORKER), subject.program],
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env={**os.environ, **dict.fromkeys(ONE_THREAD, "1")},
        )

    def end(self) -> None:
        """Ends its process."""
        self._process.kill()
        self._process.communicate()

    def _ask(self, **request: Any) -> dict[str, Any]:
        """The answer; empty, with the reason kept, where there is none."""
        if self.taken.why:
            return {}
        assert self._process.stdin and self._process.stdout
        try:
            print(json.dumps(request), file=self._process.stdin, flush=True)
            answer = json.loads(
                self._process.stdout.readline() or '{"failed": "its process ended"}'
            )
        except OSError as error:
            answer = {"failed": str(error)}
        if "missing" in answer:
            self.taken.why = f"not installed ({answer['missing']})"
        elif "failed" in answer:
            self.taken.why = str(answer["failed"])
        return {} if self.taken.why else answer

    def make(self, work: Path) -> None:
        """Everything before the first step."""
        if answer := self._ask(do="make", work=str(work), way=self._subject.way):
            self.taken.version, self.taken.making = answer["version"], answer["seconds"]

    def turn(self, steps: int) -> None:
        """Some steps."""
        if answer := self._ask(do="turn", steps=steps):
            self.taken.ms += answer["ms"]
            self.taken.seen += answer["seen"]
            self.taken.unsolved = answer["unsolved"]
            if not np.isfinite(answer["seen"]).all():
                self.taken.why = "its values are not finite"


def side_by_side(
    subjects: list[Subject], pythons: dict[str, str], work: Path, *, steps: int, turn: int
) -> dict[Subject, Taken]:
    """So many steps of each, a turn at a time, each round begun by another one.

    Args:
        subjects: what runs.
        pythons: the Python of each program; sys.executable where it has none.
        work: a file with the work.
        steps: of each subject.
        turn: steps at a time.
    """
    workers: list[Worker] = []
    try:
        for subject in subjects:
            python = pythons.get(subject.program, sys.executable)
            workers.append(Worker(subject, python, work.parent))
            workers[-1].make(work)
        for number, done in enumerate(range(0, steps, turn)):
            first = number % len(workers)
            for worker in workers[first:] + workers[:first]:
                worker.turn(min(turn, steps - done))
        return dict(zip(subjects, (worker.taken for worker in workers), strict=True))
    finally:
        for worker in workers:
            worker.end()
