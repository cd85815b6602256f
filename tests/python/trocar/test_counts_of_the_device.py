"""What a count of the device does to the force on the hand, and the ways of its compliance."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Felt, Touch

PALPATE = runpy.run_path(str(Path(__file__).parents[3] / "examples" / "palpate.py"))


def palpated(dt: str, until: float, **device: object) -> list[Felt]:
    """The organ of the example under its probe: what each step felt."""
    scene = PALPATE["scene"]()
    trocar = scene.trocars["right"]
    trocar = trocar.replace(device=trocar.device.replace(**device))
    simulation = scene.replace(step=ts.ImplicitEuler(dt), trocars={"right": trocar}).compile()
    found = []
    with Controller(trocar) as controller:
        touch = Touch(simulation, controller)
        while simulation.time < until - 1e-9:
            touch.lead()
            simulation.step()
            found.append(touch.hand_on())
            assert len(simulation.crossings()) == 0
    return found


def test_the_force_alternates_by_the_counts_of_the_device() -> None:
    """A count of 0.1 mm moves the proxy by D K_c / (K_c + k), and the force by k times as much.

    The stiffness k = 1 / W of the step is that of the model. With counts of a fiftieth the force of
    the steps alternates by less than a third: what is left is the hand's tremor.
    """
    rough = _alternation("10 ms")
    pitch, roll, own, depth = ts.SimulatedDevice().counts
    fine = _alternation("10 ms", counts=(pitch / 50, roll / 50, own / 50, depth / 50))
    assert depth == pytest.approx(1e-4)
    bound = depth * 1600.0 * 500.0 / (1600.0 + 500.0)  # N: k is 360 to 490 N/m under the probe
    assert rough < 2.0 * bound  # the tremor of 0.1 mm takes the hand over two counts at most
    assert fine < rough / 3.0


def _alternation(dt: str, **device: object) -> float:
    """Largest second difference of the force of steps while the hand stays deep, halved [N]."""
    found = palpated(dt, 1.0, **device)
    size = np.array([float(np.linalg.norm(one.force)) for one in found if one.time > 0.6])
    return float(np.abs(np.diff(size, 2)).max() / 2.0)


def test_the_way_of_compliance_may_be_named_alone() -> None:
    """As the guide writes it, and refused in a sentence where it is another."""
    simulation = PALPATE["scene"]().compile()
    assert simulation.compliance("cg").by == "cg"
    with pytest.raises(ts.ParameterError, match="found the way 'gradient'"):
        simulation.compliance("gradient")  # type: ignore[arg-type]
