"""The classes of a scene's laws, one for each formula: python/tissu/scene/generated/laws.py."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

import sympy as sp
from sympy.printing.pycode import pycode

from tissu.codegen.definition import Law
from tissu.codegen.vocabulary import Expr, Parameter, Requirement
from tissu.errors import LawError

_HEAD = """\
\"""The library's laws, as a scene names them.

Made from the formulae of python/tissu/codegen/laws by `make codegen`; never edited.
\"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from tissu import units
from tissu.scene.field import field
from tissu.scene.law import Law
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule
"""
_TYPES = {
    "1": "units.Pure",
    "Pa": "units.Pressure",
    "m": "units.Length",
    "s": "units.Time",
    "Pa s": "units.Viscosity",
}


def scene_laws(laws: Sequence[Law]) -> str:
    """The text of the module.

    Raises:
        LawError: a parameter in a unit that no field of a scene has.
    """
    bases = [law for law in laws if not law.addition]
    names = "".join(f'    "{law.class_name}",\n' for law in bases)
    listed = "".join(f"    {law.class_name},\n" for law in bases)
    classes = "".join(f"\n\n{_class(law)}" for law in bases)
    last = f"\n\nLAWS: tuple[type[Law], ...] = (\n{listed})\n"
    return f"{_HEAD}\n__all__ = [\n{names}]\n{classes}{last}"


def _class(law: Law) -> str:
    lines = [f"class {law.class_name}(Law):", *_docstring(law.text), ""]
    lines += [f'    type: Literal["{law.name}"] = "{law.name}"']
    for p in law.parameters:
        lines += _field(law, p)
    for number, requirement in enumerate(law.requirements):
        lines += _rule(law, requirement, number)
    if law.small_strain is not None:
        lines += _small_strain(law, law.small_strain)
    return "\n".join([*lines, ""])


def _docstring(text: str) -> Iterator[str]:
    body = textwrap.indent(text.strip(), "    ")
    yield f'    """{body.strip()}' + ('\n    """' if "\n" in body else '"""')


def _field(law: Law, p: Parameter) -> Iterator[str]:
    """A field with the bounds of its parameter, and what it means."""
    if p.unit not in _TYPES:
        known = ", ".join(_TYPES)
        raise LawError(f"{law.name}: {p.name} is in {p.unit}; units of the library's laws: {known}")
    kind, bounds = _TYPES[p.unit], {"gt": p.above, "ge": p.at_least, "lt": p.below}
    if p.above is not None and p.below is not None:
        kind = f'Annotated[{kind}, units.within({p.above!r}, {p.below!r}, hint="{p.hint}")]'
        bounds = {}
    given = {"default": p.default, **bounds}
    arguments = ", ".join(f"{name}={value!r}" for name, value in given.items() if value is not None)
    yield f"    {p.name}: {kind}" + (f" = field({arguments})" if arguments else "")
    unit = "" if p.unit == "1" else f" [{p.unit}]"
    example = f", such as '{p.example}'" if p.example else ""
    bounded = f", {p.accepted()}" if p.above is not None and p.below is not None else ""
    yield f'    """{p.meaning}{unit}{bounded}{example}"""'


def _rule(law: Law, requirement: Requirement, number: int) -> Iterator[str]:
    used = [p.name for p in law.parameters if sp.Symbol(p.name, real=True) in _symbols(requirement)]
    names = ", ".join(f'"{name}"' for name in used)
    found = f"found {requirement.field} = {{value:g}}; {requirement.accepted} is accepted"
    yield ""
    yield f"    @rule({names})"
    yield f"    def _requirement_{number}(self) -> Iterator[Problem]:"
    yield f"        value = {_python(law, requirement.expression)}"
    yield "        if not value > 0.0:"
    yield f'            yield Problem((), f"{found}")'


def _symbols(requirement: Requirement) -> set[Expr]:
    return set(requirement.expression.free_symbols)


def _small_strain(law: Law, lame: tuple[Expr, Expr]) -> Iterator[str]:
    yield ""
    yield "    def small_strain(self) -> tuple[float, float]:"
    yield '        """Lame\'s lambda and mu at rest [Pa]."""'
    yield f"        lame = {_python(law, lame[0])}"
    yield f"        mu = {_python(law, lame[1])}"
    yield "        return lame, mu"


def _python(law: Law, expression: Expr) -> str:
    """An expression in the constants, as Python in the fields of the class."""
    written = sp.sympify(expression)
    for name, meaning in reversed(list(law.constants.items())):
        written = written.subs(sp.Symbol(name, real=True), meaning)
    fields = {sp.Symbol(p.name, real=True): sp.Symbol(f"self.{p.name}") for p in law.parameters}
    return str(pycode(sp.simplify(written).subs(fields)))
