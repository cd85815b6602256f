"""What a VTU file holds of a body besides its shape: the fields that the scene's output names.

The points of a body that was cut are those of its material. Fields of nodes are interpolated to
them. Forces of nodes are shared among them: what is interpolated would not add up. Contacts act
on the points of the surface themselves.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.field_names import WRITTEN_BESIDE
from tissu.mesh.through_meshio import REGION_MARK

if TYPE_CHECKING:
    from tissu.cutting.material import Material
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


def point_data(
    simulation: Simulation, body: str, known: dict[str, Floats], material: Material | None
) -> dict[str, Floats]:
    """Fields (p, ...) of the points: motion, those that the output names, reactions, contact.

    Args:
        simulation: of the body.
        body: its name.
        known: its cell fields.
        material: whose points they are; absent: the points are the nodes.
    """
    data = {
        "displacement": np.array(simulation.displacements(body)),
        "velocity": np.array(simulation.velocities[body]),
    }
    names = _asked(simulation, "node_fields")
    if names and "von_mises" in known:
        found = simulation.fields(names, "nodes", body)
        data |= {name: _rows(values) for name, values in found.items()}
    forces: dict[str, Floats] = {}
    if "reactions" in (_asked(simulation, "fields") or ()):
        forces["reactions"] = simulation.reactions(body)
        if simulation.scene.bodies[body].has_rotations:
            forces["reaction_moments"] = simulation.reactions(body, moments=True)
    if material is not None:
        data = {name: material.carried(values) for name, values in data.items()}
        forces = _spread(simulation, body, material, forces)
    if body in simulation.touching:
        data["contact_pressure"], data["contact_gap"] = (
            simulation.contact_at_nodes(body)
            if material is None
            else simulation.contact_at_points(body, material.numbers)
        )
    return data | forces


def _spread(
    simulation: Simulation, body: str, material: Material, forces: dict[str, Floats]
) -> dict[str, Floats]:
    if not forces:
        return {}
    mesh, cells = simulation.meshes[body], simulation.remaining_cells(body)
    now = np.array(simulation.positions[body])
    return {
        name: material.spread(mesh, cells, values, now if name == "reactions" else None)
        for name, values in forces.items()
    }


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
