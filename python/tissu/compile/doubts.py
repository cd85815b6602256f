"""Notes on scenes that can be computed, but may not be what was meant."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.balance import held_axes
from tissu.compile.inside import nested
from tissu.compile.overlap import boxes_that_overlap
from tissu.counted import are, counted
from tissu.scene.law import UserLaw
from tissu.scene.load import Pressure
from tissu.scene.model import Condensed
from tissu.scene.problem import field_path
from tissu.scene.support import Prescribed
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu.compile.prepared import Ints, LoadedNodes, Prepared
    from tissu.scene.body import Body
    from tissu.scene.law import Law

_LONGEST = 1.0
"""m: a body above it is larger than any organ, and a mesh in millimetres is read as metres."""
_SOFTEST, _STIFFEST = 50.0, 3e10
"""Pa: Young's moduli of tissue, from below that of brain and fat (some 100 Pa; Budday et al., Fifty
shades of brain, Arch. Comput. Methods Eng. 27, 2020) to cortical bone (up to 25 GPa; Rho et al.,
Mechanical properties and the hierarchical structure of bone, Med. Eng. Phys. 20, 1998)."""
_HEAVIEST = 10.0 * 9.81
"""m/s^2: ten times that of the earth; 9810 is that of the earth in mm/s^2."""
_LONGEST_STEP = 1.0
"""s: one that is longer shows no motion of tissue; 10 is one of 10 ms in milliseconds."""
_CONTRAST, _EXACT = 1e5, 1e-7
"""Of the moduli of one body, and a tolerance: a residual says little of the soft parts beside parts
that are stiffer by this much (docs/guide/solvers.md), from this tolerance down it says enough."""
_ALL_AXES = 7
_EIGHT_NODE_FACES = {"hexahedron20", "wedge15", "pyramid13"}
_LINEAR_MODELS = ("fem", "mean_dilatation")


def doubts(prepared: Prepared) -> list[str]:
    """What is computed as it stands, one sentence each."""
    found: list[str] = []
    checks = (
        _gravity,
        _step,
        _sizes,
        _moduli,
        _contrast,
        _held_loads,
        _following_pressure,
        _turning,
        _contacts,
    )
    for check in checks:
        with contextlib.suppress(Unknown):
            for text in check(prepared):
                found.append(text)
    return found


def _gravity(prepared: Prepared) -> Iterator[str]:
    gravity = prepared.scene.gravity
    size = 0.0 if gravity is None else float(np.linalg.norm(gravity))
    if size > _HEAVIEST:
        yield (
            f"gravity: {size:.4g} m/s^2 is more than ten times that of the earth, 9.81 m/s^2; look "
            "at its unit"
        )


def _step(prepared: Prepared) -> Iterator[str]:
    dt = getattr(prepared.scene.step, "dt", None)
    if isinstance(dt, float) and dt > _LONGEST_STEP:
        yield (
            f"step.dt: {dt:g} s is longer than motions of tissue last; 10 ms is usual, written "
            "dt: 10 ms"
        )


def _sizes(prepared: Prepared) -> Iterator[str]:
    for name, known in prepared.meshes.items():
        low, high = known.mesh.bounds
        size = float((high - low).max())
        if known.positions and size > _LONGEST:
            yield (
                f"bodies.{name}: is {size:.4g} m long, more than any organ; if the mesh is in "
                "millimetres, write so: mesh: {file: ..., unit: mm}"
            )


def _moduli(prepared: Prepared) -> Iterator[str]:
    for name, body in prepared.scene.bodies.items():
        for region, law in body.laws().items():
            young = young_of(law)
            if young is None or _SOFTEST <= young <= _STIFFEST:
                continue
            place = f"bodies.{name}.law" + ("" if region is None else f".{region}")
            yield (
                f"{place}: Young's modulus at rest is {young:.4g} Pa, outside what tissue has "
                f"({_SOFTEST:g} Pa to {_STIFFEST:g} Pa, bone); look at its unit"
            )


def _contrast(prepared: Prepared) -> Iterator[str]:
    """Stiff parts hold most of a residual, soft parts most of the motion."""
    tolerance = getattr(getattr(prepared.scene.step, "solver", None), "tolerance", 0.0)
    if tolerance <= _EXACT:
        return
    for name, body in prepared.scene.bodies.items():
        moduli = [young for law in body.laws().values() if (young := young_of(law))]
        ratio = max(moduli, default=1.0) / min(moduli, default=1.0)
        if ratio >= _CONTRAST:
            yield (
                f"bodies.{name}: one of its laws is {ratio:.2g} times as stiff as another; with "
                f"step.solver.tolerance {tolerance:g} the soft parts may be off by a percent after "
                f"some steps that converged; take {_EXACT:g} or less, or the solver cholesky"
            )


def young_of(law: Law) -> float | None:
    """Young's modulus at rest [Pa]; None for a law whose moduli nothing is known of."""
    limit: tuple[float, float] | None
    if isinstance(law, UserLaw):
        made = type(law).made
        if made is None:
            return None
        values = np.array([getattr(law, name) for name in made.parameters], dtype=float)
        limit = made.build().loaded.small_strain(parameters=values)
    else:
        limit = law.small_strain()
    if limit is None:
        return None
    lam, mu = limit
    return float(mu * (3.0 * lam + 2.0 * mu) / (lam + mu))


