"""A setting: the numbers of a scene that cost accuracy or time, and what may be chosen."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from tissu.scene.solver import Auto, ConjugateGradient
from tissu.scene.step import Explicit

if TYPE_CHECKING:
    from tissu.advice.resolution import Resolutions
    from tissu.front import Scene
    from tissu.scene import Body
    from tissu.scene.step import Step


@dataclass(frozen=True, slots=True)
class Setting:
    """One way to compute the scene.

    Attributes:
        scale: cells along each edge of a body, over those of the scene.
        order: of the cells, 1 or 2.
        model: name of the model of all bodies; empty: the scene's own.
        step: method, time step, Newton's method and linear solver.
        family: of the cells of generated bars, "hexahedron" or "quad"; empty: the scene's own.
    """

    scale: Fraction
    order: int
    model: str
    step: Step
    family: str = ""

    def scene(self, scene: Scene, resolutions: Resolutions) -> Scene | None:
        """The scene with this setting; None where there is no mesh of it."""
        bodies = resolutions.bodies(self.scale, self.order, self.family)
        if bodies is None:
            return None
        if self.model:
            changes = {"model": self.model, "law_for_model": "nearest"}
            bodies = {name: body.replace(**changes) for name, body in bodies.items()}
        return scene.replace(bodies=bodies, step=self.step)

    def key(self) -> tuple[Fraction, int, str, str, str]:
        """What distinguishes it from other settings."""
        return self.scale, self.order, self.family, self.model, f"{self.step!r}"


def is_explicit(setting: Setting) -> bool:
    """Whether the method solves no system."""
    return isinstance(setting.step, Explicit)


def scene_words(scene: Scene) -> tuple[str, str, str, str]:
    """Meshes, models, step and solver of a scene."""
    models = [model.type for body in scene.bodies.values() for model in body.models().values()]
    return (
        ", ".join(mesh_words(body) for body in scene.bodies.values()),
        " and ".join(dict.fromkeys(models)),
        step_words(scene.step),
        solver_words(scene.step),
    )


def mesh_words(body: Body) -> str:
    """The mesh of a body: "8x2x2 hexahedron20", "organ.vtu", "39464 tetra"."""
    mesh = body.mesh
    if hasattr(mesh, "segments"):
        counts = "x".join(str(count) for count in mesh.cells if count)
        return f"{counts} {mesh.segments or mesh.cell}"
    if hasattr(mesh, "file"):
        return str(mesh.file.name)
    if mesh.source is not None:
        return str(mesh.source).rpartition("/")[2]
    return ", ".join(f"{len(block)} {block.type}" for block in mesh.body_blocks)


def step_words(step: Step) -> str:
    """Method, time step and Newton's method: "bdf2 5 ms, newton"."""
    dt = getattr(step, "dt", None)
    words = step.type if dt is None else f"{step.type} {dt_words(dt)}"
    newton = getattr(step, "newton", None)
    if newton is None:
        return words
    return f"{words}, newton {newton.tolerance:.0e}".replace("e-0", "e-")


def dt_words(dt: float | str) -> str:
    """A time step as it is read: "5 ms", "auto"."""
    return dt if isinstance(dt, str) else f"{1e3 * dt:.4g} ms"


def solver_words(step: Step) -> str:
    """The linear solver: "block_jacobi 1e-6", "cholesky"; "-" where no system is solved."""
    solver: Any = getattr(step, "solver", None)
    if isinstance(solver, (Auto, ConjugateGradient)):
        name = solver.type if isinstance(solver, Auto) else solver.preconditioner
        extra = [w for w in ("single", "free") if w in (_of(solver, "precision", "matrix"))]
        return " ".join([name, *extra, f"{solver.tolerance:.0e}".replace("e-0", "e-")])
    return "-" if solver is None else str(solver.type)


def _of(part: object, *names: str) -> list[object]:
    return [getattr(part, name, None) for name in names]
