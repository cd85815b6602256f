"""Measured orders of convergence: prints docs/convergence.md and draws its picture.

    python bench/convergence.py --picture docs/pictures/convergence.png > docs/convergence.md

The machinery is that of tests/convergence: manufactured solutions, with loads and error integrals
by shape functions and quadrature that are not the library's.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "convergence"))

from distorted import MESHES
from order import Errors, errors, orders
from shape_basis import ORDER

COUNTS = {1: (4, 8, 12), 2: (2, 4, 6)}
KINDS = ("regular", "smooth", "jittered", "trapezoids")
FINER = (4, 6, 8, 12)  # for the elements that lose an order
LOSING = ("hexahedron20", "wedge15", "pyramid13")
Series = tuple[tuple[int, ...], list[Errors]]

HEAD = """# Orders of convergence, measured

A displacement field u(X) is chosen, the body force that makes it an equilibrium is derived by
SymPy, and the cube of one metre is solved with that force and u on its whole boundary. The field is
smooth, without symmetry, with strains of up to 0.2; lambda = 1.2 Pa, mu = 0.8 Pa. Errors are L2
norms over the cube: of the displacement, and of the strain (small for Hooke, Green-Lagrange's for
St-Venant-Kirchhoff). Loads and errors are integrated by shape functions and quadrature of the
tests' own (`tests/convergence`), so that the library is not measured with itself. Quadrature of
the library: `full`. Direct solver, Newton to 1e-11.

Theory: displacement p + 1, strain p; p = 1 for straight elements, 2 for those with middle nodes.

![Errors against the number of cells](pictures/convergence.png)

Meshes: **regular**; **smooth**: all nodes moved by one smooth map, cells stay curved and distorted
as they shrink; **jittered**: corners moved at random by a fifth of a cell (a tenth where cells are
thinner), edges straight; **trapezoids**: every second layer of corners tilted to and fro, of one
shape at every size.

Orders of displacement and strain between the two finest meshes (12 and 8 cells along an edge for
p = 1, 6 and 4 for p = 2), and nodes and displacement error of the finest regular one:

"""

TAIL = """## What to read from it

- Every element has its full order on regular meshes and on those of a smooth map, with both laws.
- First-order elements keep it on every mesh. So do the ten-node tetrahedron, which is affine when
  its edges are straight, and the 27-node hexahedron, which holds the squares of its trilinear map;
  both reproduce a quadratic field on trapezoids to round-off. (A random mesh has another shape for
  each size, so that its orders scatter.)
- The 20-node hexahedron, the 15-node wedge and the 13-node pyramid do not hold those squares. On
  cells that stay distorted as they shrink they fall to orders 2 and 1: Arnold, Boffi and Falk,
  *Approximation by quadrilateral finite elements*, Math. Comp. 71 (2002). With a smooth field the
  lost term is still small beside the rest on the meshes above, and the orders lie between; with a
  quadratic field it is all there is. A mesh that is refined from a coarse one grows affine, and
  keeps the full order.
- On curved cells the full rule of the ten-node tetrahedron (four points, exact on affine cells)
  fails the patch test by an error of third order; `over` passes it, as every other element does
  with `full`.

