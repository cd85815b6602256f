"""Files of bodies that were cut: forces add up, and only what is touched has a contact."""

import meshio
import numpy as np
import pytest

import tissu as ts
from tissu.live_view.fields import contact_pressure
from tissu.live_view.surface import seen_of

ROUND_OFF = 1e-12
"""of the sum of the magnitudes of the forces: some hundred of them are added"""
GRAVITY = 9.81
DENSITY = 1000.0
SIZE = (0.06, 0.03, 0.03)
"""of the bars [m]"""
WEIGHT = DENSITY * GRAVITY * SIZE[0] * SIZE[1] * SIZE[2]
STIFF = ts.StVK(young=2e5, poisson=0.3)
SHEET = {"size": (0.08, 0.05, 0), "cells": (8, 5, 0)}
BLOCK = {"size": (0.08, 0.04, 0.04), "cells": (5, 2, 2)}
ROD = {"size": (0.1, 0, 0), "cells": (14, 0, 0), "cell": "line"}


def bar(cell="tetra", **fields):
    return ts.Body(
        mesh=ts.BarMesh(size=SIZE, cells=(6, 3, 3), cell=cell),
        law=ts.StableNeoHooke(young=2e4, poisson=0.3),
        density=DENSITY,
        **fields,
    )


def written(simulation, folder):
    """The file of the body at the present time."""
    ts.Series(simulation, folder).write()
    return meshio.read(next(folder.glob("frames/b_*.vtu")))


def same_wrench(simulation, found):
    """Forces of the points have the sum and the moment of those on the nodes."""
    forces, places = simulation.reactions("b"), simulation.positions["b"]
    written_forces = found.point_data["reactions"]
    of_sum = np.abs(forces).sum()
    assert of_sum > 0
    np.testing.assert_allclose(written_forces.sum(0), forces.sum(0), atol=ROUND_OFF * of_sum)
    np.testing.assert_allclose(
        np.cross(found.points, written_forces).sum(axis=0),
        np.cross(places, forces).sum(axis=0),
        atol=ROUND_OFF * of_sum * np.abs(places).max(),
    )


@pytest.mark.parametrize(
    ("cell", "method"),
    [("tetra", "virtual"), ("hexahedron", "virtual"), ("tetra", "subdivide"), ("tetra", "snap")],
)
def test_each_piece_is_borne_by_its_weight(tmp_path, cell, method):
    """In equilibrium, to 1e-6: to what Newton's method leaves of the weight."""
    simulation = ts.Scene(
        bodies={"b": bar(cell)},
        gravity=(0, 0, -GRAVITY),
        fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.Static(newton=ts.Newton(tolerance=1e-7)),
        editing=ts.Editing(method=method),
        output=ts.Output(every=1, fields=["reactions"]),
    ).compile()
    report = simulation.cut("b", ts.Plane((0.033, 0, 0), (1, 0.2, 0)))
    assert len(report.pieces) == 2
    assert simulation.step().converged
    found = written(simulation, tmp_path)
    same_wrench(simulation, found)
    reactions = found.point_data["reactions"]
    assert reactions.sum(axis=0) == pytest.approx((0, 0, WEIGHT), abs=1e-6 * WEIGHT)
    for number, piece in enumerate(simulation.pieces("b")):
        pairs = zip(found.cells, found.cell_data["piece"], strict=True)
        own = np.unique(np.concatenate([block.data[of == number].ravel() for block, of in pairs]))
        weight = DENSITY * GRAVITY * piece.volume
        assert reactions[own].sum(axis=0) == pytest.approx((0, 0, weight), abs=1e-6 * WEIGHT)


BODIES = {
    "triangle": {"mesh": ts.bar_mesh(**SHEET, cell="triangle"), "thickness": 0.002},
    "quad": {"mesh": ts.bar_mesh(**SHEET, cell="quad"), "thickness": 0.002},
    "triangle6": {"mesh": ts.bar_mesh(**SHEET, cell="triangle6"), "thickness": 0.002},
    "shell": {
        "mesh": ts.bar_mesh(**SHEET, cell="triangle"),
        "thickness": 0.002,
        "model": ts.Shell(),
    },
    "frames in a sheet": {
        "mesh": ts.bar_mesh(**SHEET, cell="quad"),
        "thickness": 0.002,
        "model": ts.Frames(),
    },
    "line": {"mesh": ts.bar_mesh(**ROD), "section": 1e-6},
    "rod": {
        "mesh": ts.bar_mesh(**ROD),
        "section": ts.Rectangle(height=0.003, width=0.002, up=(0, 0, 1)),
        "model": ts.Frames(),
    },
    "frames": {"mesh": ts.bar_mesh(**BLOCK, cell="hexahedron"), "model": ts.Frames()},
    "half levers": {"mesh": ts.bar_mesh(**BLOCK, cell="tetra"), "model": ts.Frames(lever="half")},
    "mean dilatation": {"mesh": ts.bar_mesh(**BLOCK, cell="tetra"), "model": ts.MeanDilatation()},
    "tetra10": {"mesh": ts.bar_mesh(**BLOCK, cell="tetra10")},
    "hexahedron20": {"mesh": ts.bar_mesh(**BLOCK, cell="hexahedron20")},
}


