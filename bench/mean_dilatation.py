"""Prints docs/measured/mean-dilatation.md: a cantilever that locks, and its cure: --write."""

from __future__ import annotations

import sys
from pathlib import Path

import tissu as ts

PAGE = Path(__file__).resolve().parents[1] / "docs" / "measured" / "mean-dilatation.md"
SIZE = (0.4, 0.1, 0.1)  # m
CELLS = ("hexahedron", "tetra", "wedge", "pyramid")
GRIDS = ((8, 2, 2), (12, 3, 3), (16, 4, 4))
MODELS = ("fem", "mean-dilatation")
RATIOS = (0.3, 0.4, 0.45, 0.47, 0.48, 0.49, 0.499, 0.4999)

HEAD = """# Mean dilatation

If a material hardly changes its volume, first-order cells lock: a cell that bends would have to
change the volume at its integration points, so it hardly bends. `tissu check` prints a note for
Poisson's ratios of 0.45 and above. This page measures the locking, and its cure. The model
`mean_dilatation` gives each *patch* of cells one volume ratio:

    E = sum_g w_g W((theta / J_g)^(1/3) F_g),   theta = sum_g w_g J_g / sum_g w_g  of the patch

A patch is one hexahedron (Nagtegaal, Parks and Rice 1974; Simo, Taylor and Pister 1985), or about
eight tetrahedra, or six wedges or pyramids around a node (after de Souza Neto, Andrade Pires and
Owen 2005). Force and tangent are derivatives of this energy, so momentum and energy are conserved,
and the matrix is symmetric. If F is the same everywhere, the model equals `fem` to round-off. It
takes any law, and fibres. Patches do not extend from one region or material to another. The price
is a matrix that couples all nodes of a patch, and about three passes over the cells instead of one.

```yaml
model: mean_dilatation
```

The bar of 40 x 10 x 10 cm is held at one end and bends under its own weight: neo-Hooke, E = 300
kPa, 1000 kg/m3. The end sinks by a quarter of the length.

"""
TAIL = """
## Limits

- **Coarse cells stay too stiff in bending** for a reason other than volume (tetrahedra and wedges
  most of all). This error falls with the square of the cell size, at any Poisson's ratio.
- **The pressure is that of a patch**, so it is as coarse as the patches. For a cube held all around
  with 3 to 6 cells a side, the inf-sup constant is 0.05 to 0.08 for tetrahedra, 0.26 to 0.35 for
  wedges and 0.25 to 0.39 for pyramids. Some pressure modes of tetrahedra (at most 7) affect no
  displacement; wedges and pyramids have no such modes. A regular grid of hexahedra has 3 n - 2 of
  them (7 to 16), the well-known chessboard modes
  (`tests/cpp/model/dilatation/cell_pressure_test.cpp`). Displacements do not suffer from them; the
  stress of a single cell may.
- **Size of patches.** The sag depends on the size of the patches. The figures are the ratio of the
  sag to the converged sag, for this bar with neo-Hooke and nu = 0.4999, on grids of 8 x 2 x 2 and
  16 x 4 x 4 with three ways of cutting into tetrahedra. Nearly cell by cell, it is 0.35 to 0.65 and
  0.41 to 0.84; with patches of 6 cells, 0.71 to 1.05 and 0.90 to 0.93; of 8, 0.70 to 0.97 and 0.90
  to 0.93; of 12, 0.79 to 1.31 and 0.93 to 0.94; of 24, 1.2 to 1.4 and 0.93 to 1.01.
- **Crushed cells.** When the volume at a point is below a tenth of its rest volume, the weight of
  the point in the mean falls; it is zero when the point is inverted. So energy and force stay
  finite, and the law sees the sign of its own J. A law that accepts inverted cells (stable
  neo-Hooke) brings them back. Neo-Hooke refuses them with the same message as under `fem`.
- **St-Venant-Kirchhoff.** Its lambda/2 tr(E)^2 is not a function of the volume. If bending strains
  eps are finite, one theta cannot make tr(E) small at every point, and the cells stiffen again when
  lambda eps^2 > mu. At nu = 0.49 locking is cured ([phantom](phantom.md)); at 0.4999 it is not in
  this bar. Take a law with a volume term, such as neo-Hooke.
- **Removed cells.** When a cell is removed, the others stay in their patches.
- **Quadratic cells** need no cure: take `hexahedron20` with `quadrature: reduced` in a static
  scene in which bending has to be right.
"""


