"""Repair of the cells that cuts leave."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.simulation import grab as kept
from tissu.simulation.still import still_nodes
from tissu.simulation.track import anchor_again, places_in, tracks

if TYPE_CHECKING:
    from tissu.cutting.report import CutReport
    from tissu.mesh import Mesh
    from tissu.simulation.simulation import Simulation

Ints = NDArray[np.int32]


def repairs(simulation: Simulation, body: str) -> bool:
    """Whether bad cells of a body are repaired after a cut."""
    editing = simulation.scene.editing
    return editing is not None and editing.repairs(body)


def repaired(simulation: Simulation, body: str) -> dict[str, Any]:
    """Repair bad cells of a body; what the core made."""
    editing = simulation.scene.editing
    part = None if editing is None else editing.repair
    assert part is not None
    first, count = simulation._core.body_range(body)
    grabs = kept.records(simulation._core) if simulation.scene.grabbing else {}
    mesh = simulation._meshes[body]
    return simulation._core.repair(
        body=body,
        below=part.below,
        most=part.most,
        jump=part.jump,
        still=still_nodes(mesh, [grab.nodes for grab in grabs.values()], first, count),
        regions=regions_of(simulation._rest[body]),
        goes_on=np.array(going_on(simulation, body), dtype=np.int32),
    )


def with_repair(made: dict[str, Any], repair: dict[str, Any]) -> dict[str, Any]:
    """A cut and the repair after it as one edit."""
    for name, value in repair["after"].items():
        made["after"][name] = made["after"][name] + (value - repair["before"][name])
    change = repair["after"]["elastic"] - repair["before"]["elastic"]
    made["relaid"] = made["relaid"] or repair["relaid"]
    made["repairs"] = {**repair["repairs"], "elastic_energy_change": change}
    return made


def regions_of(mesh: Mesh) -> Ints:
    """A number for each cell of a mesh; cells have the same if they are in the same regions."""
    inside = np.zeros((mesh.cell_count, len(mesh.regions)), dtype=bool)
    for column, cells in enumerate(mesh.regions.values()):
        inside[cells, column] = True
    if not mesh.regions:
        return np.zeros(mesh.cell_count, dtype=np.int32)
    return np.unique(inside, axis=0, return_inverse=True)[1].reshape(-1).astype(np.int32)


def going_on(simulation: Simulation, body: str) -> list[int]:
    """Numbers of the incisions of a body with which knives go on."""
    if not simulation.scene.instruments:
        return []
    pairs = simulation._instrument_pairs()
    known = tracks(simulation._core)
    return [
        track.incision
        for number, track in known.items()
        if pairs[number][1] == body and track.incision >= 0
    ]


def repair_ended(simulation: Simulation, name: str, body: str) -> CutReport | None:
    """Repair a body in which an incision of an instrument has ended; None: nothing was made."""
    rows = places_in(simulation, body)

    def make() -> dict[str, Any]:
        repair = repaired(simulation, body)
        nothing = {**repair, "after": dict(repair["before"]), "repairs": None}
        return with_repair(nothing, repair)

    report = simulation._made(body, make, by=name)
    if report.met_nothing:
        return None
    anchor_again(simulation, body, rows)
    return report
