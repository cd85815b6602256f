"""What cuts, what is left of a body's material, and what a cut says of itself."""

from tissu.cutting.blade import Blade, Disc, Sweep, Triangles, surface_of
from tissu.cutting.material import Material, MaterialSurface
from tissu.cutting.report import CutReport, Piece

__all__ = [
    "Blade",
    "CutReport",
    "Disc",
    "Material",
    "MaterialSurface",
    "Piece",
    "Sweep",
    "Triangles",
    "surface_of",
]
