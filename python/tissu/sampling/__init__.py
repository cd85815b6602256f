"""Sampling of frames and integration points for bodies without a mesh.

After Bosman, Duriez and Cotin, Modèle pour la simulation de tissus connectifs, REFIG 2014: frames
and integration points are two Poisson-disk samplings of the same region, the points more densely.
"""

from tissu.sampling.between import Between, between
from tissu.sampling.grid import grid_cells, grid_points
from tissu.sampling.poisson import poisson_count, poisson_distance, poisson_points
from tissu.sampling.region import Region
from tissu.sampling.shares import Shares, point_shares, point_volumes
from tissu.sampling.surface import Surface
from tissu.sampling.thin import ThinPoints, line_points, sheet_points

__all__ = [
    "Between",
    "Region",
    "Shares",
    "Surface",
    "ThinPoints",
    "between",
    "grid_cells",
    "grid_points",
    "line_points",
    "point_shares",
    "point_volumes",
    "poisson_count",
    "poisson_distance",
    "poisson_points",
    "sheet_points",
]
