"""The model mass-spring in a scene: the paper's cubes, its fields, its dampers."""

import sys
from pathlib import Path

import meshio
import numpy as np
import pytest

import tissu as ts
from tissu.errors import ParameterError
from tissu.output.series import write_vtu
from tissu.picture import draw

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import apparent_modulus as experiment

SIDE, YOUNG = experiment.SIDE, experiment.YOUNG


def test_springs_of_the_smallest_cube_by_hand():
    """Cube 1 of the paper, five tetrahedra, pressed by a plane that it is glued to.

    Each of its edges has the volume of one corner tetrahedron, L^3 / 6; each of its six diagonals
    those of two corners and of the middle tetrahedron, L^3 / 3: k = E L / 6 and E L / 3. Pressed by
    a with nothing free, an upright diagonal's strain is -a / 2: 2 W / (E L^3) = 4/6 a^2 + 2/3 a^2.
    """
    mesh = experiment.cubes()["cube 1"]
    run = experiment.compressed(mesh, 1e-3 * SIDE, axis=2, glued=True)
    assert experiment.modulus(run, 1e-3 * SIDE, 2) == pytest.approx(4 / 3 * YOUNG, rel=1e-3)


def test_the_meshes_are_the_papers():
    meshes = experiment.cubes()
    counts = {name: (m.node_count, experiment.springs_of(m)) for name, m in meshes.items()}
    assert counts["cube 1"] == (8, 18)
    assert counts["cube 5x5x5"] == (125, 540)
    assert counts["cube 10x10x10"] == (1000, 5130)
    for mesh in meshes.values():
        assert mesh.volume() == pytest.approx(SIDE**3, rel=1e-12)


@pytest.mark.parametrize(("name", "least", "most"), [("irregular", 0.7, 0.8), ("cube 1", 0.9, 1.1)])
def test_the_papers_compression(name, least, most):
    """12 mm of 50: the modulus that the rule was given, as far as the mesh has it (2.3.4)."""
    run = experiment.compressed(experiment.cubes()[name], experiment.DEPTH, axis=2, glued=False)
    assert least < experiment.modulus(run, experiment.DEPTH, 2) / YOUNG < most


def test_springs_in_all_directions_make_poisson_a_quarter():
    """The irregular mesh, nearest to edges in all directions alike: lambda = mu."""
    run = experiment.compressed(experiment.cubes()["irregular"], 1e-4 * SIDE, axis=2, glued=False)
    assert experiment.poisson(run, 1e-4 * SIDE, 2) == pytest.approx(0.25, abs=0.02)


def test_equal_masses_tilt_an_uneven_mesh():
    """Figures 2.5 and 2.6, in numbers; continuum elements do not tilt."""
    mesh = experiment.uneven()

    def tilted(model):
        near, far = experiment.tilt(mesh, experiment.sunk(mesh, model))
        return abs(np.log(near / far))

    equal, volume = tilted(ts.MassSpring(masses="equal")), tilted(ts.MassSpring())
    assert equal > 2 * volume
    assert volume > 10 * tilted(ts.FEM())


def hanging(**fields):
    mesh = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra", split="five")
    if "regions" in fields:
        mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions=fields.pop("regions"))
    law = ts.StVK(young=1e4, poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=1e3, **{"model": "mass-spring", **fields})
    return ts.Scene(
        bodies={"b": body},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("b", on=ts.Box((None, None, 0.1 - 1e-9), None))],
        step=ts.ImplicitEuler(0.005, newton=ts.Newton()),
    ).compile()


def test_a_field_that_springs_do_not_have_is_left_out(tmp_path):
    simulation = hanging()
    simulation.step()
    fields = simulation.cell_fields("b")
    assert set(fields) == {"energy_density", "volume_ratio"}
    write_vtu(tmp_path / "b.vtu", simulation.meshes["b"], simulation, "b")
    assert set(meshio.read(tmp_path / "b.vtu").cell_data) == {"strain_energy_density"}
    draw(simulation, tmp_path / "b.png", size=(400, 200))
    with pytest.raises(ParameterError, match="found the field von_mises of body 'b', whose model"):
        draw(simulation, tmp_path / "b.png", field="von_mises")
    mesh = simulation.meshes["b"]
    corners = mesh.points[mesh.cells[0].nodes]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert (fields["energy_density"] * volumes).sum() == pytest.approx(
        simulation.energy()["elastic"], rel=1e-9
    )


def test_beside_other_models_the_body_has_no_such_field():
    regions = {"a": np.arange(20), "b": np.arange(20, 40)}
    simulation = hanging(model={"a": "mass-spring", "b": "fem"}, regions=regions)
    simulation.step()
    fields = simulation.cell_fields("b")
    assert "von_mises" not in fields
    assert all(np.isfinite(values).all() for values in fields.values())
    assert len(fields["volume_ratio"]) == 40


def test_dampers_beside_the_springs_settle_it():
    """The slowest mode, 8 Hz, is damped at omega^2 eta / E = 25/s: exp(-12) of the speed is left
    after half a second. Without dampers the steps' own damping, omega^2 dt / 2, leaves 4 %.
    """
    ends = {}
    for name, viscosity in (("none", None), ("dampers", ts.KelvinVoigt(eta="100 Pa s"))):
        simulation = hanging(viscosity=viscosity)
        for _ in simulation.run(0.5):
            pass
        ends[name] = simulation.energy()["kinetic"]
    assert ends["dampers"] < 1e-3 * ends["none"]
