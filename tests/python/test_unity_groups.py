"""Which C++ sources are compiled together (third_party/unity_groups.py)."""

import itertools
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCE = """#include "x.h"

namespace tissu {{
namespace {{

{private}

}}  // namespace

void of_all() {{}}

}}  // namespace tissu
"""


@pytest.fixture
def unity(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "third_party")
    import unity_groups

    return unity_groups


def laid(folder, **sources):
    """Sources of these names, each with one line in a namespace without a name."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, private in sources.items():
        (folder / f"{name}.cpp").write_text(SOURCE.format(private=private))
    return [folder / f"{name}.cpp" for name in sources]


def names(groups):
    return sorted(sorted(path.stem for path in group) for group in groups)


def test_sources_that_define_a_private_name_alike_are_apart(unity, tmp_path):
    """Functions, constants, types and aliases. Names outside such namespaces do not matter."""
    for one in ("double of(int i) { return i; }", "constexpr int of = 3;", "struct of {};"):
        for other in ("Vec3 of(double x) {", "using of = int;", "enum class of { a };"):
            found = unity.groups(laid(tmp_path, a=one, b=other, c="int c() { return 0; }"))
            assert names(found) == [["a", "c"], ["b"]]


def test_neighbours_come_first_and_what_is_left_goes_with_others(unity, tmp_path):
    near = laid(tmp_path / "near", a="int a = 0;", b="int b = 0;", c="int a = 1;")
    far = laid(tmp_path / "far", d="int d = 0;", e="int d = 1;")
    assert names(unity.groups(near + far)) == [["a", "b", "d"], ["c", "e"]]


def test_the_sources_of_the_core_are_each_in_one_group_that_has_room(unity):
    sources = sorted((ROOT / "cpp/src").rglob("*.cpp"))
    found = unity.groups(sources)
    assert sorted(itertools.chain.from_iterable(found)) == sources
    assert max(map(len, found)) <= unity.MOST
    for group in found:
        own = [unity.own_names(path.read_text(encoding="utf-8")) for path in group]
        assert sum(map(len, own)) == len(set().union(*own))
