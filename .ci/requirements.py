"""Prints the requirements of pyproject.toml, one a line: `requirements.py [build] [EXTRA ...]`.

The package's own dependencies are always printed; `build` adds what builds it.
"""

import sys
from pathlib import Path
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:  # pip brings a copy of the same parser
    from pip._vendor import tomli as tomllib


def requirements(groups: list[str]) -> list[str]:
    """Collects the requirements of the package and of the named groups."""
    path = Path(__file__).resolve().parent.parent / "pyproject.toml"
    text: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    found: list[str] = list(text["project"]["dependencies"])
    for group in groups:
        if group == "build":
            # Eigen comes from the machine; .ci/setup.sh asks for cmeel-eigen where it cannot.
            wanted = text["build-system"]["requires"]
            found += [name for name in wanted if not name.startswith("cmeel")]
        else:
            found += text["project"]["optional-dependencies"][group]
    return found


if __name__ == "__main__":
    print("\n".join(requirements(sys.argv[1:])))
