"""What a VTU file holds of a body besides its shape: the fields that the scene's output names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.field_names import WRITTEN_BESIDE
from tissu.mesh.through_meshio import REGION_MARK

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

_ALWAYS = {"von_mises": "von_mises", "energy_density": "strain_energy_density"}


def cell_data(
    simulation: Simulation, body: str, known: dict[str, Floats]
) -> dict[str, NDArray[Any]]:
    """Fields (e, ...) of the cells by the names they are written by; `known`: its cell fields.

    Fields that the body's model does not have are left out, as von_mises of springs.
    """
    asked = _asked(simulation, "fields")
    if asked is None:
        return {written: known[name] for name, written in _ALWAYS.items() if name in known}
    names = [name for name in asked if name not in WRITTEN_BESIDE]
    data: dict[str, NDArray[Any]] = {}
    if "von_mises" in known:
        data = {name: _rows(v) for name, v in simulation.fields(names, "cells", body).items()}
    else:
        data = {name: known[name] for name in names if name in known}
    if "regions" in asked and body in simulation.meshes:
        data |= _marks(simulation.meshes[body])
    return data


def node_data(simulation: Simulation, body: str, known: dict[str, Floats]) -> dict[str, Floats]:
    """Fields (n, ...) of the nodes that the scene's output names, reactions, and contact."""
    data: dict[str, Floats] = {}
    names = _asked(simulation, "node_fields")
    if names and "von_mises" in known:
        data = {name: _rows(v) for name, v in simulation.fields(names, "nodes", body).items()}
    if body in simulation.touching:
        data["contact_pressure"], data["contact_gap"] = simulation.contact_at_nodes(body)
    if "reactions" in (_asked(simulation, "fields") or ()):
        data["reactions"] = simulation.reactions(body)
        if simulation.scene.bodies[body].has_rotations:
            data["reaction_moments"] = simulation.reactions(body, moments=True)
    return data


def _asked(simulation: Simulation, field: str) -> Sequence[str] | None:
    output = simulation.scene.output
    return None if output is None else getattr(output, field)


def _rows(values: Floats) -> Floats:
    """Tensors as rows of nine numbers."""
    return values.reshape(len(values), -1) if values.ndim == 3 else values


def _marks(mesh: Mesh) -> dict[str, NDArray[np.int32]]:
    """For each region 1 where a cell is in it: what `read_mesh` makes regions of again."""
    marks = {}
    for name, cells in mesh.regions.items():
        mark = np.zeros(mesh.cell_count, dtype=np.int32)
        mark[cells] = 1
        marks[REGION_MARK + name] = mark
    return marks
