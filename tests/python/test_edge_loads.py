"""Tractions and pressures on the rim of flat bodies, and pressures that do not follow."""

import numpy as np
import pytest

import tissu as ts
from field_states import SHEETS

E, NU = 1000.0, 0.3
THICKNESS = 0.02
SIZE = (0.2, 0.1, 0)
RIGHT = ts.Plane((0.2, 0, 0), (1, 0, 0))
TOP = ts.Plane((0, 0.1, 0), (0, 1, 0))


def scene(cell, *, loads, law=None, held=True, plane="strain"):
    body = ts.Body(
        mesh=ts.BarMesh(size=SIZE, cells=(4, 2, 0), cell=cell),
        law=ts.Hooke(young=E, poisson=NU) if law is None else law,
        density=1e3,
        thickness=THICKNESS,
        plane=plane,
    )
    sides = [ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)), axes="x")]
    sides.append(ts.Fixed("b", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y"))
    return ts.Scene(
        bodies={"b": body},
        fixed=sides if held else [],
        loads=loads,
        step=ts.Static(newton=ts.Newton(iterations=30, tolerance=1e-11), solver=ts.Cholesky()),
    )


def settled(made):
    simulation = made.compile()
    report = simulation.step()
    assert report.converged, report
    return simulation


@pytest.mark.parametrize("follows", [True, False])
@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("cell", SHEETS)
def test_pressure_on_the_rim_presses_evenly(cell, plane, follows):
    """p on the right and the top: sigma_xx = sigma_yy = -p everywhere (Hooke, p of 1e-3 E)."""
    p = 1e-3 * E
    loads = [ts.Pressure("b", on=on, pressure=p, follows=follows) for on in (RIGHT, TOP)]
    simulation = settled(scene(cell, loads=loads, plane=plane))
    stress = simulation.field("first_piola_kirchhoff_stress", "points")
    # A follower acts on the shortened rim: lengths differ by the strain, p (1 + nu) / E.
    share = 1e-8 if not follows else 2e-3
    for axis in (0, 1):
        np.testing.assert_allclose(stress[:, axis, axis], -p, rtol=share)
    assert np.abs(stress[:, 0, 1]).max() < share * p
    across = -2 * NU * p if plane == "strain" else 0.0
    np.testing.assert_allclose(stress[:, 2, 2], across, atol=share * p)


@pytest.mark.parametrize("cell", SHEETS)
def test_traction_on_an_edge_pulls_evenly(cell):
    """Plane stress, t along x: sigma_xx = t, eps_xx = t / E, eps_yy = -nu t / E."""
    t = 50.0
    load = ts.Traction("b", on=RIGHT, traction=(t, 0, 0))
    simulation = settled(scene(cell, loads=[load], plane="stress"))
    rest = simulation.meshes["b"].points
    np.testing.assert_allclose(
        simulation.displacements("b"), rest * [t / E, -NU * t / E, 0], atol=1e-9 * 0.2
    )
    given = simulation.reactions("b").sum(axis=0)
    assert given == pytest.approx((-t * SIZE[1] * THICKNESS, 0, 0), abs=1e-10)


@pytest.mark.parametrize("cell", ["triangle", "triangle6", "quad", "quad9"])
def test_pressure_all_around_is_that_of_a_body_of_volumes(cell):
    """Plane strain, StVK, a large pressure: the slice of a long body under the same pressure."""
    p, law = 150.0, ts.StVK(young=E, poisson=NU)
    flat = settled(
        scene(cell, loads=[ts.Pressure("b", on=on, pressure=p) for on in (RIGHT, TOP)], law=law)
    )
    ratio = flat.field("volume_ratio")
    sigma = flat.field("cauchy_stress")
    # A homogeneous state: sigma_xx = sigma_yy = -p, lambda_x = lambda_y = s.
    s = np.sqrt(ratio[0])
    strain = (s**2 - 1) / 2
    la, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
    assert (2 * la + 2 * mu) * strain * s**2 / s**2 == pytest.approx(-p, rel=1e-8)
    np.testing.assert_allclose(sigma[:, 0, 0], -p, rtol=1e-8)
    np.testing.assert_allclose(sigma[:, 1, 1], -p, rtol=1e-8)
    assert ratio.max() < 0.85


@pytest.mark.parametrize("cell", SHEETS)
@pytest.mark.parametrize("clockwise", [False, True])
def test_forces_of_a_rim_are_the_slope_of_its_energy(cell, clockwise):
    """f = -dE/dx of p times area and thickness, whichever way the cells are numbered."""
    made = ts.BarMesh(size=SIZE, cells=(4, 2, 0), cell=cell)
    mesh = ts.bar_mesh(size=SIZE, cells=(4, 2, 0), cell=cell)
    if clockwise:
        mesh = ts.Mesh(points=mesh.points * [1, -1, 1], cells=mesh.cells)
    body = ts.Body(
        mesh=mesh if clockwise else made,
        law=ts.Hooke(young=1.0, poisson=0.0),
        density=1e3,
        thickness=THICKNESS,
        plane="strain",
    )
    load = ts.Pressure("b", on=ts.SurfaceNodes(), pressure=3e3)
    simulation = ts.Scene(bodies={"b": body}, loads=[load], step=ts.ImplicitEuler("1 ms")).compile()
    x = simulation.positions["b"]
    random = np.random.default_rng(2)
    x[:, :2] += random.normal(0, 5e-3, (len(x), 2))
    found = simulation.forces()
    energy = simulation.energy()
    flat = np.array(x)
    for node, axis in [(0, 0), (0, 1), (len(x) // 2, 0), (len(x) - 1, 1)]:
        sides = []
        for sign in (1, -1):
            x[:] = flat
            x[node, axis] += sign * 1e-6
            sides.append(simulation.energy()["total"])
        x[:] = flat
        # Quadratic in one coordinate: the central difference is exact to round-off.
        assert found[node, axis] == pytest.approx((sides[1] - sides[0]) / 2e-6, abs=1e-6)
    assert energy["potential"] > 0.5 * 3e3 * SIZE[0] * SIZE[1] * THICKNESS  # inwards: p V
    assert np.abs(found.sum(axis=0)).max() < 1e-12 * np.abs(found).max() * len(found)


def test_a_dead_pressure_keeps_its_direction_and_a_follower_turns():
    """A plate turned by a quarter: forces on its right edge stay, or turn with it."""
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
    force = 10.0 * SIZE[1] * THICKNESS
    for follows, expected in ((False, (-force, 0, 0)), (True, (0, -force, 0))):
        load = ts.Pressure("b", on=RIGHT, pressure=10, follows=follows)
        made = scene("quad", loads=[load], held=False, law=ts.StVK(young=E, poisson=NU))
        simulation = made.replace(step=ts.ImplicitEuler("1 ms")).compile()
        simulation.positions["b"][:] = simulation.meshes["b"].points @ quarter.T
        found = simulation.forces()[simulation.rows("b")].sum(axis=0)
        assert found == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron20"])
def test_a_dead_pressure_on_volumes_is_the_traction_along_the_normal(cell):
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell=cell),
        law=ts.StVK(young=E, poisson=NU),
        density=1e3,
    )
    forces = []
    for load in (
        ts.Pressure("b", on=RIGHT, pressure=7, follows=False),
        ts.Traction("b", on=RIGHT, traction=(-7, 0, 0)),
    ):
        made = ts.Scene(bodies={"b": body}, loads=[load], step=ts.ImplicitEuler("1 ms")).compile()
        forces.append(made.forces())
    np.testing.assert_allclose(forces[0], forces[1], atol=1e-14)
    assert forces[0].sum(axis=0) == pytest.approx((-7 * 0.01, 0, 0), rel=1e-12)


def test_inner_edges_carry_no_load():
    """A selection of all nodes means the rim: the load of a closed rim adds up to nothing."""
    load = ts.Pressure("b", on=ts.SurfaceNodes(), pressure=10)
    made = scene("quad", loads=[load], held=False)
    assert "12 edges" in str(made.check())
    forces = made.replace(step=ts.ImplicitEuler("1 ms")).compile().forces()
    assert np.abs(forces.sum(axis=0)).max() < 1e-14
    inner = ts.bar_mesh(size=SIZE, cells=(4, 2, 0), cell="quad").points
    inside = (inner[:, 0] % 0.2 > 1e-9) & (inner[:, 1] % 0.1 > 1e-9)
    assert np.abs(forces[inside]).max() < 1e-14  # round-off of the elastic forces at rest


def test_a_selection_without_an_edge_is_refused():
    found = scene("quad", loads=[ts.Pressure("b", on=ts.Nodes([0]), pressure=1)]).check().problems
    assert "but no edge of its surface with all its nodes" in found[0]


def test_the_stiffness_of_a_pressed_rim_is_the_slope_of_its_forces():
    """All around, where it is symmetric; without the body's own, which is soft here."""
    load = ts.Pressure("b", on=ts.SurfaceNodes(), pressure=3e3)
    made = scene("quad8", loads=[load], held=False, law=ts.Hooke(young=1e-3, poisson=0.0))
    simulation = made.replace(step=ts.ImplicitEuler("1 ms")).compile()
    x = simulation.positions["b"]
    random = np.random.default_rng(6)
    x[:, :2] += random.normal(0, 2e-3, (len(x), 2))
    along, h = random.normal(0, 1, x.shape), 1e-4
    sides = []
    for sign in (1, -1):
        x += sign * h * along
        sides.append(simulation.forces().ravel())
        x -= sign * h * along
    slope = (sides[0] - sides[1]) / (2 * h)  # exact to round-off: forces are linear in x
    found = simulation.stiffness() @ along.ravel()
    np.testing.assert_allclose(found, -slope, atol=1e-9 * np.abs(slope).max())
    assert np.abs(slope).max() > 1


def quarter_ring(inner, outer, cells):
    """Quadrangles of nine nodes between two radii, from the x axis to the y axis."""
    radii = np.linspace(inner, outer, 2 * cells + 1)
    angles = np.linspace(0, np.pi / 2, 4 * cells + 1)
    r, a = (grid.ravel() for grid in np.meshgrid(radii, angles))
    points = np.stack([r * np.cos(a), r * np.sin(a), np.zeros_like(r)], axis=1)
    row = 2 * cells + 1
    corner = [2 * i + 2 * j * row for j in range(2 * cells) for i in range(cells)]
    around = [0, 2, 2 * row + 2, 2 * row, 1, row + 2, 2 * row + 1, row, row + 1]
    nodes = np.array(corner)[:, None] + np.array(around)
    return ts.Mesh(points=points, cells={"quad9": nodes}), r, a


def test_a_pipe_under_pressure_meets_lame():
    """Plane strain: sigma_r, sigma_t = p a^2 / (b^2 - a^2) (1 -+ b^2 / r^2), sigma_z = nu (sum).

    Lamé 1852. Stress at nodes converges with the square of the cell size: the ratio goes to 4.
    """
    a, b, p = 0.1, 0.2, 1.0
    errors = []
    for cells in (4, 8):
        mesh, r, angle = quarter_ring(a, b, cells)
        body = ts.Body(
            mesh=mesh,
            law=ts.Hooke(young=1e6, poisson=NU),
            density=1e3,
            thickness=THICKNESS,
            plane="strain",
        )
        simulation = ts.Scene(
            bodies={"b": body},
            fixed=[
                ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)), axes="x"),
                ts.Fixed("b", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y"),
            ],
            loads=[ts.Pressure("b", on=ts.Sphere((0, 0, 0), a * 1.001), pressure=p)],
            step=ts.Static(solver=ts.Cholesky()),
        ).compile()
        assert simulation.step().converged
        sigma = simulation.field("first_piola_kirchhoff_stress", "nodes")
        out = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        along = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
        factor = p * a**2 / (b**2 - a**2)
        radial = np.einsum("ni,nij,nj->n", out, sigma, out) - factor * (1 - b**2 / r**2)
        hoop = np.einsum("ni,nij,nj->n", along, sigma, along) - factor * (1 + b**2 / r**2)
        across = sigma[:, 2, 2] - NU * 2 * factor
        errors.append(max(np.abs(radial).max(), np.abs(hoop).max(), np.abs(across).max()))
    assert errors[1] < 0.013 * p
    assert errors[1] < errors[0] / 3.4
