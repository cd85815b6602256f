"""The C++ of a shared library with one law. In: a Law. Out: text that hands over a LawLibrary.

The layout is that of cpp/include/tissu/law/law_library.h.
"""

from __future__ import annotations

import json

import sympy as sp

from tissu.codegen import cpp
from tissu.codegen.definition import Law
from tissu.codegen.program import with_roots
from tissu.codegen.vocabulary import Expr, Parameter

MATERIAL = "Material"  # the class template: one law in a library needs no name of its own
_HEAD = """#include <cmath>
#include <limits>
#include <string_view>

#include "law/kernels/point.h"
#include "tissu/law/functions.h"
#include "tissu/law/law_library.h"
#include "tissu/law/tensor.h"

#define TISSU_TEXT(word) #word
#define TISSU_TEXT_OF(word) TISSU_TEXT(word)

namespace tissu::made {
"""
_TAIL = """
constexpr LawKernels kTable = TISSU_KERNELS::LawAtPoints<Material>::table();
constexpr LawLibraryKernels kKernels[] = {
    {kTable.dimension, kTable.energy, kTable.stress, kTable.stress_change, kTable.tangent}};
constexpr LawLibrary kLibrary = {
    kLawLibraryVersion, sizeof(LawLibrary), TISSU_KERNELS::kLanes, TISSU_TEXT_OF(TISSU_KERNELS),
    kName, kTable.linear, kFrameInvariant, kTable.isotropic, kAddition,
    sizeof(kParameters) / sizeof(kParameters[0]), sizeof(kConstants) / sizeof(kConstants[0]),
    kRequirementCount, 1,
    kParameters, kConstants, kRequirements, kKernels, &compute, kSmallStrain};

}  // namespace
}  // namespace tissu::made

extern "C" [[gnu::visibility("default")]] const tissu::LawLibrary* tissu_law_v2() {
  return &tissu::made::kLibrary;
}
"""


def library_source(law: Law) -> str:
    """The whole text.

    Raises:
        LawError: a name that C++ or the made text has for something else.
    """
    lines = [
        f'// Made from the law "{law.name}" (generator {cpp.VERSION}, SymPy {sp.__version__}).'
    ]
    lines += [_HEAD, cpp.structure(law), "", "namespace {", ""]
    lines += ["constexpr double kAny = std::numeric_limits<double>::infinity();"]
    lines += [f"constexpr const char* kName = {_text(law.name)};"]
    lines += [f"constexpr bool kFrameInvariant = {str(law.frame_invariant).lower()};"]
    lines += [f"constexpr bool kAddition = {str(law.addition).lower()};", ""]
    lines += ["constexpr LawLibraryParameter kParameters[] = {"]
    lines += [f"    {_parameter(p)}," for p in law.parameters]
    lines += ["};", "", "constexpr const char* kConstants[] = {"]
    lines += [f"    {_text(name)}," for name in law.constants]
    lines += ["};", "", *_compute(law), *_small_strain(law), *_requirements(law)]
    return "\n".join(lines) + _TAIL


def _text(words: str) -> str:
    return json.dumps(words, ensure_ascii=False)


def _bound(value: float | None, otherwise: str) -> str:
    return otherwise if value is None else repr(float(value))


def _parameter(p: Parameter) -> str:
    lower = p.above if p.above is not None else p.at_least
    words = ", ".join(_text(t) for t in (p.name, p.unit, p.meaning, p.accepted()))
    included = int(p.at_least is not None and p.above is None)
    bounds = f"{_bound(lower, '-kAny')}, {_bound(p.below, 'kAny')}"
    return f"{{{words}, {float(p.typical)!r}, {bounds}, {included}}}"


def _value(expression: Expr) -> str:
    return cpp.printed(with_roots(sp.sympify(expression)), "")


def _reading(names: list[str], read: set[Expr], source: str) -> list[str]:
    """Names for the entries of an array that something reads."""
    return [
        f"  const double {name} = {source}[{place}];"
        for place, name in enumerate(names)
        if sp.Symbol(name, real=True) in read
    ]


_USING = "  using std::cbrt, std::exp, std::log, std::sqrt;"


def _compute(law: Law) -> list[str]:
    parameters = [p.name for p in law.parameters]
    read = set().union(*(sp.sympify(e).free_symbols for e in law.constants.values()))
    lines = ["void compute(const double* parameters, double* constants) {", _USING]
    lines += _reading(parameters, read, "parameters")
    for place, (name, expression) in enumerate(law.constants.items()):
        if name in parameters:
            lines.append(f"  constants[{place}] = {name};")
        else:
            lines.append(f"  const double {name} = {_value(expression)};")
            lines.append(f"  constants[{place}] = {name};")
    return [*lines, "}", ""]


def _small_strain(law: Law) -> list[str]:
    if law.small_strain is None:
        return ["constexpr decltype(LawLibrary::small_strain) kSmallStrain = nullptr;", ""]
    read = set().union(*(e.free_symbols for e in law.small_strain))
    lam, mu = (_value(e) for e in law.small_strain)
    return [
        "void small_strain(const double* constants, double* lambda_and_mu) {",
        _USING,
        *_reading(list(law.constants), read, "constants"),
        f"  lambda_and_mu[0] = {lam};",
        f"  lambda_and_mu[1] = {mu};",
        "}",
        "constexpr auto kSmallStrain = &small_strain;",
        "",
    ]


def _requirements(law: Law) -> list[str]:
    count = f"constexpr std::int32_t kRequirementCount = {len(law.requirements)};"
    if not law.requirements:
        return [count, "constexpr const LawLibraryRequirement* kRequirements = nullptr;"]
    lines, rows, names = [], [], [p.name for p in law.parameters]
    for place, r in enumerate(law.requirements):
        lines += [f"double requirement_{place}(const double* parameters) {{", _USING]
        lines += _reading(names, r.expression.free_symbols, "parameters")
        lines += [f"  return {_value(r.expression)};", "}"]
        rows.append(f"    {{{_text(r.field)}, {_text(r.accepted)}, &requirement_{place}}},")
    return [*lines, count, "constexpr LawLibraryRequirement kRequirements[] = {", *rows, "};"]
