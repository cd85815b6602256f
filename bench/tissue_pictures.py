"""Draws figures 11 and 12 of bosman2014 as tissu simulates them: docs/pictures/tissue-*.png."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import tissu as ts
from tissu.picture import draw

PICTURES = Path(__file__).resolve().parents[1] / "docs" / "pictures"
HOLLOW = ts.Shell(drilling=0.01)


def sheets() -> ts.Simulation:
    """Figure 11: two sheets and a block of 1 kg and 6 kPa; the upper one held on two edges."""
    law, thick = ts.Hooke(young=2e5, poisson=0.3), 0.004
    bodies = {
        name: ts.Body(
            mesh=ts.BarMesh(size=(0.4, 0.4, 0), cells=(16, 16, 0), cell="triangle", origin=place),
            law=law, model="shell", thickness=thick, density=1000.0,
        )
        for name, place in (("upper", (-0.2, -0.2, 0.1)), ("lower", (-0.2, -0.2, 0.0)))
    }  # fmt: skip
    block = ts.BarMesh(
        size=(0.16, 0.16, 0.1), cells=(1, 1, 1), cell="hexahedron", origin=(-0.08, -0.08, 0)
    )
    tissue = ts.Tissue(
        between=("upper", "lower"), inside=block, frames=60, points=600, neighbours=6,
        law=ts.StVK(young=6e3, poisson=0.3), mass=1.0,
    )  # fmt: skip
    edges = [ts.Fixed("upper", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (-0.2, 0.2)]
    return ts.Scene(
        name="two sheets and a block",
        bodies=bodies,
        tissue={"block": tissue},
        fixed=edges,
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler(dt=0.02, newton=ts.Newton(iterations=5)),
        duration=2,
    ).compile()


def ball(
    center: tuple[float, float, float], radii: tuple[float, float, float], parts: int = 6
) -> ts.Mesh:
    """An ellipsoid of triangles: the faces of a cube, cut and drawn out."""
    cube = ts.bar_mesh(size=(2, 2, 2), cells=(parts,) * 3, cell="hexahedron", origin=(-1, -1, -1))
    surface = cube.surface()
    used, numbers = np.unique(surface.triangles, return_inverse=True)
    points = np.tan(np.asarray(cube.points)[used] * np.pi / 4)
    points /= np.linalg.norm(points, axis=1)[:, None]
    triangles = numbers.reshape(-1, 3).astype(np.int32)
    return ts.Mesh(points=points * radii + center, cells=(ts.CellBlock("triangle", triangles),))


def organs() -> ts.Simulation:
    """Like figure 12: two hollow organs of shells, tied by about 22 frames and 800 points."""
    law = ts.Hooke(young=5e5, poisson=0.4)
    shapes = {
        "uterus": ((0, 0, 0.075), (0.05, 0.035, 0.03)),
        "bladder": ((0, 0, 0), (0.045, 0.04, 0.03)),
    }
    bodies = {
        name: ts.Body(mesh=ball(*shape), law=law, model=HOLLOW, thickness=0.003, density=1050.0)
        for name, shape in shapes.items()
    }
    tissue = ts.Tissue(
        between=("uterus", "bladder"), reach=0.035, frames=22, points=800,
        law=ts.StVK(young=6e3, poisson=0.3), density=1000.0,
    )  # fmt: skip
    return ts.Scene(
        name="uterus and bladder",
        bodies=bodies,
        tissue={"fascia": tissue},
        fixed=[ts.Fixed("bladder", on=ts.Box((None, None, -0.04), (None, None, -0.02)))],
        prescribed=[
            ts.Prescribed(
                "uterus", on=ts.Box((None, None, 0.095), (None, None, 0.11)), times=(0, 1),
                displacements=[(0, 0, 0), (0.03, 0, 0.01)],
            )
        ],
        step=ts.ImplicitEuler(dt=0.02, newton=ts.Newton(iterations=5)),
        duration=1.5,
    ).compile()  # fmt: skip


def main() -> None:
    """Runs both and draws them."""
    for name, make in (("sheets", sheets), ("organs", organs)):
        simulation = make()
        reports = list(simulation.run())
        missed = sum(not report.converged for report in reports)
        print(simulation, f"{missed} of {len(reports)} steps did not converge")
        for tissue in simulation.tissue:
            print(tissue, len(simulation.points(tissue)), "points")
        draw(simulation, PICTURES / f"tissue-{name}.png")


if __name__ == "__main__":
    main()
