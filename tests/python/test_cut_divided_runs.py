"""Runs of bodies whose cells cuts divide: knives, tears, contact, files, and the same bits."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from divided import (
    SLANTED,
    bar,
    fault_of_mesh,
    jittered,
    scene,
    tetrahedra,
)
from tissu.cli.run import Job, run_scene

RELAXING = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.05)])
EXAMPLES = Path(__file__).parents[2] / "examples"


def bits(simulation: ts.Simulation) -> tuple[bytes, bytes, bytes]:
    return (
        simulation.positions["bar"].tobytes(),
        simulation.velocities["bar"].tobytes(),
        tetrahedra(simulation).tobytes(),
    )


STEPS = {
    "implicit_euler": ts.ImplicitEuler(dt=0.005),
    "bdf2": ts.BDF2(dt=0.005),
    "newmark": ts.Newmark(dt=0.005),
    "symplectic_euler": ts.SymplecticEuler(dt=1e-5),
}


@pytest.mark.parametrize("step", STEPS)
def test_the_same_bits_after_a_checkpoint(step: str, tmp_path: Path) -> None:
    """Resumed after a cut; both then cut through the first one and ablate."""
    viscosity = None if step == "symplectic_euler" else RELAXING
    body = bar((4, 2, 2), viscosity=viscosity)
    first = shaken(scene(body, step=STEPS[step]).compile())
    first.velocities["bar"][:] *= 0.1
    for _ in range(3):
        first.step()
    first.cut("bar", SLANTED)
    for _ in range(3):
        first.step()
    first.save_checkpoint(tmp_path / "one")
    second = scene(body, step=STEPS[step]).compile(checkpoint=tmp_path / "one")
    assert bits(first) == bits(second)
    for simulation in (first, second):
        simulation.cut("bar", ts.Plane(point=(0.2, 0.052, 0.05), normal=(0.2, 1.0, 0.3)))
        simulation.step()
        simulation.ablate("bar", ts.Sphere((0.36, 0.05, 0.05), 0.03))
        for _ in range(3):
            simulation.step()
    assert bits(first) == bits(second)


def test_the_same_bits_after_rewind_and_on_any_number_of_threads() -> None:
    ends = []
    for threads in (1, 2, 4):
        simulation = scene(bar((6, 3, 3)), threads=threads).compile()
        simulation.step()
        mark = simulation.mark()
        for _ in range(2):
            simulation.rewind(mark)
            simulation.cut("bar", SLANTED)
            simulation.step()
            simulation.cut("bar", ts.Plane(point=(0.2, 0.052, 0.05), normal=(0.2, 1.0, 0.3)))
            for _ in range(3):
                simulation.step()
            ends.append(bits(simulation))
    assert len(set(ends)) == 1


@pytest.mark.parametrize("steps", [1, 8, 48])
def test_a_knife_cuts_step_by_step(steps: int) -> None:
    """In any number of steps it goes through: two pieces, and no cell is left."""
    for seed in range(3):
        random = np.random.default_rng(seed)
        x, (lean, turn) = random.uniform(0.15, 0.25), random.uniform(-0.3, 0.3, 2)
        path = ts.ToolPath(
            times=[0, steps * 1e-3],
            positions=[(x, -0.03, 0), (x + 0.17 * turn, 0.14, 0)],
        )
        edge = [(-0.1 * lean, 0, -0.1), (0.25 * lean, 0, 0.25)]
        knife = ts.Knife(edge=edge, cuts=["bar"], path=path)
        simulation = scene(
            bar(mesh=jittered((6, 2, 2), seed)),
            instruments={"knife": knife},
            gravity=None,
            step=ts.ImplicitEuler(dt=1e-3),
        ).compile()
        for _ in range(steps):
            cuts = simulation.step().cuts
            assert not [cut.unresolved for cut in cuts if cut.unresolved], seed
        assert fault_of_mesh(simulation) == "", seed
        assert len(simulation.pieces("bar")) == 2, seed


def test_a_run_writes_the_parts(tmp_path: Path) -> None:
    """The scalpel of the example, with divided cells: VTU files, pictures, summary."""
    text = (EXAMPLES / "scalpel.yaml").read_text(encoding="utf-8")
    divided = tmp_path / "divided.yaml"
    divided.write_text(
        text.replace("editing: true", "editing: {method: subdivide, room: 100 %}").replace(
            "cells: [20, 10, 4]", "cells: [15, 8, 3]"
        ),
        encoding="utf-8",
    )
    job = Job(divided, tmp_path / "out", None, None, quiet=True, picture=True)
    assert run_scene(job) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    cuts = summary["cuts"]
    assert sum(cut["cells_new"] for cut in cuts) > 50
    assert abs(sum(cut["volume_change"] for cut in cuts)) < 1e-17
    frame = ts.read_mesh(sorted((tmp_path / "out").rglob("*.vtu"))[-1])
    cells = np.concatenate([block.nodes for block in frame.body_blocks])
    grown = len(cells) - 6 * 15 * 8 * 3
    assert grown == sum(cut["cells_new"] - cut["cells_gone"] for cut in cuts)
    faces = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
    assert np.unique(faces, axis=0, return_counts=True)[1].max() == 2


def test_a_piece_that_is_cut_off_falls_on_the_table(tmp_path: Path) -> None:
    """With self-contact: its weight is what the table bears; then the same bits from a file."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.06, 0.03, 0.03), cells=(6, 2, 2), cell="tetra"),
        law=ts.StableNeoHooke(young="20 kPa", poisson=0.4),
        density=1000,
        viscosity=ts.Rayleigh(mass=10, stiffness=0.01),
    )
    made = scene(
        body,
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.04), (0, 0, 1))},
        contacts=[ts.Contact(("bar", "table"), friction=0.5), ts.SelfContact("bar")],
    )
    simulation = made.compile()
    report = simulation.cut("bar", ts.Plane((0.034, 0, 0), (1, 0.1, 0.05)))
    assert report.cells_new > 0
    for _ in range(150):
        assert simulation.step().converged
    (piece,) = [piece for piece in report.pieces if not piece.held]
    weight = 9.81 * piece.mass
    assert simulation.force_on("table").force[2] == pytest.approx(-weight, rel=0.005)
    assert len(simulation.crossings()) == 0
    simulation.save_checkpoint(tmp_path / "lies")
    resumed = made.compile(checkpoint=tmp_path / "lies")
    for _ in range(3):
        simulation.step()
        resumed.step()
    assert bits(simulation) == bits(resumed)


