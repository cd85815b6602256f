"""Contacts: which bodies and obstacles meet, and what acts between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PlainValidator, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Maybe, Read, listed, written
from tissu.scene.body import MeshLike, mesh_source
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part, keeps_problems
from tissu.scene.problem import Path, Problem, nearest_word
from tissu.scene.selection import On
from tissu.scene.unknown import Unread

__all__ = ["Contact", "SelfContact", "ContactSettings"]

_EXAMPLE = "[{between: [liver, probe]}]"
_ACCEPTED = "a name and another, or a list of others, is accepted, or all"


def _name(value: object) -> object:
    """A name; YAML reads 7 as a number."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _ends(value: object) -> object:
    """Names of what meets: the word all, or one name and then one or several others."""
    value = listed(value)
    if value == "all":
        return value
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise ParameterError(f"found {written(value)}; {_ACCEPTED}: [liver, [table, probe]]")
    first, second = _name(value[0]), _name(value[1])
    if isinstance(second, (list, tuple)):
        second = tuple(_name(name) for name in second)
    others = second if isinstance(second, tuple) else (second,)
    if not others or not all(isinstance(name, str) for name in (first, *others)):
        raise ParameterError(f"found {written(value)}; {_ACCEPTED}: [liver, [table, probe]]")
    return (first, second)


_Ends = Read[
    Literal["all"] | tuple[str, str | tuple[str, ...]],
    str | Sequence[str | Sequence[str]],
]


class Meeting(Part):
    """What contacts share."""

    if TYPE_CHECKING:
        friction: units.Pure
        gap: Maybe[units.Length]
        restitution: Maybe[units.Pure]
        stiffness: Maybe[units.StiffnessPerArea]

    def words(self, gap: str | None) -> str:
        """Its numbers; `gap` where that is known ("gap 0.0001 m by default")."""
        found = [f"friction {self.friction:g}"]
        found += [gap] if gap else []
        found += [] if self.restitution is None else [f"restitution {self.restitution:g}"]
        found += [] if self.stiffness is None else [f"stiffness {self.stiffness:g} Pa/m"]
        return ", ".join(found)

    def effect(self, path: str, gap: str | None) -> Effect:
        """The effect that it switches on; `gap` where it is known."""
        raise NotImplementedError


class Contact(Meeting):
    """Two surfaces that may touch: of two bodies, or of a body and an obstacle."""

    between: Annotated[_Ends, BeforeValidator(_ends)] = field(kw_only=False)
    """the name of a body, and the name or a list of names of bodies or obstacles that it may touch;
    or all: every pair of bodies, every body with every obstacle, and every body with itself, unless
    another contact names the pair
    """
    friction: units.Pure = field(default=0.0, ge=0.0)
    """Coulomb's coefficient mu"""
    gap: Maybe[units.Length] = field(default=None, gt=0.0)
    """distance at which surfaces rest [m]; absent: 2 % of the mean surface edge of the finer
    body
    """
    restitution: Maybe[units.Pure] = field(default=None, ge=0.0, le=1.0)
    """speed after an impact over the speed before it, for the methods impulse and penalty; absent:
    0 for impulse, 0.57 for penalty, whose damper has a fifth of the critical damping
    """
    stiffness: Maybe[units.StiffnessPerArea] = field(default=None, gt=0.0)
    """contact stiffness of the method penalty [Pa/m]; absent: from the masses in explicit steps,
    from the bodies' stiffness at rest in others
    """
    on: On | None = None
    """nodes of the first body's surface that take part in the contact; absent: all"""

    def pairs(self) -> list[tuple[Path, str, Path, str]]:
        """Both names of each pair, each after its place; none for all."""
        if self.between == "all":
            return []
        first, second = self.between
        at: Path = ("between", 0)
        if isinstance(second, str):
            return [(at, first, ("between", 1), second)]
        return [(at, first, ("between", 1, k), name) for k, name in enumerate(second)]

    def effect(self, path: str, gap: str | None) -> Effect:
        """The effect that it switches on; `gap` where it is known."""
        if self.between == "all":
            return Effect("contact of all", f"{path} has {self.words(gap)}")
        first, second = self.between
        others = second if isinstance(second, str) else ", ".join(second)
        on = "" if self.on is None else f", on a selection ({self.on.type})"
        return Effect(f"contact of {first} with {others}", f"{path} has {self.words(gap)}{on}")


