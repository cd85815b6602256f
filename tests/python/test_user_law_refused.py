"""Laws of one's own that cannot be used are refused when they are defined, with the reason."""

import re
import subprocess
import sys

import pytest

import tissu as ts

pytest.importorskip("sympy")

import sympy

from tissu.formula import I_C, C, F, Ibar1, J, Parameter, Requirement, exp, ln

mu, kappa, jm, beta = sympy.symbols("mu kappa jm beta")
VOLUME = kappa / 2 * (J - 1) ** 2
GOOD = mu / 2 * (Ibar1 - 3) + VOLUME
UNITS = {"mu": "Pa", "kappa": "Pa"}


def definition(**changes):
    return {"energy": GOOD, "parameters": UNITS} | changes


REFUSED = {
    "an energy at rest": (
        definition(energy=mu / 2 * (Ibar1 - 2.9) + VOLUME),
        r"the energy at rest is .* J/m3; subtract it",
    ),
    "a stress at rest": (
        definition(energy=GOOD + kappa * (J - 1)),
        r"the stress at rest is .* Pa; it must vanish at F = I",
    ),
    "a law that sees rotations": (
        definition(energy=mu * (F[0, 0] - 1) ** 2 + GOOD),
        r"the energy changes when the body turns",
    ),
    "a false declaration": (
        definition(frame_invariant=False),
        r"it is frame-invariant; do not declare the opposite",
    ),
    "an undeclared parameter": (
        definition(parameters={"mu": "Pa", "kapa": "Pa"}),
        r"uses 'kappa', which is not a parameter.*did you mean kapa\?",
    ),
    "a parameter that nothing uses": (
        definition(parameters=UNITS | {"jm": "1"}),
        r"nothing uses the parameter 'jm'; take it out",
    ),
    "a negative shear modulus": (
        definition(energy=-mu / 2 * (Ibar1 - 3) + VOLUME),
        r"shear modulus at rest is -\d+.* Pa.*both must be above 0",
    ),
    "no shear modulus": (
        definition(energy=VOLUME, parameters={"kappa": "Pa"}),
        r"shear modulus at rest is .* Pa.*both must be above 0",
    ),
    "no bulk modulus": (
        definition(energy=mu / 2 * (Ibar1 - 3), parameters={"mu": "Pa"}),
        r"the bulk modulus .* Pa; both must be above 0",
    ),
    "a stiffness in one direction only": (
        definition(energy=mu * (C[0, 0] - 1) ** 2, parameters={"mu": "Pa"}),
        r"a small strain has the stiffness .*; it must be above 0",
    ),
    "a unit that no elastic law has": (
        definition(parameters={"mu": "Pa", "kappa": "m"}),
        r"the parameter kappa is in 'm'; accepted are 'Pa' and '1'",
    ),
    "a modulus declared as a pure number": (
        definition(parameters={"mu": "Pa", "kappa": "1"}),
        r"the energy is not in Pa with mu in Pa, kappa in 1",
    ),
    "a product of moduli": (
        definition(energy=mu * kappa / 2 * (Ibar1 - 3) + VOLUME),
        r"the energy is not in Pa",
    ),
    "no modulus": (
        definition(energy=GOOD.subs({mu: 1000, kappa: 1000}), parameters={}),
        r"no parameter is in Pa",
    ),
    "a fibre without a direction": (
        definition(energy=GOOD + mu * (ts.formula.I4 - 1) ** 2),
        r"the energy has a fibre; add a0, a1, a2 to the constants",
    ),
    "a function that kernels lack": (
        definition(energy=GOOD + mu * sympy.sin(J - 1) ** 2),
        r"the energy uses sin, which kernels do not have; ln, exp",
    ),
    "a power that kernels lack": (
        definition(energy=mu * (J ** sympy.Rational(1, 5) - 1) ** 2 + GOOD),
        r"exponents are integers, halves or thirds",
    ),
    "a text": (definition(energy="mu / 2 * (I_C - 3)"), r"a SymPy expression is accepted"),
    "a tensor": (definition(energy=C), r"is the tensor C; take its trace"),
    "no expression": (definition(energy=[1, 2]), r"of type list; a SymPy expression is accepted"),
    "a word of the vocabulary as a parameter": (
        definition(parameters=UNITS | {"J": "1"}),
        r"called like a word of the vocabulary",
    ),
    "a word of C++ as a parameter": (
        definition(
            energy=sympy.Symbol("double") / 2 * (Ibar1 - 3) + VOLUME,
            parameters={"double": "Pa", "kappa": "Pa"},
        ),
        r"a constant cannot be called double",
    ),
    "a parameter called like a field": (
        definition(parameters=UNITS | {"fibres": "1"}),
        r"no parameter can be called 'fibres'",
    ),
    "an energy that is never a number": (
        definition(energy=mu * ln(-J) + VOLUME),
        r"not finite numbers near rest; give the parameters",
    ),
    "a typical value at which it locks": (
        definition(
            energy=-mu * jm / 2 * ln(1 - (Ibar1 - 3) / jm) + VOLUME,
            parameters=[
                Parameter(name="mu", unit="Pa", meaning="shear", typical=1e3),
                Parameter(name="jm", unit="1", meaning="where it locks", typical=1e-6),
                Parameter(name="kappa", unit="Pa", meaning="bulk", typical=1e3),
            ],
        ),
        r"not finite numbers near rest",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_wrong_laws_are_refused_with_the_reason(case):
    fields, reason = REFUSED[case]
    with pytest.raises(ts.LawError, match=reason) as caught:
        ts.law("wrong", **fields)
    assert str(caught.value).startswith("wrong: ")


@pytest.mark.parametrize("name", ["Gent", "gent-2", "_gent", "lambda", "2nd", "größe", ""])
def test_names_are_plain_words(name):
    with pytest.raises(ts.LawError, match="cannot name a law"):
        ts.law(name, **definition())


@pytest.mark.parametrize("name", ["neo_hooke", "fibre"])
def test_names_of_the_library_are_taken(name):
    with pytest.raises(ts.LawError, match="tissu has a law of this name"):
        ts.law(name, **definition())


@pytest.fixture(scope="module")
def bounded():
    return ts.law(
        "bounded",
        energy=mu / (2 * beta) * (exp(beta * (I_C - 3 - 2 * ln(J))) - 1) + kappa / 2 * ln(J) ** 2,
        parameters=[
            Parameter(name="mu", unit="Pa", meaning="shear modulus", typical=1e3, above=0.0),
            Parameter(
                name="beta", unit="1", meaning="how fast it stiffens", typical=1.5, above=0.0
            ),
            Parameter(
                name="kappa", unit="Pa", meaning="volume", typical=5e3, at_least=0.0, below=1e9
            ),
        ],
        requirements=[Requirement(10 * mu - kappa, "kappa", "at most ten times mu")],
    )


def test_parameters_are_fields_with_units_bounds_and_meanings(bounded):
    law = bounded(mu="1 kPa", beta=2, kappa="0.005 MPa")
    assert (law.mu, law.beta, law.kappa) == (1000.0, 2.0, 5000.0)
    assert law == bounded(mu=1000.0, beta=2.0, kappa=5000.0)
    assert law != bounded(mu=1001.0, beta=2.0, kappa=5000.0)
    good = {"mu": 1e3, "beta": 2.0, "kappa": 5e3}
    wrong = {
        r"mu: found '-1 kPa'; more than 0": good | {"mu": "-1 kPa"},
        r"kappa: found -1; at least 0": good | {"kappa": -1},
        r"kappa: found 1000000000.0; less than 1e\+09": good | {"kappa": 1e9},
        r"mu: found '1 mm', which is a length": good | {"mu": "1 mm"},
        r"beta: is missing: how fast it stiffens": {"mu": 1e3, "kappa": 5e3},
        r"kapa: unknown key; did you mean 'kappa'\?": good | {"kapa": 1.0},
        r"kappa is -5000; accepted is at most ten times mu": good | {"kappa": 1.5e4},
    }
    for reason, fields in wrong.items():
        with pytest.raises(ts.SceneError, match=reason):
            bounded(**fields)


def test_parameters_without_stiffness_at_rest_are_refused():
    law = ts.law("plain", **definition())
    with pytest.raises(ts.SceneError, match="found a shear modulus at rest of -5 Pa"):
        law(mu=-5.0, kappa=100.0)
    with pytest.raises(ts.SceneError, match="found a bulk modulus at rest of -1 Pa"):
        law(mu=5.0, kappa=-1.0)


def test_without_sympy_the_error_says_what_to_install():
    code = """
import sys
sys.modules["sympy"] = None
import tissu
for ask in (lambda: tissu.law("x", energy=0, parameters={}), lambda: tissu.formula.J,
            lambda: tissu.read_law("x.py")):
    try:
        ask()
    except tissu.LawError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert len(done.stdout.splitlines()) == 3
    for line in done.stdout.splitlines():
        assert re.search(r"^SymPy.* is not installed; run pip install 'tissu\[laws\]'\.$", line)


@pytest.mark.parametrize(
    ("stated", "reason"),
    [
        ("3", r"found SMALL_STRAIN = 3; two expressions .* are accepted"),
        ("(mu,)", r"found SMALL_STRAIN = \(mu,\); two expressions"),
        ("(0, 2 * mu)", r"SMALL_STRAIN gives lambda = 0, mu = 2000, but .*; state those"),
        ("(kappa - 2 * mu / 3, nu)", r"SMALL_STRAIN uses 'nu', which is not a parameter"),
        ("(kappa - 2 * mu / 3, mu)", None),
    ],
)
def test_a_stated_limit_that_is_not_that_of_the_energy_is_refused(tmp_path, stated, reason):
    file = tmp_path / "rubber.py"
    file.write_text(
        '"""A law of rubber."""\n'
        "import sympy\n"
        "from tissu.formula import Ibar1, J, Parameter, symbols_of\n"
        "PARAMETERS = (\n"
        '    Parameter(name="mu", unit="Pa", meaning="shear", typical=1000.0, above=0.0),\n'
        '    Parameter(name="kappa", unit="Pa", meaning="bulk", typical=9000.0, above=0.0),\n'
        ")\n"
        "mu, kappa = symbols_of(PARAMETERS)\n"
        "nu = sympy.Symbol('nu')\n"
        'CONSTANTS = {"mu": mu, "kappa": kappa}\n'
        "ENERGY = mu / 2 * (Ibar1 - 3) + kappa / 2 * (J - 1) ** 2\n"
        f"SMALL_STRAIN = {stated}\n"
    )
    if reason is None:
        assert ts.read_law(file).__name__
        return
    with pytest.raises(ts.LawError, match=reason):
        ts.read_law(file)
