"""Writes docs/scene.md from the classes of a scene: python docs/make_scene.py [--check]."""

from __future__ import annotations

import sys
from pathlib import Path

import tissu
from tissu.codegen.names import HEADINGS, part_names
from tissu.scene.law import Law

PAGE = Path(__file__).with_name("scene.md")
HEAD = """# Scene files

A scene is the same thing in YAML and in Python: the class named in each heading, or a mapping with
its fields. A class that stands where several are possible is chosen by `type` in YAML, where a
hyphen may stand for an underscore. Numbers are SI; a text with a unit is converted ("4 kPa",
"10 ms", "1.05 g/cm^3"), and one of the wrong dimension is an error. Unknown keys are errors that
name the nearest known one. `tissu check FILE` lists every problem at once, with its line: wrong
fields, fields that contradict each other, faults of meshes, selections that select nothing. Without
problems it says what the scene switches on.

```yaml
{example}```

Volume cells of a mesh are simulated always; its triangles and quads where the body gives a
`thickness`, its lines where it gives a `section`. They are stiff along themselves and do not resist
bending, except with the models `frames` and `shell`. In space they are free to thin: no stress acts
across a sheet, nor across a line. A body that mixes them has the regions `volumes`, `sheets` and
`lines`, for a map of laws or a selection:

```yaml
law:
  volumes: {{type: neo_hooke, young: 3 kPa, poisson: 0.45}}
  sheets: {{type: stvk, young: 1 MPa, poisson: 0.4}}
thickness: 0.1 mm
```

A `section` is an area, of a circle, or a shape, which rods (`model: frames`) bend and twist by:

```yaml
section: {{type: rectangle, height: 2 mm, width: 1 mm, up: [0, 0, 1]}}
```

With `model: frames` or `shell` the nodes turn as well, and sheets bend ([frames](frames.md),
[shells](shells.md)). A node held on all axes cannot rotate either, unless
`rotations: free` says so. On a plane of symmetry across x the place is held on x and the rotation
about y and z; `axes: free` leaves the place free and holds or leads the rotation alone:

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

The axes are those of space. A rotation held about two of them remains a rotation about the third,
however large it is; one held about a single axis has no angular velocity about it.

What bodies meet, and how, is said by `obstacles`, `contacts` and `contact`: [contact](contact.md).
Driven ports through which a hand feels a tool are `trocars`: [trocar](trocar.md).

Files of `laws` are programs. They run only with `--trust-laws` (`trust_laws=True` in Python), only
from the scene's folder or below it, links followed, and only when nothing else is wrong with the
scene ([laws](laws.md)).

Units are names of a table with `*`, `/`, `^` and brackets ("N s/m^4", "kgf/cm^2", "16 cmH2O");
no text is evaluated. The words are those of YAML 1.2: 010 is ten. A scene has at most 16 MiB,
40 levels of nesting, 1,000,000,000 steps and names of 200 characters; what is beyond is refused
with its line.

`tissu run` prints on stderr, once, what `tissu check` notes. It ends with the status

| | |
|---|---|
| 0 | finished |
| 1 | a step gave values that are not finite, or was refused |
| 2 | something of the input is wrong, or results could not be written |
| 3 | some steps did not converge; 0 with `--accept-unconverged` |
| 129, 130, 143 | stopped by SIGHUP, Ctrl-C, SIGTERM, with all files complete |

`status` and `why` of `summary.json` say the same. Output files are created, or replace
regular files; a device, a pipe or a link to nothing is refused before anything is opened.

A region is named in the file of a mesh, or made from a shape: it has the cells whose centres (the
means of their nodes) lie in the shape. In a map of laws or models the key `rest` stands for the
remaining cells, which no other key has, and not for the rest shape.

```yaml
mesh:
  file: liver.vtu
  regions: {{tumour: {{type: sphere, center: [6 cm, 4 cm, 3 cm], radius: 1 cm}}}}
law:
  tumour: {{type: stvk, young: 30 kPa, poisson: 0.45}}
  rest: {{type: stvk, young: 5 kPa, poisson: 0.45}}
```

In Python `mesh.with_region("tumour", ts.Sphere((0.06, 0.04, 0.03), 0.01))` is a mesh with one more
region; numbers of cells are taken in place of a shape.

`ts.Scene.from_yaml(path)` reads a scene file. `scene.to_yaml()` and `scene.save(path)` write one
that reads back equal. `scene.replace(duration=2.0)` is the same scene with some fields changed,
checked again; every part has `replace`. `tissu schema` prints the JSON schema of scene files, with
which an editor completes keys and marks wrong ones:

```
tissu schema > scene.schema.json
```

and as the first line of a scene file, for editors with a YAML language server,

```yaml
# yaml-language-server: $schema=scene.schema.json
```

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
        else:
            default = "absent" if info.default in (None, ()) else f"`{info.default}`"
        about = " ".join((info.description or "").split())
        lines.append(f"| `{field}` | {default} | {about} |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    example = (PAGE.parent.parent / "examples" / "organ.yaml").read_text(encoding="utf-8")
    parts = [HEAD.format(example=example)]
    for title, modules in HEADINGS.items():
        names = ["Scene"] * (modules == ("scene",))
        names += [name for module in modules for name in part_names(module) if name != "UserLaw"]
        parts.append(f"## {title}\n\n" + "\n\n".join(table(name) for name in names) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        sys.exit(
            0 if PAGE.read_text(encoding="utf-8") == page() else "docs/scene.md is not current"
        )
    PAGE.write_text(page(), encoding="utf-8")
