"""The text of a scene as data with the line of every field; in bounded time, whatever the text is.

The words are those of YAML 1.2's core: `on`, `yes`, `off` are texts, 010 is ten, and 1e-6 is a
number (YAML 1.1 says otherwise). Tags of other types, aliases that blow up, deep nesting and
characters that no text has are refused with their line.
"""

from __future__ import annotations

import math
import re
import unicodedata
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tissu.errors import SceneError
from tissu.files.place import kind_of_place, reason_of
from tissu.scene.problem import Path as FieldPath
from tissu.scene.problem import Problem, Source

if TYPE_CHECKING:
    import yaml

_TAG = "tag:yaml.org,2002:"
_WORDS = {
    "bool": (r"true|True|TRUE|false|False|FALSE", "tTfF"),
    "float": (
        r"[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)",
        "-+.0123456789",
    ),
    "int": (r"[-+]?\d+", "-+0123456789"),
    "null": (r"~|null|Null|NULL|", "~nN\0"),
    "merge": (r"<<", "<"),
}
_LARGEST = 16 * 2**20  # characters of a scene
_DEEPEST = 40  # levels of nesting
_REPEATED = 100_000  # nodes that aliases repeat
_LONGEST = 4096  # characters of one text
_LONGEST_KEY = 200
_LONGEST_NUMBER = 400  # digits


def scene_file_text(path: Path) -> str:
    """The text of a scene file.

    Raises:
        SceneError: it is not a regular file, cannot be read, or is not text in UTF-8.
    """
    try:
        kind = kind_of_place(path)
        if kind not in ("a file", "nothing", "a folder"):
            raise SceneError([f"{path}: found {kind}; a YAML file is accepted"])
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise SceneError([f"{path}: not a text in UTF-8; a YAML scene is accepted"]) from None
    except (OSError, ValueError) as error:
        why = reason_of(error)
        raise SceneError([f"{path}: the scene file cannot be read: {why}"]) from None


def load(text: str, name: str) -> tuple[Any, Source, list[Problem]]:
    """Data, lines of all fields, and keys that are written twice.

    Raises:
        SceneError: not YAML, or more of it than a scene has; says in which line.
    """
    import yaml

    if len(text) > _LARGEST:
        found = f"found {len(text)} characters; at most {_LARGEST} are accepted"
        raise SceneError([f"{name}: {found}: put long lists into a mesh or a file of their own"])
    loader = None
    try:
        loader = _loader()(text)
        node = loader.get_single_node()
        if node is None:
            return None, Source(name), []
        walk = _Walk()
        walk.look(node, ())
        return loader.construct_document(node), Source(name, walk.lines), walk.problems
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        found = f"found the character U+{error.character:04X}, which no text of YAML has"
        raise SceneError([f"{name}:{line}: not valid YAML: {found}"]) from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark is not None else 1
        said = error.problem or error.context or ""
        if said.startswith("but ") and error.context:
            said = f"{error.context}, {said}"
        said = " ".join(said.split())
        raise SceneError([f"{name}:{line}: not valid YAML: {said}"]) from None
    except (yaml.YAMLError, ValueError, TypeError) as error:
        said = " ".join(str(error).split())
        raise SceneError([f"{name}:1: not valid YAML: {said}"]) from None
    finally:
        if loader is not None:
            loader.dispose()