@pytest.mark.parametrize("name", BODIES)
def test_forces_add_up_whatever_carries_them(tmp_path, name):
    """In motion, after two cuts through cells with held nodes."""
    body = ts.Body(law=STIFF, density=DENSITY, law_for_model="nearest", **BODIES[name])
    width = body.mesh.points.max(axis=0)[1]
    simulation = ts.Scene(
        bodies={"b": body},
        gravity=(1.0, 2.0, -GRAVITY),
        fixed=[ts.Fixed("b", on=ts.Box((None, None, None), (0.05, None, 1e-9)))],
        step=ts.ImplicitEuler("1 ms"),
        editing=ts.Editing(room="900 %"),
        output=ts.Output(every=1, fields=["reactions"]),
    ).compile()
    middle = 0.45 * width
    for blade in (
        ts.Plane((0.033, middle, 0), (1, 0.2 * (width > 0), 0)),
        ts.Plane((0.021, middle, 0.001), (1, -0.7 * (width > 0), 0.1)),
    ):
        simulation.step()
        assert len(simulation.cut("b", blade).pieces) > 1
    simulation.step()
    found = written(simulation, tmp_path)
    same_wrench(simulation, found)
    if body.has_rotations:
        moments = simulation.reactions("b", moments=True)
        np.testing.assert_allclose(
            found.point_data["reaction_moments"].sum(axis=0),
            moments.sum(axis=0),
            atol=ROUND_OFF * np.abs(moments).sum(),
        )


@pytest.fixture(
    scope="module", params=[("tetra", 0), ("tetra", 1), ("hexahedron", 0), ("hexahedron", 1)]
)
def on_a_table(request):
    """A bar on a table, cut across, at rest; the second time the walls of the cut meet."""
    cell, walls_meet = request.param
    contacts = [ts.Contact(("b", "table")), *[ts.SelfContact("b", gap=4e-4)] * walls_meet]
    simulation = ts.Scene(
        bodies={"b": bar(cell, viscosity=ts.Rayleigh(mass=10, stiffness=0.01))},
        gravity=(0, 0, -GRAVITY),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.0003), (0, 0, 1))},
        contacts=contacts,
        step=ts.ImplicitEuler("5 ms"),
        editing=ts.Editing(room="500 %"),
    ).compile()
    for _ in simulation.run(0.3):
        pass
    simulation.cut("b", ts.Plane((0.033, 0, 0), (1, 0, 0)))
    for _ in simulation.run(0.3):
        pass
    return simulation


def test_only_points_that_touch_have_a_contact(on_a_table, tmp_path):
    found = written(on_a_table, tmp_path)
    pressure, gap = found.point_data["contact_pressure"], found.point_data["contact_gap"]
    rest = found.points - found.point_data["displacement"]
    low, high = rest[:, 2] < 1e-9, rest[:, 2] > 1e-3  # cells are 1 cm high
    wall = np.abs(rest[:, 0] - 0.033) < 1e-3  # those beside it begin 3 mm from it
    assert (wall & high).sum() >= 12
    touched = low if len(on_a_table.scene.contacts) == 1 else low | wall
    assert (pressure[~touched] == 0.0).all()
    assert (gap[~touched] == 1e30).all()
    # A gap is a length of the scene, or there is none.
    assert ((gap == 1e30) | (np.abs(gap) < SIZE[0])).all()
    assert (gap[low] < 1e-3).all()
    assert (pressure[low] > 0.0).any()


def test_the_pressure_bears_the_weight(tmp_path, on_a_table):
    """Over the areas of the points it is the force of the contacts, to round-off."""
    simulation = on_a_table
    contacts = simulation.contacts()
    normal = np.abs(np.einsum("ij,ij->i", contacts.forces, contacts.normals))
    twice = (contacts.pairs == contacts.surfaces.index("b")).all(axis=1)
    force = normal.sum() + normal[twice].sum()  # both walls have a force
    # The bar is nearly at rest after 0.3 s: to 1 %.
    assert normal[~twice].sum() == pytest.approx(WEIGHT, rel=0.01)
    surface = simulation.contact_surface("b")
    sides = surface.rest[surface.triangles[:, 1:]] - surface.rest[surface.triangles[:, :1]]
    third = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 6
    area = np.bincount(surface.triangles.ravel(), np.repeat(third, 3))
    # Its vertices are those of the triangles, in the order of their numbers.
    vertices = np.unique(simulation._core.contact_surface("b")[0])
    vertices -= vertices < 0  # as contacts have them
    found = written(simulation, tmp_path)
    numbers = simulation.material("b").numbers
    there = np.isin(numbers, vertices)
    assert (found.point_data["contact_pressure"][~there] == 0.0).all()
    borne = (
        found.point_data["contact_pressure"][there]
        @ area[np.searchsorted(vertices, numbers[there])]
    )
    assert borne == pytest.approx(force, rel=1e-10)


def test_every_vertex_in_contact_is_a_point(on_a_table):
    """Nodes and points of the material have one numbering in contacts and in files."""
    simulation = on_a_table
    contacts = simulation.contacts()
    number = contacts.surfaces.index("b")
    own = (contacts.pairs == number).any(axis=1)[:, None] & (contacts.nodes != -1)
    met = np.unique(contacts.nodes[own & (contacts.weights != 0.0)])
    assert met.min() < -1  # points of the cut material, too
    material, surface = simulation.material("b"), simulation.surface("b")
    assert np.isin(met, material.numbers).all()
    assert np.isin(met, surface.numbers).all()
    assert np.isin(surface.numbers, material.numbers).all()
    gap = simulation.contact_at_points("b", met).gap
    assert gap.min() == contacts.gaps.min()
    assert (gap < 1e30).all()


def test_the_live_view_shows_the_pressure_of_the_file(on_a_table, tmp_path):
    simulation = on_a_table
    seen = seen_of(simulation, "b")
    shown = contact_pressure(simulation, "b", seen)
    found = written(simulation, tmp_path)
    numbers = simulation.material("b").numbers
    order = np.argsort(numbers)
    place = order[np.searchsorted(numbers[order], seen.numbers)]
    np.testing.assert_array_equal(shown, found.point_data["contact_pressure"][place])