def _uneven_faces(prepared: Prepared, met: set[str]) -> Iterator[str]:
    """An even pressure on a quadrilateral of eight nodes is -1/12 of it at each of its corners."""
    settings = prepared.scene.contact
    skins = {} if settings is None else settings.surface_of or {}
    for name, known in prepared.meshes.items():
        types = sorted({block.type for block in known.mesh.cells} & _EIGHT_NODE_FACES)
        if name in met and name not in skins and types:
            yield (
                f"contacts: body '{name}' has cells of type {types[0]}, whose quadrilateral faces "
                "have no node in their middle: an even pressure would pull at their corners, which "
                "lift off, and forces are too low (by 3 % with four cells along an edge); "
                "hexahedron27, tetra10 and cells of first order are exact"
            )


def _contacts(prepared: Prepared) -> Iterator[str]:
    scene = prepared.scene
    if scene.contacts:
        met = (
            {name for pair in prepared.contact.pairs for name in pair[:2]}
            if prepared.contact
            else set()
        )
        yield from (
            f"obstacles.{name}: no contact names it, so that all bodies pass through it"
            for name in scene.obstacles
            if prepared.contact is not None and name not in met
        )
        if prepared.contact is not None:
            yield from (
                f"contacts: '{inner}' lies inside '{outer}', which is met from outside only, so "
                "that nothing presses them apart; move it out unless it belongs there"
                for inner, outer in nested(prepared.contact)
            )
            yield from _uneven_faces(prepared, met)
        return
    if scene.contact is not None or scene.obstacles:
        field = "contact" if scene.contact is not None else "obstacles"
        yield f"{field}: without `contacts` nothing meets anything; name the pairs that meet"
    both = boxes_that_overlap({n: k.mesh.bounds for n, k in prepared.meshes.items() if k.positions})
    if both:
        shown = ", ".join(f"{a} and {b}" for a, b in both[:5]) + (", ..." if len(both) > 5 else "")
        yield (
            f"contacts: none, so that bodies pass through each other; at rest the boxes of {shown} "
            "touch or overlap"
        )


def _held_loads(prepared: Prepared) -> Iterator[str]:
    for loaded in prepared.loaded:
        body, mesh = loaded.load.body, prepared.meshes.get(loaded.load.body)
        if mesh is None or loaded.load.type == "moment":
            continue
        mask = held_axes(prepared.held, body, mesh.mesh.node_count)
        text = _held_share(loaded, (mask & _needed(loaded)) == _needed(loaded))
        if text:
            yield (
                f"{field_path(loaded.path)}: {text}, so the supports take that part of the load "
                "and no node moves by it; select other nodes, or hold fewer"
            )


def _needed(loaded: LoadedNodes) -> int:
    """Axes that a node must be held on to take all of its load."""
    vector = getattr(loaded.load, "force", getattr(loaded.load, "traction", None))
    if vector is None:
        return _ALL_AXES
    return sum(1 << axis for axis, value in enumerate(vector) if value != 0.0) or _ALL_AXES


def _held_share(loaded: LoadedNodes, held: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> str:
    """Which loaded faces, or nodes, are held altogether; empty: none."""
    if loaded.faces:
        total = sum(len(block) for block in loaded.faces)
        count = sum(int(held[block.nodes].all(axis=1).sum()) for block in loaded.faces)
        return f"{count} of {counted(total, 'loaded face')} {are(count)} held" if count else ""
    count = int(held[loaded.nodes].sum())
    total = len(loaded.nodes)
    return f"{count} of {counted(total, 'loaded node')} {are(count)} held" if count else ""


def _following_pressure(prepared: Prepared) -> Iterator[str]:
    for loaded in prepared.loaded:
        if not isinstance(loaded.load, Pressure) or not loaded.load.follows:
            continue
        linear = _linear_part(prepared.scene.bodies[loaded.load.body])
        if linear:
            yield (
                f"{field_path(loaded.path)}: the pressure follows the surface as it turns, while "
                f"{linear} knows small displacements only; where it turns far, take another law"
            )


def _turning(prepared: Prepared) -> Iterator[str]:
    for name, body in prepared.scene.bodies.items():
        linear = _linear_part(body)
        why = _why_it_turns(prepared, name, body) if linear else ""
        if why:
            yield (
                f"bodies.{name}: {linear} takes a turn of the body for strain, and {why}; take the "
                "model corotational, or another law"
            )


def _linear_part(body: Body) -> str:
    """What of a body knows no large rotation; empty: nothing."""
    models, laws = body.models(), body.laws()
    if any(isinstance(model, Condensed) for model in models.values()):
        return "a condensed region"
    plain = all(model.type in _LINEAR_MODELS for model in models.values())
    return "hooke" if plain and any(law.type == "hooke" for law in laws.values()) else ""


def _why_it_turns(prepared: Prepared, name: str, body: Body) -> str:
    if body.start is not None and body.start.spin is not None and any(body.start.spin):
        return "it starts with a spin"
    own = [held for held in prepared.held if held.support.body == name]
    for held in own:
        if isinstance(held.support, Prescribed) and held.support.rotation is not None:
            return f"{field_path(held.path)} turns it"
    condensed = [isinstance(model, Condensed) for model in body.models().values()]
    if any(condensed) and not all(condensed) and not _is_clamped(prepared, name):
        return "the rest of it may turn, since fewer than three nodes are held"
    return ""


def _is_clamped(prepared: Prepared, name: str) -> bool:
    mesh = prepared.meshes[name].mesh
    mask: Ints = held_axes(prepared.held, name, mesh.node_count)
    return int((mask == _ALL_AXES).sum()) >= 3
