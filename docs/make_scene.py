"""Writes docs/reference/scene.md from the classes of a scene; --check compares."""

from __future__ import annotations

import sys
from pathlib import Path

import tissu
from tissu.codegen.names import HEADINGS, part_names
from tissu.scene.explain import described
from tissu.scene.law import Law

PAGE = Path(__file__).parent / "reference" / "scene.md"
HEAD = """# Scene files

A scene is the same in YAML and in Python. Each heading below names a class. In YAML the same part
is a mapping with the fields of the class. Where several classes are possible, `type` chooses one.

- Numbers are SI. A text with a unit is converted: "4 kPa", "10 ms", "1.05 g/cm^3"
  ([units](units.md)).
- An unknown key is an error that names the nearest known key. A hyphen may replace an underscore.
- `tissu check FILE` lists every problem at once, each with its line. If there are none, it lists
  the effects that the scene switches on, and why.

```yaml
{example}```

## Volumes, sheets and lines

Volume cells of a mesh are always simulated. Triangles and quads are simulated if the body has a
`thickness`, and lines if it has a `section`. Sheets and lines are stiff along themselves. They
resist bending only with the models `frames` and `shell`. In space they may get thinner freely: no
stress acts across a sheet or across a line. A body that mixes them has the regions `volumes`,
`sheets` and `lines`:

```yaml
law:
  volumes: {{type: neo_hooke, young: 3 kPa, poisson: 0.45}}
  sheets: {{type: stvk, young: 1 MPa, poisson: 0.4}}
thickness: 0.1 mm
```

A `section` is the area of a circle, or a shape. Rods (`model: frames`) bend and twist according to
this shape:

```yaml
section: {{type: rectangle, height: 2 mm, width: 1 mm, up: [0, 0, 1]}}
```

## Nodes that turn

With `model: frames` or `shell` nodes have rotations as well, and sheets bend
([frames](../guide/tissue.md), [shells](../guide/shells.md)). A node that is held on all axes cannot
rotate either, unless the support has `rotations: free`. On a plane of symmetry across x, fix the
position on x and the rotation about y and z. `axes: free` fixes or prescribes only the rotation:

```yaml
fixed:
  - {{body: wall, on: {{type: plane, point: [0, 0, 0], normal: [1, 0, 0]}}, axes: x, rotations: yz}}
prescribed:
  - body: rod
    on: {{type: plane, point: [1 m, 0, 0], normal: [1, 0, 0]}}
    axes: free
    rotations: held
    times: [0, 1 s]
    rotation: {{axis: [0, 1, 0], angles: [0, 30 deg]}}
```

The axes are those of space. A rotation that is held about two axes remains a rotation about the
third, however large it is. A rotation that is held about one axis has no angular velocity about it.

`trocars` are driven ports with force feedback: [trocar](../guide/trocar.md).

## Regions

A region is a named set of cells. The mesh file names it, or a shape selects it: the cells whose
centres (the means of their nodes) lie in the shape. In a map of laws or models the key `rest` means
the remaining cells.

```yaml
mesh:
  file: liver.vtu
  regions: {{tumour: {{type: sphere, center: [6 cm, 4 cm, 3 cm], radius: 1 cm}}}}
law:
  tumour: {{type: stvk, young: 30 kPa, poisson: 0.45}}
  rest: {{type: stvk, young: 5 kPa, poisson: 0.45}}
```

In Python, `mesh.with_region("tumour", ts.Sphere((0.06, 0.04, 0.03), 0.01))` returns a mesh with one
more region. It also takes the numbers of cells instead of a shape.

## Contact

Bodies pass through each other unless `contacts` lists them:
[contact](../guide/contact.md).

## Files of laws

Files of `laws` are programs ([laws of your own](../guide/own-laws.md)). They run only with
`--trust-laws` (`trust_laws=True` in Python), only from the scene's folder or below it, links
followed, and only if nothing else is wrong with the scene.

## Reading and writing

`ts.Scene.from_yaml(path)` reads a scene file. `scene.to_yaml()` and `scene.save(path)` write a file
that reads back equal. `scene.replace(duration=2.0)` returns the scene with some fields changed, and
checks it again. Every part has `replace`.

`tissu schema` prints the JSON schema of scene files. An editor uses it to complete keys and to mark
wrong ones:

```
tissu schema > scene.schema.json
```

Editors with a YAML language server find the schema by the first line of the scene file:

```yaml
# yaml-language-server: $schema=scene.schema.json
```

## Limits

Words are read as in YAML 1.2: 010 is ten. A scene has at most 16 MiB, 40 levels of nesting,
1,000,000,000 steps, and names of 200 characters. A scene that exceeds a limit is
refused with its line.

This page is printed from the classes by `make codegen`.
"""


def words(part: type) -> str:
    """What the class says of itself: of a law all, its source and limits too, of others a line."""
    text = (part.__doc__ or "").strip()
    return " ".join(text.split()) if issubclass(part, Law) else text.splitlines()[0]


def table(name: str) -> str:
    """The fields of one class."""
    part = getattr(tissu, name)
    kind = part.model_fields.get("type")
    title = f"### {name}" + (f" (`type: {kind.default}`)" if kind is not None else "")
    lines = [title, "", words(part)]
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
        elif info.default in (None, ()):
            default = "absent" if info.default is None else "none"
        else:
            default = f"`{info.default}`"
        about = " ".join(described(part, field).split())
        lines.append(f"| `{field}` | {default} | {about} |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    example = (Path(__file__).parent.parent / "examples" / "organ.yaml").read_text(encoding="utf-8")
    parts = [HEAD.format(example=example)]
    for title, modules in HEADINGS.items():
        names = ["Scene"] * (modules == ("scene",))
        names += [name for module in modules for name in part_names(module) if name != "UserLaw"]
        parts.append(f"## {title}\n\n" + "\n\n".join(table(name) for name in names) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        sys.exit(0 if PAGE.read_text(encoding="utf-8") == page() else f"{PAGE.name} is not current")
    PAGE.write_text(page(), encoding="utf-8")
