"""Measured orders of convergence: prints docs/measured/convergence.md and draws its picture.

    python bench/convergence.py --picture docs/pictures/convergence.png \
        > docs/measured/convergence.md

The machinery is that of tests/convergence: manufactured solutions, with loads and error integrals
by shape functions and quadrature that are not the library's.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "convergence"))

from convergence_picture import Series, draw

from distorted import MESHES
from distorted_flat import FLAT_MESHES
from order import errors, orders
from shape_basis import LINES, ORDER, SURFACES, VOLUMES

COUNTS = {1: (4, 8, 12), 2: (2, 4, 6)}
FLAT_COUNTS = (8, 16, 24)
KINDS = ("regular", "smooth", "jittered", "trapezoids")
LAWS = ("hooke", "stvk")
FINER = (4, 6, 8, 12)  # for the elements that lose an order
LOSING = ("hexahedron20", "wedge15", "pyramid13")
FLAT = {"plane strain": SURFACES, "plane stress": SURFACES, "uniaxial stress": LINES}

HEAD = """# Orders of convergence

How fast does the error of each element fall as the cells shrink? An order of 2 means that halving
the cells divides the error by four. Every element reaches the theoretical order on regular meshes;
[the list below](#what-to-read-from-it) gives the exceptions on distorted meshes.

The error is known exactly, because the solution is chosen first: a displacement field u(X). SymPy
derives the body force under which this field is an equilibrium. Then a cube of one metre is solved
with that force, and with u prescribed on its whole boundary. Surface elements fill a square of one
metre under plane strain and plane stress. Line elements fill a line of one metre under uniaxial
stress.

The field is smooth, without symmetry, with strains of up to 0.2. Lamé's constants are lambda = 1.2
Pa and mu = 0.8 Pa. Errors are L2 norms of the displacement and of the strain (small strain for
Hooke, Green-Lagrange strain for St-Venant-Kirchhoff). The tests integrate loads and errors with
their own shape functions and quadratures (`tests/convergence`), so the measurement does not rely on
the library's. The library uses its quadrature `full`, the direct solver, and Newton's method to
1e-11.

In theory, the displacement has order p + 1 and the strain has order p, with p = 1 for elements
without middle nodes and p = 2 for elements with them.

![Errors against the number of cells](../pictures/convergence.png)

The curves are for St-Venant-Kirchhoff, with surfaces under plane stress. The curves of [the lost
order](#the-lost-order) are for Hooke.

There are four kinds of mesh:

- **regular**;
- **smooth**: one smooth map moves all nodes; the cells are curved and distorted, and become affine
  as they shrink;
- **jittered**: corners are moved at random by a fifth of a cell (a tenth where cells are thinner),
  and edges stay straight;
- **trapezoids**: every second layer of corners is tilted to and fro, so that the cells have the
  same distorted shape at every size.

## Volumes

Each pair gives the orders of the displacement and of the strain between the two finest meshes (12
and 8 cells along an edge for p = 1, 6 and 4 for p = 2). The last columns are the nodes and the
displacement error of the finest regular mesh.

"""

BELOW = """## Surfaces and lines

The orders are those between 24 and 16 cells along an edge. Triangles are halves of the quads.
Lines have no trapezoids.

"""

LOST = """## The lost order

Four elements lose an order on trapezoids. The table gives their orders from mesh to mesh:

"""

TAIL = """## What to read from it

- Every element has its full order on regular and smooth meshes, with both laws.
- First-order elements keep their order on every mesh. So does the ten-node tetrahedron, which is
  affine when its edges are straight, and the 27-node hexahedron, whose shape functions contain the
  squares of its trilinear map. Both reproduce a quadratic field on trapezoids to round-off. (A
  random mesh has a different shape at each size, so its orders scatter.)
- Surfaces and lines, where finer meshes are cheap, behave in the same way: quads of four and nine
  nodes, triangles and lines have their full order on every mesh, under plane strain, plane stress
  and uniaxial stress.
- The shape functions of the 20-node hexahedron, the 15-node wedge, the 13-node pyramid and the
  8-node quad do not contain those squares. On cells that stay distorted as they shrink, the orders
  of these elements fall to 2 and 1 (Arnold, Boffi and Falk, *Approximation by quadrilateral finite
  elements*, Math. Comp. 71, 2002). With a smooth field, the lost term is still a small part of the
  error on the meshes above, and the orders lie in between. With a quadratic field, it is the whole
  error. When a coarse mesh is refined, its cells become affine, so the elements keep their full
  order.
- On curved cells the quadrature `full` of the ten-node tetrahedron (four points, exact on affine
  cells) fails the patch test by an error of third order. `over` passes it, as does every other
  element with `full`.

Printed by `python bench/convergence.py --picture docs/pictures/convergence.png`. The tests in
`tests/convergence` require the orders to be within 0.2 of the theory.
"""


def measure(
    kind: str, cell: str, law: str, name: str, counts: tuple[int, ...], setting: str = "solid"
) -> Series:
    """Errors on a family of meshes."""
    make = MESHES[kind] if setting == "solid" else FLAT_MESHES[kind]
    return counts, [errors(make(cell, n), cell, law, name, setting=setting) for n in counts]


def last_orders(series: Series) -> tuple[float, float]:
    """Orders of displacement and strain between the two finest meshes."""
    counts, found = series
    displacement = orders(counts, [e.displacement for e in found])
    strain = orders(counts, [e.strain for e in found])
    return float(displacement[-1]), float(strain[-1])


Found = dict[tuple[str, str, str, str], Series]  # of setting, kind, cell and law


def measured(setting: str, cells: list[str]) -> Found:
    """Errors of the cells on every kind of mesh, with both laws."""
    kinds = [kind for kind in KINDS if kind != "trapezoids" or setting != "uniaxial stress"]
    return {
        (setting, kind, cell, law): measure(
            kind,
            cell,
            law,
            "smooth",
            COUNTS[ORDER[cell]] if setting == "solid" else FLAT_COUNTS,
            setting,
        )
        for kind in kinds
        for cell in cells
        for law in LAWS
    }


def table(found: Found, cells_of: dict[str, list[str]]) -> Iterator[str]:
    """A row for each element, setting and law, a pair of orders for each kind of mesh."""
    named = "" if "solid" in cells_of else " setting |"
    yield f"| element |{named} law | {' | '.join(KINDS)} | nodes | error, regular |"
    yield "|---|---|" + ("---|" if named else "") + "---|" * (len(KINDS) + 2)
    for setting, cells in cells_of.items():
        for cell, law in itertools.product(cells, LAWS):
            pairs = [_pair(found.get((setting, kind, cell, law))) for kind in KINDS]
            finest = found[setting, "regular", cell, law][1][-1]
            words = [cell, setting, law] if named else [cell, law]
            row = [*words, *pairs, str(finest.nodes), f"{finest.displacement:.1e} m"]
            yield f"| {' | '.join(row)} |"


def _pair(series: Series | None) -> str:
    return "–" if series is None else "{:.2f}, {:.2f}".format(*last_orders(series))


def losing_table(all_series: dict[str, Series]) -> Iterator[str]:
    """Orders of the elements that lose one, from mesh to mesh, for a quadratic field."""
    steps = " | ".join(f"{a} to {b}" for a, b in itertools.pairwise(FINER))
    yield f"| element, on trapezoids, quadratic field, Hooke | {steps} |"
    yield "|---|" + "---|" * (len(FINER) - 1)
    for cell, (counts, found) in all_series.items():
        u = orders(counts, [e.displacement for e in found])
        e = orders(counts, [e.strain for e in found])
        yield f"| {cell} | {' | '.join(f'{a:.2f}, {b:.2f}' for a, b in zip(u, e, strict=True))} |"


def main() -> None:
    """Prints the page and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args()
    volumes = measured("solid", VOLUMES)
    flat = {key: one for setting in FLAT for key, one in measured(setting, FLAT[setting]).items()}
    losing = {cell: measure("trapezoids", cell, "hooke", "quadratic", FINER) for cell in LOSING}
    losing["quad8"] = measure("trapezoids", "quad8", "hooke", "quadratic", FINER, "plane stress")
    print(HEAD, end="")
    print("\n".join(table(volumes, {"solid": VOLUMES})) + "\n")
    print(BELOW, end="")
    print("\n".join(table(flat, FLAT)) + "\n")
    print(LOST, end="")
    print("\n".join(losing_table(losing)) + "\n")
    print(TAIL, end="")
    if asked.picture:
        found = {**volumes, **flat}
        chosen = (("solid", VOLUMES), ("plane stress", SURFACES), ("uniaxial stress", LINES))
        smooth = {c: found[s, "smooth", c, "stvk"] for s, cells in chosen for c in cells}
        draw(asked.picture, smooth, losing)


if __name__ == "__main__":
    main()
