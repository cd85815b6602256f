"""A VTU file for each body and time, and the PVD index that ParaView opens as one series."""

from __future__ import annotations

import re
import weakref
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted
from tissu.files import distinct_names, file_name, require_folder_place, whole_file
from tissu.files.whole import clear_unfinished
from tissu.output.folder import inner_folder, prepare_folder
from tissu.output.held import hold
from tissu.output.obstacle_file import write_contact_surface, write_obstacle
from tissu.output.vtu_fields import cell_data, point_data

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.simulation import Simulation

FRAMES = "frames"
_EARLY = " <!-- the run ended early here -->"
Floats = NDArray[np.float64]


class Series:
    """Writes the bodies of a simulation at the times `write` is called.

    The points are where the nodes are at that time; point fields: displacement [m] and velocity
    [m/s]; cell fields: strain_energy_density [J/m^3], and von_mises [Pa] for models that compute
    it, or those that the scene's `output` names. Bodies with contacts also have the point fields
    contact_pressure [Pa] and contact_gap [m]. Connective tissue is written as its integration
    points, obstacles that bodies meet as their surface. A body with a `surface_of` has that mesh in
    addition. Bodies that were cut have the surface and the inside of their material. After each
    call all files are complete and the index lists all of them.
    No other process writes there as long as the series is kept.

        series = ts.Series(simulation, "results")
        for report in simulation.run("0.5 s"):
            series.write()

    Args:
        simulation: what is written.
        folder: the folder of the files; it is made if it does not exist.

    Attributes:
        index: the PVD file.
        count: number of times written.
        last_time: simulated time of the last ones [s].
        inverted: a sentence on the first time written at which cells were inside out; empty: none.
    """

    def __init__(self, simulation: Simulation, folder: str | PathLike[str]) -> None:
        """Makes the folder, and takes away what an earlier series of this name left in it.

        A simulation that went on from a checkpoint continues the series in the folder: frames
        until that time stay, but for those that only an early end had written; later ones are
        taken away.

        Raises:
            TissuError: the folder cannot be written, or another process writes there.
        """
        self._simulation = simulation
        self._folder = prepare_folder(folder)
        weakref.finalize(self, hold(self._folder))
        self._entries: list[str] = []
        require_folder_place(self._folder / FRAMES, "output folder", within=True)
        self._parts = [*simulation.meshes, *simulation.tissue, *simulation.obstacles]
        self._surfaces = _surface_names(simulation, self._parts)
        self._parts += self._surfaces
        self._names = distinct_names(self._parts)
        self.index = self._folder / f"{file_name(simulation.scene.name)}.pvd"
        self.count = 0
        self.last_time = -1.0
        self.inverted = ""
        if simulation.resumed_from is not None:
            self._continue(len(self._parts))
        _clear(self.index, kept=self._entries)
        for folder in (self._folder, self._folder / FRAMES):
            clear_unfinished(folder)

    def write(self, *, ended_early: bool = False) -> None:
        """Writes the present state of every body and obstacle.

        Args:
            ended_early: it is written only because the run ends before its time: a series that
                goes on from a checkpoint does not keep it.

        Raises:
            TissuError: a file cannot be written.
        """
        simulation = self._simulation
        inner_folder(self._folder, FRAMES)
        for part, body in enumerate(self._parts):
            name = f"{FRAMES}/{self._names[body]}_{self.count:05d}.vtu"
            if body in simulation.tissue:
                write_points(self._folder / name, simulation, body)
            elif body in self._surfaces:
                write_contact_surface(self._folder / name, simulation, self._surfaces[body])
            elif body in simulation.obstacles:
                write_obstacle(self._folder / name, simulation, body)
            else:
                write_body(self._folder / name, simulation, body)
                self._look_for_inverted(body)
            self._entries.append(
                f'    <DataSet timestep="{simulation.time:.9g}" group="" part="{part}" '
                f'name={quoteattr(body)} file="{name}"/>{_EARLY if ended_early else ""}\n'
            )
        self.count += 1
        self.last_time = simulation.time
        with whole_file(self.index) as partial:
            partial.write_text(_index(self._entries), encoding="utf-8")

    def _continue(self, parts: int) -> None:
        """Takes over what is in the folder until the present time, when it is all there."""
        time = self._simulation.time
        text = self.index.read_text(encoding="utf-8") if self.index.is_file() else ""
        entries = [line for line in text.splitlines(keepends=True) if "<DataSet" in line]
        times = [_time_of(entry) for entry in entries]
        kept = [
            entry
            for entry, t in zip(entries, times, strict=True)
            if t <= time * (1.0 + 1e-8) and _EARLY not in entry
        ]
        whole = all((self._folder / name).is_file() for name in _frames("".join(kept)))
        if not kept or not whole or len(kept) % parts:
            return
        self._entries, self.count = kept, len(kept) // parts
        last = _time_of(kept[-1])
        self.last_time = time if last >= time * (1.0 - 1e-8) else last

    def _look_for_inverted(self, body: str) -> None:
        if self.inverted:
            return
        inverted = self._simulation.inverted_cells(body)
        if not len(inverted):
            return
        first = ", ".join(map(str, inverted[:5])) + (", ..." if len(inverted) > 5 else "")
        verb = "is" if len(inverted) == 1 else "are"
        laws = self._simulation.scene.bodies[body].laws().values()
        resists = any(law.type == "stable_neo_hooke" for law in laws)
        other = "" if resists else " or the law stable_neo_hooke, which resists it"
        self.inverted = (
            f"at t = {self._simulation.time:.4g} s {counted(len(inverted), 'cell')} of body "
            f"'{body}' {verb} inside out ({first}); what follows is not a deformation of the body: "
            f"take smaller steps{other}"
        )


