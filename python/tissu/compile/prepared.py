"""A scene with its meshes read and selections resolved, and everything found wrong on the way."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted
from tissu.mesh.cell import dimension
from tissu.scene.model import FEM, Model
from tissu.scene.problem import Path, Problem
from tissu.ties import Links, Weights

if TYPE_CHECKING:
    from tissu.compile.contact import PreparedContact
    from tissu.mesh import CellBlock, Mesh
    from tissu.scene.load import Load
    from tissu.scene.scene import SceneData
    from tissu.scene.support import Support
    from tissu.user_law.made import MadeLaw

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]


@dataclass(slots=True)
class Findings:
    """Problems that stop the scene, and notes that do not."""

    problems: list[Problem] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def problem(self, path: Path, text: str) -> None:
        """Add a problem at a field."""
        self.problems.append(Problem(path, text))

    def note(self, text: str) -> None:
        """Add a note."""
        self.notes.append(text)


@dataclass(frozen=True, slots=True)
class Group:
    """Cells of one type with one kind of law: what becomes one block of the world.

    Attributes:
        cell_type: name of the cell type.
        nodes: (e, k) node numbers in the body.
        cells: (e,) numbers of the cells across the mesh's volume blocks.
        law: name of the law.
        parameters: for each parameter, (1,) or (e,) values in SI.
        fibres: the same for the fibres added to the law; empty: none.
        made: what a law of one's own is made of; None: a law of the library.
        model: what computes the cells' forces.
    """

    cell_type: str
    nodes: Ints
    cells: Ints
    law: str
    parameters: dict[str, Floats]
    fibres: dict[str, Floats] = field(default_factory=dict)
    made: MadeLaw | None = None
    model: Model = field(default_factory=FEM)

    @property
    def surface(self) -> bool:
        """Whether they are sheets."""
        return dimension(self.cell_type) == 2


@dataclass(frozen=True, slots=True)
class KnownMesh:
    """A mesh that can be simulated or, when it has problems, what may be asked of it.

    Attributes:
        mesh: the mesh.
        positions: whether its length is beyond doubt, so that boxes and the like mean something.
        surface: whether its cells are beyond doubt, so that its faces are those of the body.
    """

    mesh: Mesh
    positions: bool = True
    surface: bool = True


@dataclass(frozen=True, slots=True)
class PreparedBody:
    """A body with its mesh, the blocks it is made of, and its density [kg/m^3]."""

    mesh: Mesh
    groups: list[Group]
    density: float


@dataclass(frozen=True, slots=True)
class PreparedTissue:
    """A tissue as the world takes it.

    Attributes:
        mesh: its own frames, as points that no cell joins.
        points: its integration points (p, 3) [m] and
        volumes: their volumes (p,) [m^3].
        shared: nodes of bodies that it holds, by name and number.
        weights: how the points listen to its frames and, by numbers after those, to these nodes.
        density: [kg/m^3].
        links: of the points, which blades may sever.
    """

    mesh: Mesh
    points: Floats
    volumes: Floats
    shared: list[tuple[str, int]]
    weights: Weights
    density: float
    links: Links


@dataclass(frozen=True, slots=True)
class Held:
    """A support with the nodes it holds or moves."""

    support: Support
    path: Path
    nodes: Ints


@dataclass(frozen=True, slots=True)
class LoadedNodes:
    """A load with its nodes (k,) and, for loads on the surface, its faces, whole and outward."""

    load: Load
    path: Path
    nodes: Ints
    faces: tuple[CellBlock, ...] = ()


@dataclass(slots=True)
class Prepared:
    """A scene, resolved as far as its problems allow.

    Attributes:
        meshes: those in which nodes can be selected, whether or not they have problems.
        bodies: those without any problem.
        contact: the contacts, where the scene has any.
    """

    scene: SceneData
    findings: Findings = field(default_factory=Findings)
    meshes: dict[str, KnownMesh] = field(default_factory=dict)
    bodies: dict[str, PreparedBody] = field(default_factory=dict)
    tissue: dict[str, PreparedTissue] = field(default_factory=dict)
    held: list[Held] = field(default_factory=list)
    loaded: list[LoadedNodes] = field(default_factory=list)
    contact: PreparedContact | None = None

    def has_rotations(self, name: str) -> bool:
        """Whether the nodes of a body or tissue are frames."""
        return name in self.tissue or bool(self.scene.bodies[name].has_rotations)

    def counts(self) -> dict[str, str]:
        """What each support and load selects: "fixed[0]" -> "42 nodes"."""
        counts = {
            f"{h.path[0]}[{h.path[1]}]": counted(len(h.nodes), "node")
            for h in self.held
            if h.path[0] != "bodies"
        }
        for loaded in self.loaded:
            faces = sum(len(block) for block in loaded.faces)
            edges = any(dimension(block.type) == 1 for block in loaded.faces)
            text = (
                counted(faces, "edge" if edges else "face")
                if loaded.load.on_surface
                else counted(len(loaded.nodes), "node")
            )
            counts[f"{loaded.path[0]}[{loaded.path[1]}]"] = text
        if self.contact is not None:
            counts |= {"contact": self.contact.words(), **self.contact.gaps}
        return counts