class _Walk:
    """Notes the line of each field, and keys given twice.

    Attributes:
        lines: of the fields.
        problems: keys given twice.
    """

    def __init__(self) -> None:
        self.lines: dict[FieldPath, int] = {}
        self.problems: list[Problem] = []
        self._above: set[int] = set()
        self._seen: set[int] = set()
        self._repeated = 0

    def look(self, node: yaml.Node, path: FieldPath) -> None:
        """A node, and all below it as often as aliases name them."""
        if id(node) in self._above:
            raise refused(node, "an alias that contains itself")
        self._repeated += id(node) in self._seen
        if self._repeated > _REPEATED:
            text = f"aliases that repeat more than {_REPEATED} values; write fewer of them"
            raise refused(node, text)
        self._seen.add(id(node))
        self._above.add(id(node))
        self.lines.setdefault(path, node.start_mark.line + 1)
        self._look_below(node, path)
        self._above.discard(id(node))

    def _look_below(self, node: yaml.Node, path: FieldPath) -> None:
        import yaml

        if isinstance(node, yaml.SequenceNode):
            for number, item in enumerate(node.value):
                self.look(item, (*path, number))
        elif isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                if not isinstance(key, yaml.ScalarNode):
                    raise refused(key, "found a list or a mapping as a key; a word is accepted")
                if len(key.value) > _LONGEST_KEY:
                    text = f"found a key of {len(key.value)} characters; at most {_LONGEST_KEY}"
                    raise refused(key, f"{text} are accepted")
                inner = (*path, str(key.value))
                if inner in self.lines:
                    text = f"written twice, first in line {self.lines[inner]}; keep one of them"
                    self.problems.append(Problem(inner, text))
                self.lines[inner] = key.start_mark.line + 1
                self.look(value, inner)


def refused(node: yaml.Node, text: str) -> yaml.MarkedYAMLError:
    """The error of a node that a scene does not have."""
    import yaml

    return yaml.constructor.ConstructorError(None, None, text, node.start_mark)


@lru_cache(maxsize=1)
def _loader() -> type[yaml.SafeLoader]:
    import yaml

    class Loader(yaml.SafeLoader):
        """SafeLoader with the words of YAML 1.2, and with bounds."""

        _depth = 0

        def compose_node(self, parent: Any, index: Any) -> Any:
            self._depth += 1
            if self._depth > _DEEPEST:
                mark = self.peek_event().start_mark  # type: ignore[no-untyped-call]
                text = f"found more than {_DEEPEST} levels of nesting; a scene has fewer"
                raise yaml.composer.ComposerError(None, None, text, mark)
            node = super().compose_node(parent, index)
            self._depth -= 1
            return node

    Loader.yaml_implicit_resolvers = {}
    add_words(Loader)
    tags = (f"{_TAG}seq", f"{_TAG}map", None)  # None: what every other tag comes to
    Loader.yaml_constructors = {tag: Loader.yaml_constructors[tag] for tag in tags}
    for kind in ("bool", "float", "int", "null", "str"):
        Loader.add_constructor(f"{_TAG}{kind}", _scalar(kind))
    return Loader


def _scalar(kind: str) -> Any:
    """The constructor of a word, whose text must be one of its kind also where a tag says so."""
    pattern = re.compile(_WORDS[kind][0]) if kind in _WORDS else None

    def construct(loader: yaml.SafeLoader, node: yaml.Node) -> Any:
        text = str(loader.construct_scalar(node))  # type: ignore[arg-type]
        if pattern is None:
            return _checked(text, node)
        if pattern.fullmatch(text) is None:
            raise refused(node, f"found '{text[:60]}', which is not of the type {kind}")
        if len(text) > _LONGEST_NUMBER:
            raise refused(node, f"found a number of {len(text)} digits")
        return _value(kind, text)

    return construct


def _value(kind: str, text: str) -> Any:
    if kind == "null":
        return None
    if kind == "bool":
        return text.lower() == "true"
    if kind == "int":
        return int(text)
    word = text.lower().lstrip("+-")
    if word in (".inf", ".nan"):
        return math.copysign(float(word[1:]), -1.0 if text[0] == "-" else 1.0)
    return float(text)


def _checked(text: str, node: yaml.Node) -> str:
    """A text that has only what texts have: no control characters, no halves of characters."""
    if len(text) > _LONGEST:
        found = f"found a text of {len(text)} characters; at most {_LONGEST} are accepted"
        raise refused(node, found)
    odd = next((c for c in text if unicodedata.category(c) in ("Cc", "Cs") and c not in "\t\n"), "")
    if odd:
        raise refused(node, f"found the character U+{ord(odd):04X} in a text; take it out")
    return text


def add_words(cls: Any) -> None:
    """Gives a loader or dumper the words of YAML 1.2's core."""
    for kind, (pattern, first) in reversed(_WORDS.items()):
        cls.add_implicit_resolver(
            f"{_TAG}{kind}",
            re.compile(f"^(?:{pattern})$"),
            ["" if c == "\0" else c for c in first],
        )
