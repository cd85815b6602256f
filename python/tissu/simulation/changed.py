"""What of a simulation's scene may change while it runs: its numbers, by a world made anew.

A constant of a cell is in many places of a world, packed for the kernels. So another number
makes another world, as the removal of cells does; the state goes on, with all that models and the
method in time remember.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.simulation.parameters import Parameters

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    import numpy as np
    from numpy.typing import NDArray

    from tissu import _core as core
    from tissu.compile import Check
    from tissu.front import Scene
    from tissu.mesh import Mesh
    from tissu.scene.load import Load, Where
    from tissu.scene.support import Support
    from tissu.simulation.entry import Entry
    from tissu.simulation.meshes import Meshes

    Floats = NDArray[np.float64]
    Ints = NDArray[np.int32]


class Changed:
    """The part of a simulation that changes what it was compiled from."""

    scene: Scene
    _core: core.Simulation
    _entry: Entry
    _world: core.World
    _check: Check
    _meshes: Meshes
    _rest: dict[str, Mesh]
    _loads: Sequence[tuple[Load, Where]]
    _physics_known: dict[str, Any] | None
    _positions: Mapping[str, Floats]
    _steps: int
    _unconverged: tuple[int, str]

    if TYPE_CHECKING:

        def _follow_cells(self, body: str) -> None: ...
        def _as_severed(self, world: core.World, places: Mapping[str, Floats]) -> core.World: ...
        def _become_severed(self, severed: Mapping[str, Ints]) -> None: ...
        def _prepare_first_step(self) -> None: ...

    @property
    def parameters(self) -> Parameters:
        """The numbers of the scene that may change while it runs, by their names.

        `simulation.parameters["bodies.liver.law.young"] = "6 kPa"` acts from the next step on, as
        in a new scene with that value. See `Parameters`.
        """
        return Parameters(self, self._entry)  # type: ignore[arg-type]

    def allow_grabbing(self) -> None:
        """Allow grabs from now on, if the scene was compiled without `grabbing: true`.

        The motion stays the same until a point is grabbed. As after a checkpoint, the linear solver
        starts without memory, so an iterative solver may end at other digits within its tolerance.
        """
        if not self.scene.grabbing:
            self._become(self.scene.replace(grabbing=True))

    def allow_touch(self) -> None:
        """Allow grabs, and give each support without a name a name for `lead`.

        The motion stays the same until one is used; see `allow_grabbing`.
        """
        scene, taken = self.scene, set[str]()
        for support in (*scene.fixed, *scene.prescribed):
            taken |= set() if support.name is None else {support.name}
        given = {
            group: [_named(part, f"{group}[{number}]", taken) for number, part in enumerate(parts)]
            for group, parts in (("fixed", scene.fixed), ("prescribed", scene.prescribed))
        }
        unnamed = any(support.name is None for support in (*scene.fixed, *scene.prescribed))
        if unnamed or not scene.grabbing:
            self._become(scene.replace(grabbing=True, **given))

    def reset(self) -> None:
        """Return to the first state of the scene, at time zero and with all its cells.

        Parameters keep their present values. Loads return to those of the scene, and grabs are
        released.
        """
        fresh = self._compiled(self.scene)
        self._core.replace_world(world=fresh._world)
        self._core.restore(fresh._core.snapshot())
        self._take_over(fresh)
        self._steps = 0
        self._unconverged = (0, "")
        self._become_severed({})
        for body in self._rest:
            self._follow_cells(body)
        self._prepare_first_step()

    def _become(self, scene: Scene) -> None:
        """Go on with a scene that differs in numbers only.

        Raises:
            SceneError: it is not accepted; nothing has changed then.
        """
        fresh = self._compiled(scene)
        self._core.settle()
        world = self._as_severed(fresh._world, self._positions)
        world = self._core.edited_like_now(fresh=world) if self._edited() else world
        self._core.replace_world(world=world)
        self._take_over(fresh)
        self.scene = scene
        self._physics_known = None

    def _edited(self) -> bool:
        """Whether a body has other cells, or material that is divided though no cell has parted."""
        return any(
            self._meshes[body] is not mesh or (self.scene.editing and self._core.divided(body))
            for body, mesh in self._rest.items()
        )

    def _compiled(self, scene: Scene) -> Changed:
        """A simulation of the scene, with the meshes that are in memory already."""
        bodies = {name: body.replace(mesh=self._rest[name]) for name, body in scene.bodies.items()}
        return scene.replace(bodies=bodies)._compiled()

    def _take_over(self, fresh: Changed) -> None:
        self._world, self._check, self._loads = fresh._world, fresh._check, fresh._loads


def _named(support: Support, name: str, taken: set[str]) -> Support:
    """The support with a name: its own, or the one that is offered, unless another has it."""
    return support if support.name is not None or name in taken else support.replace(name=name)
