"""What is made of all laws together: the list of types, the table of parameters and constants."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tissu.codegen.cpp import banner, is_thin, printed
from tissu.codegen.definition import Law
from tissu.codegen.program import square_root
from tissu.codegen.vocabulary import Expr, Parameter

SOURCE = "python/tissu/codegen/laws"


def type_list(laws: Sequence[Law]) -> str:
    """all.h: every law, and AllLaws."""
    lines = ["#pragma once", "", *banner(SOURCE), ""]
    lines += [f'#include "tissu/law/generated/{law.name}.h"' for law in laws]
    lines += ['#include "tissu/law/law_list.h"', "", "namespace tissu {", ""]
    lines += ["/// Every law of the library, additions last."]
    lines += [f"using AllLaws = LawList<{', '.join(law.class_name for law in laws)}>;"]
    additions = [law.class_name for law in laws if law.addition]
    bases = [law.class_name for law in laws if not law.addition]
    lines += ["/// Those that stand alone.", f"using BaseLaws = LawList<{', '.join(bases)}>;"]
    lines += ["/// Those to be added to one that does."]
    lines += [f"using AdditionLaws = LawList<{', '.join(additions)}>;"]
    thin = [law.class_name for law in laws if is_thin(law)]
    lines += ["/// Those that sheets and lines may be made of."]
    lines += [f"using ThinLaws = LawList<{', '.join(thin)}>;"]
    return "\n".join([*lines, "", "}  // namespace tissu", ""])


def _bound(value: float | None, otherwise: str) -> str:
    return otherwise if value is None else repr(float(value))


def _parameter(p: Parameter) -> str:
    lower = p.above if p.above is not None else p.at_least
    return (
        f'{{"{p.name}", "{p.unit}", "{p.meaning}", "{p.accepted()}", {float(p.typical)!r}, '
        f"{_bound(lower, '-kAny')}, {_bound(p.below, 'kAny')}, "
        f"{str(p.at_least is not None and p.above is None).lower()}}}"
    )


def _value(expression: Expr) -> str:
    roots = sp.sympify(expression).replace(
        lambda e: e.is_Pow and e.exp.is_Rational and e.exp.q == 2,
        lambda e: square_root(e.base) ** e.exp.p,
    )
    return printed(roots, "").replace("sqrt(", "std::sqrt(")


def _law(law: Law) -> str:
    parameters = ",\n".join(_parameter(p) for p in law.parameters)
    names = ", ".join(f'"{name}"' for name in law.constants)
    lines = [f"namespace {law.name} {{", ""]
    lines += [f"constexpr LawParameter kParameters[] = {{{parameters}}};"]
    lines += [f"constexpr std::string_view kConstants[] = {{{names}}};", ""]
    lines += ["void compute(const double* parameters, double* constants) {"]
    for i, p in enumerate(law.parameters):
        lines.append(f"const double {p.name} = parameters[{i}];")
    for r in law.requirements:
        lines.append(f'require({_value(r.expression)}, "{law.name}", "{r.field}", "{r.accepted}");')
    for i, (name, expression) in enumerate(law.constants.items()):
        if str(expression) == name:
            lines.append(f"constants[{i}] = {name};")
        else:
            lines.append(f"const double {name} = {_value(expression)};")
            lines.append(f"constants[{i}] = {name};")
    lines += ["}", ""]
    if law.small_strain is not None:
        read = set().union(*(e.free_symbols for e in law.small_strain))
        lines += ["Lame small_strain(const double* constants) {"]
        for i, name in enumerate(law.constants):
            if sp.Symbol(name, real=True) in read:
                lines.append(f"const double {name} = constants[{i}];")
        values = ", ".join(_value(e) for e in law.small_strain)
        lines += [f"return {{{values}}};", "}", ""]
    return "\n".join([*lines, f"}}  // namespace {law.name}", ""])


def table(laws: Sequence[Law]) -> str:
    """laws.cpp: the parameters and constants of every law."""
    lines = [*banner(SOURCE), "", "#include <cmath>", "#include <limits>", ""]
    lines += ['#include "tissu/law/law_info.h"', ""]
    lines += ["namespace tissu {", "namespace {", ""]
    lines += ["constexpr double kAny = std::numeric_limits<double>::infinity();", ""]
    lines += [_law(law) for law in laws]
    lines += ["constexpr LawInfo kLaws[] = {"]
    for law in laws:
        limit = "nullptr" if law.small_strain is None else f"&{law.name}::small_strain"
        flags = f"{str(law.frame_invariant).lower()}, {str(law.addition).lower()}"
        lines.append(
            f'{{"{law.name}", {law.name}::kParameters, {law.name}::kConstants, {flags}, '
            f"&{law.name}::compute, {limit}}},"
        )
    lines += ["};", "", "}  // namespace", ""]
    lines += [
        "std::span<const LawInfo> all_laws() { return kLaws; }",
        "",
        "}  // namespace tissu",
        "",
    ]
    return "\n".join(lines)
