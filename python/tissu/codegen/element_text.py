"""The C++ of an element: one header with its nodes, shape functions, gradients and rules.

Everything is printed as it stands in the formulae, in a fixed order, so that the same table always
makes the same text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import sympy

from tissu.codegen.element_properties import exact_for, zero_energy_modes
from tissu.codegen.elements import Element
from tissu.codegen.quadrature import Rule
from tissu.codegen.reference_cells import AXES

VERSION = 1
"""Of this generator; raised when the text of unchanged elements changes."""

_BANNER = (
    "// Made by `python -m tissu.codegen --update`, elements version {version}, from\n"
    "// python/tissu/codegen/elements.py. Change that, not this.\n"
)
_WIDTH = 109
_W = sympy.Symbol("w", real=True)
_CELLS = {
    "line": "(-1, 1)",
    "triangle": "the corners (0,0) (1,0) (0,1)",
    "quad": "(-1, 1)^2",
    "tetra": "the corner at the origin and the three unit points",
    "hexahedron": "(-1, 1)^3",
    "wedge": "the triangle (0,0) (1,0) (0,1) times (-1, 1), nodes 0 1 2 at z = -1",
    "pyramid": "the base (-1, 1)^2 at z = 0 and the apex (0, 0, 1)",
}
_AFFINE = {True: "true;  ///< one Jacobian serves the whole cell", False: "false;"}
_LAWS = {
    "": "",
    "hooke": "; exact for Hooke on affine cells",
    "stvk": "; exact for StVK on affine cells",
}


def element_header(element: Element) -> str:
    """The header of one element.

    Args:
        element: from the table.

    Returns:
        The text of a C++ file.
    """
    n, m = len(element.nodes), element.dimension
    values = [expression(N) for N in element.shapes]
    gradients = [[expression(d) for d in row] for row in element.gradients]
    operations = [sum(map(_count, values)), sum(_count(d) for row in gradients for d in row)]
    return "\n".join(
        [
            _BANNER.format(version=VERSION) + _description(element, operations),
            "#pragma once\n",
            "#include <array>\n#include <string_view>\n",
            '#include "tissu/element/quadrature.h"\n',
            "namespace tissu {\n",
            f"/// {_title(element)}",
            f"struct {element.struct} {{",
            f'  static constexpr std::string_view kName = "{element.name}";',
            f"  static constexpr int kNodes = {n};",
            f"  static constexpr int kDimension = {m};",
            f"  static constexpr int kOrder = {element.order};",
            f"  static constexpr bool kAffine = {_AFFINE[element.affine]}",
            f"  using Point = std::array<double, {m}>;\n",
            "  /// Reference coordinates of the nodes.",
            f"  static constexpr std::array<Point, {n}> nodes = {{{{",
            *_table((_row([_number(c) for c in node], 6) for node in element.nodes), 6),
            "  }};\n",
            *_function(element, "values", f"std::array<double, {n}>", values, braces=1),
            *_function(
                element,
                "gradients",
                f"std::array<Point, {n}>",
                [_row(row, 8) for row in gradients],
                braces=2,
            ),
            *_rules(element),
            "};\n",
            "}  // namespace tissu\n",
        ]
    )


def list_header(elements: Sequence[Element]) -> str:
    """The header that includes all others and calls a function for each element.

    Args:
        elements: the table.

    Returns:
        The text of a C++ file.
    """
    includes = sorted(f'#include "tissu/element/generated/{e.name}.h"' for e in elements)
    calls = [f"  f({e.struct}{{}});" for e in elements]
    return "\n".join(
        [
            _BANNER.format(version=VERSION),
            "#pragma once\n",
            *includes,
            "\nnamespace tissu {\n",
            f"inline constexpr int kElementCount = {len(elements)};\n",
            "/// Calls f with an object of each element's type, in the order of the table.",
            "template <class Function>",
            "constexpr void for_each_element(Function&& f) {",
            *calls,
            "}\n",
            "}  // namespace tissu\n",
        ]
    )


def expression(formula: Any) -> str:
    """C++ for a polynomial in x, y, z, or for one divided by powers of 1 - z.

    A polynomial is printed as a product of its factors. With w = 1 / (1 - z) every quotient becomes
    a polynomial plus terms w^k q_k(x, y) with q_k of degree k at least: inside the pyramid these
    stay bounded, and w = 0 leaves what they tend to along its axis.

    Args:
        formula: a SymPy expression.

    Returns:
        Its text; numbers are doubles, no power is left.
    """
    z = AXES[2]
    quotient = sympy.together(formula)
    if not quotient.as_numer_denom()[1].free_symbols:
        return _factored(formula)
    parts: dict[int, Any] = {}
    for term in sympy.Add.make_args(sympy.expand(quotient.subs(z, 1 - 1 / _W))):
        coefficient, power = term.as_coeff_exponent(_W)
        rest = coefficient * (1 - z) ** max(-power, 0)
        parts[max(power, 0)] = parts.get(max(power, 0), 0) + rest
    texts = []
    for power, part in sorted(parts.items()):
        text = _factored(sympy.expand(part))
        texts.append(" * ".join([*([] if text == "1" else [text]), *["w"] * power]))
    return " + ".join(t for t in texts if t != "0").replace("+ -", "- ")


def _factored(formula: Any) -> str:
    """Coefficient times factors, each with a positive first term, sorted by their variables."""
    number, factors = sympy.factor_list(sympy.expand(formula), *AXES)
    turned = []
    for factor, times in factors:
        sign = -1 if _terms(factor)[0][1] < 0 else 1
        number *= sign**times
        turned += [sign * factor] * times
    if number == 0:
        return "0"
    alone = len(turned) == 1
    if number == -1 and alone and _is_sum(turned[0]):
        return _sum(-turned[0])
    texts = [f"({_sum(f)})" if _is_sum(f) else _sum(f) for f in sorted(turned, key=_order)]
    if abs(number) != 1 or not texts:
        return " * ".join([_number(number), *texts])
    if alone and _is_sum(turned[0]):
        return _sum(turned[0])
    return ("-" if number < 0 else "") + " * ".join(texts)


def _is_sum(formula: Any) -> bool:
    return len(_terms(formula)) > 1


def _terms(formula: Any) -> list[tuple[tuple[int, ...], Any]]:
    """(exponents, coefficient), the constant first, then by degree, x before y before z."""
    terms = sympy.Poly(formula, *AXES).terms()
    return sorted(terms, key=lambda t: (sum(t[0]), [-k for k in t[0]]))


def _order(factor: Any) -> Any:
    used = [i for i, s in enumerate(AXES) if factor.has(s)]
    return _is_sum(factor), used, [(k, str(c)) for k, c in _terms(factor)]


def _sum(formula: Any) -> str:
    text = ""
    for exponents, coefficient in _terms(formula):
        names = [str(s) for s, k in zip(AXES, exponents, strict=True) for _ in range(k)]
        size = abs(coefficient)
        number = [] if size == 1 and names else [_number(size)]
        sign = ("-" if coefficient < 0 else "") if not text else " - " if coefficient < 0 else " + "
        text += sign + " * ".join(number + names)
    return text or "0"


def _number(value: Any) -> str:
    """An integer as it is, a fraction as the nearest double."""
    exact = sympy.nsimplify(value)
    return str(exact) if exact.is_Integer else repr(float(exact))


def _count(text: str) -> int:
    """Operations of a printed expression; a sign is none."""
    return sum(text.count(sign) for sign in (" * ", " + ", " - "))


def _table(rows: Iterable[str], indent: int) -> list[str]:
    space = " " * indent
    return [
        f"{space}// clang-format off",
        *(f"{space}{row}," for row in rows),
        f"{space}// clang-format on",
    ]


def _function(
    element: Element, name: str, result: str, rows: Sequence[str], *, braces: int
) -> list[str]:
    what = {"values": "N_a(xi)", "gradients": "dN_a/dxi"}[name]
    text = " ".join(rows)
    used = [s for s in AXES if str(s) in text or (element.rational and s is AXES[2])]
    lines = [
        f"  /// {what}",
        f"  static constexpr {result} {name}(const Point& {'xi' if used else '/*xi*/'}) {{",
        *(f"    const double {s} = xi[{AXES.index(s)}];" for s in used),
    ]
    if element.rational:
        lines.append("    const double w = z < 1 ? 1 / (1 - z) : 0.0;  // limit along the axis")
    return [*lines, f"    return {'{' * braces}", *_table(rows, 8), f"    {'}' * braces};", "  }"]


def _row(entries: Sequence[str], indent: int) -> str:
    """One row of a table, on one line if it fits."""
    line = f"{{{', '.join(entries)}}}"
    gap = ",\n" + " " * (indent + 1)
    return line if indent + len(line) < _WIDTH else f"{{{gap.join(entries)}}}"


def _rules(element: Element) -> list[str]:
    lines: list[str] = []
    made: dict[Rule, str] = {}
    for name, rule in element.rules.items():
        struct = name.capitalize()
        if rule in made:
            lines.append(f"  using {struct} = {made[rule]};")
            continue
        made[rule] = struct
        lines += ["", *_rule(element, rule, struct)]
    return lines


def _rule(element: Element, rule: Rule, struct: str) -> list[str]:
    modes, law = zero_energy_modes(element, rule), exact_for(element, rule)
    count, point = len(rule.points), f"WeightedPoint<{element.dimension}>"
    lines = [f"  /// {rule.name}{_LAWS[law]}."]
    if modes:
        modes_text = "one zero-energy mode" if modes == 1 else f"{modes} zero-energy modes"
        lines.append(f"  /// Has {modes_text} beyond the rigid motions.")
    points = [
        f"{{{{{', '.join(map(_double, p))}}}, {_double(w)}}}"
        for p, w in zip(rule.points, rule.weights, strict=True)
    ]
    return [
        *lines,
        f"  struct {struct} {{",
        f"    static constexpr int kPoints = {count};",
        f"    static constexpr int kDegree = {rule.degree};",
        f"    static constexpr int kZeroEnergyModes = {modes};",
        f'    static constexpr std::string_view kExactFor = "{law}";',
        f"    static constexpr std::array<{point}, {count}> points = {{{{",
        *_table(points, 8),
        "    }};",
        "  };",
    ]


def _double(value: float) -> str:
    return repr(0.0 if value == 0.0 else value)


def _title(element: Element) -> str:
    shape = {"line": "Line", "quad": "Quadrangle", "tetra": "Tetrahedron"}
    name = shape.get(element.cell, element.cell.capitalize())
    return f"{name} of {len(element.nodes)} nodes on {_CELLS[element.cell]}."


def _description(element: Element, operations: Sequence[int]) -> str:
    formula = [f"//   {line}".rstrip() for line in element.formula.splitlines() if line]
    counts = f"// Operations: values {operations[0]}, gradients {operations[1]}.\n"
    return "\n".join(["//", "// Shape functions:", *formula, counts])
