"""Regions of a mesh by shapes: which cells they have, laws by them, and the same in YAML."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import tissu as ts

BAR = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell="hexahedron")
CENTRES = BAR.points[BAR.volume_blocks[0].nodes].mean(axis=1)


def _pulled(body: ts.Body) -> ts.Simulation:
    end = ts.Plane((0.4, 0, 0), (1, 0, 0))
    return ts.Scene(
        bodies={"bar": body},
        fixed=[
            ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)), axes="x"),
            ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y"),
            ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 0, 1)), axes="z"),
        ],
        loads=[ts.Traction("bar", on=end, traction=(100.0, 0, 0))],
        step=ts.Static(solver=ts.Cholesky()),
    ).compile()


def test_a_shape_has_the_cells_whose_centres_lie_in_it() -> None:
    ball = ts.Sphere((0.1, 0.05, 0.05), 0.06)
    mesh = BAR.with_region("tumour", ball)
    inside = np.linalg.norm(CENTRES - [0.1, 0.05, 0.05], axis=1) <= 0.06
    assert 0 < inside.sum() < len(inside)
    assert mesh.regions["tumour"].tolist() == np.flatnonzero(inside).tolist()
    assert "tumour" not in BAR.regions  # a mesh is never changed
    half = BAR.with_region("half", ts.Box((None, None, None), (0.2, None, None)))
    assert half.regions["half"].tolist() == np.flatnonzero(CENTRES[:, 0] < 0.2).tolist()


def test_cells_are_named_by_numbers_bools_and_nodes_too() -> None:
    assert BAR.with_region("a", [3, 1, 3]).regions["a"].tolist() == [1, 3]
    assert BAR.with_region("a", CENTRES[:, 0] > 0.3).regions["a"].tolist() == [
        c for c in range(32) if CENTRES[c, 0] > 0.3
    ]
    of_two = np.unique(BAR.volume_blocks[0].nodes[[4, 5]])
    found = BAR.with_region("a", ts.Nodes(of_two.tolist())).regions["a"]
    assert found.tolist() == [4, 5]
    again = BAR.with_region("a", [1]).with_region("b", ts.Region("a"))
    assert again.regions["b"].tolist() == [1]


@pytest.mark.parametrize(
    ("where", "words"),
    [
        (ts.Sphere((9, 9, 9), 0.1), "found no cell"),
        ([32], "found cell 32; numbers from 0 to 31"),
        ([0.5], "found an array of float64 of shape"),
        (np.ones(31, dtype=bool), "a bool for each of 32 cells"),
    ],
)
def test_what_means_no_cells_is_refused(where: object, words: str) -> None:
    with pytest.raises(ts.MeshError, match=words):
        BAR.with_region("tumour", where)  # type: ignore[arg-type]


def test_a_region_of_another_law_lengthens_by_its_own_modulus() -> None:
    """Two halves in a row under 100 Pa: E = 1 kPa and 4 kPa give 0.1 and 0.025 of each length."""
    mesh = BAR.with_region("soft", ts.Box((None, None, None), (0.2, None, None)))
    laws = {"soft": ts.Hooke(young=1e3, poisson=0.0), "rest": ts.Hooke(young=4e3, poisson=0.0)}
    simulation = _pulled(ts.Body(mesh=mesh, law=laws, density=1000.0))
    simulation.step()
    moved = simulation.displacements("bar")[:, 0]
    x = mesh.points[:, 0]
    expected = np.where(x <= 0.2, 0.1 * x, 0.02 + 0.025 * (x - 0.2))
    assert moved == pytest.approx(expected, rel=1e-6, abs=1e-9)  # the solver's tolerance


def test_the_rest_has_every_cell_that_no_other_region_of_the_map_has() -> None:
    mesh = BAR.with_region("a", [0, 1]).with_region("b", [1, 2])
    law = ts.Hooke(young=1e3, poisson=0.3)
    with pytest.raises(ts.SceneError, match="1 of 32 cells is in several regions of the law"):
        _pulled(ts.Body(mesh=mesh, law={"a": law, "b": law, "rest": law}, density=1e3))
    with pytest.raises(ts.SceneError, match="30 of 32 cells are in no region"):
        _pulled(ts.Body(mesh=mesh, law={"a": law}, density=1e3))


def test_a_scene_file_says_the_same_and_reads_back(tmp_path: Path) -> None:
    text = """
bodies:
  bar:
    mesh:
      type: bar
      size: [40 cm, 10 cm, 10 cm]
      cells: [8, 2, 2]
      cell: hexahedron
      regions: {soft: {type: box, max: [20 cm, null, null]}}
    law:
      soft: {type: hooke, young: 1 kPa, poisson: 0}
      rest: {type: hooke, young: 4 kPa, poisson: 0}
    density: 1 g/cm^3
step: {type: static}
fixed: [{body: bar, on: {type: region, name: soft}}]
"""
    scene = ts.Scene.from_yaml_text(text)
    mesh = scene.compile().meshes["bar"]
    assert mesh.regions["soft"].tolist() == np.flatnonzero(CENTRES[:, 0] < 0.2).tolist()
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
    with pytest.raises(ts.SceneError, match=r"regions.soft.*radius: is missing"):
        ts.Scene.from_yaml_text(text.replace("type: box, max: [20 cm, null, null]",
                                             "type: sphere, center: [0, 0, 0]"))  # fmt: skip


def test_a_region_of_a_file_is_written_and_read(tmp_path: Path) -> None:
    """A mesh that came from a file and got a region is no longer what the file says."""
    ts.write_mesh(BAR, tmp_path / "bar.vtu")
    mesh = ts.read_mesh(tmp_path / "bar.vtu").with_region("tumour", [4, 9])
    law = ts.Hooke(young=1e3, poisson=0.3)
    body = ts.Body(mesh=mesh, law={"tumour": law, "rest": law}, density=1e3)
    scene = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(0.01))
    with pytest.raises(ts.SceneError, match="made in memory"):
        scene.to_yaml()
    scene.save(tmp_path / "scene.yaml")
    again = ts.Scene.from_yaml(tmp_path / "scene.yaml").compile()
    assert again.meshes["bar"].regions["tumour"].tolist() == [4, 9]


def test_sheets_of_a_region_are_named_where_they_are_simulated() -> None:
    flat = ts.bar_mesh(size=(0.4, 0.1, 0), cells=(8, 2, 0), cell="quad")
    mesh = flat.with_region("half", ts.Box((None, None, None), (0.2, None, None)))
    law = ts.Hooke(young=1e3, poisson=0.3)
    body = ts.Body(
        mesh=mesh, law={"half": law, "rest": law}, density=1e3, thickness=1e-3, plane="stress"
    )
    simulation = ts.Scene(bodies={"sheet": body}, step=ts.ImplicitEuler(0.01)).compile()
    assert len(simulation.meshes["sheet"].regions["half"]) == 8


@pytest.mark.parametrize("step", ["auto", "{type: auto}", "{type: symplectic_euler}"])
def test_auto_is_a_type_of_step_too(step: str) -> None:
    body = "{mesh: {type: bar, size: [1, 1, 1], cells: [1, 1, 1]}, density: 1000, law: %s}"
    law = "{type: hooke, young: 1, poisson: 0}"
    scene = ts.Scene.from_yaml_text(f"bodies: {{b: {body % law}}}\nstep: {step}")
    assert scene.step == ts.SymplecticEuler()
    assert isinstance(scene.step, ts.SymplecticEuler)
    assert scene.step.dt == "auto"