def test_a_notched_strip_tears() -> None:
    drawn = ts.Prescribed(
        "bar",
        on=ts.Plane((0.12, 0, 0), (1, 0, 0)),
        times=[0, 1],
        displacements=[(0, 0, 0), (0.08, 0, 0)],
    )
    strip = ts.bar_mesh(size=(0.12, 0.03, 0.01), cells=(24, 6, 2), cell="tetra")
    simulation = scene(
        bar(mesh=strip, law=ts.StVK(young="100 kPa", poisson=0.3)),
        prescribed=[drawn],
        gravity=None,
        tear=[ts.Tear("bar", strength="30 kPa", length="6 mm")],
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    simulation.cut("bar", ts.Disc((0.061, 0.03, 0.005), (1, 0, 0), 0.008))
    while len(simulation.pieces("bar")) == 1 and simulation.time < 0.6:
        simulation.step()
    assert [piece.held for piece in simulation.pieces("bar")] == [True, True]
    assert fault_of_mesh(simulation) == ""


def test_a_body_that_was_cut_by_copies_is_not_divided(tmp_path: Path) -> None:
    copies = scene(editing=ts.Editing(method="virtual", room="900 %"))
    simulation = copies.compile()
    simulation.cut("bar", SLANTED)
    simulation.save_checkpoint(tmp_path / "copies")
    try:
        other = scene().compile(checkpoint=tmp_path / "copies")
    except ts.TissuError as error:
        assert "editing" in str(error)
        return
    positions = np.array(other.positions["bar"])
    with pytest.raises(ts.ParameterError, match="was cut by virtual copies before"):
        other.cut("bar", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    assert (other.positions["bar"] == positions).all()