Printed by `python bench/convergence.py --picture docs/pictures/convergence.png`; the tests in
`tests/convergence` hold the orders to 0.2 of the theory.
"""


def measure(kind: str, cell: str, law: str, name: str, counts: tuple[int, ...]) -> Series:
    """Errors on a family of meshes."""
    return counts, [errors(MESHES[kind](cell, n), cell, law, name) for n in counts]


def last_orders(series: Series) -> tuple[float, float]:
    """Orders of displacement and strain between the two finest meshes."""
    counts, found = series
    displacement = orders(counts, [e.displacement for e in found])
    strain = orders(counts, [e.strain for e in found])
    return float(displacement[-1]), float(strain[-1])


def table(all_series: dict[tuple[str, str, str], Series]) -> Iterator[str]:
    """A row for each element and law, a pair of orders for each kind of mesh."""
    yield f"| element | law | {' | '.join(KINDS)} | nodes | error, regular |"
    yield "|---|---|" + "---|" * (len(KINDS) + 2)
    for cell in ORDER:
        for law in ("hooke", "stvk"):
            pairs = [last_orders(all_series[kind, cell, law]) for kind in KINDS]
            finest = all_series["regular", cell, law][1][-1]
            shown = " | ".join(f"{u:.2f}, {e:.2f}" for u, e in pairs)
            yield f"| {cell} | {law} | {shown} | {finest.nodes} | {finest.displacement:.1e} m |"


def losing_table(all_series: dict[str, Series]) -> Iterator[str]:
    """Orders of the elements that lose one, from mesh to mesh, for a quadratic field."""
    steps = " | ".join(f"{a} to {b}" for a, b in itertools.pairwise(FINER))
    yield f"| element, on trapezoids, quadratic field, Hooke | {steps} |"
    yield "|---|" + "---|" * (len(FINER) - 1)
    for cell, (counts, found) in all_series.items():
        u = orders(counts, [e.displacement for e in found])
        e = orders(counts, [e.strain for e in found])
        yield f"| {cell} | {' | '.join(f'{a:.2f}, {b:.2f}' for a, b in zip(u, e, strict=True))} |"


def draw(path: Path, smooth: dict[str, Series], losing: dict[str, Series]) -> None:
    """Three panels of errors against h: displacement, strain, and the lost order."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 3, figsize=(12.5, 4.6), layout="constrained")
    titles = (
        "displacement error [m], smooth map",
        "strain error [1], smooth map",
        "displacement error [m], trapezoids,\nquadratic field (Hooke)",
    )
    for panel, title in zip(axes, titles, strict=True):
        panel.set(xscale="log", yscale="log", xlabel="cells along an edge", title=title)
        panel.set_xticks([2, 4, 6, 8, 12], ["2", "4", "6", "8", "12"])
        panel.minorticks_off()
        panel.grid(True, which="major", color="0.9")
    colours = dict(zip(ORDER, pyplot.get_cmap("tab10").colors, strict=False))
    for cell, series in smooth.items():
        for panel, field in zip(axes, ("displacement", "strain"), strict=False):
            _curve(panel, series, field, cell, colours[cell])
    for cell, series in losing.items():
        _curve(axes[2], series, "displacement", cell, colours[cell])
    _slopes(axes[0], {2: (4, 4e-3), 3: (2, 9e-4)})
    _slopes(axes[1], {1: (4, 4.5e-2), 2: (2, 1.1e-2)})
    _slopes(axes[2], {2: (4, 3.2e-5), 3: (4, 1e-5)})
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    figure.savefig(path, dpi=110)


def _curve(panel: Any, series: Series, field: str, cell: str, colour: Any) -> None:
    counts, found = series
    style = "-o" if ORDER[cell] == 1 else "--s"
    values = [getattr(e, field) for e in found]
    panel.plot(counts, values, style, color=colour, label=cell, markersize=4)


def _slopes(panel: Any, starts: dict[int, tuple[int, float]]) -> None:
    """Grey lines of the orders of the theory, from (cells, error) to three times the cells."""
    for order, (cells, error) in starts.items():
        line = [error, error / 3**order]
        panel.plot([cells, 3 * cells], line, color="0.55", linewidth=1)
        middle = (1.75 * cells, error / 1.75**order)
        place = {"xytext": (5, 4), "textcoords": "offset points"}
        panel.annotate(f"order {order}", middle, color="0.35", **place)


def main() -> None:
    """Prints the page and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args()
    found = {
        (kind, cell, law): measure(kind, cell, law, "smooth", COUNTS[ORDER[cell]])
        for kind in KINDS
        for cell in ORDER
        for law in ("hooke", "stvk")
    }
    losing = {cell: measure("trapezoids", cell, "hooke", "quadratic", FINER) for cell in LOSING}
    print(HEAD, end="")
    print("\n".join(table(found)) + "\n")
    print("\n".join(losing_table(losing)) + "\n")
    print(TAIL, end="")
    if asked.picture:
        smooth = {cell: found["smooth", cell, "stvk"] for cell in ORDER}
        draw(asked.picture, smooth, losing)


if __name__ == "__main__":
    main()
