"""The fields that a scene's output names, in the VTU files by the same names."""

import meshio
import numpy as np
import pytest

import tissu as ts
from field_states import LAWS, STATES, body_of, put
from tissu.mesh import read_mesh
from tissu.output import Series

HELD = ts.Plane((0, 0, 0), (1, 0, 0))


def scene(body, **output):
    return ts.Scene(
        bodies={"b": body},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("b", on=HELD)],
        step=ts.ImplicitEuler("1 ms"),
        output=ts.Output(every=0.01, **output),
    )


def written(simulation, folder):
    Series(simulation, folder).write()
    return meshio.read(next(folder.glob("frames/*.vtu")))


@pytest.mark.parametrize("cell", ["tetra10", "quad"])
def test_every_field_is_written_by_its_name(cell, tmp_path):
    body = body_of(cell, LAWS["stvk"])
    made = scene(body, fields=ts.FIELD_NAMES, node_fields=ts.FIELD_NAMES)
    simulation = made.compile()
    put(simulation, STATES["stretch"] @ STATES["shear"])
    found = written(simulation, tmp_path)
    assert set(found.cell_data) == set(ts.FIELD_NAMES)
    assert set(found.point_data) == {"displacement", "velocity", *ts.FIELD_NAMES}
    for name in ts.FIELD_NAMES:
        cells, nodes = (simulation.field(name, at) for at in ("cells", "nodes"))
        of_file = found.cell_data[name][0].reshape(cells.shape)
        np.testing.assert_array_equal(of_file, cells)
        np.testing.assert_array_equal(found.point_data[name].reshape(nodes.shape), nodes)


def test_regions_and_reactions_are_written(tmp_path):
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron")
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions={"left": [0], "all": [0, 1]})
    body = ts.Body(mesh=mesh, law=LAWS["stvk"], density=1e3)
    simulation = scene(body, fields=["regions", "reactions", "volume_ratio"]).compile()
    simulation.step()
    found = written(simulation, tmp_path)
    assert set(found.cell_data) == {"region:left", "region:all", "volume_ratio"}
    np.testing.assert_array_equal(found.point_data["reactions"], simulation.reactions("b"))
    assert np.abs(found.point_data["reactions"]).max() > 0.1
    again = read_mesh(next(tmp_path.glob("frames/*.vtu")))
    assert {name: cells.tolist() for name, cells in again.regions.items()} == {
        "left": [0],
        "all": [0, 1],
    }


def test_moments_are_written_of_nodes_that_turn(tmp_path):
    simulation = scene(body_of("triangle", LAWS["hooke"], model="shell"), fields=["reactions"])
    simulation = simulation.compile()
    simulation.step()
    found = written(simulation, tmp_path)
    moments = simulation.reactions("b", moments=True)
    np.testing.assert_array_equal(found.point_data["reaction_moments"], moments)
    assert np.abs(moments).max() > 0


def test_without_a_choice_the_file_has_what_it_had(tmp_path):
    found = written(scene(body_of("tetra", LAWS["stvk"])).compile(), tmp_path)
    assert set(found.cell_data) == {"von_mises", "strain_energy_density"}
    assert set(found.point_data) == {"displacement", "velocity"}


def test_springs_write_what_they_have(tmp_path):
    body = body_of("tetra", LAWS["hooke"], model="mass_spring")
    made = scene(body, fields=["cauchy_stress", "energy_density"], node_fields=["von_mises"])
    found = written(made.compile(), tmp_path)
    assert set(found.cell_data) == {"energy_density"}
    assert set(found.point_data) == {"displacement", "velocity"}


def test_unknown_fields_are_refused_with_the_nearest():
    with pytest.raises(ts.SceneError) as caught:
        scene(body_of("tetra", LAWS["stvk"]), fields=["von_misses"], node_fields=["reactions"])
    text = str(caught.value)
    assert "no field is named 'von_misses'; did you mean 'von_mises'? Fields: deformation" in text
    assert "no field is named 'reactions'" in text


def test_a_choice_is_read_from_yaml():
    text = """
bodies:
  b: {mesh: {type: bar, size: [1, 1, 1], cells: [1, 1, 1]}, law: {type: stvk, young: 1 kPa,
      poisson: 0.3}, density: 1000}
step: {type: implicit_euler, dt: 1 ms}
output: {every: 10 ms, fields: [cauchy_stress, regions], node_fields: [von_mises]}
"""
    made = ts.Scene.from_yaml_text(text)
    assert made.output.fields == ("cauchy_stress", "regions")
    assert ts.Scene.from_yaml_text(made.to_yaml()) == made