def _surface_names(simulation: Simulation, taken: list[str]) -> dict[str, str]:
    """Name of the part -> body whose surface in contact is a mesh of its own."""
    names: dict[str, str] = {}
    for body in simulation.own_surfaces:
        name = f"{body}-surface"
        while name in taken or name in names:
            name += "-"
        names[name] = body
    return names


def write_body(path: Path, simulation: Simulation, body: str) -> None:
    """Writes one body at the present time: its cells, or its material where it was cut.

    Raises:
        TissuError: the file cannot be written.
    """
    if simulation.is_cut(body):
        write_material(path, simulation, body)
    else:
        write_vtu(path, simulation.meshes[body], simulation, body)


def write_material(path: Path, simulation: Simulation, body: str) -> None:
    """Writes the material of a body that was cut, at the present time.

    Point field `node`: the node of the body that a point is, -1: it rides on several. Cell fields
    `cell`, `origin` (the original cell) and `piece` (by volume, from 0).

    Raises:
        TissuError: the file cannot be written.
    """
    from tissu.mesh.through_meshio import library

    meshio = library()
    material = simulation.material(body)
    blocks = material.mesh.body_blocks
    ends = np.cumsum([len(block.nodes) for block in blocks])[:-1]
    host = np.searchsorted(simulation.remaining_cells(body), material.cell)
    fields = simulation.cell_fields(body)
    own = material.nodes[:, 0].copy()
    own[np.count_nonzero(material.weights, axis=1) > 1] = -1
    at_cells = {name: values[host] for name, values in cell_data(simulation, body, fields).items()}
    at_cells["cell"] = material.cell
    at_cells["origin"] = simulation.origin(body)[host]
    at_cells["piece"] = pieces_of(simulation, body, material.cell)
    result = meshio.Mesh(
        material.points,
        [(block.type, block.nodes) for block in blocks],
        point_data=point_data(simulation, body, fields, material) | {"node": own},
        cell_data={name: list(np.split(values, ends)) for name, values in at_cells.items()},
    )
    with whole_file(path) as partial:
        meshio.write(partial, result, file_format="vtu")


def pieces_of(simulation: Simulation, body: str, cells: NDArray[np.int32]) -> NDArray[np.int32]:
    """For each of these cells (m,) the piece, by volume, that holds it; the larger of two."""
    piece = np.zeros(len(cells), dtype=np.int32)
    found = simulation.pieces(body)
    for number in reversed(range(len(found))):
        piece[np.isin(cells, found[number].cells)] = number
    return piece


def write_vtu(path: Path, mesh: Mesh, simulation: Simulation, body: str) -> dict[str, Floats]:
    """Writes one body at the present time; returns its cell fields.

    Raises:
        TissuError: the file cannot be written.
    """
    from tissu.mesh.through_meshio import library

    meshio = library()
    blocks = mesh.body_blocks
    ends = np.cumsum([len(block.nodes) for block in blocks])[:-1]

    def by_block(values: NDArray[Any]) -> list[NDArray[Any]]:
        return list(np.split(np.asarray(values), ends))

    fields = simulation.cell_fields(body)
    result = meshio.Mesh(
        np.array(simulation.positions[body]),
        [(block.type, block.nodes) for block in blocks],
        point_data=point_data(simulation, body, fields, None),
        cell_data={
            name: by_block(values) for name, values in cell_data(simulation, body, fields).items()
        },
    )
    with whole_file(path) as partial:
        meshio.write(partial, result, file_format="vtu")
    return fields


def write_points(path: Path, simulation: Simulation, tissue: str) -> None:
    """Writes the integration points of a tissue at the present time.

    Raises:
        TissuError: the file cannot be written.
    """
    from tissu.mesh.through_meshio import library

    meshio = library()
    now, fields = simulation.points(tissue), simulation.cell_fields(tissue)
    result = meshio.Mesh(
        now,
        [("vertex", np.arange(len(now))[:, None])],
        point_data={"displacement": now - simulation.points(tissue, rest=True)},
        cell_data={
            name: [values] for name, values in cell_data(simulation, tissue, fields).items()
        },
    )
    with whole_file(path) as partial:
        meshio.write(partial, result, file_format="vtu")


def _index(entries: list[str]) -> str:
    return (
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n'
        + "".join(entries)
        + "  </Collection>\n</VTKFile>\n"
    )


def _clear(index: Path, kept: list[str]) -> None:
    """Removes the frames that an index lists, the index, and the picture beside it; nothing else.

    Frames of the entries to keep stay, in an index of their own.
    """
    if not index.is_file():
        return
    index.with_suffix(".png").unlink(missing_ok=True)  # of the run before
    text = index.read_text(encoding="utf-8", errors="replace")
    if kept:
        with whole_file(index) as partial:
            partial.write_text(_index(kept), encoding="utf-8")
    else:
        index.unlink()
    for name in set(_frames(text)) - set(_frames("".join(kept))):
        (index.parent / name).unlink(missing_ok=True)


def _frames(text: str) -> list[str]:
    return re.findall(rf'file="({FRAMES}/[\w.-]+\.vtu)"', text)


def _time_of(entry: str) -> float:
    """The time of an entry [s]; infinity where it has none."""
    found = re.search(r'timestep="([^"]+)"', entry)
    try:
        return float(found[1]) if found is not None else float("inf")
    except ValueError:
        return float("inf")
