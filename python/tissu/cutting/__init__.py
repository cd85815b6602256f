"""What cuts, what is left of a body's material, and what a cut says of itself."""

from tissu.cutting.blade import Blade, Capsule, Disc, Sweep, Triangles, surface_of
from tissu.cutting.material import Material, MaterialSurface
from tissu.cutting.quality import Quality
from tissu.cutting.report import CutReport, Piece, Repairs

__all__ = [
    "Blade",
    "Capsule",
    "CutReport",
    "Disc",
    "Material",
    "MaterialSurface",
    "Piece",
    "Quality",
    "Repairs",
    "Sweep",
    "Triangles",
    "surface_of",
]
