"""Blades in connective tissue: what is severed, what is kept, and what moves as if built apart."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import tissu as ts
from severing_scenes import (
    ACROSS,
    HALF,
    MIDDLE,
    STEP,
    G,
    alone,
    around,
    flying,
    hanging,
    same,
    simulated,
    steps,
)
from tissu.simulation.lumped import momenta_of

Floats = NDArray[np.float64]


def test_the_scalpel_of_the_example_severs() -> None:
    """Nothing holds the lower block at the end, which falls."""
    simulation = ts.examples.scene("severed").compile()
    for report in simulation.run():
        assert report.converged
    upper, lower = sorted(simulation.pieces("fascia"), key=lambda piece: not piece.held)
    assert (upper.held, lower.held) == (True, False)
    assert simulation.velocities["lower"][:, 2].mean() < -1.0


def test_severed_organs_move_as_scenes_built_apart() -> None:
    """Cut off all around both blocks: each moves as if it were alone, and the tissue falls freely.

    The lower block spins and bends while it falls. The gap is bounded by what Newton's method
    leaves: 1e-9 of the load in each step.
    """
    scene, simulation = hanging(), simulated()
    apart = {body: alone(scene, body).compile() for body in ("upper", "lower")}
    for body in apart:
        assert simulation.cut("fascia", around(body)).links_severed > 100
    assert simulation._left("fascia").shared == []
    arms = simulation.positions["lower"] - (0.05, 0.05, 0.02)
    for one in (simulation, apart["lower"]):
        one.velocities["lower"][:] = np.cross((30, 20, 10), arms)
    before = simulation.positions["fascia"].copy()
    count, h = 20, 5e-3
    for one in (simulation, *apart.values()):
        steps(one, count)
    for body, one in apart.items():
        assert simulation._core.mass(body) == pytest.approx(one._core.mass(body), rel=1e-13)
        assert one.energy()["elastic"] > 1e-4
        assert np.abs(simulation.positions[body] - one.positions[body]).max() < 1e-9
    fallen = np.array([0, 0, -G * h * h * count * (count + 1) / 2])
    followed = np.unique(simulation._left("fascia").weights.frames)
    moved = simulation.positions["fascia"] - before
    assert moved[followed] == pytest.approx(np.tile(fallen, (len(followed), 1)), abs=1e-9)
    idle = np.setdiff1d(np.arange(len(moved)), followed)
    assert np.abs(moved[idle]).max(initial=0.0) < 1e-15  # frames without points are held
    elastic = sum(one.energy()["elastic"] for one in apart.values())
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-6)


def test_a_cut_in_the_middle_leaves_tissue_at_both_organs() -> None:
    """One half stays with the upper block, and the other one falls with the lower block."""
    simulation = simulated()
    steps(simulation, 5)
    mass, above = sum(simulation._core.lumped_masses()[0]), _above(simulation)
    report = simulation.cut("fascia", MIDDLE)
    assert report.points_gone == ()
    assert report.mass_change == 0.0
    assert sum(simulation._core.lumped_masses()[0]) == pytest.approx(mass, rel=1e-13)
    big = [piece for piece in report.pieces if len(piece.cells) > 10]
    assert [piece.held for piece in big].count(True) == 1
    assert sum(piece.mass for piece in report.pieces) == pytest.approx(
        simulation._links["fascia"].masses.sum(), rel=1e-12
    )
    assert all(np.array_equal(piece.cells, np.flatnonzero(above == piece.held)) for piece in big)
    start = simulation.positions["lower"][:, 2].mean()
    speed = simulation.velocities["lower"][:, 2].mean()
    steps(simulation, 40)
    t, h = 0.2, 5e-3
    fallen = simulation.positions["lower"][:, 2].mean() - start - speed * t
    # The block falls, and trembles with its half of the tissue, which is a tenth of its mass.
    assert fallen == pytest.approx(-G * t * (t + h) / 2, rel=0.05)


@pytest.mark.parametrize("blade", [MIDDLE, HALF])
def test_mass_and_momenta_are_kept(blade: ts.Plane | ts.Sweep) -> None:
    """And each side keeps its own: none of the momentum goes over to the other organ."""
    simulation = flying().compile()
    steps(simulation, 8)
    above = _above(simulation)
    sides = _sides(simulation, above)
    total = _momenta(simulation)
    size = np.abs(total).reshape(2, 3).max(axis=1).repeat(3)
    report = simulation.cut("fascia", blade)
    assert report.links_severed > 20
    assert (np.abs(_momenta(simulation) - total) < 1e-12 * size).all()
    assert np.abs(report.momentum_change).max() < 1e-12 * size[0]
    assert np.abs(report.angular_momentum_change).max() < 1e-12 * size[-1]
    assert np.abs(report.kinetic_energy_change) < 0.05 * simulation.energy()["kinetic"]
    if blade is MIDDLE:
        now = _sides(simulation, above)
        for side in ("upper", "lower"):
            assert (np.abs(now[side] - sides[side]) < 1e-11 * size).all()
    steps(simulation, 20)
    assert (np.abs(_momenta(simulation) - total)[:3] < 1e-7 * size[:3]).all()


@pytest.mark.parametrize("kind", ["frames", "shell"])
def test_organs_whose_nodes_turn_keep_their_momenta(kind: str, tmp_path: Path) -> None:
    """The tissue follows their nodes themselves. A checkpoint goes on."""
    scene = flying()
    bodies = {name: _turning(kind, name, body) for name, body in scene.bodies.items()}
    fascia = scene.tissue["fascia"].replace(points=100)
    if kind == "shell":  # their sheets are not closed: the tissue fills the gap
        gap = ts.BarMesh(size=(0.08, 0.08, 0.03), cells=(1, 1, 1), cell="hexahedron",
                         origin=(0.01, 0.01, 0.04))  # fmt: skip
        fascia = fascia.replace(inside=gap, reach=None)
    scene = scene.replace(bodies=bodies, tissue={"fascia": fascia})
    simulation = scene.compile()
    steps(simulation, 6)
    total = _momenta(simulation)
    size = np.abs(total).reshape(2, 3).max(axis=1).repeat(3)
    report = simulation.cut("fascia", HALF)
    assert report.links_severed > 10
    assert report.points_gone == ()
    assert (np.abs(_momenta(simulation) - total) < 1e-12 * size).all()
    steps(simulation, 2)
    simulation.save_checkpoint(tmp_path / "cut.tissu")
    resumed = scene.compile(checkpoint=tmp_path / "cut.tissu")
    for one in (simulation, resumed):
        one.cut("fascia", MIDDLE)
        steps(one, 2)
    assert same(simulation, resumed)


def _turning(kind: str, name: str, body: ts.Body) -> ts.Body:
    """A block of frames, or the sheet of shells on the side of it where the tissue is."""
    start = ts.Start(velocity=(0.1, 0, 0.05) if name == "upper" else (-0.1, 0.2, 0))
    if kind == "frames":
        return body.replace(model=ts.Frames(), start=start)
    points = body.mesh.mesh().points
    low, high = points.min(axis=0), points.max(axis=0)
    origin = (*low[:2], low[2] if name == "upper" else high[2])
    sheet = ts.BarMesh(size=(*(high - low)[:2], 0), cells=(5, 5, 0), cell="triangle", origin=origin)
    law = ts.Hooke(young=1e5, poisson=0.3)
    return ts.Body(mesh=sheet, law=law, density=1e3, thickness="5 mm", model="shell", start=start)


def _momenta(simulation: ts.Simulation) -> Floats:
    """Momentum and angular momentum of everything, by the matrix of mass."""
    rows, columns, blocks = simulation._core.mass_matrix()
    p = np.zeros_like(simulation._core.velocities)
    np.add.at(p, rows, np.einsum("bij,bj->bi", blocks, simulation._core.velocities[columns]))
    x, places = simulation._core.positions, np.zeros(len(p), dtype=bool)
    for name in (*simulation.bodies, *simulation.tissue):
        first, count = simulation._core.body_range(name)
        places[first : first + count] = True
    turning = p[~places].sum(axis=0)
    return np.concatenate(
        [p[places].sum(axis=0), np.cross(x[places], p[places]).sum(axis=0) + turning]
    )


def _above(simulation: ts.Simulation) -> NDArray[np.bool_]:
    """Which points are above the middle now."""
    return np.asarray(simulation.points("fascia")[:, 2] > 0.055)


def _sides(simulation: ts.Simulation, above: NDArray[np.bool_]) -> dict[str, Floats]:
    """Momenta of each block alone and of the points that are, or were, on its side."""
    left = simulation._left("fascia")
    points = momenta_of(simulation, "fascia", left, left.kept)
    of_points = {"upper": points[above].sum(axis=0), "lower": points[~above].sum(axis=0)}
    found = {}
    for body, tissue in of_points.items():
        mesh = simulation.meshes[body]
        alone = ts.Scene(bodies={body: simulation.scene.bodies[body]}, step=STEP).compile()
        mass = alone._core.lumped_masses()[0][: mesh.node_count, None]
        p = mass * simulation.velocities[body]
        own = [p.sum(axis=0), np.cross(simulation.positions[body], p).sum(axis=0)]
        found[body] = np.concatenate(own) + tissue
    return found


def test_the_weights_left_are_those_of_shepard() -> None:
    """Of tissue in a box, which follows its own frames alone: w_i = d_i^-2 / sum, and its slope."""
    block = ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron")
    tissue = ts.Tissue(inside=block, frames=20, points=60, neighbours=6, mass=1,
                       law=ts.StVK(young=6e3, poisson=0.3))  # fmt: skip
    simulation = ts.Scene(tissue={"block": tissue}, step=STEP, editing=True).compile()
    disc = ts.Disc((0.1, 0.05, 0.05), (1, 0, 0.2), 0.04)
    report = simulation.cut("block", disc)
    links, left = simulation._links["block"], simulation._left("block")
    severed = simulation._severed["block"]
    assert 10 < len(severed) == report.links_severed
    normal = np.array([1, 0, 0.2]) / np.linalg.norm([1, 0, 0.2])
    for row, point in enumerate(left.kept):
        x = links.points[point]
        frames = [f for f in links.listened.frames[point] if [point, f] not in severed.tolist()]
        arms = x - links.origins[frames]
        power = (arms**2).sum(axis=1) ** -1.0
        w = power / power.sum()
        g = -2 * arms / (arms**2).sum(axis=1)[:, None]
        slope = w[:, None] * (g - w @ g)
        count = left.weights.listed()[row]
        order = np.argsort(frames)
        assert left.weights.frames[row][count] == pytest.approx(np.array(frames)[order])
        assert left.weights.weights[row][count] == pytest.approx(w[order], rel=1e-9)
        assert left.weights.gradients[row][count] == pytest.approx(slope[order], abs=1e-8 * 100)
        # By hand: both ends on other sides of the plane of the disc, and the crossing within it.
        for f in links.listened.frames[point]:
            a, b = (links.origins[f] - disc.center) @ normal, (x - disc.center) @ normal
            at = links.origins[f] + a / (a - b) * (x - links.origins[f])
            r = np.linalg.norm(at - disc.center)
            if abs(r - 0.04) > 4e-4:  # beside the rim, which is a polygon
                assert ([point, f] in severed.tolist()) == (a * b < 0 and r < 0.04)


def test_moving_least_squares_fall_to_shepard_where_frames_do_not_span() -> None:
    """All weights sum to one and hold F = 1 at rest; those that span stay linear."""
    scene = hanging()
    fascia = scene.tissue["fascia"].replace(shape="moving_least_squares", frames=40)
    simulation = scene.replace(tissue={"fascia": fascia}).compile()
    simulation.cut("fascia", MIDDLE)
    simulation.cut("fascia", ACROSS)
    links, left = simulation._links["fascia"], simulation._left("fascia")
    assert left.weights.weights.sum(axis=1) == pytest.approx(1.0, abs=1e-9)
    assert left.weights.gradients.sum(axis=1) == pytest.approx(0.0, abs=1e-6)
    pairs = links.without(simulation._severed["fascia"])
    touched = np.unique(simulation._severed["fascia"][:, 0])
    kinds = set()
    for p in np.intersect1d(touched, left.kept):
        frames = np.ascontiguousarray(pairs[pairs[:, 0] == p, 1])
        found = links._shaped(int(p), links.origins[frames])
        place = found.weights[0] @ links.origins[frames][found.frames[0]]
        linear = np.allclose(place, links.points[p], atol=1e-9)
        kinds.add(linear)
        assert linear or not links._serves(links.origins[frames]) or found.weights.min() >= 0.0
    assert kinds == {True, False}
    assert simulation.energy()["elastic"] == pytest.approx(0.0, abs=1e-12)


def test_static_equilibrium_after_a_cut() -> None:
    """Partly cut, the lower block hangs deeper, and the support still bears the whole weight.

    A cut that would leave it without support is refused, and changes no bit.
    """
    step = ts.Static(newton=ts.Newton(iterations=60), load_steps=4, solver=ts.Cholesky())
    simulation = hanging(step=step).compile()
    weight = G * float(simulation._core.lumped_masses()[0].sum())
    start, sunk = simulation.mark(), []
    for refused in (False, True):
        simulation.rewind(start)
        if refused:
            with pytest.raises(ts.ParameterError, match="1 more part of the scene without support"):
                simulation.cut("fascia", MIDDLE)
        assert simulation.step().converged
        assert simulation.reactions("upper")[:, 2].sum() == pytest.approx(weight, rel=1e-5)
        sunk.append(simulation.displacements("lower"))
    assert np.array_equal(*sunk)
    simulation.rewind(start)
    quarter = ts.Sweep([[(x, -0.01, 0.055), (x, 0.11, 0.055)] for x in (-0.01, 0.035)])
    assert simulation.cut("fascia", quarter).links_severed > 10
    assert simulation.step().converged
    assert simulation.reactions("upper")[:, 2].sum() == pytest.approx(weight, rel=1e-5)
    assert simulation.displacements("lower")[:, 2].min() < sunk[0][:, 2].min() - 1e-3
    # Under load the energy jumps: by what the report says.
    before = simulation.energy()["elastic"]
    report = simulation.cut(
        "fascia", ts.Sweep([[(x, -0.01, 0.05), (x, 0.11, 0.05)] for x in (0.03, 0.04)])
    )
    assert report.links_severed > 0
    jump = simulation.energy()["elastic"] - before
    assert abs(jump) > 1e-9
    assert report.elastic_energy_change == pytest.approx(jump, rel=1e-9)
