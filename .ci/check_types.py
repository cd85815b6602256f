"""Checks that no two files define a type of one name in one namespace.

Templates of the standard library on such types would have one symbol for both, of which the linker
keeps either: the sizes of the other are wrong there, and no warning is given.
"""

import re
import sys
from collections import defaultdict

from check_arrows import ROOT, cpp_files

COMMENT = re.compile(r"//[^\n]*")
TOKEN = re.compile(
    r"namespace\s*(?P<space>[\w:]*)\s*\{"
    r"|\b(?:struct|class|enum|enum\s+class)\s+(?P<type>\w+)\s*(?:final\s*)?(?::(?!:)[^;{}()]*)?\{"
    r"|\{|\}"
)


def types_of(text: str) -> set[str]:
    """Full names of the types that a file defines, but for those of nameless namespaces."""
    found: set[str] = set()
    open_braces: list[str | None] = []
    for token in TOKEN.finditer(COMMENT.sub("", text)):
        if token[0] == "}":
            if open_braces:
                open_braces.pop()
            continue
        named = token["space"] if token[0].startswith("namespace") else None
        if token["type"] and None not in open_braces and "" not in open_braces:
            found.add("::".join([*map(str, open_braces), token["type"]]))
        open_braces.append(named)
    return found


def main() -> int:
    """Prints what is defined twice."""
    files = defaultdict(list)
    for _, path in cpp_files():
        for name in types_of(path.read_text(encoding="utf-8")):
            files[name].append(str(path.relative_to(ROOT)))
    twice = {name: paths for name, paths in sorted(files.items()) if len(paths) > 1}
    for name, paths in twice.items():
        print(f"types: {name} is defined in {' and '.join(paths)}; give one of them another name")
    if not twice:
        print("types: each is defined once")
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(main())
