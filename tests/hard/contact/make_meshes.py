"""Makes the meshes of the hard cases with contact: python tests/hard/contact/make_meshes.py.

Each is small, and the same bytes come of the same numpy.
"""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np

import tissu as ts

HERE = Path(__file__).parent
ORGAN = HERE.parents[2] / "examples" / "make_organ.py"


def ball(radius: float, cells: int) -> ts.Mesh:
    """A cube of hexahedra whose shells become spheres."""
    mesh = ts.BarMesh(size=(2, 2, 2), cells=(cells,) * 3, cell="hexahedron", origin=(-1, -1, -1))
    points = mesh.mesh().points
    longest = np.abs(points).max(axis=1, keepdims=True)
    length = np.linalg.norm(points, axis=1, keepdims=True)
    points = (
        radius * points * np.divide(longest, length, where=length > 0, out=np.ones_like(length))
    )
    return ts.Mesh(points=points, cells=mesh.mesh().cells)


def hollow(radius: float) -> ts.Mesh:
    """An icosahedron whose edges are halved twice, on a sphere."""
    golden = (1 + 5**0.5) / 2
    ring = [(0.0, s, t * golden) for s in (1, -1) for t in (1, -1)]
    points = [np.roll(p, k) for p in ring for k in range(3)]
    near = 2.0 + 1e-9
    triangles = [
        (a, b, c)
        for a in range(12)
        for b in range(a + 1, 12)
        for c in range(b + 1, 12)
        if all(np.linalg.norm(points[i] - points[j]) < near for i, j in ((a, b), (b, c), (a, c)))
    ]
    triangles = [outwards(points, triangle) for triangle in triangles]
    for _ in range(2):
        triangles = halved(points, triangles)
    sphere = np.array([radius * p / np.linalg.norm(p) for p in points])
    return ts.Mesh(points=sphere, cells=[("triangle", np.array(triangles))])


def outwards(points: list[np.ndarray], triangle: tuple[int, int, int]) -> tuple[int, int, int]:
    """Anticlockwise seen from outside of what is around the origin."""
    a, b, c = triangle
    return triangle if np.linalg.det([points[i] for i in triangle]) > 0 else (a, c, b)


def halved(points: list[np.ndarray], triangles: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Four triangles of each; the middles of edges are added to the points."""
    middle: dict[tuple[int, int], int] = {}

    def of(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append((points[a] + points[b]) / 2)
        return middle[key]

    made = []
    for a, b, c in triangles:
        ab, bc, ca = of(a, b), of(b, c), of(c, a)
        made += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return made


def ribbon(line: np.ndarray, width: float, across: int) -> ts.Mesh:
    """A sheet of triangles along a line in x and z, as wide as said along y."""
    y = np.linspace(0, width, across + 1)
    points = np.array([(x, v, z) for x, z in line for v in y])
    triangles = []
    for i in range(len(line) - 1):
        for j in range(across):
            a, b = i * (across + 1) + j, (i + 1) * (across + 1) + j
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return ts.Mesh(points=points, cells=[("triangle", np.array(triangles))])


def arc(center: tuple[float, float], radius: float, parts: int) -> list[tuple[float, float]]:
    """The points inside a half circle that goes up, to the right."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, parts + 1)[1:-1]
    return [(center[0] + radius * np.cos(a), center[1] + radius * np.sin(a)) for a in angles]


def bend() -> ts.Mesh:
    """A layer, a half circle of 8 mm, and a layer that comes down to 4 mm above the first."""
    low = [(x, 0.0) for x in np.linspace(0, 0.1, 9)]
    high = [(x, 0.004 + 0.12 * x) for x in np.linspace(0.1, 0, 9)]
    return ribbon(np.array([*low, *arc((0.1, 0.008), 0.008, 8), *high]), 0.04, 3)


def liver() -> ts.Mesh:
    """The organ of the examples in cells of 3 cm."""
    nodes, cells = runpy.run_path(str(ORGAN))["make"](h=0.03)
    return ts.Mesh(points=nodes, cells=[("tetra", cells)])


def turned_over(mesh: ts.Mesh, height: float) -> ts.Mesh:
    """Turned by half a turn about x, and lifted."""
    return ts.Mesh(points=mesh.points * (1, -1, -1) + (0, 0, height), cells=mesh.cells)


def bar_with(xs: np.ndarray, ys: np.ndarray, zs: np.ndarray) -> ts.Mesh:
    """A bar of tetrahedra whose nodes stand at these places along the axes."""
    cells = tuple(len(v) - 1 for v in (xs, ys, zs))
    mesh = ts.BarMesh(size=cells, cells=cells, cell="tetra").mesh()
    i, j, k = np.rint(mesh.points).astype(int).T
    return ts.Mesh(points=np.stack([xs[i], ys[j], zs[k]], axis=1), cells=mesh.cells)


def sliver_block() -> ts.Mesh:
    """10 cm wide; a column of cells is 0.1 mm wide."""
    xs = np.array([0.0, 0.05, 0.0501, 0.1])
    return bar_with(xs, np.array([0.0, 0.05, 0.1]), np.array([0.0015, 0.05, 0.1]))


def sliver_plate() -> ts.Mesh:
    """A square of triangles with slivers along y.

    Two triangles more have no area: corners in a line, and two in one place.
    """
    xs, ys = [-0.1, 0.03, 0.03001, 0.2], [-0.1, 0.05, 0.2]
    points = [(x, y, 0.0) for x in xs for y in ys]
    triangles = []
    for i in range(3):
        for j in range(2):
            a, b = 3 * i + j, 3 * (i + 1) + j
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    points += [(0.06, 0.06, 0.0), (0.07, 0.06, 0.0), (0.08, 0.06, 0.0), (0.02, 0.02, 0.0)]
    points += [(0.02, 0.02, 0.0), (0.04, 0.02, 0.0)]
    triangles += [(12, 13, 14), (15, 16, 17)]
    return ts.Mesh(points=np.array(points), cells=[("triangle", np.array(triangles))])


VTK = {"triangle": 5, "tetra": 10, "hexahedron": 12}


def write(name: str, mesh: ts.Mesh) -> None:
    """Writes a legacy VTK file whose numbers are the shortest that read as the same doubles."""
    blocks = [(block.type, np.asarray(block.nodes)) for block in mesh.cells]
    cells = [(kind, row) for kind, data in blocks for row in data.tolist()]
    text = ["# vtk DataFile Version 3.0", f"{name}, by make_meshes.py", "ASCII"]
    text += ["DATASET UNSTRUCTURED_GRID", f"POINTS {len(mesh.points)} double"]
    text += [" ".join(repr(float(x)) for x in point) for point in np.round(mesh.points, 9)]
    text += [f"CELLS {len(cells)} {sum(len(row) + 1 for _, row in cells)}"]
    text += [" ".join(map(str, (len(row), *row))) for _, row in cells]
    text += [f"CELL_TYPES {len(cells)}", *(str(VTK[kind]) for kind, _ in cells)]
    (HERE / f"{name}.vtk").write_text("\n".join(text) + "\n", encoding="ascii")


def main() -> None:
    """Makes all of them."""
    organ = liver()
    write("ball", ball(0.03, 2))
    write("hollow", hollow(0.1))
    write("bend", bend())
    write("liver", organ)
    write("liver_above", turned_over(organ, 0.17))
    write("sliver_block", sliver_block())
    write("sliver_plate", sliver_plate())


if __name__ == "__main__":
    main()
