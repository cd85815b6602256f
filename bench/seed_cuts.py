"""The figures on cuts of Chendeb (2007), made again: `python bench/seed_cuts.py [--write]`.

No time is measured, so that the numbers do not depend on the machine.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from carriers import CELLS, SIZE, mesh
from kernels import table
from section import MEASURED, put_between

import tissu as ts
from tissu.cutting.quality import Quality

CUTS = 40
CUBE, SIDE = 0.1, 6
METHODS = ("subdivide", "snap")
PICTURE = MEASURED.parent / "pictures" / "seed-cuts.png"

Array = np.ndarray[Any, Any]


def bar(method: str, *, depth: bool = False) -> ts.Simulation:
    """The jittered bar at rest, which nothing holds."""
    body = ts.Body(mesh=mesh(), law=ts.StableNeoHooke(young=5e4, poisson=0.3), density=1000)
    editing = ts.Editing(method=method, room="300 %", depth=depth)
    scene = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(dt=0.01), editing=editing)
    return scene.compile()


def blades() -> list[tuple[Array, Array]]:
    """Points and unit normals of planes in random directions."""
    random = np.random.default_rng(4)
    found = []
    for _ in range(CUTS):
        normal = random.standard_normal(3)
        found.append((random.uniform(0.2, 0.8, 3) * SIZE, normal / np.linalg.norm(normal)))
    return found


def fallen(*, touches: bool) -> list[str]:
    """A cube with a slot from which cells are taken, on a table under its weight."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(CUBE,) * 3, cells=(SIDE,) * 3, cell="tetra"),
        law=ts.StableNeoHooke(young=3e3, poisson=0.3),
        density=1000,
        viscosity=ts.Rayleigh(mass=5, stiffness=0.01),
    )
    contacts: list[Any] = [ts.Contact(("cube", "table"), friction=0.5)]
    contacts += [ts.SelfContact("cube")] if touches else []
    simulation = ts.Scene(
        bodies={"cube": body},
        gravity=(0, 0, -9.81),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))},
        contacts=contacts,
        step=ts.ImplicitEuler(dt=0.005),
        editing=True,
    ).compile()
    slot = ts.Box((CUBE / 3, -1, 3 * CUBE / SIDE), (1, 1, 4 * CUBE / SIDE))
    report = simulation.ablate("cube", slot)
    for _ in range(160):
        simulation.step()
    return [
        "with" if touches else "without",
        str(report.cells_gone),
        f"{-100 * report.volume_change / CUBE**3:.1f} %",
        str(nodes_in_cells(simulation)),
    ]


def nodes_in_cells(simulation: ts.Simulation) -> int:
    """How many nodes lie inside cells that do not have them."""
    places = np.asarray(simulation.positions["cube"])
    cells = np.concatenate([block.nodes for block in simulation.meshes["cube"].body_blocks])
    inverse = np.linalg.inv(np.swapaxes(places[cells[:, 1:]] - places[cells[:, :1]], 1, 2))
    inside = 0
    for node in np.unique(cells):
        weights = np.einsum("cij,cj->ci", inverse, places[node] - places[cells[:, 0]])
        within = (weights > 1e-6).all(axis=1) & (weights.sum(axis=1) < 1.0 - 1e-6)
        inside += bool((within & (cells != node).all(axis=1)).any())
    return inside


def away(simulation: ts.Simulation, point: Array, normal: Array) -> Array:
    """How far vertices of cut faces lie from the blade at rest, in edges of the mesh."""
    surface = simulation.surface("bar")
    places = surface.carried(np.asarray(simulation.meshes["bar"].points))
    walls = np.unique(surface.triangles[surface.cut])
    return np.abs((places[walls] - point) @ normal) / float((SIZE / CELLS).max())


def along(method: str) -> tuple[list[str], Quality]:
    """Planes through the bar, each from the same state; and the cells after one of them."""
    simulation = bar(method)
    mark = simulation.mark()
    moved = born = gone = cut = left = 0
    far, shape, radii, bad = [], 1.0, 1.0, 0
    first = []
    for point, normal in blades():
        report = simulation.cut("bar", ts.Plane(point, normal))
        moved += report.nodes_moved
        born += report.cells_new
        gone += report.cells_gone
        cut += report.cells_cut
        left += len(report.unresolved)
        far.append(away(simulation, point, normal))
        quality = simulation.quality("bar", rest=True)
        first.append(quality)
        shape, radii = min(shape, quality.shape.min()), min(radii, quality.radii.min())
        bad += int(quality.has_short_edge.sum() + quality.is_flat.sum())
        simulation.rewind(mark)
    distance = np.concatenate(far)
    row = [
        method,
        f"{moved / CUTS:.0f}",
        f"{(born - gone) / CUTS:.0f}",
        f"{np.sqrt(np.mean(distance**2)):.3f}",
        f"{distance.max():.2f}",
        f"{shape:.3f}",
        f"{radii:.3f}",
        f"{bad / CUTS:.1f}",
        str(left),
    ]
    return row, first[0]


