"""Checks that every C++ source is named in the list that should build it (no glob)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# List -> folders whose .cpp files it must name, relative to the list's own folder.
LISTS = {
    "cpp/CMakeLists.txt": ["src"],
    "python/bind/CMakeLists.txt": ["."],
    "tests/CMakeLists.txt": ["cpp"],
    "bench/CMakeLists.txt": ["."],
}


def main() -> int:
    """Prints every source in no list; 1 when there is one."""
    problems = []
    for name, folders in LISTS.items():
        path = ROOT / name
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        named = set(re.findall(r"[\w./-]+\.cpp", text))
        for folder in folders:
            for source in sorted((path.parent / folder).rglob("*.cpp")):
                relative = source.relative_to(path.parent).as_posix()
                if relative not in named and "consumer" not in source.parts:
                    problems.append(f"{name} does not name {relative}")
    print("\n".join(problems) or "lists: complete")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
