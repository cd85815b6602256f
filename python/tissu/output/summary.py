"""What a run was and what came of it, as one JSON file."""

from __future__ import annotations

import dataclasses
import json
import math
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel

from tissu.files import whole_file

if TYPE_CHECKING:
    from tissu.cutting.report import CutReport
    from tissu.mesh import Mesh
    from tissu.output.contact_tally import ContactTally
    from tissu.simulation import Simulation, StepReport


@dataclasses.dataclass(slots=True)
class StepTally:
    """What the reports of all steps say together.

    Attributes:
        steps: number of steps.
        unconverged: number of those that did not converge.
        newton_iterations: of all steps.
        solver_iterations: of all steps.
        indefinite: systems whose matrix was not positive definite, and was made so.
        largest_residual: of all steps.
        first_unconverged: what the first step that did not converge said; empty: all did.
        cuts: what instruments and tears did, one after the other; see `cut_record`.
    """

    steps: int = 0
    unconverged: int = 0
    newton_iterations: int = 0
    solver_iterations: int = 0
    indefinite: int = 0
    largest_residual: float = 0.0
    first_unconverged: str = ""
    cuts: list[dict[str, Any]] = dataclasses.field(default_factory=list)

    def add(self, report: StepReport) -> None:
        """Takes one more step into account."""
        self.steps += 1
        self.newton_iterations += report.newton_iterations
        self.solver_iterations += report.solver_iterations
        self.indefinite += report.indefinite
        self.largest_residual = max(self.largest_residual, report.residual)
        self.cuts += [cut_record(report.time, cut) for cut in report.cuts]
        if not report.converged:
            self.unconverged += 1
            self.first_unconverged = self.first_unconverged or str(report)


_NESTED = ("pieces", "repairs")


def summarise(
    simulation: Simulation,
    *,
    tally: StepTally,
    status: str,
    wall_seconds: Mapping[str, float],
    files: Mapping[str, str],
    why: str = "",
    notes: Sequence[str] = (),
    contacts: ContactTally | None = None,
) -> dict[str, Any]:
    """The summary as data; numbers in SI.

    Args:
        simulation: at the end of its run.
        tally: the steps of the run.
        status: "finished", "unconverged": some steps did not converge, "interrupted", "diverged",
            or "stopped": a step was refused, or results could not be written.
        wall_seconds: wall time by stage of the run: compile, steps, output, picture.
        files: what was written, by kind, relative to the folder of the summary.
        why: what is wrong, where it is not finished or some steps did not converge.
        notes: sentences worth knowing.
        contacts: of the run; without it, or where nothing meets anything, the summary has none.
    """
    from tissu import _core

    build, resumed = dict(_core.build_info()), simulation.resumed_from
    every_note = [*(note for mesh in simulation.meshes.values() for note in mesh.notes), *notes]
    touched = None if contacts is None else contacts.record()
    steps = dataclasses.asdict(tally)
    cuts = steps.pop("cuts")
    return {
        "tissu": build.pop("version", ""),
        "status": status,
        "why": why,
        "build": {**build, "python": platform.python_version(), "numpy": np.__version__},
        "machine": {"processor": platform.machine(), "system": platform.system()},
        "threads": simulation.scene.threads,
        "instruction_set": build.get("instruction_set", ""),
        "scene": plain(simulation.scene),
        "laws": [law.record() for law in simulation.scene.own_laws()],
        "meshes": {name: _body_data(simulation, name) for name in simulation.meshes},
        "simulated_seconds": simulation.time,
        "resumed_from": None if resumed is None else dataclasses.asdict(resumed),
        "stable_step_seconds": simulation.stable_step,
        "steps": steps,
        "timings": profile_data(simulation),
        "wall_seconds": dict(wall_seconds),
        "energy_joules": dict(simulation.energy()),
        **({} if touched is None else {"contacts": touched}),
        **({"cuts": cuts} if simulation.scene.editing else {}),
        "files": dict(files),
        "notes": every_note,
    }


def cut_record(time: float, report: CutReport) -> dict[str, Any]:
    """A cut, ablation or tear at a time [s] as data; of its pieces how large they are."""
    names = [one.name for one in dataclasses.fields(report) if one.name not in _NESTED]
    repairs = None if report.repairs is None else dataclasses.asdict(report.repairs)
    pieces = [
        {
            "first_cell": piece.first_cell,
            "cells": len(piece.cells),
            "volume": piece.volume,
            "mass": piece.mass,
            "held": piece.held,
        }
        for piece in report.pieces
    ]
    values = {name: getattr(report, name) for name in names}
    return {"time": time, **values, "repairs": repairs, "pieces": pieces}


def write_summary(path: Path, summary: Mapping[str, Any]) -> None:
    """Writes a summary; a number that is not finite becomes null.

    Raises:
        TissuError: the file cannot be written.
    """
    text = json.dumps(plain(summary), indent=2, allow_nan=False, ensure_ascii=False)
    with whole_file(path) as partial:
        partial.write_text(text + "\n", encoding="utf-8")


def _body_data(simulation: Simulation, name: str) -> dict[str, Any]:
    """Of its mesh; volume and surface of a cut body are of its material, as copies overlap."""
    data = mesh_data(simulation.meshes[name])
    if simulation.scene.editing and simulation.is_cut(name):
        data["surface_triangles"] = len(simulation.surface(name).triangles)
        data["volume_m3"] = simulation.material(name).mesh.volume()
    return data


def mesh_data(mesh: Mesh) -> dict[str, Any]:
    """Counts and origin of a mesh."""
    cells: dict[str, int] = {}
    for block in mesh.body_blocks:
        cells[block.type] = cells.get(block.type, 0) + len(block.nodes)
    return {
        "file": mesh.source,
        "unit": mesh.unit,
        "scale": mesh.scale,
        "nodes": mesh.node_count,
        "cells": cells,
        "surface_triangles": len(mesh.surface().triangles),
        "volume_m3": mesh.volume(),
        "bounds_m": mesh.bounds.tolist(),
        "regions": {name: len(cells) for name, cells in mesh.regions.items()},
    }


def profile_data(simulation: Simulation) -> Any:
    """The profile as data."""
    return plain(dataclasses.asdict(simulation.profile()))


def plain(value: Any) -> Any:
    """A value as JSON knows it: parts of a scene by their fields, numbers not finite as null."""
    if isinstance(value, BaseModel):
        return {name: plain(getattr(value, name)) for name in type(value).model_fields}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        return plain(value.tolist())
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)
