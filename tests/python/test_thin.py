"""Sheets and lines of a scene against closed forms, and against the volumes they stand for."""

import numpy as np
import pytest

from tissu import (
    BarMesh,
    Body,
    Box,
    Cholesky,
    Fixed,
    ImplicitEuler,
    NeoHooke,
    Newton,
    NodalLoad,
    Nodes,
    Prescribed,
    Pressure,
    Scene,
    Static,
    StVK,
)
from tissu.mesh import CellBlock, Mesh, bar_mesh

E, NU, RHO = 1e4, 0.3, 1000.0
LAW = StVK(young=E, poisson=NU)
STATIC = Static(newton=Newton(iterations=50, tolerance=1e-10), solver=Cholesky(), load_steps=4)
EVERYWHERE = Box(None, None)
LEFT = Box(None, (0, None, None))


def solved(**fields):
    simulation = Scene(step=STATIC, **fields).compile()
    assert simulation.step().converged
    return simulation


def stretch(stress, young=E):
    """The s > 1/sqrt(3) with E/2 (s^2 - 1) s = stress."""
    roots = np.roots([young / 2, 0.0, -young / 2, -stress])
    return float(roots.real[np.argmin(np.abs(roots - 1.0))])


def test_a_hanging_string_is_stretched_by_the_weight_below():
    """Tension at a cell is the weight of the nodes below: N = A E/2 (s^2 - 1) s, node by node."""
    count, length, section, g = 5, 0.5, 2e-4, 9.81
    body = Body(
        mesh=BarMesh(size=(length, 0, 0), cells=(count, 0, 0), cell="line"),
        law=LAW,
        density=RHO,
        section=section,
    )
    simulation = solved(
        bodies={"string": body},
        fixed=[Fixed("string", on=LEFT), Fixed("string", on=EVERYWHERE, axes="yz")],
        gravity=(g, 0, 0),
    )
    x = simulation.positions["string"][:, 0]
    h = length / count
    expected = [h * stretch(RHO * g * h * (count - i - 0.5)) for i in range(count)]
    np.testing.assert_allclose(np.diff(x), expected, rtol=1e-8)  # Newton's tolerance
    assert np.diff(x).max() > 1.2 * h


def test_a_cable_of_two_pieces_carries_a_load_at_its_middle():
    """2 N sin(angle) = P, with N = A E/2 (s^2 - 1) s of each half."""
    half, depth, section, load = 1.0, 0.2, 1e-4, 0.1
    points = [(-half, 0, 0), (half, 0, 0), (0, 0, -depth)]
    mesh = Mesh(points=points, cells=(CellBlock("line", [[0, 2], [2, 1]]),))
    body = Body(mesh=mesh, law=LAW, density=RHO, section="1 cm^2")
    simulation = solved(
        bodies={"cable": body},
        fixed=[Fixed("cable", on=Nodes(ids=(0, 1))), Fixed("cable", on=Nodes(ids=(2,)), axes="y")],
        loads=[NodalLoad("cable", on=Nodes(ids=(2,)), force=(0, 0, -load))],
    )
    x, _, z = simulation.positions["cable"][2]
    s = np.hypot(half, z) / np.hypot(half, depth)
    assert abs(x) < 1e-9
    tension = section * E / 2 * (s**2 - 1) * s
    assert 2 * tension * -z / np.hypot(half, z) == pytest.approx(load, rel=1e-7)
    assert s > 1.05


@pytest.mark.parametrize("cell", ["quad", "quad8", "quad9", "triangle", "triangle6"])
@pytest.mark.parametrize("plane", ["stress", "strain", None])
def test_a_plate_pulled_along_x_narrows(cell, plane):
    """P_y = 0: E_y = -nu E_x; without strain across nu -> nu / (1 - nu), E -> E / (1 - nu^2).

    Without `plane` the sheet is free to thin; z is held here, since nothing else would do it.
    """
    length, width, thickness, s = 0.2, 0.1, 0.01, 1.2
    nu, young = (NU / (1 - NU), E / (1 - NU**2)) if plane == "strain" else (NU, E)
    body = Body(
        mesh=BarMesh(size=(length, width, 0), cells=(3, 2, 0), cell=cell),
        law=LAW,
        density=RHO,
        thickness=thickness,
        plane=plane,
    )
    held = [
        Fixed("plate", on=LEFT, axes="x"),
        Fixed("plate", on=Box(None, (None, 0, None)), axes="y"),
    ]
    if plane is None:
        held.append(Fixed("plate", on=EVERYWHERE, axes="z"))
    right = Box((length, None, None), None)
    far = ((s - 1) * length, 0, 0)
    pulled = Prescribed("plate", on=right, axes="x", times=(0,), displacements=[far])
    simulation = solved(bodies={"plate": body}, fixed=held, prescribed=[pulled])
    rest, now = simulation.meshes["plate"].points, simulation.positions["plate"]
    across = np.sqrt(1 - nu * (s**2 - 1))
    np.testing.assert_allclose(now, rest * [s, across, 1], atol=1e-9 * length)
    strain = (s**2 - 1) / 2
    energy = young / 2 * strain**2 * length * width * thickness
    assert simulation.energy()["elastic"] == pytest.approx(energy, rel=1e-9)


def cantilever(mesh, *, axes, **fields):
    body = Body(mesh=mesh, law=LAW, density=RHO, **fields)
    fixed = [Fixed("beam", on=LEFT)]
    if axes:
        fixed.append(Fixed("beam", on=EVERYWHERE, axes=axes))
    return solved(bodies={"beam": body}, fixed=fixed, gravity=(0, -9.81, 0))


