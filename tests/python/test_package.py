"""The package as a whole: what it exports, how fast it is imported, that its stubs are true."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import tissu
from tissu import _core, _haptic
from tissu.codegen import names

STUBS = Path(tissu.__file__).parent


def test_every_exported_name_is_there():
    for name in tissu.__all__:
        assert getattr(tissu, name) is not None


def test_the_packages_and_their_stub_are_what_the_list_gives():
    """Byte for byte, as the C++ that is made."""
    root = Path(tissu.__file__).parent
    for path, text in names.made_files(root).items():
        assert path.read_text(encoding="utf-8") == text, f"{path}: run make codegen"


def test_every_part_of_a_scene_is_below_a_heading():
    """A module of tissu.scene with public names, but below no heading, fails here."""
    root = Path(tissu.__file__).parent
    listed = set(names.scene_names(root))
    for path in (root / "scene").rglob("*.py"):
        module = ".".join(path.relative_to(root / "scene").with_suffix("").parts)
        if "__init__" not in module and names.part_names(module, root):
            assert module in listed


def test_the_binding_has_no_defaults():
    """Each stands once, in the part of the scene."""
    docs = [vars(owner)[name].__doc__ or "" for owner in owners() for name in vars(owner)]
    signatures = [doc.split("\n")[0] for doc in docs if ") ->" in doc]
    assert len(signatures) > 60
    assert [text for text in signatures if " = " in text] == []


def owners() -> list[object]:
    return [_core, *(value for value in vars(_core).values() if isinstance(value, type))]


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'Liver'"):
        tissu.Liver  # noqa: B018


def test_import_is_fast_and_leaves_the_heavy_libraries_alone():
    # The budget is 0.3 s; the clock of a shared machine is not asserted, what is imported is.
    code = (
        "import sys, tissu; from tissu import Scene, Body, _core;"
        "print([m for m in ('meshio', 'pint', 'rich', 'matplotlib', 'yaml', 'typer', 'sympy')"
        " if m in sys.modules])"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"


def arguments_of(doc: str) -> list[str]:
    """Argument names in a docstring of pybind11: name(self: X, *, a: int, b: float = 1) -> C."""
    inside = doc[doc.index("(") + 1 : doc.rindex(") ->")]
    depth, start, parts = 0, 0, []
    for i, c in enumerate(inside):
        depth += (c in "[({") - (c in "])}")
        if c == "," and depth == 0:
            parts.append(inside[start:i])
            start = i + 1
    parts.append(inside[start:])
    names = [part.split(":")[0].strip() for part in parts if part.strip()]
    return [name for name in names if name not in ("self", "*")]


def stub_functions(body: list[ast.stmt]) -> dict[str, list[str]]:
    functions = [node for node in body if isinstance(node, ast.FunctionDef)]
    return {
        f.name: [a.arg for a in (*f.args.args, *f.args.kwonlyargs) if a.arg != "self"]
        for f in functions
        if not f.decorator_list
    }


def real_functions(owner: object) -> dict[str, list[str]]:
    found = {}
    for name in vars(owner):
        value = getattr(owner, name)
        first = (getattr(value, "__doc__", None) or "").split("\n")[0]
        wanted = name == "__init__" or not name.startswith("_")
        if wanted and callable(value) and not isinstance(value, type) and ") ->" in first:
            found[name] = arguments_of(first)
    return found


@pytest.mark.parametrize("module", [_core, _haptic], ids=lambda module: module.__name__)
def test_the_stub_of_a_compiled_module_is_true(module):
    tree = ast.parse((STUBS / f"{module.__name__.split('.')[-1]}.pyi").read_text())
    assert stub_functions(tree.body) == real_functions(module)
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    assert set(classes) == {n for n, v in vars(module).items() if isinstance(v, type)}
    for name in set(classes) - {"Split", "Plane"}:
        real = getattr(module, name)
        functions = stub_functions(classes[name].body)
        assert functions == {
            k: v for k, v in real_functions(real).items() if k != "__init__" or v or k in functions
        }, name
        stubbed = {
            node.name
            for node in classes[name].body
            if isinstance(node, ast.FunctionDef) and node.decorator_list
        }
        assert stubbed == {k for k, v in vars(real).items() if isinstance(v, property)}, name


def test_texts_of_fields_are_read_only_where_they_are_asked_for():
    """Reading the sources of all parts would take nearly half of the time of an import."""
    code = (
        "import inspect\ninspect.getsource = inspect.findsource = None\nimport tissu\ntissu.Scene\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    with pytest.raises(tissu.SceneError, match=r"edge: is missing: points of the cutting edge"):
        tissu.Knife(cuts=["organ"])


def test_an_instruction_set_that_is_not_there_is_refused():
    out = subprocess.run(
        [sys.executable, "-c", "from tissu import _core; _core.build_info()"],
        capture_output=True,
        text=True,
        env={**os.environ, "TISSU_ISA": "mmx"},
        check=False,
    )
    assert 'TISSU_ISA is "mmx"' in out.stderr
    assert "baseline" in out.stderr
