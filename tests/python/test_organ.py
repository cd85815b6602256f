"""The example: an organ made by a script, held and left to gravity."""

import importlib.util
from pathlib import Path

import meshio
import numpy as np
import pytest

import tissu

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(scope="module")
def make_organ():
    spec = importlib.util.spec_from_file_location("make_organ", EXAMPLES / "make_organ.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def organ():
    return tissu.read_mesh(EXAMPLES / "organ.vtu")


def test_the_script_makes_the_committed_mesh(make_organ):
    nodes, cells = make_organ.make()
    committed = meshio.read(EXAMPLES / "organ.vtu")
    assert np.array_equal(committed.cells[0].data, cells)
    assert np.abs(committed.points - nodes).max() < 2e-7
    assert (EXAMPLES / "organ.vtu").stat().st_size < 600_000


def test_the_mesh_is_one_good_closed_body(organ):
    report = organ.quality()
    assert 3000 <= organ.cell_count <= 6000
    assert report.parts == 1
    assert report.closed
    assert report.min_quality > 0.15
    assert report.median_quality > 0.8
    assert not report.notes
    triangles = organ.surface().triangles
    edges = len(triangles) * 3 // 2
    assert len(np.unique(triangles)) - edges + len(triangles) == 2  # like a sphere


def test_it_is_as_large_as_a_liver_and_its_right_lobe_is_the_big_one(organ):
    assert np.ptp(organ.bounds, axis=0)[0] == pytest.approx(0.21, abs=0.02)
    assert 1.0e-3 < organ.volume() < 1.8e-3
    centre = organ.points[organ.volume_blocks[0].nodes].mean(axis=1)
    volume = organ.cell_volumes()
    assert volume[centre[:, 0] < 0].sum() > 1.5 * volume[centre[:, 0] > 0].sum()


def test_surface_nodes_lie_on_the_shape(make_organ, organ):
    on = organ.points[np.unique(organ.surface().triangles)]
    assert np.abs(make_organ.organ(on)).max() < 1e-5


@pytest.mark.parametrize("h", [0.02, 0.031])
def test_other_shapes_and_sizes_are_meshed_as_well(make_organ, h):
    def ball(points):
        return np.linalg.norm(points - 0.003, axis=1) - 0.1

    nodes, cells = make_organ.make(ball, h=h, sweeps=1)
    assert make_organ.quality(nodes, cells).min() > 0.15
    triangles = make_organ.surface(cells)
    assert len(np.unique(triangles)) - len(triangles) // 2 == 2
    assert make_organ.volumes(nodes, cells).sum() == pytest.approx(4e-3 * np.pi / 3, rel=0.06)


def test_the_organ_sags_and_comes_to_rest():
    simulation = tissu.Scene.from_yaml(EXAMPLES / "organ.yaml").compile()
    reports = list(simulation.run(2.0))
    assert all(report.converged for report in reports)
    shift = np.asarray(simulation.displacements("organ"))
    assert 0.01 < np.linalg.norm(shift, axis=1).max() < 0.06
    assert shift[:, 2].mean() < 0
    speed = np.linalg.norm(np.asarray(simulation.velocities["organ"]), axis=1)
    assert speed.max() < 0.02
    energy = simulation.energy()
    assert energy["kinetic"] < 1e-3 * energy["elastic"]
