"""Hard cases with contact in which cells go: in a contact of two livers, and all of one side."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from contact_runs import between
from outcome import CONTACT, case

import tissu as ts
from tissu.compile.contact_surface import body_surface, edges_of

CUTS = (50, 70, 90)
"""Steps of 10 ms before which cells go; the livers stand pressed by 1 cm from 0.3 s on."""


def touched_cells(simulation: ts.Simulation, body: str) -> np.ndarray:
    """Numbers of the cells with a node in contact."""
    found = simulation.contacts()
    number = found.surfaces.index(body)
    own = np.where(found.weights > 0.0, found.pairs[:, [0]], found.pairs[:, [1]]) == number
    nodes = np.unique(found.nodes[own & (found.nodes >= 0) & (found.weights != 0.0)])
    cells = np.concatenate([b.nodes for b in simulation.meshes[body].volume_blocks])
    return simulation.remaining_cells(body)[np.isin(cells, nodes).any(axis=1)]


def parts_of(simulation: ts.Simulation, body: str) -> set[frozenset[int]]:
    """Nodes of all vertices, edges and triangles of the surface of the cells that are there."""
    surface = body_surface(simulation.meshes[body], simulation.scene.bodies[body])
    parts = [surface.triangles, edges_of(surface.triangles), surface.nodes[:, None]]
    return {frozenset(row) for part in parts for row in part.tolist()}


def require_no_stale_key(simulation: ts.Simulation) -> None:
    """All that contacts join are parts of surfaces that are there."""
    found = simulation.contacts()
    for number, body in enumerate(found.surfaces):
        if body not in simulation.bodies:
            continue
        parts = parts_of(simulation, body)
        own = np.where(found.weights > 0.0, found.pairs[:, [0]], found.pairs[:, [1]]) == number
        for row, mine in zip(found.nodes, own & (found.nodes >= 0), strict=True):
            assert not mine.any() or frozenset(row[mine].tolist()) in parts


def livers(threads: int = 1) -> ts.Scene:
    return case("livers", CONTACT).replace(editing=True, threads=threads)


def go(simulation: ts.Simulation, steps: range) -> str:
    """Takes these steps, cuts before some of them, and audits each; a sum over all their bits."""
    bits = hashlib.sha256()
    gone = 0
    for number in steps:
        if number in CUTS:
            gone += cut(simulation)
        report = simulation.step()
        assert report.converged, report
        assert simulation.crossings() == [], report
        force, other = (simulation.force_on(body).force for body in ("low", "high"))
        assert np.abs(force + other).max() <= 1e-9 * np.abs(force).max()
        for body in simulation.bodies:
            bits.update(np.ascontiguousarray(simulation.positions[body]).tobytes())
            assert not len(simulation.inverted_cells(body))
        bits.update(np.ascontiguousarray(simulation.contacts().forces).tobytes())
    assert gone > 0
    return bits.hexdigest()


def cut(simulation: ts.Simulation) -> int:
    """A third of the touched cells of each go; forces of what is left are there to the bit.

    How many contacts went with them.
    """
    before = simulation.contacts()
    assert between(simulation, "high", "low")[2] > 0.02
    for body in ("low", "high"):
        cells = touched_cells(simulation, body)
        assert len(cells) > 1
        simulation.remove_cells(body=body, cells=cells[::3])
    require_no_stale_key(simulation)
    after = simulation.contacts()
    keys = [tuple(row) for row in before.nodes.tolist()]
    old = dict(zip(keys, before.forces, strict=True))
    for row, force in zip(after.nodes.tolist(), after.forces, strict=True):
        assert np.array_equal(old[tuple(row)], force)
    return len(before) - len(after)


@cache
def cut_livers(threads: int) -> str:
    return go(livers(threads).compile(), range(110))


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_cells_go_in_the_contact_of_two_livers(threads: int) -> None:
    assert cut_livers(threads) == cut_livers(1)


def test_it_goes_on_from_a_checkpoint_between_two_cuts(tmp_path: Path) -> None:
    first = livers().compile()
    go(first, range(80))
    first.save_checkpoint(tmp_path / "middle")
    second = livers().compile(checkpoint=tmp_path / "middle")
    assert go(first, range(80, 100)) == go(second, range(80, 100))


@pytest.mark.parametrize("method", ["implicit_euler", "bdf2"])
def test_all_cells_of_one_side_go_under_a_tool(method: str) -> None:
    """Of the liver all that the other one, which is a tool here, touches, until nothing is left to
    touch: the force falls to zero, and the tool meets what is below."""
    scene = livers().replace(step={"type": method, "dt": "10 ms", "solver": {"type": "cholesky"}})
    simulation = scene.compile()
    before = simulation.meshes["low"].cell_count
    forces = []
    for number in range(120):
        if number >= 50 and number % 5 == 0 and len(simulation.contacts()):
            cells = touched_cells(simulation, "low")
            if len(cells):
                simulation.remove_cells(body="low", cells=cells)
                require_no_stale_key(simulation)
        report = simulation.step()
        assert simulation.crossings() == [], report
        forces.append(between(simulation, "high", "low")[2])
    assert max(forces[40:50]) > 0.1
    assert abs(forces[-1]) < 0.1 * max(forces[40:50])
    assert simulation.meshes["low"].cell_count < before - 50