def sag(cell: str, cells: tuple[int, int, int], model: str, poisson: float) -> float:
    """How far the nodes of the free end go down, their mean [m]; not a number where it fails."""
    reduced = cell == "hexahedron20"
    scene = ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.BarMesh(size=SIZE, cells=cells, cell=cell),
                law=ts.NeoHooke(young=300e3, poisson=poisson),
                density=1000,
                model=model,
                quadrature="reduced" if reduced else "full",
            )
        },
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, -9.81, 0),
        step=ts.Static(newton=ts.Newton(iterations=60, tolerance=1e-9), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    if not simulation.step().converged:
        return float("nan")
    end = simulation.meshes["bar"].points[:, 0] > SIZE[0] - 1e-9
    return float(-simulation.displacements("bar")[end, 1].mean())


def reference() -> tuple[list[str], float]:
    """Rows of the quadratic cells at nu = 0.4999, and the value they go to."""
    rows, found = [], []
    for cells in ((4, 2, 2), (8, 4, 4), (16, 8, 8)):
        found.append(sag("hexahedron20", cells, "fem", 0.4999))
        rows.append(f"| {'x'.join(map(str, cells))} | {1e3 * found[-1]:.1f} |")
    limit = found[2] + (found[2] - found[1]) ** 2 / (2 * found[1] - found[0] - found[2])
    return rows, limit


def page() -> str:
    """The whole page, measured."""
    rows, limit = reference()
    lines = ["## Against quadratic cells, nu = 0.4999", ""]
    lines += ["Hexahedra of 20 nodes with 2 x 2 x 2 points do not lock. Their sag is the"]
    lines += ["reference:", ""]
    lines += ["| grid | sag [mm] |", "|---|---|", *rows]
    lines += [f"| limit (Aitken) | {1e3 * limit:.1f} |", ""]
    lines += ["The next table gives the ratio of the sag of first-order cells to the reference,"]
    lines += ["first with `fem`, then with `mean_dilatation`:", ""]
    lines += ["| grid | " + " | ".join(CELLS) + " |", "|---" * (1 + len(CELLS)) + "|"]
    for grid in GRIDS:
        pairs = [[sag(c, grid, m, 0.4999) / limit for m in MODELS] for c in CELLS]
        cells = [f"{fem:.2f} -> {mean:.2f}" for fem, mean in pairs]
        lines.append(f"| {'x'.join(map(str, grid))} | " + " | ".join(cells) + " |")
    lines += ["", "## From which Poisson's ratio", ""]
    lines += ["The table gives the ratio of the sag with `fem` to that with `mean_dilatation` on"]
    lines += ["the same 12 x 3 x 3 grid, for several Poisson's ratios nu. A value of 1 means that"]
    lines += ["`fem` does not lock:", ""]
    lines += ["| nu | " + " | ".join(CELLS) + " |", "|---" * (1 + len(CELLS)) + "|"]
    for nu in RATIOS:
        ratios = [
            sag(c, GRIDS[1], "fem", nu) / sag(c, GRIDS[1], "mean-dilatation", nu) for c in CELLS
        ]
        lines.append(f"| {nu} | " + " | ".join(f"{r:.2f}" for r in ratios) + " |")
    lines += ["", "Printed by `python bench/mean_dilatation.py --write`."]
    return HEAD + "\n".join(lines) + "\n" + TAIL


if __name__ == "__main__":
    if "--write" in sys.argv[1:]:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        print(page())
