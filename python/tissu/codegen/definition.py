"""A law as its file defines it.

In: the path of a file. Out: a Law, every word of which is known.
"""

from __future__ import annotations

import ast
import difflib
import reprlib
import runpy
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import sympy as sp

from tissu.codegen import vocabulary as words
from tissu.codegen.vocabulary import Expr, Parameter, Requirement
from tissu.errors import LawError

LAWS = Path(__file__).parent / "laws"
VOCABULARY = frozenset(
    [
        words.I_C,
        words.II_C,
        words.J,
        words.Ibar1,
        words.Ibar2,
        words.Ibar4,
        words.I4,
        words.tr_C2,
        words.tr_E,
        words.tr_E2,
        words.tr_eps,
        words.tr_eps2,
        *words.F.components,
        *words.a,
    ]
)
# The first laws of every list, in the order in which a reader meets them.
ORDER = ("hooke", "stvk", "neo_hooke", "stable_neo_hooke", "mooney_rivlin", "yeoh", "arruda_boyce")
_KNOWN = {
    "PARAMETERS",
    "CONSTANTS",
    "ENERGY",
    "SMALL_STRAIN",
    "REQUIREMENTS",
    "FRAME_INVARIANT",
    "ADDITION",
    "CLASS",
}


@dataclass(frozen=True, kw_only=True)
class Law:
    """One energy density and what it needs.

    Attributes:
        name: as in a scene, snake_case.
        class_name: of the C++ template.
        text: the docstring of the file: source and limits.
        formula: the energy as its file writes it.
        parameters: what the user gives.
        constants: what the kernels store: name -> expression in the parameters.
        energy: W [J/m3] in the vocabulary and the constants.
        small_strain: Lamé's constants at rest in the constants; None for an addition.
        requirements: conditions on several parameters.
        frame_invariant: False only where the law is known not to be.
        addition: to be added to a base law, zero stiffness at rest in some directions.
    """

    name: str
    class_name: str
    text: str
    formula: str
    parameters: tuple[Parameter, ...]
    constants: Mapping[str, Expr]
    energy: Expr
    small_strain: tuple[Expr, Expr] | None
    requirements: tuple[Requirement, ...] = ()
    frame_invariant: bool = True
    addition: bool = False

    def constant_values(self, values: Mapping[str, float]) -> dict[str, float]:
        """The constants of given parameters."""
        known = {p.name: sp.Float(values[p.name], 30) for p in self.parameters}
        for name, expression in self.constants.items():
            # A constant named as a parameter means the parameter in its own expression.
            table = {sp.Symbol(n, real=True): v for n, v in known.items()}
            known[name] = sp.N(sp.sympify(expression).subs(table), 30)
        return {name: float(known[name]) for name in self.constants}


def refuse_unknown(law: str, place: str, used: Iterable[Expr], known: Iterable[str]) -> None:
    """Refuses the first symbol that is not declared."""
    names = sorted(known)
    for symbol in sorted(used, key=str):
        if str(symbol) not in names:
            near = difflib.get_close_matches(str(symbol), names, n=1)
            hint = f"; did you mean {near[0]}?" if near else f"; known: {', '.join(names)}."
            raise LawError(
                f"{law}: {place} uses '{symbol}', which is not a parameter, constant or word of "
                f"the vocabulary{hint}"
            )


def check_symbols(law: Law) -> None:
    """Refuses undeclared symbols and parameters that nothing uses."""
    parameters = [p.name for p in law.parameters]
    known, used = list(parameters), {str(s) for s in law.energy.free_symbols}
    for name, expression in law.constants.items():
        symbols = sp.sympify(expression).free_symbols
        refuse_unknown(law.name, f"the constant {name}", symbols, known)
        if name in parameters and str(expression) != name:
            raise LawError(
                f"{law.name}: the constant {name} is not the parameter {name}; rename it."
            )
        known.append(name)
        used |= {str(s) for s in symbols}
    allowed = [*law.constants, *map(str, VOCABULARY)]
    refuse_unknown(law.name, "the energy", law.energy.free_symbols, allowed)
    for requirement in law.requirements:
        used |= {str(s) for s in requirement.expression.free_symbols}
    for name in parameters:
        if name not in used:
            raise LawError(f"{law.name}: nothing uses the parameter '{name}'; take it out.")
    along = law.energy.free_symbols & {words.I4, words.Ibar4, *words.a}
    if along and not {"a0", "a1", "a2"} <= set(law.constants):
        raise LawError(f"{law.name}: the energy has a fibre; add a0, a1, a2 to the constants.")


def _formula(path: Path) -> str:
    """The text of ENERGY."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "ENERGY":
            return ast.unparse(node.value)
    return ""


def _made(name: str, formula: str, found: Mapping[str, Any], *, limit: bool) -> Law:
    for needed in ("PARAMETERS", "CONSTANTS", "ENERGY"):
        if needed not in found:
            raise LawError(f"{name}: the file has no {needed}.")
    for key in found:
        if key.isupper() and key not in _KNOWN:
            near = difflib.get_close_matches(key, sorted(_KNOWN), n=1, cutoff=0.8)
            if near:
                raise LawError(f"{name}: {key} is not read; did you mean {near[0]}?")
    addition = bool(found.get("ADDITION", False))
    small_strain = found.get("SMALL_STRAIN")
    if limit and small_strain is None and not addition:
        raise LawError(f"{name}: SMALL_STRAIN = (lambda, mu) is missing.")
    if not str(found.get("__doc__") or "").strip():
        raise LawError(f"{name}: the file has no docstring; give the law's source and limits.")
    return Law(
        name=name,
        class_name=found.get("CLASS") or "".join(part.capitalize() for part in name.split("_")),
        formula=formula,
        text=str(found["__doc__"]).strip(),
        parameters=tuple(found["PARAMETERS"]),
        constants=dict(found["CONSTANTS"]),
        energy=sp.sympify(found["ENERGY"]),
        small_strain=None if small_strain is None else _two(name, small_strain),
        requirements=tuple(found.get("REQUIREMENTS", ())),
        frame_invariant=bool(found.get("FRAME_INVARIANT", True)),
        addition=addition,
    )


def _two(name: str, small_strain: object) -> tuple[Expr, Expr]:
    try:
        lam, mu = (sp.sympify(constant) for constant in small_strain)  # type: ignore[attr-defined]
        if isinstance(lam, sp.Expr) and isinstance(mu, sp.Expr):
            return lam, mu
    except (TypeError, ValueError, sp.SympifyError):
        pass
    raise LawError(
        f"{name}: found SMALL_STRAIN = {reprlib.repr(small_strain)}; two expressions in the "
        "constants are accepted, Lamé's lambda and mu at rest: (lambda, mu); or leave it out."
    )


def read_law(path: Path, *, limit: bool = True) -> Law:
    """The law of one file.

    limit: SMALL_STRAIN must be there.

    Raises:
        LawError: a part is missing, or a symbol is not declared.
    """
    if not path.stem.isidentifier() or not path.stem.islower():
        raise LawError(f"{path.name}: the file's name is the law's: small letters, digits and _.")
    law = _made(path.stem, _formula(path), runpy.run_path(str(path)), limit=limit)
    check_symbols(law)
    return law


def read_laws(folder: Path = LAWS) -> list[Law]:
    """Every law of a folder: those of ORDER first, additions last, the rest by name."""
    laws = [read_law(p) for p in folder.glob("*.py") if not p.stem.startswith("_")]

    def place(law: Law) -> tuple[bool, int, str]:
        return law.addition, ORDER.index(law.name) if law.name in ORDER else len(ORDER), law.name

    return sorted(laws, key=place)
