"""From a formula and parameters to a law of the scene: `tissu.law` and `tissu.read_law`.

SymPy is imported here only, when a law is defined: a scene without one does not need it.
"""

from __future__ import annotations

import keyword
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tissu.errors import LawError
from tissu.files.place import path_of
from tissu.scene.law import UserLaw
from tissu.scene.laws import built_in_names
from tissu.user_law.made import MadeLaw
from tissu.user_law.running import as_law_errors
from tissu.user_law.scene_class import scene_class

if TYPE_CHECKING:
    from tissu.codegen.definition import Law
    from tissu.codegen.vocabulary import Expr, Parameter, Requirement


def law(
    name: str,
    *,
    energy: Any,
    parameters: Mapping[str, str] | Sequence[Parameter],
    constants: Mapping[str, Any] | None = None,
    requirements: Sequence[Requirement] = (),
    text: str = "",
    frame_invariant: bool = True,
) -> type[UserLaw]:
    """A user-defined law from its energy density; compiled now, or taken from the cache.

    The stress P = dW/dF and the tangent dP/dF are derived from W, never given.

    Args:
        name: its `type` in a scene: small letters, digits and _.
        energy: W [J/m3], a SymPy expression in the words of `tissu.formula` (I_C, J, Ibar1,
            tr(E), F[0, 1], ln, exp, sqrt, positive, …) and the parameters' names.
        parameters: unit of each parameter, "Pa" or "1" for a pure number; or
            `tissu.formula.Parameter`s, which have a meaning, bounds and a typical value too.
        constants: expressions that the kernels store instead of parameters, to save work: name ->
            expression in the parameters. The energy may use both.
        requirements: conditions on several parameters, `tissu.formula.Requirement`s.
        text: what the law is for, its source and its limits; the class's documentation.
        frame_invariant: False only for an energy that is known to change when the body turns.

    Returns:
        A class: `Gent(mu="1 kPa", jm=5.0, kappa="20 kPa", fibres=None)` is a law of a Body.

    Raises:
        LawError: SymPy or a C++ compiler is missing; or the law cannot be used: energy or stress at
            rest, dependence on rotation, an unknown symbol, a parameter that nothing uses, an
            energy that is not in Pa, no stiffness at small strain.
    """
    _need_sympy()
    _check_name(name)
    from tissu.codegen import definition
    from tissu.user_law.formula import in_words

    listed, given = _parameters(name, parameters)
    _check_parameters(name, listed)
    written = in_words(energy, law=name, place="the energy")
    stored = {
        constant: in_words(expression, law=name, place=f"the constant {constant}")
        for constant, expression in (constants or {}).items()
    }
    known = [*(p.name for p in listed), *stored, *map(str, definition.VOCABULARY)]
    definition.refuse_unknown(name, "the energy", written.free_symbols, known)
    used = {str(symbol): symbol for symbol in written.free_symbols}
    direct = {p.name: used[p.name] for p in listed if p.name in used and p.name not in stored}
    made = definition.Law(
        name=name,
        class_name="Material",
        text="",
        formula=str(written),
        parameters=listed,
        constants={**direct, **stored},
        energy=written,
        small_strain=None,
        requirements=tuple(
            replace(
                r, expression=in_words(r.expression, law=name, place=f"the condition on {r.field}")
            )
            for r in requirements
        ),
        frame_invariant=frame_invariant,
    )
    definition.check_symbols(made)
    return _class_of(made, text=text, given=given, file=None)


def read_law(path: str | os.PathLike[str]) -> type[UserLaw]:
    """A user-defined law from a Python file of the form of tissu/codegen/laws; the file is run.

    Read the file before you run it: it can do anything that a program can.

    The name of the file is that of the law. PARAMETERS, CONSTANTS, ENERGY, a docstring and, if
    present, REQUIREMENTS and FRAME_INVARIANT are read. SMALL_STRAIN may be left out; if it is
    there, it must be the limit of the energy.

    Raises:
        LawError: the file cannot be read or run, or its law is refused; see `law`.
    """
    _need_sympy()
    file = path_of(path, "the path of a Python file with the formula of a law", error=LawError)
    if not file.is_file():
        raise LawError(
            f"{file}: no such file; a Python file with the formula of a law is accepted."
        )
    _check_name(file.stem)
    with as_law_errors(file):
        made, text = _law_of_file(file)
        return _class_of(made, text=text, given=True, file=file)


def _law_of_file(file: Path) -> tuple[Law, str]:
    """Runs the file: its law in the generator's words, and its documentation."""
    from tissu.codegen import definition
    from tissu.user_law.formula import in_words

    found = definition.read_law(file, limit=False)
    if found.addition:
        raise LawError(f"{file}: ADDITION = True; a law that stands alone is accepted.")
    _check_parameters(found.name, found.parameters)
    energy = in_words(found.energy, law=found.name, place="the energy")
    stored = {
        name: in_words(expression, law=found.name, place=f"the constant {name}")
        for name, expression in found.constants.items()
    }
    made = replace(
        found,
        class_name="Material",
        text="",
        formula=str(energy),
        energy=energy,
        constants=stored,
        small_strain=_stated(found),
    )
    return made, found.text


def _stated(law: Law) -> tuple[Expr, Expr] | None:
    """What SMALL_STRAIN of a file states, in the generator's words."""
    from tissu.codegen.definition import refuse_unknown
    from tissu.user_law.formula import in_words

    if law.small_strain is None:
        return None
    lam, mu = (in_words(e, law=law.name, place="SMALL_STRAIN") for e in law.small_strain)
    refuse_unknown(law.name, "SMALL_STRAIN", lam.free_symbols | mu.free_symbols, law.constants)
    return lam, mu


