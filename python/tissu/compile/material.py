"""What each cell is made of: laws by region, density from mass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.locking import note_locking
from tissu.compile.model import check_model, law_of_model
from tissu.compile.prepared import Findings, Floats, Group, Ints
from tissu.compile.thin import check_law, material_volume
from tissu.counted import are, counted
from tissu.errors import ParameterError
from tissu.mesh.mesh import first_five
from tissu.scene.direction import scaled
from tissu.scene.selection import region_cells

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.law import Law
    from tissu.scene.model import Model
    from tissu.scene.problem import Path


def cell_groups(mesh: Mesh, body: Body, path: Path, findings: Findings) -> list[Group]:
    """The body's cells in blocks of one cell type, kind of law and model, in mesh order."""
    laws = list(body.laws().values())
    owner = _owner_of_cells(mesh, body.law, (*path, "law"), findings)
    if owner is None:
        return []
    if not body.has_rotations:  # frames take laws of volumes on sheets and lines
        _check_laws(mesh, laws, owner, path, findings)
    models = list(body.models().values())
    carrier = _owner_of_cells(mesh, body.model, (*path, "model"), findings)
    if carrier is None:
        return []
    groups: list[Group] = []
    used: list[tuple[str, Law, Model]] = []
    first = 0
    for block in mesh.body_blocks:
        cells = np.arange(first, first + len(block.nodes), dtype=np.int32)
        for law, model, count in _pairs(owner[cells], carrier[cells]):
            check_model(models[model], laws[law], str(block.type), count, body, path, findings)
            used.append((str(block.type), laws[law], models[model]))
        for some in _alike(laws, owner[cells], carrier[cells]):
            law, model = laws[owner[cells[some[0]]]], models[carrier[cells[some[0]]]]
            of_cells = owner[cells[some]]
            groups.append(
                Group(
                    cell_type=str(block.type),
                    nodes=np.asarray(block.nodes)[some],
                    cells=cells[some],
                    law=law_of_model(model, law, body) or law.type,
                    parameters=parameters_of(laws, of_cells),
                    fibres=fibres_of(laws, of_cells),
                    made=type(law).made,
                    model=model,
                )
            )
        first += len(block.nodes)
    note_locking(used, body.quadrature, path, findings)
    return groups


def _pairs(owner: Ints, carrier: Ints) -> list[tuple[int, int, int]]:
    """The pairs of a law and a model that cells have, and how many have them."""
    pairs, counts = np.unique(np.stack([owner, carrier]), axis=1, return_counts=True)
    return [(int(law), int(model), int(n)) for (law, model), n in zip(pairs.T, counts, strict=True)]


def _alike(laws: list[Law], owner: Ints, carrier: Ints) -> list[Ints]:
    """The places of the cells that can stand in one block, by their first: one kind of law each."""
    kinds = [(law.type, law.fibres is not None, type(law).made) for law in laws]
    number = np.array([kinds.index(kind) for kind in kinds], dtype=np.int64)
    keys = number[owner] * (int(carrier.max(initial=0)) + 1) + carrier
    found, first = np.unique(keys, return_index=True)
    return [np.flatnonzero(keys == key).astype(np.int32) for key in found[np.argsort(first)]]


def _check_laws(mesh: Mesh, laws: list[Law], owner: Ints, path: Path, findings: Findings) -> None:
    """Laws that their cells cannot have, whatever is wrong with their parameters."""
    first = 0
    for block in mesh.body_blocks:
        for number in np.unique(owner[first : first + len(block)]):
            check_law(laws[number], str(block.type), path, findings)
        first += len(block)


def density_of(body: Body, mesh: Mesh, path: Path, findings: Findings) -> float:
    """Density [kg/m^3], from the total mass where that is given."""
    density = body.density if body.mass is None else body.mass / material_volume(mesh, body)
    assert density is not None  # the body has one of both
    if not 50.0 <= density <= 30000.0:
        hint = "; was g/cm^3 meant?" if 0.05 <= density < 50.0 else ""
        findings.note(
            f"{path[0]}.{path[1]}: a density of {density:.4g} kg/m^3 is unlike any tissue{hint}"
        )
    return float(density)


def _owner_of_cells(mesh: Mesh, given: object, path: Path, findings: Findings) -> Ints | None:
    """For each cell the number of its law or model; None when regions do not give it just one."""
    what = str(path[-1])
    count = np.zeros(mesh.cell_count, dtype=np.int32)
    owner = np.zeros(mesh.cell_count, dtype=np.int32)
    if not isinstance(given, dict):
        return owner
    known = True
    for number, region in enumerate(given):
        if _is_rest(region, mesh):
            continue
        try:
            cells = region_cells(region, mesh)
        except ParameterError as error:
            findings.problem((*path, region), str(error))
            known = False
            continue
        count[cells] += 1
        owner[cells] = number
    if not known:
        return None
    for number, region in enumerate(given):
        if _is_rest(region, mesh):
            owner[count == 0] = number
            count[count == 0] = 1
    for wrong, words in (
        (count == 0, f"in no region of the {what}"),
        (count > 1, f"in several regions of the {what}"),
    ):
        if wrong.any():
            cells_text = f"first: {first_five(np.flatnonzero(wrong))}"
            findings.problem(
                path,
                f"{wrong.sum()} of {counted(len(count), 'cell')} {are(wrong.sum())} {words} "
                f"({cells_text}); "
                f"each cell needs one {what}",
            )
    return owner if bool((count == 1).all()) else None


def _is_rest(region: str, mesh: Mesh) -> bool:
    """Whether it means the cells that no other region of the map has."""
    return region == "rest" and region not in mesh.regions


def parameters_of(laws: list[Law], owner: Ints) -> dict[str, Floats]:
    """Parameters of cells: one value when all cells share their law, else one for each cell."""
    used, of_cell = np.unique(owner, return_inverse=True)
    names = laws[used[0]].parameter_names()
    values = {name: np.array([getattr(laws[n], name) for n in used], dtype=float) for name in names}
    if len(used) == 1:
        return values
    return {name: value[of_cell] for name, value in values.items()}


def fibres_of(laws: list[Law], owner: Ints) -> dict[str, Floats]:
    """Parameters of the fibres of cells, none when their law has no fibres."""
    used, of_cell = np.unique(owner, return_inverse=True)
    rows = []
    for number in used:
        fibres = laws[number].fibres
        if fibres is None:
            return {}
        rows.append([fibres.k1, fibres.k2, *scaled(fibres.direction)])
    names = ("k1", "k2", "direction_x", "direction_y", "direction_z")
    values = dict(zip(names, np.array(rows, dtype=float).T, strict=True))
    if len(used) == 1:
        return values
    return {name: value[of_cell] for name, value in values.items()}
