"""Checks that what is shown type-checks under mypy --strict, and that wrong scenes do not.

README's example and every file of examples/ must pass; each line of WRONG must be refused: the
arguments of a part are those of its fields.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

WRONG = """\
ts.StVK(yung="5 kPa", young=1, poisson=0.3)
ts.StVK(young=None, poisson=0.3)
ts.StVK(poisson=0.3)
ts.Yeoh(c1="1 kPa", c2=[1], kappa="20 kPa")
ts.ImplicitEuler()
ts.ImplicitEuler("10 ms", solver=3)
ts.Box((None, 0, "2 cm"), 3)
ts.Sphere((0, 0, 0), "1 cm", 2)
ts.Fixed("liver", axes="xy")
ts.Prony(branches=[ts.Rayleigh(mass=1)])
ts.Scene(step=ts.Static(), gravity="9.81 m/s^2 down", thread=2)
"""


def errors_of(*files: Path) -> str:
    """What mypy says of the files, with the project's settings."""
    command = [sys.executable, "-m", "mypy", "--no-pretty", *map(str, files)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode else ""


def main() -> int:
    """Prints what is wrong; 1 when something is."""
    readme = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    assert readme is not None
    with tempfile.TemporaryDirectory() as folder:
        shown, wrong = Path(folder, "readme.py"), Path(folder, "wrong.py")
        shown.write_text(readme[1], encoding="utf-8")
        wrong.write_text(f"import tissu as ts\n{WRONG}", encoding="utf-8")
        problems = errors_of(shown, *sorted((ROOT / "examples").glob("*.py"))).splitlines()
        refused = {int(n) for n in re.findall(r"wrong\.py:(\d+): error", errors_of(wrong))}
    for number, line in enumerate(WRONG.splitlines(), start=2):
        if number not in refused:
            problems.append(f"mypy accepts {line}")
    print("\n".join(problems) or "examples: all typed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
