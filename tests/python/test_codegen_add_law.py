"""A law is added as CONTRIBUTING.md says; wrong ones are refused, with the reason."""

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("sympy")

from tissu.codegen import __main__ as codegen
from tissu.codegen.checks import check_law
from tissu.codegen.cpp import LawError, formatter
from tissu.codegen.definition import LAWS, read_law
from tissu.errors import SceneError

ROOT = Path(__file__).resolve().parents[2]


def documented_law() -> str:
    """The text of CONTRIBUTING.md, so that what is shown is what works."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    return text.split("```python\n")[1].split("```")[0]


GENT = documented_law()

DERIVATIVES = r"""
#include <cmath>
#include <cstdio>
#include "tissu/law/generated/all.h"
#include "tissu/law/law.h"
#include "tissu/law/law_info.h"

static_assert(tissu::Law<tissu::Gent>);

int main() {
  const tissu::LawInfo* none = nullptr;
  (void)none;
  const tissu::Gent<double> law{1000.0, 5.0, 20000.0};
  tissu::Tensor2<double> F{{{1.2, 0.1, -0.2}, {0.05, 0.9, 0.15}, {-0.1, 0.2, 1.1}}};
  const tissu::Tensor2<double> P = law.stress(F);
  const tissu::Tangent<double> A = law.tangent(F);
  const double h = 1e-5;
  double worst = 0.0;
  for (int c = 0; c < 9; ++c) {
    tissu::Tensor2<double> forward = F, back = F, dF{};
    forward(c / 3, c % 3) += h;
    back(c / 3, c % 3) -= h;
    dF(c / 3, c % 3) = 1.0;
    const double slope = (law.energy(forward) - law.energy(back)) / (2.0 * h);
    worst = std::fmax(worst, std::fabs(slope - P(c / 3, c % 3)));
    const tissu::Tensor2<double> dP = law.stress_change(F, dF);
    for (int r = 0; r < 9; ++r) {
      const int i = r / 3, j = r % 3;
      const double change = (law.stress(forward)(i, j) - law.stress(back)(i, j)) / (2.0 * h);
      worst = std::fmax(worst, std::fabs(change - A(i, j, c / 3, c % 3)));
      worst = std::fmax(worst, std::fabs(change - dP(i, j)));
    }
  }
  std::printf("%.3g\n", worst);
  return worst < 1e-4 ? 0 : 1;  // of a stiffness of 2e4, by differences of second order
}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library's laws and one more."""
    laws = tmp_path_factory.mktemp("codegen") / "laws"
    shutil.copytree(LAWS, laws, ignore=shutil.ignore_patterns("__pycache__"))
    (laws / "gent.py").write_text(GENT, encoding="utf-8")
    return laws


@pytest.fixture(scope="module")
def made(folder: Path) -> Path:
    """The C++ of that folder."""
    try:
        formatter()
    except LawError as error:
        pytest.skip(str(error))
    root = folder.parent / "project"
    assert codegen.main(["--update", "--laws", str(folder), "--root", str(root)]) == 0
    return root


def test_a_new_law_joins_every_list(made: Path) -> None:
    listed = (made / "cpp/include/tissu/law/generated/all.h").read_text(encoding="utf-8")
    table = (made / "cpp/src/law/generated/laws.cpp").read_text(encoding="utf-8")
    names = re.search(r"AllLaws\s*=\s*LawList<([^>]*)>", listed)
    assert names is not None
    assert names[1].replace("\n", " ").split(",")[-2:] == [" Gent", " Fibre"]
    assert '"jm", "1"' in table


