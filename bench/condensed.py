"""Prints docs/measured/condensed.md: a linear body, whole and condensed: --write."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

PAGE = Path(__file__).resolve().parents[1] / "docs" / "measured" / "condensed.md"
SIZES = ((8, 4, 4), (16, 8, 8), (24, 12, 12))
STEPS = 30
HEAD = """# Condensed linear bodies

How fast is a step of a linear body if its matrix is factored, or its inner nodes eliminated, in
advance? With a few touched nodes, a condensed step is several times as fast as a sparse solve.
With a whole surface, it is several times as slow.

A body of Hooke's law under `step: {type: static, solver: {type: cholesky}}` has one constant
matrix. It is factored in the first step, and every later step costs one solve. `model: condensed`
goes further (Bro-Nielsen and Cotin 1996): inner nodes are eliminated once. The unknowns are the
touched nodes (fixed, prescribed, loaded, or shared with other cells), and on request the whole
surface. The positions of the other nodes are computed on demand, by a solve with the factor of the
inner nodes. In [contact](../guide/contact.md) any node of the surface may be touched, so all of
them are kept, whatever `keep` says.

One region may be condensed while others have models of their own (Cotin, Delingette, Ayache 2000):

```yaml
model: {far: condensed, near: fem}   # regions of the mesh
editing: true                        # cells of `near` may go; `far` is not condensed again
```

A bar of hexahedra is held at one end and pulled at four nodes of the other, by a force that
changes in each step. Times are medians of 30 steps on one thread. The answers agree to 1e-9 of
the largest displacement.

"""
TAIL = """
The time of a step is bounded by the memory that it reads. The sparse solve reads its factor twice.
The condensed solve reads a dense matrix of (3 n)^2 numbers, where n is the number of kept nodes. So
a step with a few touched nodes costs next to nothing, and one with a whole surface of some thousand
nodes costs more than the sparse solve of the whole body. Keep the surface only if something may
touch it anywhere. The preparation takes one solve for each kept degree of freedom.
"""


def scene(cells: tuple[int, int, int], model: object) -> ts.Scene:
    """The bar; its pull turns as time goes."""
    corners = ts.Box((0.0799, None, None), (None, 0.0051, 0.0051))
    return ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.BarMesh(size=(0.08, 0.04, 0.04), cells=cells, cell="hexahedron"),
                law=ts.Hooke(young="10 kPa", poisson=0.45),
                density=1000,
                model=model,
            )
        },
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[
            ts.NodalLoad(
                "bar", on=corners, force=(0.01, 0, 0.02), times=[0, 2 * STEPS], factors=[0, 1]
            )
        ],
        step=ts.Static(solver=ts.Cholesky()),
    )


def measured(cells: tuple[int, int, int], model: object) -> tuple[str, np.ndarray]:
    """A row of the table, and the displacements at its end."""
    begin = time.perf_counter()
    simulation = scene(cells, model).compile()
    simulation.step()
    made = time.perf_counter() - begin
    simulation.clear_profile()
    for _ in range(STEPS):
        simulation.step()
    begin = time.perf_counter()
    moved = np.array(simulation.displacements("bar"))
    looked = 1e3 * (time.perf_counter() - begin)
    name = model if isinstance(model, str) else f"condensed, keep {model.keep}"  # type: ignore[attr-defined]
    mesh = simulation.meshes["bar"]
    blocks = simulation.plan().matrix_blocks
    profile = simulation.profile()
    return (
        f"| {mesh.node_count} | {name} | {blocks} | {made:.2f} | {profile.p50_ms:.3f} "
        f"| {looked:.2f} |",
        moved,
    )


def page() -> str:
    """The whole page."""
    lines = [
        "| nodes | model | blocks of the matrix | make [s] | step [ms] | look at all nodes [ms] |",
        "|---|---|---|---|---|---|",
    ]
    for cells in SIZES:
        whole = None
        for model in ("fem", ts.Condensed(keep="touched"), ts.Condensed(keep="surface")):
            row, moved = measured(cells, model)
            lines.append(row)
            whole = moved if whole is None else whole
            assert np.abs(moved - whole).max() < 1e-9 * np.abs(whole).max()
    printed = f"\nPrinted by `python bench/condensed.py --write`; {machine_line()}\n"
    return HEAD + "\n".join(lines) + "\n" + TAIL + printed


if __name__ == "__main__":
    if "--write" in sys.argv[1:]:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        print(page())
