"""Writes docs/reference/units.md from the table of units and the dimensions of a scene's fields."""

from __future__ import annotations

from pathlib import Path

from tissu import unit_table, units

PAGE = Path(__file__).parent / "reference" / "units.md"
HEAD = """# Units

A plain number is SI. A text is a number and a unit, and it is converted: `"4 kPa"`, `"10 ms"`,
`"1.05 g/cm^3"`. A unit of the wrong dimension is an error, which names the dimension that was
found:

```python
import tissu as ts

try:
    ts.StVK(young="5 mm", poisson=0.45)
except ts.SceneError as error:
    print(error)
```

```text
1 problem in the scene:
- StVK: young: found '5 mm', which is a length; a pressure is accepted: …
```

Units are multiplied with `*` or a space, divided with `/`, raised with `^`, and grouped with
brackets: `"N s/m^4"`, `"kgf/cm^2"`. Nothing is evaluated: units come from the tables below. In
Python a quantity of the package pint is accepted as well. Results are always SI.

There is no unit system to choose. A mesh in millimetres is read with `unit="mm"`, and its points
are in metres from then on. Data in mm, tonne, s and MPa is written with its units: `"12 MPa"`,
`"1e-9 t/mm^3"`.

## Dimensions
"""


def dimensions() -> str:
    """What the fields of a scene accept."""
    lines = ["| dimension | SI unit | an example | |", "|---|---|---|---|"]
    for dimension in units.DIMENSIONS:
        some = " ".join(f"`{name}`" for name in list(dimension.units)[:6])
        unit = f"`{dimension.unit}`" if dimension.unit else "1"
        lines.append(f"| {dimension.name} | {unit} | `{dimension.example}` | {some} |")
    return "\n".join(lines)


def prefixed() -> str:
    """Units that take a prefix."""
    lines = ["| unit | names | in SI |", "|---|---|---|"]
    for symbol, names, factor, powers in unit_table._PREFIXED:
        words = ", ".join(f"`{name}`" for name in names.split())
        lines.append(f"| `{symbol}` | {words} | {factor} {unit_table.words_of(powers)} |")
    return "\n".join(lines)


def plain() -> str:
    """Units that take none."""
    lines = ["| names | in SI |", "|---|---|"]
    for names, factor, powers in unit_table._PLAIN:
        words = ", ".join(f"`{name}`" for name in names.split())
        lines.append(f"| {words} | {factor} {unit_table.words_of(powers)} |")
    for names, size, powers in unit_table._ANGLES:
        words = ", ".join(f"`{name}`" for name in names.split())
        lines.append(f"| {words} | {float(size):.6g} {unit_table.words_of(powers)} |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    short = ", ".join(f"`{name}`" for name in unit_table._PREFIXES)
    return (
        "\n\n".join(
            [
                HEAD.rstrip(),
                dimensions(),
                "A plain number has the SI unit. The last column lists some accepted units.",
                f"## Units with prefixes\n\nPrefixes are {short}. `µ` is read as `u`. Names take "
                "long prefixes: `kilopascal`.",
                prefixed(),
                "## Units without prefixes",
                plain(),
                "This page is printed by `make codegen`.",
            ]
        )
        + "\n"
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