def shallow(*, depth: bool) -> list[str]:
    """A blade that goes half a cell deep along the top of the bar."""
    simulation = bar("snap", depth=depth)
    x, low = 0.213, SIZE[2] - 0.5 * SIZE[2] / CELLS[2]
    corners = [(x, -1, low), (x + 0.02, 1, low), (x + 0.02, 1, 1), (x, -1, 1)]
    report = simulation.cut("bar", ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)]))
    quality = simulation.quality("bar", rest=True)
    return [
        "with" if depth else "without",
        str(report.nodes_moved),
        str(report.cells_new),
        str(report.faces_opened),
        f"{1e4 * report.area:.1f}",
        f"{quality.shape.min():.2f}",
    ]


def spread(name: str, quality: Quality) -> list[str]:
    """How radii and volumes of cells are spread."""
    volume = quality.volume / quality.volume.mean()
    least, low, median = np.quantile(quality.radii, (0.0, 0.05, 0.5))
    return [
        name,
        str(len(volume)),
        f"{least:.2f}",
        f"{low:.2f}",
        f"{median:.2f}",
        f"{volume.min():.3f}",
        f"{np.std(volume):.2f}",
    ]


def draw(meshes: dict[str, Quality]) -> None:
    """Figure 4.21: RRS against volume, a dot for each cell."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, panels = pyplot.subplots(
        1, len(meshes), figsize=(10.5, 3.4), sharex=True, sharey=True, layout="constrained"
    )
    for panel, (name, quality) in zip(panels, meshes.items(), strict=True):
        panel.scatter(quality.volume / meshes["uncut"].volume.mean(), quality.radii, s=4)
        panel.axhline(0.1, linewidth=0.8, linestyle="--", color="grey")
        panel.set(
            title=f"{name}: {len(quality.volume)} cells", xlabel="volume / mean of uncut", ylim=0
        )
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("RRS = 3 rho_in / rho_out")
    figure.savefig(PICTURE, dpi=110)


def section() -> tuple[str, dict[str, Quality]]:
    """The tables and what they say, and the cells of figure 4.21."""
    meshes = {"uncut": bar("snap").quality("bar", rest=True)}
    rows = []
    for method in METHODS:
        row, meshes[method] = along(method)
        rows.append(row)
    spreads = [spread(name, quality) for name, quality in meshes.items()]
    of_path = ["method", "nodes moved", "cells added", "distance, rms", "largest"]
    of_path += ["least q", "least RRS", "bad cells", "left"]
    of_depth = ["depth", "nodes moved", "cells made", "faces opened", "area cm2", "least q"]
    of_spread = ["mesh", "cells", "RRS, least", "RRS, 5 %", "RRS, median", "volume, least"]
    of_spread += ["volume, spread"]
    text = (
        "## The figures of Chendeb 2007\n\n"
        "Section 4.4 of the thesis shows its cuts in pictures. The tables give numbers for the\n"
        "same cases. Figure 4.20 shows the collapse of a short edge, and figure 4.21 compares it\n"
        "with a new mesh around bad cells. tissu has neither of these repairs. Its guards limit\n"
        "how bad cells become, and the tables count the bad ones that a cut leaves.\n\n"
        "### Figure 4.12: a cube cut by removal, then dropped\n\n"
        f"Cells are removed from a slot in a cube of {CUBE * 100:.0f} cm and {6 * SIDE**3:,}\n"
        "tetrahedra, which then falls on a table. The last column counts nodes that lie inside\n"
        "cells of the other side of the slot after 0.8 s. In the thesis the upper side falls into\n"
        "the lower one. With contact of the cube with itself it rests on it.\n\n"
        + table(
            ["contact with itself", "cells removed", "volume lost", "nodes inside"],
            [fallen(touches=False), fallen(touches=True)],
        )
        + "\n\n### Figures 4.13 to 4.15 and 4.17: nodes on the path\n\n"
        f"{CUTS} random planes cut the jittered bar of the table above, each when it is uncut.\n"
        "Two columns give means of a cut: nodes moved, and cells that the mesh has more.\n"
        "*distance* is that of the vertices of the cut faces from the blade, in edges of the\n"
        "mesh. The least q and RRS = 3 rho_in / rho_out are those of all cuts. *bad cells* is the\n"
        "mean number of cells of the two types of Forest: with an edge below a fifth of the\n"
        "longest, or an RRS below 0.1. Cells `left` were met and not cut.\n\n"
        + table(of_path, rows)
        + "\n\n### Figure 4.16: depth\n\n"
        "A slanted blade goes half a cell deep through the top of the bar: 12.6 cm2 of it lie in\n"
        "the bar. Without depth, moved nodes would open nothing, so that the cells are divided.\n"
        "With depth the cut reaches the next nodes below.\n\n"
        + table(of_depth, [shallow(depth=False), shallow(depth=True)])
        + "\n\n### Figure 4.21: RRS and volume\n\n"
        "The cells of the bar before and after the first of these planes. Volumes are relative to\n"
        "their mean, and their spread is the standard deviation.\n\n"
        + table(of_spread, spreads)
        + "\n\n![RRS against volume before and after a cut](../pictures/seed-cuts.png)\n"
        + "\nPrinted by `python bench/seed_cuts.py --write`.\n"
    )
    return text, meshes


def main() -> None:
    """Prints the section, or writes it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="to docs/measured/cutting.md")
    text, meshes = section()
    if parser.parse_args().write:
        draw(meshes)
        put_between(MEASURED / "cutting.md", "bench/seed_cuts.py", text)
    else:
        print(text)


if __name__ == "__main__":
    main()
