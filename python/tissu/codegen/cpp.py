"""The text of a law's header. In: a Law and its four Programs. Out: C++, formatted."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import sympy as sp

from tissu.codegen import derive, kernels, thin
from tissu.codegen import vocabulary as words
from tissu.codegen.definition import Law
from tissu.codegen.program import FUNCTIONS, Program
from tissu.codegen.vocabulary import Expr
from tissu.errors import LawError

VERSION = 1  # of the generator: raise it when the same formula gives other C++
STANDARD = ("log", "exp", "sqrt", "cbrt")  # of <cmath>; the others are in tissu/law/functions.h
# What neither a parameter nor a constant may be called: names of the text around it, words of C++.
_TAKEN = """
    A F P T dF dP energy stress stress_change tangent kName kLinear kFrameInvariant kAddition
    kIsotropic kHomogeneous
    parameters constants compute small_strain require std tissu log exp sqrt cbrt positive step
    Tensor2 Tangent alignas alignof and and_eq asm assert auto bitand bitor bool break case catch
    char char8_t char16_t char32_t class co_await co_return co_yield compl concept const const_cast
    consteval constexpr constinit continue decltype default delete do double dynamic_cast else enum
    errno explicit export extern false float for friend goto if inline int long mutable namespace
    new noexcept not not_eq nullptr operator or or_eq private protected public register
    reinterpret_cast requires return short signed sizeof static static_assert static_cast struct
    switch template this thread_local throw true try typedef typeid typename union unsigned using
    virtual void volatile wchar_t while xor xor_eq
"""
RESERVED = frozenset(_TAKEN.split())
QUESTIONS: dict[str, Callable[[Expr], Program]] = {
    "energy": kernels.energy,
    "stress": kernels.stress,
    "stress_change": kernels.stress_change,
    "tangent": kernels.tangent,
}


def number(value: Expr, scalar: str) -> str:
    """A rational as `T(2.0 / 3.0)`, a float as it is."""
    if value.is_Rational and value.q != 1 and (2**20) % value.q:
        text = f"{value.p}.0 / {value.q}.0"
        return f"{scalar}({text})" if scalar else f"({text})"
    text = repr(float(value))
    return f"{scalar}({text})" if scalar else text


def printed(expression: Expr, scalar: str = "T") -> str:
    """C++ of an expression: products for powers, one sign for each term."""
    if expression.is_Number:
        return number(expression, scalar)
    if expression.is_Symbol:
        return _symbol(str(expression))
    if expression.is_Add:
        return _sum(expression, scalar)
    if expression.is_Mul:
        return _product(expression, scalar)
    if expression.is_Pow:
        base, n = expression.base, expression.exp
        if not n.is_Integer:
            return f"{ {sp.Rational(1, 2): 'sqrt'}[n] }({printed(base, scalar)})"
        if n < 0:
            return f"{number(sp.Integer(1), scalar)} / {_factor(base**-n, scalar)}"
        return " * ".join([_factor(base, scalar)] * int(n))
    return f"{FUNCTIONS[type(expression)]}({printed(expression.args[0], scalar)})"


def _symbol(name: str) -> str:
    for tensor in ("dF", "F"):
        if (
            name.startswith(tensor)
            and name[len(tensor) :].isdigit()
            and len(name) == len(tensor) + 2
        ):
            return f"{tensor}({name[-2]}, {name[-1]})"
    return name


def _factor(expression: Expr, scalar: str) -> str:
    text = printed(expression, scalar)
    return f"({text})" if expression.is_Add or expression.is_Mul or expression.is_Pow else text


def _sum(expression: Expr, scalar: str) -> str:
    # Names before products: what follows is multiply-and-add, one operation of the machine.
    terms = sorted(expression.args, key=lambda t: (_negative(t), t.is_Number, not t.is_Symbol))
    text = ""
    for term in terms:
        if _negative(term):
            text += f" - {printed(-term, scalar)}" if text else f"-{_factor(-term, scalar)}"
        else:
            text += f" + {printed(term, scalar)}" if text else printed(term, scalar)
    return text


def _negative(term: Expr) -> bool:
    return bool(term.as_coeff_Mul()[0].is_negative)


def _product(expression: Expr, scalar: str) -> str:
    coefficient, rest = expression.as_coeff_Mul()
    sign = "-" if coefficient.is_negative else ""
    above = [] if abs(coefficient) == 1 else [number(abs(coefficient), scalar)]
    below = []
    for factor in sp.Mul.make_args(rest):
        if factor.is_Pow and factor.exp.is_negative:
            below.append(_factor(1 / factor, scalar))
        elif factor.is_Pow and factor.exp.is_Integer:
            above.append(printed(factor, scalar))
        else:
            above.append(_factor(factor, scalar))
    text = " * ".join(above) or number(sp.Integer(1), scalar)
    return sign + " / ".join([text, *below])


def _function(name: str, program: Program, m: int = 3) -> str:
    """One member function, for F of 3 x m."""
    read = program.symbols()
    tensor = "Tensor2<T>" if m == 3 else f"Columns<T, {m}>"
    tangent = "Tangent<T>" if m == 3 else f"ColumnsTangent<T, {m}>"
    result = {"energy": "T", "tangent": tangent}.get(name, tensor)
    arguments = ["F", "dF"] if name == "stress_change" else ["F"]
    given = []
    for argument in arguments:
        used = any(_symbol(s).startswith(f"{argument}(") for s in read)
        given.append(f"const {tensor}& {argument if used else f'/*{argument}*/'}")
    lines = [f"[[nodiscard]] {result} {name}({', '.join(given)}) const {{"]
    called = set(program.count().functions)
    lines += [f"using std::{f};" for f in STANDARD if f in called]
    lines += [f"const T {symbol} = {printed(e)};" for symbol, e in program.lets]
    if name == "energy":
        return "\n".join([*lines, f"return {printed(program.outputs['W'])};", "}"])
    target = {"stress": "P", "stress_change": "dP", "tangent": "A"}[name]
    lines.append(f"{result} {target};")
    lines += [f"{entry} = {printed(e)};" for entry, e in program.outputs.items()]
    return "\n".join([*lines, f"return {target};", "}"])


DESCRIBED = {
    "energy": "W [J/m3]",
    "stress": "P = dW/dF [Pa]",
    "stress_change": "dP = dP/dF : dF [Pa]",
    "tangent": "dP/dF, upper triangle [Pa]",
}


def is_isotropic(law: Law) -> bool:
    """Whether the energy is written in invariants of C alone."""
    directed = set(words.a) | {words.I4, words.Ibar4}
    return (
        law.frame_invariant
        and not derive.has_components(law.energy)
        and not law.energy.free_symbols & directed
    )


def is_homogeneous(law: Law) -> bool:
    """Whether twice the constants give twice the energy."""
    constants = [sp.Symbol(name, real=True) for name in law.constants]
    slope = sum(sp.diff(law.energy, c) * c for c in constants)
    return bool(sp.expand(slope - law.energy) == 0)


THIN = {2: "The same of a sheet, F of 3 x 2", 1: "The same of a line, F of 3 x 1"}


def is_thin(law: Law) -> bool:
    """Whether sheets and lines may be made of it: Lamé's constants, and traces of a strain."""
    named = {"lambda", "mu"} <= set(law.constants)
    return named and thin.traces(law.energy, set(law.constants)) is not None


