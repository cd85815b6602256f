"""Points on sheets and along lines, with the areas and lengths that belong to them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tissu.errors import MeshError, ParameterError
from tissu.mesh import Mesh
from tissu.mesh import thin as thins
from tissu.mesh.cell import Floats, Ints
from tissu.mesh.surface import area
from tissu.sampling.chains import chains
from tissu.sampling.closed import require_triangles
from tissu.sampling.greedy import spaced
from tissu.sampling.region import MOST_CELLS, Indices, drawn, positions, positive
from tissu.sampling.shares import shared_out

_FINE = 8  # candidates along the distance of two points


@dataclass(frozen=True, slots=True, eq=False)
class ThinPoints:
    """Points on a sheet or along a line.

    Attributes:
        points: positions (n, 3) [m].
        sizes: area [m2] or length [m] that belongs to each point (n,); they add up to the whole.
        directions: unit normal of the sheet's triangle or tangent of the line there (n, 3).
    """

    points: Floats
    sizes: Floats
    directions: Floats

    def __len__(self) -> int:
        """Number of points."""
        return len(self.points)


def sheet_points(
    sheet: Mesh | tuple[Floats, Ints], distance: float, *, seed: int = 0
) -> ThinPoints:
    """Poisson-disk points on a sheet, no two nearer than `distance` in space.

    The points are chosen, in an order that is drawn, among the centres of fine triangles of sides
    up to an eighth of the distance, until none is left to choose: so two layers of a fold that
    are nearer than the distance share their points. The area goes to the nearest point.

    Args:
        sheet: a mesh, of which the surface cells are taken, or points (p, 3) [m] and triangles
            (t, 3).
        distance: smallest distance of two points [m].
        seed: of the random numbers.

    Raises:
        MeshError: no triangles, or arrays that are not triangles.
        ParameterError: a distance that is not positive, or larger than the sheet.
    """
    points, triangles = _triangles(sheet)
    value = _fitting(points[triangles].reshape(-1, 3), distance, "distance", "sheet")
    areas = area(points, triangles)
    _require_size(areas.sum(), "area", "triangles")
    centres, of = _fine_centres(points, triangles, value / _FINE)
    weights = areas[of] / np.bincount(of, minlength=len(triangles))[of]
    chosen = spaced(centres, value, drawn(seed))
    widths = np.repeat(np.sqrt(weights)[:, None], 3, axis=1)
    sizes = shared_out(centres[chosen], centres, weights, widths).volumes
    a, b, c = points[triangles[of[chosen]]].swapaxes(0, 1)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return ThinPoints(centres[chosen], sizes * (areas.sum() / sizes.sum()), normals)


def line_points(line: Mesh | tuple[Floats, Ints], spacing: float) -> ThinPoints:
    """Points at even distances along lines.

    Each stretch between ends and branchings is cut into equal parts of about the spacing, at
    least one, and has a point in the middle of each.

    Args:
        line: a mesh, of which the line cells are taken, or points (p, 3) [m] and segments (s, 2).
        spacing: length of the parts [m].

    Raises:
        MeshError: no segments, or arrays that are not segments.
        ParameterError: a spacing that is not positive, or larger than the longest stretch.
    """
    points, segments = _segments(line)
    value = positive(spacing, "spacing")
    ways = [points[nodes] for nodes in chains(segments)]
    lengths = [np.linalg.norm(np.diff(way, axis=0), axis=1) for way in ways]
    longest = max(float(part.sum()) for part in lengths)
    _require_size(longest, "length", "segments")
    if not longest / MOST_CELLS <= value <= longest * (1.0 + 1e-9):
        raise ParameterError(
            f"found spacing {value:g} m; lengths up to that of the longest stretch, {longest:g} m, "
            f"and from {longest / MOST_CELLS:.2g} m on are accepted"
        )
    parts = [
        _along(way, part, value) for way, part in zip(ways, lengths, strict=True) if part.sum() > 0
    ]
    return ThinPoints(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _along(way: Floats, lengths: Floats, spacing: float) -> tuple[Floats, Floats, Floats]:
    """Points, lengths and tangents of one stretch through the corners `way`."""
    kept = np.flatnonzero(lengths > 0.0)
    reached = np.concatenate([[0.0], np.cumsum(lengths[kept])])
    count = max(1, round(reached[-1] / spacing))
    where = (np.arange(count) + 0.5) * (reached[-1] / count)
    piece = np.clip(np.searchsorted(reached, where, side="right") - 1, 0, len(kept) - 1)
    start, end = way[kept[piece]], way[kept[piece] + 1]
    tangents = (end - start) / lengths[kept[piece]][:, None]
    points = start + (where - reached[piece])[:, None] * tangents
    return points, np.full(count, reached[-1] / count), tangents


def _fine_centres(points: Floats, triangles: Ints, side: float) -> tuple[Floats, Indices]:
    """Centres of the k^2 equal triangles each triangle is cut into, and the triangle of each."""
    corners = points[triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    cuts = np.maximum(np.ceil(longest / side), 1.0)
    if (cuts**2).sum() > MOST_CELLS / 5:
        raise ParameterError(
            f"found distance {side * _FINE:g} m, which makes {(cuts**2).sum():.2g} fine triangles; "
            f"up to {MOST_CELLS / 5:.0e} are accepted: take a larger one"
        )
    centres, of = [], []
    for k in np.unique(cuts).astype(np.int64):
        which = np.flatnonzero(cuts == k)
        i, j = np.divmod(np.arange(k * k), k)
        up = i + j < k  # the others are the mirrored triangles of the square
        u = np.where(up, i + 1 / 3, k - i - 1 / 3) / k
        v = np.where(up, j + 1 / 3, k - j - 1 / 3) / k
        weights = np.stack([1.0 - u - v, u, v], axis=1)
        centres.append(np.einsum("kc,tcx->tkx", weights, corners[which]).reshape(-1, 3))
        of.append(np.repeat(which, k * k))
    return np.concatenate(centres), np.concatenate(of)


def _triangles(sheet: Mesh | tuple[Floats, Ints]) -> tuple[Floats, Ints]:
    if isinstance(sheet, Mesh):
        flat = thins.with_thin(sheet, sheets=True, lines=False)
        three, _, four, _ = thins.faces(flat)
        halves = four[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
        sheet = flat.points, np.concatenate([three, halves])
    points, triangles = positions(sheet[0]), np.asarray(sheet[1], dtype=np.int32)
    require_triangles(points, triangles)
    return points, triangles


def _segments(line: Mesh | tuple[Floats, Ints]) -> tuple[Floats, Ints]:
    if isinstance(line, Mesh):
        flat = thins.with_thin(line, sheets=False, lines=True)
        line = flat.points, thins.line_pieces(flat)[0]
    points, segments = positions(line[0]), np.asarray(line[1], dtype=np.int32)
    if segments.ndim != 2 or segments.shape[1] != 2 or not len(segments):
        raise MeshError(
            f"found segments of shape {segments.shape}; an array (s, 2) of at least one segment "
            "is accepted"
        )
    if segments.min() < 0 or segments.max() >= len(points):
        raise MeshError(
            f"found segments with the nodes {segments.min()} to {segments.max()}; numbers from 0 "
            f"to {len(points) - 1} are accepted"
        )
    return points, segments


def _fitting(points: Floats, length: float, name: str, what: str) -> float:
    value, longest = positive(length, name), float(np.ptp(points, axis=0).max())
    if value > longest * (1.0 + 1e-9):
        raise ParameterError(
            f"found {name} {value:g} m, which is larger than the {what}: its longest side is "
            f"{longest:g} m; lengths up to that are accepted: take a smaller one"
        )
    return value


def _require_size(size: float, name: str, what: str) -> None:
    if not size > 0.0:
        raise MeshError(f"found {what} whose {name} is 0; {what} with some {name} are accepted")
