"""Condensed regions in scenes: the same answers as with all nodes, and what they refuse."""

import numpy as np
import pytest

import tissu as ts

BAR = ts.BarMesh(size=(0.08, 0.04, 0.04), cells=(6, 3, 3), cell="hexahedron")
HELD = ts.Plane((0, 0, 0), (1, 0, 0))
END = ts.Plane((0.08, 0, 0), (1, 0, 0))


def scene(model="fem", *, mesh=BAR, law=None, step=None, **changes):
    law = law or ts.Hooke(young="10 kPa", poisson=0.4)
    return ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1000, model=model)},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=HELD)],
        loads=[ts.Traction("bar", on=END, traction=(20, 0, 10))],
        step=step or ts.Static(solver=ts.Cholesky()),
        **changes,
    )


def solved(scene):
    simulation = scene.compile()
    simulation.step()
    return simulation


@pytest.mark.parametrize("keep", ["touched", "surface"])
@pytest.mark.parametrize("cell", ["hexahedron", "tetra", "hexahedron20"])
def test_the_displacements_are_those_of_all_nodes(keep, cell):
    """Both solve the same equations; 1e-10 is room for the condition of the matrix (1e5)."""
    mesh = BAR.replace(cell=cell)
    whole = solved(scene(mesh=mesh)).displacements("bar")
    condensed = solved(scene(ts.Condensed(keep=keep), mesh=mesh))
    assert condensed.displacements("bar") == pytest.approx(whole, abs=1e-10 * np.abs(whole).max())
    fields = condensed.cell_fields("bar")["von_mises"]
    assert fields == pytest.approx(
        solved(scene(mesh=mesh)).cell_fields("bar")["von_mises"], rel=1e-7
    )


def test_only_the_kept_nodes_are_in_the_matrix():
    """Two ends of 4 x 4 nodes: 32 x 32 blocks, and a diagonal one for each other node."""
    plan = scene("condensed").compile().plan()
    assert plan.matrix_blocks == 32 * 32 + (7 * 16 - 32)


def test_a_condensed_half_stands_beside_a_moving_one_that_is_cut():
    """The elastic energy, which hybrid and whole share, is that of the same equations of motion.

    The inner nodes of the condensed half have no inertia of their own: slow motion agrees to the
    share of the kinetic energy, so equilibrium after strong damping is compared.
    """
    mesh = ts.bar_mesh(size=(0.08, 0.04, 0.04), cells=(6, 3, 3), cell="hexahedron")
    middle = mesh.points[mesh.cells[0].nodes].mean(axis=1)[:, 0]
    halves = {"near": np.flatnonzero(middle < 0.04), "far": np.flatnonzero(middle > 0.04)}
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions=halves)
    step = ts.ImplicitEuler(0.2, solver=ts.Cholesky())
    runs = {}
    for model in ("fem", {"near": ts.Condensed(), "far": ts.FEM()}):
        simulation = scene(model, mesh=mesh, step=step, editing=True).compile()
        for _ in range(150):
            simulation.step()
        simulation.remove_cells(body="bar", cells=halves["far"][-2:])
        for _ in range(300):
            simulation.step()
        runs[str(model)] = simulation.displacements("bar")
    whole, hybrid = runs.values()
    used = np.unique(mesh.cells[0].nodes[np.setdiff1d(np.arange(54), halves["far"][-2:])])
    assert hybrid[used] == pytest.approx(whole[used], abs=1e-6 * np.abs(whole).max())


def test_cells_of_the_condensed_region_itself_may_go_too():
    simulation = scene("condensed", editing=True).compile()
    simulation.remove_cells(body="bar", cells=[53])
    simulation.step()
    whole = scene(editing=True).compile()
    whole.remove_cells(body="bar", cells=[53])
    whole.step()
    moved = whole.displacements("bar")
    assert simulation.displacements("bar") == pytest.approx(moved, abs=1e-9 * np.abs(moved).max())


def test_another_law_is_computed_as_hookes_and_said_so():
    other = scene("condensed", law=ts.StVK(young="10 kPa", poisson=0.4))
    (problem,) = other.check().problems
    assert "it takes hooke; take one of them, the model fem, or law_for_model: nearest" in problem
    near = other.bodies["bar"].replace(law_for_model="nearest")
    check = other.replace(bodies={"bar": near}).check()
    assert check.ok
    told = [note for note in check.notes if "condensed computes hooke in place of stvk" in note]
    assert len(told) == 1


def test_a_region_that_nothing_touches_is_told_by_check():
    loose = scene("condensed", step=ts.ImplicitEuler(0.01)).replace(fixed=(), loads=())
    (problem,) = loose.check().problems
    assert problem.startswith("bodies.bar.model: found a condensed region of which no node is held")
    assert loose.replace(bodies={"bar": loose.bodies["bar"].replace(model="fem")}).check().ok


def test_a_law_without_young_is_refused():
    law = ts.MooneyRivlin(c1=1e3, c2=1e3, kappa=1e6)
    with pytest.raises(ts.SceneError, match=r"bar\.model: found condensed for the law mooney"):
        scene("condensed", law=law).compile()


@pytest.mark.parametrize("keep", ["touched", "surface"])
def test_energies_under_gravity_are_those_of_the_whole_body(keep: str) -> None:
    """1/2 u K u and -m g x of all nodes, though steps know the kept ones alone."""
    energies = []
    for model in (ts.FEM(), ts.Condensed(keep=keep)):
        body = ts.Body(
            mesh=ts.BarMesh(size=(0.2, 0.05, 0.05), cells=(4, 2, 2), cell="tetra"),
            model=model,
            law=ts.Hooke(young=1e6, poisson=0.3),
            density=1000,
        )
        simulation = ts.Scene(
            bodies={"bar": body},
            fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            gravity=(1.0, -2.0, -9.81),
            step=ts.Static(solver=ts.Cholesky()),
        ).compile()
        assert simulation.step().converged
        u = simulation.displacements("bar").ravel()
        if not energies:
            K = simulation.stiffness()
        found = simulation.energy()
        assert found["elastic"] == pytest.approx(0.5 * u @ (K @ u), rel=1e-9)
        energies.append([found["elastic"], found["potential"], found["total"]])
    assert energies[1] == pytest.approx(energies[0], rel=1e-9)
