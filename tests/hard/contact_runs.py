"""Runs of the hard cases with contact: each once for a method and a number of threads."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from outcome import CONTACT, Outcome, case, outcome, with_method

import tissu as ts


@dataclass
class Run:
    """What a run left behind.

    Attributes:
        outcome: steady, bounded or refused.
        reports: of every step.
        energies: kinetic and stored energy before the first step, and after every one [J].
        bits: a sum over positions, velocities and contact forces of every step.
        simulation: at its end.
    """

    outcome: Outcome
    reports: list[ts.StepReport]
    energies: list[float]
    bits: str
    simulation: ts.Simulation


@dataclass
class _Watch:
    reports: list[ts.StepReport] = field(default_factory=list)
    energies: list[float] = field(default_factory=list)
    sum: hashlib._Hash = field(default_factory=hashlib.sha256)

    def __call__(self, simulation: ts.Simulation, report: ts.StepReport) -> None:
        self.reports.append(report)
        self.energies.append(simulation.energy()["total"])
        for body in simulation.bodies:
            for values in (simulation.positions[body], simulation.velocities[body]):
                assert np.isfinite(values).all(), report
                self.sum.update(np.ascontiguousarray(values).tobytes())
        found = simulation.contacts()
        assert np.isfinite(found.forces).all(), report
        self.sum.update(np.ascontiguousarray(found.forces).tobytes())


def run(scene: ts.Scene) -> Run:
    """Runs a scene to its end, or to where it is refused; every number of every step is finite."""
    kept: list[ts.Simulation] = []
    watch = _Watch()
    start = scene.compile().energy()["total"]
    found = outcome(scene, keep=kept, watch=watch)
    return Run(found, watch.reports, [start, *watch.energies], watch.sum.hexdigest(), kept[0])


@cache
def ran(name: str, method: str = "implicit_euler", threads: int = 1) -> Run:
    """The run of a case as its file has it, but for the method and the threads."""
    return run(with_method(case(name, CONTACT), method).replace(threads=threads))


def weight(simulation: ts.Simulation, body: str) -> float:
    """Of a body, on the earth [N]."""
    return float(9.81 * masses(simulation, body).sum())


def masses(simulation: ts.Simulation, body: str) -> np.ndarray:
    """Lumped mass of every node (n,) [kg]."""
    rows = simulation.rows(body)
    return simulation.mass_matrix().diagonal()[3 * rows.start : 3 * rows.stop : 3]


def between(simulation: ts.Simulation, first: str, second: str) -> np.ndarray:
    """Sum of the contact forces (3,) on the first of two surfaces [N]."""
    found = simulation.contacts()
    a, b = found.surfaces.index(first), found.surfaces.index(second)
    straight = (found.pairs == [a, b]).all(axis=1)
    turned = (found.pairs == [b, a]).all(axis=1)
    return found.forces[straight].sum(axis=0) - found.forces[turned].sum(axis=0)