def banner(source: str) -> list[str]:
    """The first lines of every made file."""
    return [
        f"// Made from {source}",
        f"// by `python -m tissu.codegen --update` (generator {VERSION}, "
        f"SymPy {sp.__version__}). Do not edit.",
    ]


def check_names(law: Law, programs: dict[str, Program]) -> None:
    """Refuses a constant named as one of the generated names, or as a word of C++."""
    made = {str(symbol) for program in programs.values() for symbol, _ in program.lets}
    made |= RESERVED
    clash = sorted((made & set(law.constants)) - {"a0", "a1", "a2"})
    clash += sorted(RESERVED & {p.name for p in law.parameters})
    if clash:
        raise LawError(f"{law.name}: a constant cannot be called {clash[0]}; choose another name.")


def structure(law: Law) -> str:
    """The law's class template, not yet formatted."""
    programs = {name: make(law.energy) for name, make in QUESTIONS.items()}
    check_names(law, programs)
    lines = [f"/// {line}".rstrip() for line in law.text.splitlines()]
    lines += ["///", f"///     W = {law.formula}", "///", "/// Operations:"]
    lines += [f"/// - {name}: {p.count()}" for name, p in programs.items()]
    lines += ["template <class T>", f"struct {law.class_name} {{"]
    lines += [f'static constexpr std::string_view kName = "{law.name}";']
    linear = (
        not programs["tangent"].symbols()
        - set(law.constants)
        - {str(symbol) for symbol, _ in programs["tangent"].lets}
    )
    flags = {
        "kLinear": (linear, "one tangent serves every F"),
        "kFrameInvariant": (law.frame_invariant, "blind to rotation"),
        "kIsotropic": (is_isotropic(law), "blind to the axes of the rest shape"),
        "kHomogeneous": (is_homogeneous(law), "in proportion to its constants"),
        "kAddition": (law.addition, "to be added to a base law"),
    }
    lines += [
        f"static constexpr bool {k} = {str(v).lower()};  ///< {t}" for k, (v, t) in flags.items()
    ]
    for name, expression in law.constants.items():
        text = str(expression).replace("**", "^")
        lines.append(f"T {name};" + (f"  ///< {text}" if text != name else ""))
    for name, program in programs.items():
        lines += ["", f"/// {DESCRIBED[name]}", _function(name, program)]
    for m in (2, 1) if is_thin(law) else ():
        lines += ["", f"// {THIN[m]}, in axes whose first {m} lie in it."]
        for name, program in thin.programs(law.energy, frozenset(law.constants), m).items():
            lines.append(_function(name, program, m))
    return "\n".join([*lines, "};"])


def header(law: Law) -> str:
    """The law's header, not yet formatted."""
    body = structure(law)
    called = {f for make in QUESTIONS.values() for f in make(law.energy).count().functions}
    lines = ["#pragma once", "", *banner(f"python/tissu/codegen/laws/{law.name}.py"), ""]
    lines += ["#include <cmath>"] * any(f in STANDARD for f in called)
    lines += ["#include <string_view>", ""]
    own = any(f not in STANDARD for f in called)
    lines += ['#include "tissu/law/functions.h"'] * own + ['#include "tissu/law/tensor.h"', ""]
    return "\n".join([*lines, "namespace tissu {", "", body, "", "}  // namespace tissu", ""])


def formatter() -> str:
    """The path of clang-format: beside this Python, or on the path."""
    beside = Path(sys.executable).with_name("clang-format")
    found = str(beside) if beside.exists() else shutil.which("clang-format")
    if found is None:
        raise LawError("clang-format is missing; install the project with its extra `lint`.")
    return found


def formatted(text: str, path: Path) -> str:
    """The text in the format of the folder that `path` is in."""
    done = subprocess.run(
        [formatter(), f"--assume-filename={path}", "--fallback-style=Google"],
        input=text,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout
