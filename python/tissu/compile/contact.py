"""Contacts of a scene: surfaces, pairs and their gaps, as the world takes them."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu.compile.contact_skin import skin_surface
from tissu.compile.contact_surface import ContactSurface, body_surface, numbered
from tissu.compile.contact_tissue import tissue_surface
from tissu.compile.obstacle import PreparedObstacle, prepared_obstacle
from tissu.compile.select import selected_nodes, selection_words
from tissu.counted import counted
from tissu.scene.contact import Contact, ContactSettings
from tissu.scene.contact_rules import meets_others, method_of, surface_missing
from tissu.scene.problem import field_path
from tissu.scene.tissue import is_tied, tissues_of
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu._core import WorldBuilder
    from tissu.compile.prepared import Ints, Prepared
    from tissu.scene.body import Body
    from tissu.scene.contact import SelfContact
    from tissu.scene.problem import Path

GAP = 0.02
"""share of the mean surface edge of the finer body that is the gap where none is given"""
_WIDE = 0.1
"""share of that edge above which a gap is remarkable"""
_NARROW = 1e-5
"""share of that edge below which steps are found that do not converge for round-off: a barrier's at
2e-6, others at 4e-8
"""
_LOST = 1e-8
"""share of that edge below which a gap is refused: at 1e-14, surfaces were found to cross"""


class PreparedPair(NamedTuple):
    """Two surfaces that meet, a body first, and which nodes of it alone; empty: all."""

    a: str
    b: str
    contact: Contact | SelfContact
    gap: float
    nodes: Ints


@dataclass(slots=True)
class PreparedContact:
    """All contacts of a scene, of what is known of them.

    Attributes:
        bodies: surfaces of the bodies that meet something, in the order of the scene.
        obstacles: all of them.
        gaps: the gap of each contact, in words.
    """

    method: str
    step: str
    settings: ContactSettings
    bodies: dict[str, ContactSurface] = field(default_factory=dict)
    obstacles: dict[str, PreparedObstacle] = field(default_factory=dict)
    pairs: list[PreparedPair] = field(default_factory=list)
    gaps: dict[str, str] = field(default_factory=dict)

    @property
    def triangle_count(self) -> int:
        """Triangles of all surfaces."""
        solid = [obstacle.surface for obstacle in self.obstacles.values() if obstacle.surface]
        return sum(len(surface.triangles) for surface in (*self.bodies.values(), *solid))

    def words(self) -> str:
        """Method, broad phase and size."""
        size = counted(self.triangle_count, "surface triangle")
        return f"{self.settings.words(self.method, self.step)}; {size}"

    def add_to(self, builder: WorldBuilder) -> None:
        """Put it into the world, whose bodies are there."""
        settings = self.settings
        builder.set_contact(
            method=self.method,
            broad_phase=settings.broad_phase,
            penalty=settings.penalty,
            iterations=settings.iterations,
            travel=settings.travel,
        )
        for name, surface in self.bodies.items():
            fields = surface._asdict()
            rest = {key: fields[key] for key in ("edges", "radius", "closed")}
            riders = surface.riders
            of_core = None if riders is None else riders.in_core()
            triangles = surface.triangles if riders is None else numbered(surface.triangles)
            builder.add_contact_surface(body=name, triangles=triangles, riders=of_core, **rest)
        for obstacle in self.obstacles.values():
            obstacle.add_to(builder)
        numbers = {name: number for number, name in enumerate([*self.bodies, *self.obstacles])}
        for pair in self.pairs:
            contact = pair.contact
            builder.add_contact_pair(
                a=numbers[pair.a],
                b=numbers[pair.b],
                friction=contact.friction,
                gap=pair.gap,
                restitution=contact.restitution,
                stiffness=contact.stiffness,
                nodes=pair.nodes,
            )


def prepare_contact(prepared: Prepared) -> None:
    """Resolve the contacts of a scene as far as its problems allow.

    Raises:
        Unknown: fields that all contacts need could not be read.
    """
    scene, findings = prepared.scene, prepared.findings
    obstacles: dict[str, PreparedObstacle] = {}
    for name, obstacle in scene.obstacles.items():
        with contextlib.suppress(Unknown):
            ready = prepared_obstacle(name, obstacle, findings)
            if ready is not None:
                obstacles[name] = ready
    if not scene.contacts:
        return
    method = method_of(scene)
    made = PreparedContact(method or "", scene.step.type, scene.contact or ContactSettings())
    made.obstacles = obstacles
    surfaces = _surfaces(prepared)
    wrong = {problem.path[:2] for problem in findings.problems}
    for number, contact in enumerate(scene.contacts):
        path: Path = ("contacts", number)
        if path in wrong:
            continue
        with contextlib.suppress(Unknown):
            _prepare_pairs(prepared, made, surfaces, path, contact)
    met = {name for pair in made.pairs for name in (pair.a, pair.b)}
    made.bodies = {name: surface for name, surface in surfaces.items() if name in met}
    prepared.contact = made


def _surfaces(prepared: Prepared) -> dict[str, ContactSurface]:
    """The surfaces of all bodies that have one that is known."""
    scene = prepared.scene
    own = scene.contact.surface_of if scene.contact is not None else {}
    wrong = {problem.path for problem in prepared.findings.problems}
    surfaces = {}
    for name, body in scene.bodies.items():
        if not _has_surface(prepared, name) or ("contact", "surface_of", name) in wrong:
            continue
        mesh = prepared.meshes[name].mesh
        if name not in own:
            surfaces[name] = body_surface(mesh, body)
            continue
        lever = _lever(body)
        skin = skin_surface(name, own[name], mesh, prepared.findings, lever=lever)
        if skin is not None:
            surfaces[name] = skin
    for name in prepared.tissue:
        if surface_missing(scene, name) or not meets_others(scene, name):
            continue
        inside = tissue_surface(prepared, name)
        if inside is not None:
            surfaces[name] = inside
    return surfaces


def _lever(body: Body) -> float:
    """The share of a lever by which the volume cells of a body turn; 0: its nodes do not."""
    halves = [getattr(model, "lever", None) for model in body.models().values()]
    if not body.has_rotations:
        return 0.0
    return 0.5 if "half" in halves else 1.0


def _has_surface(prepared: Prepared, name: str) -> bool:
    """Whether what meets of a body is beyond doubt."""
    known = prepared.meshes.get(name)
    with contextlib.suppress(Unknown):
        return known is not None and known.surface and not surface_missing(prepared.scene, name)
    return False


def _prepare_pairs(
    prepared: Prepared,
    made: PreparedContact,
    surfaces: dict[str, ContactSurface],
    path: Path,
    contact: Contact | SelfContact,
) -> None:
    """The pairs of one contact, of surfaces that are known."""
    gaps, finest = [], 0.0
    for a, b in pairs_of(prepared, contact):
        first, second = (a, b) if a in surfaces else (b, a)
        known = {**surfaces, **made.obstacles}
        if first not in known or second not in known:
            continue  # told already
        nodes: Ints | None = np.empty(0, dtype=np.int32)
        if first in surfaces:
            nodes = _met_nodes(prepared, surfaces[first], path, contact, first)
        if nodes is None:
            return
        if contact.stiffness is not None:
            thin = _without_area(made, surfaces, first, second)
            if thin is not None:
                text = f"found {contact.stiffness:g} Pa/m for '{thin}', whose contacts with "
                text += f"'{second if thin == first else first}' have no area; leave it out: the "
                text += "stiffness then comes from the masses, or from the body"
                prepared.findings.problem((*path, "stiffness"), text)
                return
        edge = _finest_edge(made, surfaces, first, second)
        if contact.gap is not None:
            wide = _wide_gap(made, surfaces, (first, second), contact.gap)
            if wide:
                text = f"{wide}, and {GAP * edge:.2g} m is the default"
                prepared.findings.problem((*path, "gap"), text)
                return
            if contact.gap < _LOST * edge:
                text = f"found {contact.gap:g} m, and distances so small are lost in round-off; "
                text += f"{_LOST * edge:.2g} m or more is accepted, "
                text += f"{GAP * edge:.2g} m is the default"
                prepared.findings.problem((*path, "gap"), text)
                return
        gaps.append(GAP * edge if contact.gap is None else contact.gap)
        finest = edge if not finest else min(finest, edge)
        made.pairs.append(PreparedPair(first, second, contact, gaps[-1], nodes))
    if not gaps:
        return
    made.gaps[field_path(path)] = _gap_words(gaps, given=contact.gap is not None)
    if contact.gap is not None and contact.gap > _WIDE * finest:
        prepared.findings.note(
            f"{field_path(path)}.gap: {contact.gap:g} m is more than a tenth of the mean surface "
            f"edge, {finest:.4g} m, so that surfaces rest visibly apart; {GAP * finest:.2g} m is "
            "the default"
        )
    least = _NARROW * finest
    if contact.gap is not None and contact.gap < least:
        prepared.findings.note(
            f"{field_path(path)}.gap: {contact.gap:g} m is less than {_NARROW:g} of the mean "
            f"surface edge, {finest:.4g} m; round-off counts there, so that steps may not "
            f"converge: take {least:.1g} m or more"
        )


def _without_area(
    made: PreparedContact, surfaces: dict[str, ContactSurface], first: str, second: str
) -> str | None:
    """Which of two has contacts without an area: a body with lines, or a round free obstacle.

    What is round meets the faces of a body on their area, but other obstacles at points.
    """
    for name in (first, second):
        if name in surfaces and len(surfaces[name].edges):
            return name
    if first in surfaces or second in surfaces:
        return None
    for name in (first, second):
        surface = made.obstacles[name].surface
        if surface is not None and not len(surface.triangles):
            return name
    return None


def _wide_gap(
    made: PreparedContact,
    surfaces: dict[str, ContactSurface],
    pair: tuple[str, str],
    gap: float,
) -> str:
    """What is wrong with a gap that no body of the pair is as long as; empty: nothing."""
    sizes = {name: surfaces[name].longest for name in pair if name in surfaces}
    for name in pair:
        obstacle = made.obstacles.get(name)
        if obstacle is not None and obstacle.rigid is not None and obstacle.surface is not None:
            sizes[name] = obstacle.surface.longest
    name = max(sizes, key=lambda one: sizes[one])
    if gap < sizes[name]:
        return ""
    text = f"found {gap:g} m for '{name}', which is {sizes[name]:.4g} m long"
    return f"{text}; a gap smaller than the body is accepted"


def _finest_edge(
    made: PreparedContact, surfaces: dict[str, ContactSurface], first: str, second: str
) -> float:
    """Mean surface edge of the finer body; of two obstacles of the finer free one."""
    bodies = [surfaces[name].mean_edge for name in {first, second} if name in surfaces]
    free = [made.obstacles[name] for name in {first, second} if name in made.obstacles]
    return min(bodies or [one.size for one in free if one.rigid is not None])


def pairs_of(prepared: Prepared, contact: Contact | SelfContact) -> Iterator[tuple[str, str]]:
    """The names of what meets, by this contact."""
    if not isinstance(contact, Contact):
        yield contact.self, contact.self
        return
    if contact.between != "all":
        yield from ((first, second) for _, first, _, second in contact.pairs())
        return
    scene = prepared.scene
    named = set()
    for other in scene.contacts:
        if getattr(other, "between", None) != "all":
            named |= {frozenset(pair) for pair in pairs_of(prepared, other)}
    bodies = [*scene.bodies, *tissues_of(scene)]
    free = {name for name, one in scene.obstacles.items() if one.mass is not None}
    every = [
        *itertools.combinations_with_replacement(bodies, 2),
        *itertools.product(bodies, scene.obstacles),
        *(two for two in itertools.combinations(scene.obstacles, 2) if free & {*two}),
    ]
    yield from (
        pair for pair in every if frozenset(pair) not in named and not is_tied(scene, *pair)
    )


def _met_nodes(
    prepared: Prepared,
    surface: ContactSurface,
    path: Path,
    contact: Contact | SelfContact,
    body: str,
) -> Ints | None:
    """Nodes of a body that `on` selects; empty: all; None, and maybe a problem: none.

    Only those of its surface count. Where cells may be removed any of them may come to lie there.
    """
    on = contact.on if isinstance(contact, Contact) else None
    if on is None:
        return np.empty(0, dtype=np.int32)
    if surface.riders is not None and on.by_place:
        selected: Ints | None = np.asarray(on.nodes(surface.as_mesh()))
    else:
        selected = selected_nodes(prepared, path, body, on)
    if selected is None:
        return None
    if surface.riders is not None:
        whole = on.type == "surface"
        kept = selected if on.by_place else surface.riders.carried_by(selected)
        kept = np.empty(0, dtype=np.int32) if whole else np.sort(numbered(kept))
    else:
        kept = np.intersect1d(selected, surface.nodes).astype(np.int32)
        whole = False
    if not len(kept) and not whole:
        what = counted(len(selected), "node")
        text = f"{selection_words(on)} selects {what} of body '{body}', but none of its surface"
        prepared.findings.problem((*path, "on"), text)
        return None
    if not prepared.scene.editing or surface.riders is not None:
        return kept
    return np.empty(0, dtype=np.int32) if on.type == "surface" else selected


def _gap_words(gaps: list[float], *, given: bool) -> str:
    if given:
        return f"gap {gaps[0]:g} m"
    low, high = f"{min(gaps):.3g}", f"{max(gaps):.3g}"
    size = f"{low} m" if low == high else f"{low} to {high} m"
    return f"gap {size} by default"
