"""The figures on cuts of Chendeb (2007), made again: `python bench/seed_cuts.py [--write]`.

No time is measured, so that the numbers do not depend on the machine.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from carriers import CELLS, SIZE
from kernels import table
from section import MEASURED, put_between
from seed_bar import CUTS, bad, bar, blades
from seed_repairs import PLANES, ROUNDS, collapsed, crossed, new_mesh, repaired

import tissu as ts
from tissu.cutting.quality import Quality

CUBE, SIDE = 0.1, 6
METHODS = ("subdivide", "snap")
PICTURE = MEASURED.parent / "pictures" / "seed-cuts.png"

Array = np.ndarray[Any, Any]


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


def along(method: str) -> list[str]:
    """Planes through the bar, each from the same state."""
    simulation = bar(method)
    mark = simulation.mark()
    moved = born = gone = cut = left = 0
    far, shape, radii, worst = [], 1.0, 1.0, 0
    for point, normal in blades():
        report = simulation.cut("bar", ts.Plane(point, normal))
        moved += report.nodes_moved
        born += report.cells_new
        gone += report.cells_gone
        cut += report.cells_cut
        left += len(report.unresolved)
        far.append(away(simulation, point, normal))
        quality = simulation.quality("bar", rest=True)
        shape, radii = min(shape, quality.shape.min()), min(radii, quality.radii.min())
        worst += bad(quality)
        simulation.rewind(mark)
    distance = np.concatenate(far)
    return [
        method,
        f"{moved / CUTS:.0f}",
        f"{(born - gone) / CUTS:.0f}",
        f"{np.sqrt(np.mean(distance**2)):.3f}",
        f"{distance.max():.2f}",
        f"{shape:.3f}",
        f"{radii:.3f}",
        f"{worst / CUTS:.1f}",
        str(left),
    ]


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
        2, 3, figsize=(10.5, 6.4), sharex=True, sharey=True, layout="constrained"
    )
    for panel, (name, quality) in zip(panels.flat, meshes.items(), strict=True):
        panel.scatter(quality.volume / meshes["uncut"].volume.mean(), quality.radii, s=4)
        panel.axhline(0.1, linewidth=0.8, linestyle="--", color="grey")
        panel.set(
            title=f"{name}: {len(quality.volume)} cells", xlabel="volume / mean of uncut", ylim=0
        )
        panel.grid(alpha=0.3)
    for panel in panels[:, 0]:
        panel.set_ylabel("RRS = 3 rho_in / rho_out")
    figure.savefig(PICTURE, dpi=110)


def section() -> tuple[str, dict[str, Quality]]:
    """The tables and what they say, and the cells of figure 4.21."""
    meshes = {"uncut": bar("snap").quality("bar", rest=True)}
    rows, repairs = [along(method) for method in METHODS], []
    for method in METHODS:
        for repair in (None, ts.Repair()):
            repairs.append(repaired(method, repair))
            made, _ = crossed(method, repair)
            meshes[repairs[-1][0]] = made.quality("bar", rest=True)
            if method == "subdivide" and repair is None:
                remade, of_new = new_mesh(made)
    meshes["subdivide, new mesh"] = remade
    spreads = [spread(name, quality) for name, quality in meshes.items()]
    of_path = ["method", "nodes moved", "cells added", "distance, rms", "largest"]
    of_path += ["least q", "least RRS", "bad cells", "left"]
    of_depth = ["depth", "nodes moved", "cells made", "faces opened", "area cm2", "least q"]
    of_spread = ["mesh", "cells", "RRS, least", "RRS, 5 %", "RRS, median", "volume, least"]
    of_spread += ["volume, spread"]
    of_repair = ["method", "cells", "short edges", "flat", "least q", "least RRS"]
    of_repair += ["collapses", "flips", "moves", "volume"]
    of_edge = ["mesh", "cells", "with a short edge", "shortest / longest", "least q", "least RRS"]
    of_edge += ["volume cm3"]
    of_mesh = ["bad cells", "bad in the new mesh", "faces that do not fit", "volume off"]
    text = (
        "## The figures of Chendeb 2007\n\n"
        "Section 4.4 of the thesis shows its cuts in pictures. The tables give numbers for the\n"
        "same cases. Guards limit how bad cells become, and the tables count the bad ones that\n"
        "a cut leaves.\n\n"
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
        + "\n\n### Figure 4.20: collapse of a short edge\n\n"
        "Planes cut the bar one after the other, and the worst cell after each cut is repaired.\n"
        "The table shows the bar before and after the first collapse of a short edge. The least q\n"
        "of the cells around rises; other measures may fall.\n\n"
        + table(of_edge, collapsed())
        + f"\n\nIn {ROUNDS} bars, {PLANES} of the random planes cross. Entries are means,\n"
        "but for the least q and RRS, which are those of all bars. The last column is the largest\n"
        "relative change of volume. `repair` has its defaults. Later planes cut the repaired\n"
        "cells. Short edges stay on cut faces that are not plane, where no node may move.\n\n"
        + table(of_repair, repairs)
        + "\n\n### Figure 4.21: RRS and volume\n\n"
        f"The cells of the first of these bars, before and after its {PLANES} planes. Volumes are\n"
        "relative to their mean, and their spread is the standard deviation. *new mesh* replaces\n"
        "the cells at the nodes of bad ones by a Delaunay mesh of the same nodes.\n\n"
        + table(of_spread, spreads)
        + "\n\nThe new mesh is not better: a Delaunay mesh has flat cells. Where the cells that\n"
        "it replaces do not fill a convex region, faces of their border are missing. The mesh\n"
        "does not conform there, and it has another volume. Flips and collapses keep both.\n\n"
        + table(of_mesh, [of_new])
        + "\n\n![RRS against volume before and after cuts](../pictures/seed-cuts.png)\n"
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
