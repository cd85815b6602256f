"""Where a picture is taken from: a parallel projection, chosen from the shape and from gravity."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError

Array = NDArray[np.float64]

AZIMUTH = math.radians(28.0)  # away from the view square onto the longest horizontal axis
ELEVATION = math.radians(22.0)
ROUND = 1.15  # ratio of horizontal extents below which no axis counts as the longest


@dataclass(frozen=True, slots=True)
class Camera:
    """A parallel projection onto a picture.

    Attributes:
        axes: (3,3) rows: to the right of the picture, to its top, towards the viewer.
        centre: (3,) point at the middle of the picture [m].
        scale: pixels per metre.
        size: width and height of the picture [pixels].
    """

    axes: Array
    centre: Array
    scale: float
    size: tuple[int, int]

    def project(self, points: ArrayLike) -> Array:
        """Points (n,3) [m] -> (n,3): column and row from the top left corner, nearness [pixels]."""
        seen = (np.asarray(points, dtype=np.float64) - self.centre) @ self.axes.T * self.scale
        seen[:, 0] += self.size[0] / 2
        seen[:, 1] = self.size[1] / 2 - seen[:, 1]
        return np.asarray(seen)

    def enlarged(self, factor: int) -> Camera:
        """The same view with `factor` times the pixels in each direction."""
        size = (self.size[0] * factor, self.size[1] * factor)
        return Camera(self.axes, self.centre, self.scale * factor, size)


def look_at(
    shapes: Sequence[ArrayLike],
    *,
    size: tuple[int, int],
    up: ArrayLike = (0.0, 0.0, 1.0),
    towards: ArrayLike | None = None,
    margin: float = 0.06,
) -> Camera:
    """A camera that shows all shapes, from the side of the first one and a little from above.

    Args:
        shapes: points (n,3) [m] of each shape.
        size: width and height of the picture [pixels].
        up: (3,) direction that points to the top of the picture.
        towards: (3,) direction from the shapes to the viewer, in place of that from the side.
        margin: share of the picture left free on each side.

    Raises:
        ParameterError: no points, points that are not finite, a picture without pixels, or a
            direction of length zero.
    """
    clouds = [np.asarray(s, dtype=np.float64).reshape(-1, 3) for s in shapes]
    clouds = [c for c in clouds if len(c)]
    if not clouds or not all(np.isfinite(c).all() for c in clouds):
        raise ParameterError("a picture needs at least one point, and finite coordinates only")
    if min(size) < 1:
        raise ParameterError(f"a picture of {size[0]} x {size[1]} pixels; at least 1 x 1 is needed")
    top = np.asarray(up, dtype=np.float64)
    axes = view_axes(clouds[0], top) if towards is None else axes_towards(towards, top)
    seen = np.vstack(clouds) @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    extent = np.maximum(high - low, 1e-12 + 1e-9 * np.abs(seen).max())
    room = np.array(size) * (1 - 2 * margin)
    scale = float((room / extent[:2]).min())
    return Camera(axes, np.asarray((low + high) / 2 @ axes), scale, size)


def view_axes(points: Array, up: Array) -> Array:
    """Axes (3,3) of a view square onto the longest horizontal axis, turned and raised a little."""
    length = float(np.linalg.norm(up))
    up = up / length if length > 0 else np.array([0.0, 0.0, 1.0])
    right = _longest_horizontal(points, up)
    towards = np.cross(right, up)
    right, towards = (
        math.cos(AZIMUTH) * right - math.sin(AZIMUTH) * towards,
        math.cos(AZIMUTH) * towards + math.sin(AZIMUTH) * right,
    )
    top = math.cos(ELEVATION) * up - math.sin(ELEVATION) * towards
    towards = math.cos(ELEVATION) * towards + math.sin(ELEVATION) * up
    return np.stack([right, top, towards])


def axes_towards(towards: ArrayLike, up: Array) -> Array:
    """Axes (3,3) of a view from a direction (3,); `up` points upwards on the picture.

    Along `up` itself, the axis that lies most across it points upwards.

    Raises:
        ParameterError: not three finite numbers, or all of them zero.
    """
    direction = np.asarray(towards, dtype=np.float64)
    usable = direction.shape == (3,) and bool(np.isfinite(direction).all()) and direction.any()
    if not usable:
        raise ParameterError(
            f"found {towards!r} as the direction to the viewer; three finite numbers that are not "
            "all zero are accepted"
        )
    direction = direction / np.linalg.norm(direction)
    right = np.cross(up, direction)
    if np.linalg.norm(right) <= 1e-6 * np.linalg.norm(up):
        right = np.cross(np.eye(3)[int(np.argmin(np.abs(direction)))], direction)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(direction, right), direction])


def _longest_horizontal(points: Array, up: Array) -> Array:
    """Direction (3,) across `up` in which the points reach farthest; an axis when that is all."""
    first = np.eye(3)[int(np.argmin(np.round(np.abs(up), 6)))]
    first = first - (first @ up) * up
    first /= np.linalg.norm(first)
    flat = np.stack([first, np.cross(up, first)])
    centred = (points - points.mean(axis=0)) @ flat.T
    spread, turns = np.linalg.eigh(centred.T @ centred / len(points))
    round_shape = spread[1] <= ROUND**2 * max(spread[0], 0.0) or spread[1] == 0.0
    right = first if round_shape else turns[:, 1] @ flat
    return np.asarray(right * np.sign(right[np.argmax(np.abs(right))]))
