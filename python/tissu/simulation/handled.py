"""What acts on a simulation while it runs: loads, grabbed points, and supports that are led."""

from __future__ import annotations

import difflib
import numbers
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.cutting.material import material_now, surface_now
from tissu.errors import ParameterError
from tissu.simulation import grab as kept
from tissu.simulation.drag import (
    drag_stiffness,
    frames_at,
    near_frame,
    near_material,
    near_surface,
    used_nodes,
)
from tissu.simulation.grab import Grab, Record
from tissu.simulation.grab_point import GrabPoint, grab_point, require_free
from tissu.simulation.lead import Lead
from tissu.simulation.live_load import LiveLoad
from tissu.simulation.obstacle_lead import ObstacleLead
from tissu.simulation.rigid import Rigid

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.front import Scene
    from tissu.mesh import Mesh
    from tissu.reading import Number, VectorLike
    from tissu.scene.load import Load, Where
    from tissu.scene.support import Support
    from tissu.simulation.entry import Entry
    from tissu.simulation.meshes import Meshes
    from tissu.ties import Left

Floats = NDArray[np.float64]


class Handled:
    """The part of a simulation by which a running program pulls and pushes."""

    scene: Scene
    _core: core.Simulation
    _entry: Entry
    _meshes: Meshes
    _rest: dict[str, Mesh]
    _tissue: dict[str, Mesh]
    _positions: Mapping[str, Floats]
    _loads: Sequence[tuple[Load, Where]]
    _last_grab: int

    if TYPE_CHECKING:

        def _left(self, tissue: str) -> Left: ...

    def load(self, which: str | int) -> LiveLoad:
        """A load of the scene, to be changed from the next step on.

        Changes are part of the state: checkpoints include them.

        Args:
            which: its `name`, or its number in the scene.

        Raises:
            ParameterError: no load of that name or number.
        """
        number = self._number_of(which)
        load, where = self._loads[number]
        return LiveLoad(
            simulation=self._core, entry=self._entry, load=load, where=where, number=number
        )

    def grab(
        self,
        body: str,
        at: int | VectorLike,
        target: VectorLike,
        stiffness: Number | str,
        *,
        offset: VectorLike | None = None,
    ) -> Grab:
        """Pull a point of a body to a target, f = stiffness (target - position), until released.

        The grab is part of the state: checkpoints include it.

        Args:
            body: its name.
            at: number of a node, or a place of the body at rest (3,) [m], which moves with its cell
                by the shape functions.
            target: a place in space (3,) [m].
            stiffness: of the spring [N/m], or text such as "50 N/m".
            offset: of a node that is a frame: from the node to the point at rest (3,) [m]; it
                turns with the node.

        Raises:
            ParameterError: the scene was compiled without `grabbing: true`; no such body or node;
                a place outside the body; a point that cannot move; a stiffness that is not
                positive.
        """
        self._require_grabbing()
        self._require_known(body)
        mesh = {**self._meshes, **self._tissue}[body]
        material = None
        if self._lies_over(body):
            parts = self._core.material_mesh(body)
            material = material_now(parts, mesh.points, self._positions[body])
        point = grab_point(
            self._core, body=body, mesh=mesh, material=material, at=at, offset=offset
        )
        return self._hold(body, point, kept.target_of(target), kept.stiffness_of(stiffness))

    def drag(
        self,
        body: str,
        point: VectorLike,
        *,
        stiffness: Number | str | None = None,
    ) -> Grab:
        """Grab the surface at its place nearest to a point, as a hand or a mouse does.

        The grab does not pull yet: its target is the place of the point. Set `grab.target` to pull,
        and call `grab.release()` to let go.

        Args:
            body: its name.
            point: a place in space (3,) [m]. A body with faces is held by the triangle that is
                nearest to it, a line that was cut by its nearest point, another body by the
                nearest node, a frame with its offset from it. Of a body that was cut, the material
                that is nearest says which frames may be taken.
            stiffness: of the spring [N/m]; absent: Young's modulus at rest times the mean length
                of an edge, so that the point follows about as far as the tissue around it yields.

        Raises:
            ParameterError: see `grab`.
        """
        self._require_grabbing()
        self._require_known(body)
        mesh = {**self._meshes, **self._tissue}[body]
        place = kept.target_of(point)
        self._core.settle()
        now = self._positions[body]
        has_frames = self._core.frames_of(body)[0] >= 0
        surface = None
        if self._lies_over(body):
            surface = surface_now(self._core.material_surface(body), now)
        if has_frames:
            among = self._frames_in_use(body) if surface is None else frames_at(surface, place)
            found = near_frame(now, self._core.rotations(body), place, among=among)
        elif surface is not None:
            found = near_material(surface, place)
        else:
            found = near_surface(mesh, now, place)
        require_free(self._core, body, found.nodes)
        stiff = self.drag_stiffness(body) if stiffness is None else stiffness
        grab = self._hold(body, found, place, kept.stiffness_of(stiff))
        grab.target = grab.position
        return grab

    def drag_stiffness(self, body: str) -> float:
        """The default stiffness of a `drag` [N/m].

        Raises:
            ParameterError: no such body.
        """
        self._require_known(body)
        return drag_stiffness(self.scene, body, {**self._meshes, **self._tissue}[body])

    def drag_as(self, other: Grab) -> Grab:
        """Grab the same point of the same body as a grab of another simulation.

        Its stiffness and its target are those of the other grab. Both simulations must have the
        same mesh.

        Raises:
            ParameterError: see `grab`; the body has fewer nodes here.
        """
        self._require_grabbing()
        self._require_known(other.body)
        point = other.point
        count = len(self._positions[other.body])
        if point.nodes.max() >= count:
            raise ParameterError(
                f"found a grab of node {point.nodes.max()} of '{other.body}', which has {count} "
                "nodes here; a grab of a body with the same mesh is accepted"
            )
        require_free(self._core, other.body, point.nodes)
        return self._hold(other.body, point, other.target, other.stiffness)

    def _lies_over(self, body: str) -> bool:
        """Whether cells of a body lie over each other, copies that hold a part of one each."""
        rest = self._rest.get(body)
        cut = rest is not None and self._meshes[body] is not rest
        return cut and self.scene.editing is not None and self._core.divided(body)

    def _frames_in_use(self, body: str) -> NDArray[np.int64]:
        """The frames of a body that have cells, of a tissue those that points follow."""
        if body in self._meshes:
            return used_nodes(self._meshes[body])
        weights = self._left(body).weights
        followed = np.unique(weights.frames[weights.listed()])
        return followed[followed < len(self._positions[body])].astype(np.int64)

    def _hold(self, body: str, point: GrabPoint, pulled: Floats, stiff: float) -> Grab:
        """Pull a point of a body to a target [m], with a stiffness [N/m]."""
        grabs = kept.records(self._core)
        self._last_grab = max([self._last_grab, *grabs]) + 1
        first, _ = self._core.body_range(body)
        frame, rotation = -1, -1
        if point.offset is not None:
            frame, rotation = (one + int(point.nodes[0]) for one in self._core.frames_of(body))
        grabs[self._last_grab] = Record(
            number=self._last_grab,
            stiffness=stiff,
            target=pulled,
            nodes=first + point.nodes,
            weights=point.weights,
            frame=frame,
            rotation=rotation,
            place=np.zeros(3) if point.offset is None else point.offset,
        )
        kept.keep(self._core, grabs)
        return self._grab(self._last_grab, body)

    @property
    def grabs(self) -> tuple[Grab, ...]:
        """The grabs that hold now, in the order in which they were made."""
        if not self.scene.grabbing:
            return ()
        ranges = {name: self._core.body_range(name) for name in self._positions}
        found = []
        for number, record in kept.records(self._core).items():
            row = int(record.nodes[0])
            body = next(n for n, (first, count) in ranges.items() if first <= row < first + count)
            found.append(self._grab(number, body))
        return tuple(found)

    def lead(
        self,
        which: str | Support,
        positions: ArrayLike | None = None,
        *,
        over: Number | str | None = None,
    ) -> Lead:
        """A named support or motion of the scene, to be moved live from the next step on.

        Live targets are part of the state: checkpoints include them.

        Args:
            which: its `name`, or the part of the scene itself.
            positions: target places of its nodes (k, 3) [m], see `Lead.place`; None: it continues
                its present motion until `move` or `place` of the returned object is called.
            over: time in which they reach the target [s]; None: the next step.

        Raises:
            ParameterError: no support of that name; one without a name, or whose nodes have all
                lost their cells; what `Lead.place` refuses.
        """
        support = self._support(which)
        self._require_led_nodes(support)
        lead = Lead(simulation=self._core, entry=self._entry, support=support)
        if positions is not None:
            lead.place(positions, over=over)
        elif over is not None:
            raise ParameterError("found over without positions; both or neither are accepted")
        return lead

    def obstacle(self, name: str) -> ObstacleLead:
        """An obstacle of the scene, to be moved live from the next step on.

        Live targets are part of the state: checkpoints include them.

        Raises:
            ParameterError: no obstacle of that name, or a scene without contacts.
        """
        known = list(self.scene.obstacles) if self.scene.contacts else []
        if name not in known:
            raise ParameterError(
                f"found obstacle {name!r}{_nearest(name, known)} accepted: "
                f"{', '.join(known) or 'none, since the scene has no contacts with obstacles'}"
            )
        return ObstacleLead(simulation=self._core, entry=self._entry, name=name)

    def rigid(self, name: str) -> Rigid:
        """The place and the motion of an obstacle that has a mass.

        Raises:
            ParameterError: no obstacle of that name has a mass.
        """
        known = [key for key, one in self.scene.obstacles.items() if one.mass is not None]
        if name not in known:
            raise ParameterError(
                f"found obstacle {name!r}{_nearest(name, known)} accepted, with a mass: "
                f"{', '.join(known) or 'none of this scene'}"
            )
        return Rigid(simulation=self._core, entry=self._entry, name=name)

    def _support(self, which: str | Support) -> Support:
        supports = [*self.scene.fixed, *self.scene.prescribed]
        known = [support.name for support in supports if support.name is not None]
        name = which if isinstance(which, str) else getattr(which, "name", None)
        for support in supports:
            if support.name is not None and support.name == name:
                return support
        if not isinstance(which, str) and any(which is support for support in supports):
            raise ParameterError(
                f"found a support of '{which.body}' without a name; give it one in the scene, "
                f"such as `name: hand`, and lead it by that; accepted: {_listed(known)}"
            )
        if name in self.scene.obstacles:
            raise ParameterError(
                f"found {name!r}, an obstacle: lead it by `obstacle({name!r}).move`"
            )
        raise ParameterError(
            f"found support {name!r}{_nearest(name, known)} accepted: {_listed(known)}"
        )

    def _require_led_nodes(self, support: Support) -> None:
        """Refuse a support that edits have left no node."""
        try:
            self._core.led_nodes(str(support.name))
        except ParameterError:
            raise ParameterError(
                f"found support '{support.name}' of '{support.body}', none of whose nodes has a "
                "cell left; a support of nodes with cells is accepted"
            ) from None

    def _grab(self, number: int, body: str) -> Grab:
        return Grab(simulation=self._core, entry=self._entry, number=number, body=body)

    def _number_of(self, which: str | int) -> int:
        count = len(self._loads)
        if isinstance(which, numbers.Integral) and not isinstance(which, bool):
            if 0 <= which < count:
                return int(which)
            accepted = f"0 to {count - 1} are accepted" if count else "the scene has no load"
            raise ParameterError(f"found load {which}; {accepted}")
        names = [load.name for load, _ in self._loads]
        if isinstance(which, str) and which in names:
            return names.index(which)
        known = [name for name in names if name is not None]
        raise ParameterError(
            f"found load {which!r}{_nearest(which, known)} accepted: "
            + (", ".join(known) or "the number of a load, since none has a name")
        )

    def _require_grabbing(self) -> None:
        if not self.scene.grabbing:
            raise ParameterError(
                f"found a grab in scene '{self.scene.name}', which was compiled without it; "
                "`grabbing: true` is accepted: compile `scene.replace(grabbing=True)`"
            )

    def _require_known(self, body: str) -> None:
        if body not in self._positions:
            raise ParameterError(
                f"found body {body!r}{_nearest(body, list(self._positions))} accepted: "
                + ", ".join(self._positions)
            )


def _listed(known: Sequence[str]) -> str:
    """Names of supports, or how one gets a name."""
    return ", ".join(known) or (
        "none, since no part of `fixed` and `prescribed` has a name; give one to what is to be led"
    )


def _nearest(word: object, known: Sequence[str]) -> str:
    """The known word nearest to it, as a question."""
    near = difflib.get_close_matches(str(word), known, n=1, cutoff=0.5)
    return f"; did you mean '{near[0]}'?" if near else ";"
