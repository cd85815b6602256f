"""What can be shown by colour: each field with its unit, and its values at nodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError
from tissu.live_view.surface import gone_of
from tissu.picture.layout import length_unit, pressure_unit
from tissu.scene.selection import region_cells

if TYPE_CHECKING:
    from tissu.live_view.surface import Seen
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]
Unit = Callable[[float], tuple[float, str]]


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a body.

    Attributes:
        label: what it is called.
        unit: factor and unit in which values up to a largest one are written.
        values: at the nodes (k,) that are seen of a body, in SI units.
    """

    label: str
    unit: Unit
    values: Callable[[Simulation, str, Seen], Floats]


def displacement(simulation: Simulation, body: str, seen: Seen) -> Floats:
    """How far nodes are from where they are at rest (k,) [m]."""
    return gone_of(simulation, body, seen)


def contact_pressure(simulation: Simulation, body: str, seen: Seen) -> Floats:
    """Normal force of contacts over the area of the surface (k,) [Pa]; see `contact_at_nodes`."""
    if body not in simulation.meshes:
        raise ParameterError(f"found tissue '{body}', which meets nothing")
    if seen.numbers is not None:
        return simulation.contact_at_points(body, seen.numbers).pressure
    return seen.at(simulation.contact_at_nodes(body).pressure)


def _of_cells(name: str) -> Callable[[Simulation, str, Seen], Floats]:
    def values(simulation: Simulation, body: str, seen: Seen) -> Floats:
        if body in simulation.tissue:
            raise ParameterError(f"found tissue '{body}', which has no cells")
        found = simulation.cell_fields(body)
        if name not in found:
            raise ParameterError(f"found a model of '{body}' that has no {name}")
        return at_nodes(found[name], seen)

    return values


def stiffness(simulation: Simulation, body: str, seen: Seen) -> Floats:
    """Young's modulus at small strain (k,) [Pa], as the laws of the scene have it."""
    if body not in simulation.meshes:
        raise ParameterError(f"found tissue '{body}', which has no cells")
    mesh, rest = simulation.meshes[body], 0.0
    of_cells = np.full(mesh.cell_count, np.nan)
    for region, law in simulation.scene.bodies[body].laws().items():
        if type(law).made is not None:
            raise ParameterError(f"found a law of '{body}' without known moduli")
        lame, mu = law.small_strain()
        young = mu * (3.0 * lame + 2.0 * mu) / (lame + mu)
        if region is None:
            of_cells[:] = young
        elif region == "rest" and region not in mesh.regions:
            rest = young
        else:
            of_cells[region_cells(region, mesh)] = young
    return at_nodes(np.where(np.isnan(of_cells), rest, of_cells), seen)


def at_nodes(of_cells: Floats, seen: Seen) -> Floats:
    """Values (e,) of cells as means (k,) over the faces and lines around each node that is seen."""
    corners = np.concatenate([seen.triangles.ravel(), seen.lines.ravel()])
    values = np.concatenate(
        [np.repeat(of_cells[seen.cells], 3), np.repeat(of_cells[seen.line_cells], 2)]
    )
    total = np.bincount(corners, values, minlength=len(seen.nodes))
    count = np.bincount(corners, minlength=len(seen.nodes))
    return np.asarray(total / np.maximum(count, 1))


def _density_unit(largest: float) -> tuple[float, str]:
    factor, unit = pressure_unit(largest)
    return factor, {"Pa": "J/m³", "kPa": "kJ/m³", "MPa": "MJ/m³", "GPa": "GJ/m³"}[unit]


FIELDS: dict[str, Field] = {
    "displacement": Field("displacement", length_unit, displacement),
    "von_mises": Field("von Mises stress", pressure_unit, _of_cells("von_mises")),
    "energy_density": Field("strain energy density", _density_unit, _of_cells("energy_density")),
    "volume_ratio": Field("volume ratio", lambda _: (1.0, "1"), _of_cells("volume_ratio")),
    "contact_pressure": Field("contact pressure", pressure_unit, contact_pressure),
    "stiffness": Field("Young's modulus at small strain", pressure_unit, stiffness),
}
"""The fields by their names; another one is another line."""


def offered(simulation: Simulation, seen: dict[str, Seen]) -> list[str]:
    """The fields that at least one body has."""
    found = []
    for name, field in FIELDS.items():
        for body, of_body in seen.items():
            try:
                field.values(simulation, body, of_body)
            except ParameterError:
                continue
            found.append(name)
            break
    return found
