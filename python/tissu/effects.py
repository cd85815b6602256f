"""Which effects a scene switches on, and why; which are absent. An absent effect runs no code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.scene.body import Body
    from tissu.scene.law import Law
    from tissu.scene.model import Model
    from tissu.scene.scene import Scene
    from tissu.scene.selection import Selection
    from tissu.scene.start import Start
    from tissu.scene.step import Step
    from tissu.scene.tissue import Tissue
    from tissu.scene.viscosity import Viscosity


@dataclass(frozen=True, slots=True)
class Effect:
    """An effect that the scene switches on.

    Attributes:
        name: the effect and where it acts ("viscosity of organ").
        why: the field of the scene that asks for it, and its value.
    """

    name: str
    why: str

    def __str__(self) -> str:
        return f"{self.name}: {self.why}"


def effects_of(scene: Scene, counts: Mapping[str, str] | None = None) -> list[Effect]:
    """Effects that the scene switches on, in the order of its fields.

    Args:
        scene: the scene.
        counts: what a field selects, by its path ("fixed[0]" -> "42 nodes"), where it is known.
    """
    counts = counts or {}
    effects = [effect for name, body in scene.bodies.items() for effect in _of_body(name, body)]
    for name, tissue in scene.tissue.items():
        effects += _of_tissue(name, tissue)
    if scene.gravity is not None:
        effects.append(Effect("gravity", f"gravity is {_vector(scene.gravity)} m/s^2"))
    for number, fixed in enumerate(scene.fixed):
        path = f"fixed[{number}]"
        why = f"{path} holds {_nodes(fixed.on, counts.get(path))} on {fixed.axes}"
        effects.append(Effect(f"fixed nodes of {fixed.body}", why))
    for number, moved in enumerate(scene.prescribed):
        path = f"prescribed[{number}]"
        end = f"until {moved.times[-1]:g} s"
        why = f"{path} moves {_nodes(moved.on, counts.get(path))} on {moved.axes} {end}"
        effects.append(Effect(f"prescribed motion of {moved.body}", why))
    for number, load in enumerate(scene.loads):
        path = f"loads[{number}]"
        why = f"{path} acts on {_nodes(load.on, counts.get(path))}"
        effects.append(Effect(f"{load_name(load.type)} on {load.body}", why))
    effects.append(_of_step(scene.step))
    if scene.editing:
        effects.append(Effect("cell removal", "editing is true"))
    return effects


def absent_of(scene: Scene) -> list[str]:
    """Effects that the scene does not ask for; none of them runs or is stored."""
    present = {
        "sheets": any(body.thickness is not None for body in scene.bodies.values()),
        "lines": any(body.section is not None for body in scene.bodies.values()),
        "frames": bool(scene.tissue) or any(b.has_rotations for b in scene.bodies.values()),
        "connective tissue": bool(scene.tissue),
        "viscosity": any(body.viscosity is not None for body in scene.bodies.values()),
        "gravity": scene.gravity is not None,
        "fixed nodes": bool(scene.fixed),
        "prescribed motion": bool(scene.prescribed),
        "loads": bool(scene.loads),
        "inertia": scene.step.type != "static",
        "cell removal": scene.editing,
        "contact": False,
        "cutting": False,
        "haptics": False,
    }
    return [name for name, on in present.items() if not on]


def load_name(kind: str) -> str:
    """What a type of load is called."""
    return {"nodal": "nodal load"}.get(kind, kind)


def _of_body(name: str, body: Body) -> list[Effect]:
    effects = []
    for region, law in body.laws().items():
        where = name if region is None else f"{name}, region {region}"
        path = f"bodies.{name}.law" + ("" if region is None else f".{region}")
        effects.append(Effect(f"elasticity of {where}", f"{path} is {_law(law)}"))
    for region, model in body.models().items():
        if model.type != "fem":
            where = name if region is None else f"{name}, region {region}"
            path = f"bodies.{name}.model" + ("" if region is None else f".{region}")
            effects.append(Effect(f"model of {where}", f"{path} is {_model(model)}"))
    if body.thickness is not None:
        plane = "" if body.plane is None else f", plane is {body.plane}"
        why = f"bodies.{name}.thickness is {body.thickness:g} m{plane}"
        effects.append(Effect(f"sheets of {name}", why))
    if body.section is not None:
        why = f"bodies.{name}.section is {body.section:g} m^2"
        effects.append(Effect(f"lines of {name}", why))
    if body.start is not None:
        effects.append(Effect(f"start of {name}", f"bodies.{name}.start is {_start(body.start)}"))
    if body.viscosity is not None:
        why = f"bodies.{name}.viscosity is {_viscosity(body.viscosity)}"
        effects.append(Effect(f"viscosity of {name}", why))
    return effects


def _of_tissue(name: str, tissue: Tissue) -> list[Effect]:
    place = (
        "inside a surface" if tissue.between is None else "between " + " and ".join(tissue.between)
    )
    why = f"tissue.{name} is {place}, of about {tissue.frames} frames and {tissue.points} points"
    law = Effect(f"elasticity of {name}", f"tissue.{name}.law is {_law(tissue.law)}")
    return [Effect(f"connective tissue {name}", why), law]


def _of_step(step: Step) -> Effect:
    if step.type == "static":
        return Effect("equilibrium", f"step is static, in {step.load_steps} load steps")
    dt = step.dt if isinstance(step.dt, str) else f"{step.dt:g} s"
    return Effect("inertia", f"step is {step.type} with dt {dt}")


def _law(law: Law) -> str:
    values = [(n, getattr(law, n)) for n in type(law).model_fields if n not in ("type", "fibres")]
    pure = ("poisson", "lambda_m")
    words = ", ".join(f"{n} {value:g}" + ("" if n in pure else " Pa") for n, value in values)
    fibres = "" if law.fibres is None else f", fibres k1 {law.fibres.k1:g}, k2 {law.fibres.k2:g}"
    return f"{law.type} with {words}{fibres}"


def _start(start: Start) -> str:
    words: list[str] = [start.shape] if start.shape != "rest" else []
    if start.velocity is not None:
        words.append(f"velocity {_vector(start.velocity)} m/s")
    if start.spin is not None:
        words.append(f"spin {_vector(start.spin)} rad/s")
    return ", ".join(words) or "at rest"


def _viscosity(viscosity: Viscosity) -> str:
    if viscosity.type == "rayleigh":
        return f"rayleigh, mass {viscosity.mass:g} 1/s, stiffness {viscosity.stiffness:g} s"
    if viscosity.type == "kelvin_voigt":
        return f"kelvin_voigt, eta {viscosity.eta:g} Pa s, zeta {viscosity.zeta:g} Pa s"
    if viscosity.type == "centroid":
        return f"centroid, coefficient {viscosity.coefficient:g} N s/m^4"
    branches = (f"weight {b.weight:g} time {b.time:g} s" for b in viscosity.branches)
    return f"prony, {', '.join(branches)}"


def _model(model: Model) -> str:
    words = [f"{n} {getattr(model, n)}" for n in type(model).model_fields if n != "type"]
    return model.type + (f" with {', '.join(words)}" if words else "")


def _nodes(on: Selection, count: str | None) -> str:
    return f"{count} ({on.type})" if count else f"the nodes of a selection ({on.type})"


def _vector(vector: tuple[float, float, float]) -> str:
    return "(" + ", ".join(f"{component:g}" for component in vector) + ")"
