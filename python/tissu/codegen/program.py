"""A list of assignments: common parts named once, nothing unread, every operation counted.

In: named expressions, in order. Out: the same values from fewer operations. Nothing is expanded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from tissu.codegen.vocabulary import Expr, positive, step


class cube_root(sp.Function):  # type: ignore[misc]  # noqa: N801 - a function in a formula
    """The real cube root, of either sign."""

    nargs = 1


class square_root(sp.Function):  # type: ignore[misc]  # noqa: N801 - a function in a formula
    """The square root."""

    nargs = 1


FUNCTIONS: dict[type, str] = {
    sp.log: "log",
    sp.exp: "exp",
    cube_root: "cbrt",
    square_root: "sqrt",
    positive: "positive",
    step: "step",
}


@dataclass(frozen=True)
class Count:
    """Operations of one evaluation."""

    multiplications: int = 0
    additions: int = 0
    divisions: int = 0
    functions: tuple[str, ...] = ()

    def __add__(self, other: Count) -> Count:
        return Count(
            self.multiplications + other.multiplications,
            self.additions + other.additions,
            self.divisions + other.divisions,
            self.functions + other.functions,
        )

    @property
    def cost(self) -> int:
        """For choosing: a division counts 8, a function 40."""
        return self.multiplications + self.additions + 8 * self.divisions + 40 * len(self.functions)

    def __str__(self) -> str:
        parts = [f"{self.multiplications} multiplications", f"{self.additions} additions"]
        if self.divisions:
            parts.append(f"{self.divisions} division{'s' if self.divisions > 1 else ''}")
        parts += sorted(set(self.functions))
        return ", ".join(parts)


def count(expression: Expr) -> Count:
    """The operations of an expression as it is printed."""
    total = Count()
    for argument in expression.args if not expression.is_Rational else ():
        total += count(argument)
    if expression.is_Add:
        return total + Count(additions=len(expression.args) - 1)
    if expression.is_Mul:
        factors = [f for f in expression.args if f != -1]
        below = sum(1 for f in factors if f.is_Pow and f.exp.is_negative)
        lone = 1 if below == len(factors) else 0  # 1/x needs no product
        return total + Count(multiplications=len(factors) - 1 - below + lone)
    if expression.is_Pow:
        n = int(expression.exp)
        return total + Count(multiplications=abs(n) - 1, divisions=int(n < 0))
    if type(expression) in FUNCTIONS:
        return total + Count(functions=(FUNCTIONS[type(expression)],))
    return total


def with_roots(expression: Expr) -> Expr:
    """x^(n/3), x^(n/2) by their roots: no general power is left."""

    def rooted(power: Expr) -> Expr:
        root = {2: square_root, 3: cube_root}.get(power.exp.q)
        if root is None:
            raise ValueError(f"{power}: exponents are integers, halves or thirds.")
        return root(power.base) ** power.exp.p

    return expression.replace(lambda e: e.is_Pow and e.exp.is_Rational and e.exp.q > 1, rooted)


def _forms(expression: Expr) -> Iterable[Expr]:
    """Ways to write an expression without expanding it."""
    yield expression
    yield sp.factor_terms(expression)
    sums = sorted({p.base for p in expression.atoms(sp.Pow) if p.base.is_Add}, key=str)
    names = {s: sp.Dummy(f"s{i}") for i, s in enumerate(sums)}
    short = expression.xreplace(names)
    back = {v: k for k, v in names.items()}
    for power in sorted({p for p in short.atoms(sp.Pow) if p.exp.is_positive}, key=str):
        if power.base.is_Symbol and short.is_polynomial(power.base):
            inner = short.as_independent(power.base, as_Add=True)
            yield (inner[0] + sp.horner(inner[1], power.base)).xreplace(back)


def cheapest(expression: Expr) -> Expr:
    """The form with the fewest operations."""
    return min(_forms(expression), key=lambda e: count(e).cost)


def _is_plain(expression: Expr) -> bool:
    """A symbol, a number or minus one: it needs no name."""
    return bool(expression.is_Atom or (-expression).is_Atom)


Shared = tuple[list[tuple[Any, Expr]], list[Expr]]


def _common(expressions: list[Expr], start: int) -> Shared:
    """Common parts as x<start>, x<start + 1>, ..., and what is left of the expressions."""
    powers = set().union(*(e.atoms(sp.Pow) for e in expressions))
    # A sum to a power is printed once for each factor: listing it once more gives it a name.
    bases = {p.base for p in powers if p.exp.is_positive and not p.base.is_Atom}
    names = sp.numbered_symbols("x", start=start, real=True)
    listed = [*expressions, *sorted(bases, key=str)]
    common, reduced = sp.cse(listed, symbols=names, order="canonical")
    return list(common), list(reduced)[: len(expressions)]


def _cost(shared: Shared) -> int:
    return sum(count(e).cost for e in [*(e for _, e in shared[0]), *shared[1]])


@dataclass
class Program:
    """Assignments `name = expression`, then outputs.

    Attributes:
        lets: the assignments, in order.
        outputs: target in C++ -> expression.
    """

    lets: list[tuple[Any, Expr]] = field(default_factory=list)
    outputs: dict[str, Expr] = field(default_factory=dict)

    def let(self, name: str, expression: Expr) -> Expr:
        """A name for an expression, or the expression itself where it is plain."""
        expression = sp.sympify(expression)
        if _is_plain(expression):
            return expression
        symbol = sp.Symbol(name, real=True)
        if all(symbol != known for known, _ in self.lets):
            self.lets.append((symbol, expression))
        return symbol

    def share(self, named: Mapping[str, Expr], *, rewrite: bool = True) -> dict[str, Expr]:
        """Names for several expressions, common parts first; one division for each divisor.

        rewrite: look for the cheapest form of each; too slow for long sums of components.
        """
        divisors: dict[Expr, Any] = {}

        def inverse(power: Expr) -> Expr:
            known = divisors.setdefault(power.base, sp.Symbol(f"inverse{len(divisors)}", real=True))
            return known**-power.exp

        forms = [with_roots(sp.sympify(e)) for e in named.values()]
        forms = [
            e.replace(lambda p: p.is_Pow and p.exp.is_integer and p.exp.is_negative, inverse)
            for e in forms
        ]
        ways = [forms]
        if rewrite:
            ways = [[cheapest(e) for e in way] for way in (forms, map(sp.factor_terms, forms))]
        made = [sp.Pow(base, -1) for base in divisors]
        start = self._next_x()
        shared = [_common([*made, *way], start) for way in ways]
        common, reduced = min(shared, key=_cost)
        pending = [*common, *zip(divisors.values(), reduced, strict=False)]
        self._add_in_order(pending)
        return {
            name: self.let(name, expression)
            for name, expression in zip(named, reduced[len(made) :], strict=True)
        }

    def _next_x(self) -> int:
        return sum(1 for symbol, _ in self.lets if str(symbol).startswith("x"))

    def _add_in_order(self, pending: list[tuple[Any, Expr]]) -> None:
        """Appends assignments so that each stands after what it reads."""
        while pending:
            waiting = {symbol for symbol, _ in pending}
            ready = [item for item in pending if not item[1].free_symbols & waiting]
            self.lets.extend(ready)
            pending = [item for item in pending if item not in ready]

    def pruned(self) -> Program:
        """Without the assignments that no output needs."""
        needed = set().union(*(e.free_symbols for e in self.outputs.values()))
        lets: list[tuple[Any, Expr]] = []
        for symbol, expression in reversed(self.lets):
            if symbol in needed:
                lets.append((symbol, expression))
                needed |= expression.free_symbols
        return Program(lets[::-1], dict(self.outputs))

    def count(self) -> Count:
        """All operations."""
        expressions: Sequence[Expr] = [e for _, e in self.lets] + list(self.outputs.values())
        return sum((count(e) for e in expressions), Count())

    def symbols(self) -> set[str]:
        """Every name that is read."""
        expressions = [e for _, e in self.lets] + list(self.outputs.values())
        return {str(s) for e in expressions for s in e.free_symbols}

    def evaluate(self, values: Mapping[str, float]) -> dict[str, float]:
        """The outputs for given numbers of F, dF and the constants."""
        known: dict[Any, float] = {sp.Symbol(n, real=True): v for n, v in values.items()}

        def number(expression: Expr) -> float:
            return float(_evaluator(expression)(known))

        for symbol, expression in self.lets:
            known[symbol] = number(expression)
        return {target: number(expression) for target, expression in self.outputs.items()}


def _evaluator(expression: Expr) -> Callable[[Mapping[Any, float]], float]:
    import math

    scalar: dict[type, Callable[[float], float]] = {
        sp.log: math.log,
        sp.exp: math.exp,
        cube_root: lambda x: math.copysign(abs(x) ** (1 / 3), x),
        square_root: math.sqrt,
        positive: lambda x: max(x, 0.0),
        step: lambda x: float(x > 0.0),
    }

    def value(e: Expr, known: Mapping[Any, float]) -> float:
        if e.is_Symbol:
            return known[e]
        if e.is_number:
            return float(e)
        parts = [value(argument, known) for argument in e.args]
        if e.is_Add:
            return math.fsum(parts)
        if e.is_Mul:
            return math.prod(parts)
        return float(parts[0] ** parts[1]) if e.is_Pow else scalar[type(e)](*parts)

    return lambda known: value(expression, known)
