"""An effect that a scene does not have takes no instruction of a step: counted by callgrind.

Each scene with an effect runs between two runs of the scene without it, in one process. The
functions of an effect are known by their names; that these names are right is seen where it runs.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))

import effect_rows
import instruction_counts
from effect_rows import ROWS, Measured
from instruction_counts import Counts, Function

needs_counts = pytest.mark.skipif(
    instruction_counts.missing() is not None, reason=str(instruction_counts.missing())
)
STEPS = 2
SIZES = (1, 2, 3)


@pytest.fixture(scope="module")
def measured() -> dict[str, Measured]:
    """Every row, by the name of its effect."""
    rows = effect_rows.measure(size=1, steps=STEPS)
    return {one.row.effect: one for one in rows}


@pytest.fixture(scope="module")
def bare_by_size() -> list[Counts]:
    """The bare scene on finer and finer meshes, each in a process of its own."""
    return [instruction_counts.count(["bare"], size=n, steps=STEPS)[0] for n in SIZES]


@needs_counts
@pytest.mark.parametrize("effect", [row.effect for row in ROWS if row.own is not None])
def test_an_absent_effect_takes_no_instruction(measured: dict[str, Measured], effect: str) -> None:
    one = measured[effect]
    assert one.row.own is not None
    assert effect_rows.matching(one.without.own, one.row.own) == {}
    assert effect_rows.matching(one.again.own, one.row.own) == {}
    assert effect_rows.instructions_of(one.present, one.row.own) > 0


@needs_counts
@pytest.mark.parametrize("effect", [row.effect for row in ROWS])
def test_the_scene_without_it_is_the_same_before_and_after(
    measured: dict[str, Measured], effect: str
) -> None:
    """In instructions, function by function, and in the bits of its motion."""
    one = measured[effect]
    assert one.again.own == one.without.own
    assert one.again.scene["checksum"] == one.without.scene["checksum"]


@needs_counts
def test_leave_to_edit_costs_the_room_in_the_matrix_alone(measured: dict[str, Measured]) -> None:
    """An editable body keeps a quarter of its rows free: more to clear, nothing more to compute.

    The functions that multiply by its matrix begin with another way to find the end of a row.
    """
    one = measured["editing allowed, nothing removed"]
    assert one.present.own.keys() == one.without.own.keys()
    changed = [f for f in one.present.own if one.present.own[f] != one.without.own[f]]
    assert [
        f.name for f in changed if not re.search(r"memset|BlockMatrix::|Forecast::multiply", f.name)
    ] == []
    assert one.present.scene["checksum"] == one.without.scene["checksum"]


@needs_counts
def test_counts_are_the_same_in_another_process(
    measured: dict[str, Measured], bare_by_size: list[Counts]
) -> None:
    assert bare_by_size[0].own == measured["gravity"].without.own


@needs_counts
def test_every_function_of_a_bare_step_is_of_something_present(bare_by_size: list[Counts]) -> None:
    """Nothing runs that is not known: an effect that came later would be seen."""
    for counts in bare_by_size:
        unknown = [f for f in counts.own if effect_rows.part_of(f) == "unknown"]
        assert unknown == []


@needs_counts
@pytest.mark.parametrize("question", effect_rows.ASKED)
def test_what_asks_for_absent_effects_does_not_grow_with_the_mesh(
    bare_by_size: list[Counts], question: str
) -> None:
    pattern = effect_rows.ASKED[question]
    found = [effect_rows.instructions_of(counts, pattern) for counts in bare_by_size]
    assert found[0] > 0
    assert found == [found[0]] * len(found)
    cells = [counts.scene["cells"] for counts in bare_by_size]
    assert cells == sorted(set(cells))
    assert found[0] < 1e-3 * bare_by_size[0].total


@needs_counts
def test_a_bare_step_solves_one_system(bare_by_size: list[Counts]) -> None:
    """Of ten iterations: no rescue runs, whose functions would be counted as the method's."""
    for counts in bare_by_size:
        assert counts.scene["solves"] == STEPS
        assert counts.scene["iterations"] == 10 * STEPS


PROFILE = """# callgrind format
version: 1
events: Ir

ob=/usr/bin/program
fl=???
fn=tissu::step(int)
0 5
cob=/usr/lib/libc.so.6
cfn=memcpy
calls=2 0
0 40
0 3

ob=/usr/lib/libc.so.6
fl=???
fn=memcpy
0 40

totals: 48
"""


def test_the_reader_keeps_own_instructions_apart_from_those_of_calls() -> None:
    own = instruction_counts.own_instructions(PROFILE.splitlines())
    assert own == {
        Function("program", "tissu::step(int)"): 8,
        Function("libc.so.6", "memcpy"): 40,
    }


def test_the_reader_refuses_a_profile_that_does_not_add_up() -> None:
    with pytest.raises(RuntimeError, match="says 49 instructions, its lines 48"):
        instruction_counts.own_instructions(PROFILE.replace("48", "49").splitlines())
