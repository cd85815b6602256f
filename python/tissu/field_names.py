"""The names of the fields of a simulation, and the places where they are taken."""

from __future__ import annotations

from typing import Literal, get_args

FieldName = Literal[
    "deformation_gradient",
    "green_strain",
    "cauchy_stress",
    "first_piola_kirchhoff_stress",
    "second_piola_kirchhoff_stress",
    "von_mises",
    "principal_stresses",
    "principal_strains",
    "energy_density",
    "volume_ratio",
]
"""Names of the fields of `Simulation.field`."""

Place = Literal["cells", "points", "nodes"]
"""Where a field is wanted."""

FIELD_NAMES: tuple[str, ...] = get_args(FieldName)
PLACES: tuple[str, ...] = get_args(Place)
WRITTEN_BESIDE = ("regions", "reactions")
"""What `Output.fields` accepts beside them: marks of the cells of each region, and what supports
give to the nodes."""
