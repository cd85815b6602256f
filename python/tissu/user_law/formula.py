"""What a user wrote as a formula, in the words of the generator.

In: anything SymPy makes. Out: real symbols, exact numbers, functions that kernels have; or a
LawError with the reason.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy as sp

from tissu.codegen.program import FUNCTIONS, with_roots
from tissu.codegen.vocabulary import Expr, Tensor, positive
from tissu.errors import LawError

ACCEPTED = "ln, exp, sqrt, powers, positive, and the words of tissu.formula"


def in_words(written: Any, *, law: str, place: str) -> Expr:
    """The formula with symbols known by their names alone, and numbers made exact.

    Args:
        written: a SymPy expression, or a number.
        law: name of the law, for messages.
        place: what the formula is: "the energy", "the constant c".

    Raises:
        LawError: no expression, or one with a function that kernels do not have.
    """
    found = f"{law}: {place} is "
    if isinstance(written, Tensor):
        raise LawError(f"{found}the tensor {written.name}; take its trace tr(…), or a component.")
    if isinstance(written, str):
        raise LawError(f"{found}the text {written!r}; a SymPy expression is accepted ({ACCEPTED}).")
    try:
        expression = sp.sympify(written)
    except (sp.SympifyError, TypeError, AttributeError):
        expression = None
    if not isinstance(expression, sp.Expr):
        kind = type(written).__name__
        raise LawError(f"{found}of type {kind}; a SymPy expression is accepted ({ACCEPTED}).")
    expression = expression.replace(sp.Max, _positive_part)
    expression = expression.rewrite([sp.sinh, sp.cosh, sp.tanh], sp.exp)
    expression = expression.xreplace({n: _exact(n) for n in expression.atoms(sp.Float)})
    expression = expression.xreplace(
        {s: sp.Symbol(str(s), real=True) for s in expression.free_symbols}
    )
    expression = expression.replace(_is_general_power, lambda e: sp.exp(e.exp * sp.log(e.base)))
    constants = expression.atoms(sp.NumberSymbol)
    expression = expression.xreplace({n: _exact(n) for n in constants})
    _check_functions(expression, law, place)
    return expression


def _exact(number: Expr) -> Expr:
    """A number as a short fraction that rounds to it (2/3), else as its shortest decimal text."""
    value = float(number)
    if abs(value) == float("inf"):
        return number
    short = Fraction(value).limit_denominator(1000)
    if float(short) == value:
        return sp.Rational(short.numerator, short.denominator)
    return sp.Rational(repr(value))


def _positive_part(*arguments: Expr) -> Expr:
    """max(x, 0) as positive(x)."""
    rest = [a for a in arguments if a != 0]
    if len(arguments) == 2 and len(rest) == 1:
        return positive(rest[0])
    return sp.Max(*arguments, evaluate=False)


def _is_general_power(expression: Expr) -> bool:
    return bool(expression.is_Pow and not expression.exp.is_Rational)


def _check_functions(expression: Expr, law: str, place: str) -> None:
    for part in sp.preorder_traversal(expression):
        plain = part.is_Symbol or part.is_Rational or part.is_Add or part.is_Mul or part.is_Pow
        if plain or type(part) in FUNCTIONS:
            continue
        what = part.func.__name__ if part.args else str(part)
        raise LawError(f"{law}: {place} uses {what}, which kernels do not have; {ACCEPTED} are.")
    try:
        with_roots(expression)
    except ValueError as error:
        raise LawError(f"{law}: {place} has the power {error}") from None
