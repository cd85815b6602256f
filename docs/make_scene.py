"""Writes docs/scene.md from the classes of tissu.scene: python docs/make_scene.py [--check]."""

from __future__ import annotations

import sys
from pathlib import Path

import tissu.scene as scene

PAGE = Path(__file__).with_name("scene.md")
_LAWS = (
    *("Hooke", "StVK", "NeoHooke", "StableNeoHooke", "MooneyRivlin", "Yeoh", "ArrudaBoyce"),
    *("Fibres", "Rayleigh", "KelvinVoigt", "Centroid", "Prony", "PronyBranch"),
)
_STEPS = (
    *("ExplicitEuler", "SymplecticEuler", "RK2", "RK4"),
    *("ImplicitEuler", "ImplicitMidpoint", "BDF2", "Newmark", "EnergyMomentum"),
    *("BDF2FixedPoint", "Static", "Newton"),
)
_MODELS = (
    *("FEM", "Corotational", "MassSpring", "MassLink", "MassTensor"),
    *("Condensed", "MeanDilatation", "Frames", "Shell"),
)
ORDER = (
    ("The scene", ("Scene", "Output")),
    ("Bodies and meshes", ("Body", "Start", "MeshFile", "BarMesh")),
    ("Connective tissue", ("Tissue",)),
    ("Laws and viscosity", _LAWS),
    ("Models", _MODELS),
    ("Selections: which nodes", ("Box", "Sphere", "Plane", "Nodes", "SurfaceNodes", "Region")),
    ("Supports and motion", ("Fixed", "Prescribed", "Rotation")),
    ("Loads", ("NodalLoad", "Moment", "Traction", "Pressure")),
    ("Steps", _STEPS),
    ("Linear solvers", ("Auto", "ConjugateGradient", "Cholesky")),
)
HEAD = """# Scene files

A scene is the same thing in YAML and in Python: the class named in each heading, or a mapping with
its fields. A class that stands where several are possible is chosen by `type` in YAML. Numbers are
SI; a text with a unit is converted ("4 kPa", "10 ms", "1.05 g/cm^3"), and one of the wrong
dimension is an error. Unknown keys are errors that name the nearest known one. `tissu check FILE`
lists every problem at once, with its line: wrong fields, fields that contradict each other, faults
of meshes, selections that select nothing. Without problems it says what the scene switches on.

```yaml
{example}```

Volume cells of a mesh are simulated always; its triangles and quads where the body gives a
`thickness`, its lines where it gives a `section`. They are stiff along themselves and do not resist
bending, but for the models `frames` and `shell`. In space they are free to thin: no stress acts
across a sheet, nor across a line. A body that mixes them has the regions `volumes`, `sheets` and
`lines`, for a map of laws or a selection:

```yaml
law:
  volumes: {{type: neo_hooke, young: 3 kPa, poisson: 0.45}}
  sheets: {{type: stvk, young: 1 MPa, poisson: 0.4}}
thickness: 0.1 mm
```

With `model: frames` or `shell` the nodes turn as well, and sheets bend ([frames](frames.md),
[shells](shells.md)). A held node does not turn where all its axes are held, unless
`rotations: free` says so.

This page is printed from the classes by `python docs/make_scene.py`.
"""


def table(name: str) -> str:
    """The fields of one class."""
    part = getattr(scene, name)
    kind = part.model_fields.get("type")
    title = f"### {name}" + (f" (`type: {kind.default}`)" if kind is not None else "")
    first = (part.__doc__ or "").strip().splitlines()[0]
    lines = [title, "", first]
    if set(part.model_fields) - {"type"}:
        lines += ["", "| field | default | |", "|---|---|---|"]
    for field, info in part.model_fields.items():
        if field == "type":
            continue
        if info.is_required():
            default = "required"
        elif info.default_factory is not None:
            made = info.default_factory()  # type: ignore[call-arg]
            default = type(made).__name__ if not isinstance(made, (list, tuple, dict)) else "none"
        else:
            default = "absent" if info.default in (None, ()) else f"`{info.default}`"
        about = " ".join((info.description or "").split())
        lines.append(f"| `{field}` | {default} | {about} |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    example = (PAGE.parent.parent / "examples" / "organ.yaml").read_text(encoding="utf-8")
    parts = [HEAD.format(example=example)]
    for title, names in ORDER:
        parts.append(f"## {title}\n\n" + "\n\n".join(table(name) for name in names) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        sys.exit(
            0 if PAGE.read_text(encoding="utf-8") == page() else "docs/scene.md is not current"
        )
    PAGE.write_text(page(), encoding="utf-8")