@pytest.mark.parametrize("law", ["quad", "quad9"])
def test_plane_strain_is_the_slice_of_a_long_body(law):
    """One layer of volumes whose nodes are held along z: the same equations, so the same sag."""
    thickness = 0.02
    flat = cantilever(
        BarMesh(size=(0.2, 0.04, 0), cells=(8, 2, 0), cell=law),
        axes=None,
        thickness=thickness,
        plane="strain",
    )
    solid_cell = {"quad": "hexahedron", "quad9": "hexahedron27"}[law]
    solid = cantilever(
        BarMesh(size=(0.2, 0.04, thickness), cells=(8, 2, 1), cell=solid_cell), axes="z"
    )
    points, moved = solid.meshes["beam"].points, solid.displacements("beam")
    face = np.flatnonzero(points[:, 2] == 0)
    of_flat, of_face = (
        np.lexsort(np.round(p[:, :2], 9).T) for p in (flat.meshes["beam"].points, points[face])
    )
    sag = flat.displacements("beam")[of_flat]
    assert len(sag) == len(face)
    np.testing.assert_allclose(sag, moved[face][of_face], atol=1e-6 * np.abs(sag).max())
    assert sag.min() < -0.02


def organ(**fields):
    """A block of tetrahedra whose outer faces are in its mesh."""
    solid = bar_mesh(size=(0.04, 0.03, 0.02), cells=(4, 3, 2))
    mesh = Mesh(
        points=solid.points, cells=(*solid.cells, CellBlock("triangle", solid.surface().triangles))
    )
    return Body(mesh=mesh, **fields)


def sagging(body):
    return Scene(
        bodies={"organ": body},
        fixed=[Fixed("organ", on=LEFT)],
        gravity=(0, 0, -9.81),
        step=ImplicitEuler(0.01),
    ).compile()


def test_a_capsule_stiffens_the_organ_it_wraps():
    parenchyma = NeoHooke(young=2e3, poisson=0.4)
    bare = sagging(organ(law=parenchyma, density=RHO))
    law = {"volumes": parenchyma, "sheets": StVK(young=1e6, poisson=0.3)}
    wrapped = sagging(organ(law=law, density=RHO, thickness="0.1 mm"))
    mesh = wrapped.meshes["organ"]
    assert {name: len(cells) for name, cells in mesh.regions.items()} == {
        "volumes": 144,
        "sheets": len(mesh.surface().triangles),
    }
    area = 2 * (0.04 * 0.03 + 0.04 * 0.02 + 0.03 * 0.02)
    mass = RHO * (0.04 * 0.03 * 0.02 + area * 1e-4)
    assert wrapped._world.mass == pytest.approx(mass, rel=1e-12)
    for _ in range(20):
        assert bare.step().converged
        assert wrapped.step().converged
    lowest = [s.displacements("organ")[:, 2].min() for s in (bare, wrapped)]
    assert lowest[0] < 2 * lowest[1] < 0


def test_a_mesh_that_says_itself_which_cells_are_thin_has_the_same_regions():
    law = {"volumes": NeoHooke(young=2e3, poisson=0.4), "sheets": StVK(young=1e6, poisson=0.3)}
    whole = organ(law=law, density=RHO, thickness="0.1 mm")
    said = Mesh(points=whole.mesh.points, cells=whole.mesh.cells, thin=(2,))
    found = [sagging(body) for body in (whole, whole.replace(mesh=said))]
    ends = []
    for simulation in found:
        assert simulation.step().converged
        ends.append(simulation.positions["organ"])
        assert set(simulation.meshes["organ"].regions) == {"volumes", "sheets"}
    np.testing.assert_array_equal(*ends)


def test_a_total_mass_is_that_of_volumes_sheets_and_lines():
    solid = bar_mesh(size=(0.1, 0.1, 0.1), cells=(1, 1, 1), cell="hexahedron")
    points = np.vstack([solid.points, [(0.2, 0, 0)]])
    blocks = (CellBlock("line", [[1, 8]]), CellBlock("quad", [[0, 1, 3, 2]]), *solid.cells)
    body = Body(
        mesh=Mesh(points=points, cells=blocks), law=LAW, mass=2.0, thickness=0.01, section="1 cm2"
    )
    simulation = sagging(body)
    assert simulation._world.mass == pytest.approx(2.0, rel=1e-12)
    assert simulation.step().converged
    assert simulation.meshes["organ"].parts().tolist() == [0, 0, 0]


def test_pressure_pushes_a_sheet_against_its_winding():
    side, thickness, pressure, dt = 0.1, 1e-3, 2.0, 1e-4
    body = Body(
        mesh=BarMesh(size=(side, side, 0), cells=(3, 3, 0), cell="quad"),
        law=LAW,
        density=RHO,
        thickness=thickness,
    )
    scene = Scene(
        bodies={"sheet": body},
        loads=[Pressure("sheet", on=EVERYWHERE, pressure=pressure)],
        step=ImplicitEuler(dt),
    )
    simulation = scene.compile()
    simulation.step()
    share = np.outer([0.5, 1, 1, 0.5], [0.5, 1, 1, 0.5]).ravel() / 9  # of the mass, of each node
    momentum = share @ simulation.velocities["sheet"][:, 2]
    assert momentum == pytest.approx(-pressure * dt / (RHO * thickness), rel=1e-6)


def test_yaml_says_the_same():
    body = Body(
        mesh=BarMesh(size=(0.2, 0.1, 0), cells=(3, 2, 0), cell="quad8"),
        law=LAW,
        density=RHO,
        thickness="2 mm",
        section="1 mm^2",
        plane="stress",
    )
    scene = Scene(bodies={"plate": body}, step=ImplicitEuler(0.01))
    again = Scene.from_yaml_text(scene.to_yaml()).bodies["plate"]
    assert (again.thickness, again.section, again.plane) == (2e-3, pytest.approx(1e-6), "stress")
    assert again == body