class SelfContact(Meeting):
    """A body that may touch itself, for instance where it folds."""

    self: Annotated[str, BeforeValidator(_name)] = field(kw_only=False)
    """name of the body"""
    friction: units.Pure = field(default=0.0, ge=0.0)
    """Coulomb's coefficient mu"""
    gap: Maybe[units.Length] = field(default=None, gt=0.0)
    """distance at which surfaces rest [m]; absent: 2 % of the mean surface edge"""
    restitution: Maybe[units.Pure] = field(default=None, ge=0.0, le=1.0)
    """speed after an impact over the speed before it, for the methods impulse and penalty; absent:
    0 for impulse, 0.57 for penalty, whose damper has a fifth of the critical damping
    """
    stiffness: Maybe[units.StiffnessPerArea] = field(default=None, gt=0.0)
    """contact stiffness of the method penalty [Pa/m]; absent: from the masses in explicit steps,
    from the bodies' stiffness at rest in others
    """

    def effect(self, path: str, gap: str | None) -> Effect:
        """The effect that it switches on; `gap` where it is known."""
        return Effect(f"contact of {self.self} with itself", f"{path} has {self.words(gap)}")


_OneMesh = Annotated[Any, PlainValidator(mesh_source)]
_SurfaceOf = Read[dict[str, _OneMesh], Mapping[str, MeshLike]]


class ContactSettings(Part):
    """Settings that all contacts of a scene share."""

    method: Literal["auto", "augmented", "barrier", "penalty", "impulse", "geometric"] = "auto"
    """how contact forces are computed; auto: the first method that the step supports"""
    broad_phase: Literal["hierarchy", "sweep_and_prune", "grid", "octree", "fcl"] = "hierarchy"
    """how near surfaces are found; it changes the time of a step, but not its result"""
    penalty: Literal["linear", "reciprocal"] = "linear"
    """how the force of the method penalty grows as surfaces close: with their depth, or as one over
    their distance
    """
    iterations: Annotated[int, Field(ge=1)] = 20
    """largest number of linear systems in a step that is linearised once; with the method impulse,
    of contact searches in a step whose motion is cut short
    """
    travel: bool = True
    """whether nodes are stopped where surfaces would otherwise pass through each other"""
    overlap: Literal["refuse", "separate"] = "refuse"
    """what to do with surfaces that cross at the start: refuse the scene, or separate them: bodies
    are deformed until they press on each other without crossing
    """
    surface_of: _SurfaceOf = field(default_factory=dict)
    """body -> mesh that is its surface in contact, in place of the boundary of its cells, which
    carry its vertices: a mesh file, a bar, or (in Python) a Mesh; its triangles and quads, or the
    boundary of its volume cells
    """

    def words(self, method: str, step: str) -> str:
        """What a plan says of it; `method`: the one that runs."""
        chosen = f"auto: {method}, for the step {step}" if self.method == "auto" else method
        chosen += f" with a {self.penalty} law" if method == "penalty" else ""
        travel = "" if self.travel else "; travel is false, so that surfaces may cross"
        own = f"; surface_of {', '.join(self.surface_of)}" if self.surface_of else ""
        return f"contact.method is {chosen}; broad phase {self.broad_phase}{travel}{own}"


def _one_contact(value: Any, info: ValidationInfo) -> Any:
    """A contact: in Python by class, in YAML by its key `between` or `self`."""
    if isinstance(value, (Contact, SelfContact)):
        return value
    try:
        return _class_of(value).model_validate(value, context=info.context)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        return Unread((Problem((), str(error)),))


def _class_of(value: object) -> type[Contact] | type[SelfContact]:
    """The class that a mapping means; a key that is misspelt means the one nearest to it.

    Raises:
        ParameterError: not a mapping, or both keys.
    """
    accepted = "a mapping with `between` or `self` is accepted, such as {between: [liver, probe]}"
    if not isinstance(value, Mapping):
        raise ParameterError(f"found {written(value)}; {accepted}")
    keys = [key for key in ("between", "self") if key in value]
    if len(keys) == 2:
        text = "found both between and self; one of them is accepted: an entry for each"
        raise ParameterError(text)
    if not keys:
        known = {*Contact.model_fields, "self"}
        meant = [nearest_word(key, known) for key in value if key not in known]
        keys = [key for key in meant if key in ("between", "self")]
    if not keys:
        raise ParameterError(f"found neither between nor self; {accepted}")
    return Contact if keys[0] == "between" else SelfContact


OneContact = Annotated[Contact | SelfContact, PlainValidator(_one_contact)]


def _contact_list(value: object) -> object:
    """Refuse a word that stands in place of the list, with the list that it may mean."""
    if isinstance(value, str):
        meant = "[{between: all}]" if value.strip().lower() == "all" else _EXAMPLE
        raise ParameterError(f"found {written(value)}; a list is accepted, such as {meant}")
    return value


Contacts = Annotated[
    Read[tuple[OneContact, ...], Sequence[Contact | SelfContact]], BeforeValidator(_contact_list)
]
