"""The generator of laws: the C++ is what the formulae give, its derivatives are right."""

import re
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("sympy")

import sympy as sp

from tissu.codegen import __main__ as codegen
from tissu.codegen import cpp, definition, kernels
from tissu.codegen.checks import Point, check_law, random_rotation
from tissu.codegen.definition import Law, read_laws
from tissu.scene.generated.laws import LAWS as SCENE_LAWS
from tissu.scene.part import type_name

ROOT = Path(__file__).resolve().parents[2]
LAWS = {law.name: law for law in read_laws()}
NAMES = sorted(LAWS)

# Multiplications + additions of St-Venant–Kirchhoff as one writes it by hand: E, S, P = F S; dP
# = dF S + F dS; A_iJkL entry by entry. The generator must not be worse.
BY_HAND = {"energy": 58, "stress": 97, "stress_change": 215, "tangent": 277}


def cost(law: Law, question: str) -> int:
    made = cpp.QUESTIONS[question](law.energy).count()
    return made.multiplications + made.additions


def has_formatter() -> bool:
    try:
        return bool(cpp.formatter())
    except cpp.LawError:
        return False


@pytest.mark.skipif(not has_formatter(), reason="clang-format is not installed")
@pytest.mark.skipif(not (ROOT / "cpp").exists(), reason="not in a checkout")
def test_generated_files_are_current(capsys: pytest.CaptureFixture[str]) -> None:
    code = codegen.main(["--check", "--root", str(ROOT)])
    assert code == 0, capsys.readouterr().out


def test_the_laws_of_the_library() -> None:
    """A file is a law: those of ORDER first, additions last; scenes have a class for the others."""
    bases = [name for name, law in LAWS.items() if not law.addition]
    assert list(LAWS) == [*bases, *(name for name, law in LAWS.items() if law.addition)]
    assert tuple(bases[: len(definition.ORDER)]) == definition.ORDER
    assert set(LAWS) == {path.stem for path in definition.LAWS.glob("[a-z]*.py")}
    assert [type_name(cls) for cls in SCENE_LAWS] == bases


@pytest.mark.parametrize("name", [name for name in NAMES if not LAWS[name].addition])
def test_the_class_of_a_scene_knows_lames_constants_at_rest(name: str) -> None:
    """As the formula's SMALL_STRAIN gives them; to 1e-12, the round-off of another order."""
    law, cls = LAWS[name], next(cls for cls in SCENE_LAWS if type_name(cls) == name)
    values = {p.name: p.typical for p in law.parameters}
    constants = law.constant_values(values)
    known = {sp.Symbol(n, real=True): v for n, v in constants.items()}
    assert law.small_strain is not None
    wanted = [float(sp.sympify(e).subs(known)) for e in law.small_strain]
    assert cls(**values).small_strain() == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_every_law_is_accepted(name: str) -> None:
    check_law(LAWS[name])


@pytest.mark.parametrize("name", NAMES)
def test_text_is_the_same_twice_and_has_no_power(name: str) -> None:
    text = cpp.header(LAWS[name])
    assert text == cpp.header(LAWS[name])
    assert "pow(" not in text and "Pow" not in text
    assert f"W = {LAWS[name].formula}" in text


@pytest.mark.parametrize("question", BY_HAND)
def test_stvk_costs_no_more_than_by_hand(question: str) -> None:
    assert cost(LAWS["stvk"], question) <= BY_HAND[question]


@pytest.mark.parametrize("name", NAMES)
def test_counts_in_the_banner_are_those_of_the_text(name: str) -> None:
    """Every * and binary + or - of the printed function, counted in the text itself."""
    law = LAWS[name]
    for question, make in cpp.QUESTIONS.items():
        program = make(law.energy)
        texts = [cpp.printed(e) for _, e in program.lets]
        texts += [cpp.printed(e) for e in program.outputs.values()]
        joined = "\n".join(re.sub(r"T\([^)]*\)|F\(\d, \d\)", "n", text) for text in texts)
        made = program.count()
        assert joined.count(" * ") == made.multiplications, question
        assert joined.count(" + ") + joined.count(" - ") == made.additions, question
        assert joined.count(" / ") == made.divisions, question


@pytest.mark.parametrize("name", NAMES)
def test_derivatives_are_those_of_the_energy(name: str) -> None:
    point = Point(LAWS[name])
    generator = np.random.default_rng(5)
    F = random_rotation(generator) @ np.diag([1.3, 1.2, 0.9]) @ random_rotation(generator)
    dF = generator.uniform(-1, 1, (3, 3))
    h = 1e-4
    A = point.tangent(F)
    scale = abs(A).max()
    slope = (point.energy(F + h * dF) - point.energy(F - h * dF)) / (2 * h)
    assert np.sum(point.stress(F) * dF) == pytest.approx(slope, abs=1e-6 * scale)
    change = (point.stress(F + h * dF) - point.stress(F - h * dF)) / (2 * h)
    np.testing.assert_allclose(point.stress_change(F, dF), change, atol=1e-6 * scale)
    np.testing.assert_allclose((A @ dF.ravel()).reshape(3, 3), change, atol=1e-6 * scale)


def test_energy_in_components_gives_the_same_law() -> None:
    """C[i, j] in place of an invariant: differentiated as it stands, to the same numbers."""
    from dataclasses import replace

    from tissu.codegen.vocabulary import I_C, C

    law = LAWS["neo_hooke"]
    trace = C[0, 0] + C[1, 1] + C[2, 2]
    other = replace(law, energy=law.energy.subs(I_C, trace))
    assert kernels.derive.has_components(other.energy)
    F = np.eye(3) + np.random.default_rng(2).uniform(-0.2, 0.2, (3, 3))
    one, two = Point(law), Point(other)
    np.testing.assert_allclose(one.stress(F), two.stress(F), rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(one.tangent(F), two.tangent(F), rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(
        one.stress_change(F, F), two.stress_change(F, F), rtol=1e-12, atol=1e-9
    )
    check_law(other)