def test_a_new_law_is_a_class_of_scenes_with_the_units_of_its_formula(
    made: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    spec = importlib.util.spec_from_file_location("laws_with_gent", made / codegen.SCENE)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    gent = module.Gent(mu="1 kPa", jm=30, kappa=2e4)
    assert gent.words() == "gent with mu 1000 Pa, jm 30, kappa 20000 Pa"
    assert gent.small_strain() == (2e4 - 2000 / 3, 1000)
    with pytest.raises(SceneError, match="jm: found '30 Pa', which is a pressure"):
        module.Gent(mu=1000, jm="30 Pa", kappa=2e4)
    assert "Gent" in module.__all__


def test_a_new_law_compiles_and_its_derivatives_are_right(made: Path, tmp_path: Path) -> None:
    compiler = shutil.which("g++") or shutil.which("c++")
    if compiler is None or not (ROOT / "cpp").exists():
        pytest.skip("no C++ compiler, or not in a checkout")
    source, binary = tmp_path / "gent.cpp", tmp_path / "gent"
    source.write_text(DERIVATIVES, encoding="utf-8")
    includes = ["-I", str(made / "cpp/include"), "-I", str(ROOT / "cpp/include")]
    flags = ["-std=c++20", "-Wall", "-Wextra", "-Wconversion", "-Werror"]
    table = made / "cpp/src/law/generated/laws.cpp"
    subprocess.run([compiler, *flags, "-fsyntax-only", *includes, str(table)], check=True)
    subprocess.run([compiler, *flags, *includes, str(source), "-o", str(binary)], check=True)
    done = subprocess.run([str(binary)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"largest error of a derivative: {done.stdout}"


def test_a_stale_file_is_named(
    made: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["--check", "--laws", str(folder), "--root", str(made)]
    assert codegen.main(arguments) == 0
    header = made / "cpp/include/tissu/law/generated/gent.h"
    text = header.read_text(encoding="utf-8")
    try:
        header.write_text(text.replace("jm", "jn", 1), encoding="utf-8")
        capsys.readouterr()
        assert codegen.main(arguments) == 1
        said = capsys.readouterr().out
        assert "generated/gent.h is not what the formulae give" in said
        assert "make codegen" in said
    finally:
        header.write_text(text, encoding="utf-8")


REFUSED = {
    "an energy at rest": ("(Ibar1 - 3) / jm)", "(Ibar1 - 2.9) / jm)", r"energy at rest is .*J/m3"),
    "a stress at rest": ("(J - 1) ** 2", "((J - 1) ** 2 + (J - 1))", r"stress at rest is .* Pa"),
    "an undeclared parameter": ("kappa / 2", "kapa / 2", r"uses 'kapa'.*did you mean kappa"),
    "an unused parameter": ("kappa / 2 * (J", "mu / 2 * (J", r"uses the parameter 'kappa'|SMALL"),
    "a wrong limit": ("mu / 3, mu)", "mu / 3, 2 * mu)", r"SMALL_STRAIN gives .* mu = 2000"),
    "no source": ('"""Gent', 'WORDS = """Gent', r"no docstring"),
    "no constants": ("CONSTANTS", "CONSTANT", r"no CONSTANTS"),
    "no limit": ("SMALL_STRAIN", "SMALL", r"SMALL_STRAIN = \(lambda, mu\) is missing"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_wrong_laws_are_refused_with_the_reason(case: str, tmp_path: Path) -> None:
    good, bad, reason = REFUSED[case]
    assert good in GENT
    text = GENT.replace(good, bad)
    if "kapa" in bad:
        text += "\n"
        text = text.replace(
            "CONSTANTS =", "from sympy import Symbol\nkapa = Symbol('kapa')\nCONSTANTS ="
        )
    path = tmp_path / "gent.py"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LawError, match=reason) as caught:
        check_law(read_law(path))
    assert str(caught.value).startswith("gent: ")


def test_a_law_that_sees_rotations_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cubic.py"
    text = (LAWS / "hooke.py").read_text(encoding="utf-8")
    path.write_text(text.replace("FRAME_INVARIANT = False", ""), encoding="utf-8")
    with pytest.raises(LawError, match="energy changes when the body turns"):
        check_law(read_law(path))
    stvk = (LAWS / "stvk.py").read_text(encoding="utf-8")
    path.write_text(stvk + "\nFRAME_INVARIANT = False\n", encoding="utf-8")
    with pytest.raises(LawError, match="it is frame-invariant"):
        check_law(read_law(path))


def test_names_that_cannot_be_cpp_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "gent.py").write_text(GENT.replace("jm", "J_23"), encoding="utf-8")
    code = codegen.main(["--update", "--laws", str(tmp_path), "--root", str(tmp_path / "project")])
    assert code == 2
    assert "J_23" in capsys.readouterr().err
    with pytest.raises(LawError, match="small letters"):
        read_law(tmp_path / "Gent-2.py")
