"""A direction of any length means the same as the unit vector along it."""

import numpy as np
import pytest

import tissu as ts

OBLIQUE = np.array([1.0, -2.0, 0.5])


@pytest.mark.parametrize("length", [1e160, 1e-200, 1e308, 3.0])
def test_a_plane_is_that_of_its_unit_normal(length):
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(4, 4, 4))
    unit = OBLIQUE / np.linalg.norm(OBLIQUE)
    wanted = ts.Plane((0.5, 0.5, 0.5), unit, 0.1).nodes(mesh)
    found = ts.Plane((0.5, 0.5, 0.5), OBLIQUE * (length / 2.0), 0.1).nodes(mesh)
    # By hand: |(x - 0.5) - 2 (y - 0.5) + 0.5 (z - 0.5)| <= 0.1 sqrt(5.25)
    distance = np.abs((mesh.points - 0.5) @ OBLIQUE) / np.sqrt(5.25)
    assert found.tolist() == np.flatnonzero(distance <= 0.1).tolist() == wanted.tolist()


def test_the_smallest_number_is_a_direction_too():
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2))
    found = ts.Plane((0, 0, 0), (0, 5e-324, 0)).nodes(mesh)
    assert found.tolist() == np.flatnonzero(mesh.points[:, 1] == 0.0).tolist()


def test_a_sphere_as_large_as_numbers_go_holds_all():
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2))
    assert len(ts.Sphere((1e200, 0, 0), 2e200).nodes(mesh)) == mesh.node_count
    assert len(ts.Sphere((1e200, 0, 0), 0.5e200).nodes(mesh)) == 0


def turned(length):
    """Where a bar's nodes are when its end has been turned by 0.3 about an oblique axis."""
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron"),
        law=ts.StVK(
            young=1e4,
            poisson=0.3,
            fibres=ts.Fibres(k1=1e4, k2=0.5, direction=OBLIQUE * length),
        ),
        density=1e3,
    )
    ends = [ts.Plane((x, 0, 0), (1, 0, 0)) for x in (0.0, 0.2)]
    rotation = ts.Rotation(center=(0.2, 0.05, 0.05), axis=OBLIQUE * length, angles=(0.0, 0.3))
    scene = ts.Scene(
        bodies={"bar": bar},
        fixed=[ts.Fixed("bar", on=ends[0])],
        prescribed=[ts.Prescribed("bar", on=ends[1], times=(0.0, 0.03), rotation=rotation)],
        step=ts.ImplicitEuler(0.01, solver=ts.Cholesky()),
        duration=0.03,
    )
    simulation = scene.compile()
    for _ in simulation.run():
        pass
    return np.array(simulation.positions["bar"])


@pytest.mark.parametrize("length", [2.0**530, 2.0**-660])
def test_axes_and_fibres_of_any_length_give_the_same_bits(length):
    found = turned(length)
    assert np.isfinite(found).all()
    assert found.tobytes() == turned(1.0).tobytes()
    assert (
        np.abs(
            found - ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron").points
        ).max()
        > 0.01
    )