def law_from_record(record: Mapping[str, Any]) -> type[UserLaw]:
    """The law that a summary records, made again from its formula.

    Its digest is the recorded one, where generator and SymPy have the same version.

    Raises:
        LawError: as `law`.
    """
    _need_sympy()
    import sympy as sp

    from tissu.codegen.definition import VOCABULARY
    from tissu.codegen.vocabulary import F, Parameter, Requirement, positive

    parameters = [Parameter(**fields) for fields in record["parameters"]]
    names = [p.name for p in parameters] + list(record["constants"])
    words = {str(symbol): symbol for symbol in (*VOCABULARY, *F.components)}
    words["positive"] = positive
    words |= {name: sp.Symbol(name, real=True) for name in names}

    def read(text: str) -> Any:
        return _read_formula(text, words)

    return law(
        record["name"],
        energy=read(record["formula"]),
        parameters=parameters,
        constants={name: read(text) for name, text in record["constants"].items()},
        requirements=[
            Requirement(read(r["expression"]), r["field"], r["accepted"])
            for r in record["requirements"]
        ],
        frame_invariant=record["frame_invariant"],
    )


def _read_formula(text: str, words: Mapping[str, Any]) -> Any:
    """The expression that a record's text stands for: arithmetic on known words, nothing else.

    Raises:
        LawError: another word, or what is not arithmetic.
    """
    import sympy as sp
    from sympy.parsing.sympy_parser import parse_expr, standard_transformations

    known = {f"w_{name}": word for name, word in words.items()}
    known |= {f"w_{f}": getattr(sp, f) for f in ("log", "exp", "sqrt", "Rational")}
    renamed = re.sub(r"(?<![\w.])[A-Za-z_]\w*", lambda match: f"w_{match[0]}", text)
    unknown = sorted(set(re.findall(r"w_\w+", renamed)) - set(known))
    if unknown or not re.fullmatch(r"[\w\s.+\-*/(),]*", text):
        found = unknown[0][2:] if unknown else text
        raise LawError(
            f"found '{found}' in the formula of a record; arithmetic on its constants is accepted"
        )
    try:
        return parse_expr(
            renamed,
            local_dict=known,
            global_dict={"Integer": sp.Integer, "Float": sp.Float, "Symbol": sp.Symbol},
            transformations=standard_transformations,
        )
    except (SyntaxError, TypeError, ValueError) as error:
        raise LawError(
            f"found '{text}' as the formula of a record; it is not arithmetic: {error}"
        ) from None


def _need_sympy() -> None:
    try:
        import sympy  # noqa: F401
    except ImportError:
        raise LawError(
            "SymPy, which derives stress and tangent from an energy, is not installed; run "
            "pip install 'tissu[laws]'."
        ) from None


def _check_name(name: object) -> None:
    if not isinstance(name, str):
        raise LawError(f"found {name!r} as the name of a law; a text is accepted, such as 'gent'.")
    plain = name.isidentifier() and name.isascii() and name == name.lower()
    if not plain or name.startswith("_") or keyword.iskeyword(name) or len(name) > 60:
        raise LawError(
            f"{name!r} cannot name a law; small letters, digits and _ are accepted, a letter first."
        )
    if name in built_in_names():
        raise LawError(f"{name}: tissu has a law of this name; choose another one.")


def _parameters(
    name: str, given: Mapping[str, str] | Sequence[Parameter]
) -> tuple[tuple[Parameter, ...], bool]:
    """The parameters, and whether they came with typical values."""
    from tissu.codegen.vocabulary import Parameter

    if isinstance(given, Mapping):
        units = {str(parameter): str(unit) for parameter, unit in given.items()}
        made = tuple(
            Parameter(name=n, unit=u or "1", meaning="", typical=1.0) for n, u in units.items()
        )
        return made, False
    listed = tuple(given)
    for item in listed:
        if not isinstance(item, Parameter):
            raise LawError(
                f"{name}: found {item!r} among the parameters; a mapping of names to units, or "
                "tissu.formula.Parameter, is accepted."
            )
    return listed, True


def _check_parameters(law: str, parameters: Sequence[Parameter]) -> None:
    from tissu.codegen.definition import VOCABULARY

    words = {str(symbol) for symbol in VOCABULARY}
    if not any(p.unit == "Pa" for p in parameters):
        raise LawError(f"{law}: no parameter is in Pa; an energy density needs at least one.")
    for number, p in enumerate(parameters):
        if p.name in words:
            raise LawError(
                f"{law}: the parameter {p.name} is called like a word of the vocabulary; "
                "choose another name."
            )
        if p.name in {other.name for other in parameters[:number]}:
            raise LawError(f"{law}: the parameter {p.name} is given twice; take one out.")
        taken = not p.name.isidentifier() or keyword.iskeyword(p.name) or hasattr(UserLaw, p.name)
        if taken or p.name.startswith("_") or p.name in UserLaw.model_fields:
            raise LawError(f"{law}: no parameter can be called {p.name!r}; choose another name.")


def _class_of(law: Law, *, text: str, given: bool, file: Path | None) -> type[UserLaw]:
    """Checks the law, compiles it, and makes its class."""
    from tissu.user_law.checks import checked
    from tissu.user_law.source import library_source

    law = checked(law, given=given)
    made = MadeLaw(law, library_source(law), file)
    made.build()
    return scene_class(made, text or f"W = {law.energy}")
