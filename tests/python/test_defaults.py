"""`solver: auto` against every fixed choice, in counted work: bench/defaults.py on small scenes."""

import sys
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
from default_rows import ROWS as TIMED_ROWS
from default_rows import Taken
from default_scenes import SCENES
from defaults import HEAD, Run, cell, compared, over_best, ratio

# Steps enough that each wrong prediction has been learned: a choice is tried when what it would
# have saved has paid for making it, some tens of steps where a factor serves for twenty.
STEPS = 160
# The factor of a constant matrix pays for itself after 84 steps: the half that is compared begins
# later.
CONSTANT = ("half condensed",)
# A factor of which the gain is less than half of a solve is left alone, since making it anew makes
# a frame late each time: here it would take 0.78 of what `auto` does, whose multigrid is renewed in
# parts that make no frame late either.
LIMITS = {("bar", 800, "100 ms"): 1.3}
ROWS = [
    *(("bar", 800, "10 ms"), ("bar", 800, "100 ms"), ("bar of hexahedra", 800, "10 ms")),
    *(("cube", 1000, "1 ms"), ("cube", 1000, "10 ms"), ("thin plate", 800, "10 ms")),
    *(("slivers", 1000, "10 ms"), ("nu 0.499", 800, "10 ms"), ("shell", 800, "10 ms")),
    *(("frames", 600, "10 ms"), ("mixed cells", 800, "10 ms"), ("cut", 800, "10 ms")),
    *(("bar", 800, "static"), ("cube", 1000, "static"), ("half condensed", 1500, "10 ms")),
    *(("thin plate", 800, "static"), ("nu 0.499", 800, "static"), ("shell", 800, "static")),
    *(("contrast 1e6", 800, "static"), ("slivers", 800, "static")),
]


@pytest.mark.parametrize(("name", "size", "step"), ROWS)
def test_auto_takes_at_most_a_quarter_more_than_the_best_fixed_choice(name, size, step):
    steps = 2 * STEPS if name in CONSTANT else STEPS
    found = compared(name, size, step, counts=True, steps=steps)
    assert found["auto"].failures == min(run.failures for run in found.values())
    limit = LIMITS.get((name, size, step), 1.25)
    assert ratio(found) <= limit, {choice: cell(run, counts=True) for choice, run in found.items()}


@pytest.mark.parametrize(("name", "size"), [("bar", 2000), ("bar of hexahedra", 2000)])
def test_no_frame_is_made_late_by_a_trial(name, size):
    # Three solves are what a trial may take as predicted. Making the levels of a multigrid, counted
    # in the step where its last part ends, takes three of a bar near rest; a factor took 18.
    simulation = SCENES[name](size, ts.ImplicitEuler("10 ms", solver=ts.Auto())).compile()
    taken = []
    for _ in range(STEPS):
        simulation.clear_profile()
        simulation.step()
        taken.append(simulation.profile().solves.work)
    assert max(taken[1:]) <= 6.0 * np.median(taken), taken


def test_a_failure_where_another_choice_succeeds_is_no_ratio():
    runs = {"auto": Run(1.0, 1.0, 1.0, 1, ""), "cholesky": Run(9.0, 9.0, 9.0, 0, "")}
    assert ratio(runs) == float("inf")
    runs["auto"] = Run(12.0, 11.0, 12.0, 0, "")
    runs["multigrid"] = Run(1.0, 1.0, 1.0, 3, "")  # cheap, and wrong three times
    assert ratio(runs) == pytest.approx(11.0 / 9.0)


def test_times_are_compared_over_the_steps_that_both_took():
    auto = Taken(steps=[9.0, 9.0, 2.0, 2.0, 1.0, 1.0, 1.0, 1.0])
    early = Taken(steps=[8.0, 8.0, 8.0, 8.0])  # dear, and left out after four
    found = {"auto": auto, "stale_cholesky": early, "multigrid": Taken(steps=[1.0] * 4 + [0.8] * 4)}
    assert over_best(found) == pytest.approx(1.0 / 0.8)
    assert over_best({"auto": auto, "stale_cholesky": early}) == pytest.approx(2.0 / 8.0)
    found["auto"] = Taken(steps=[0.1] * 8, failed=[2])
    assert over_best(found) == float("inf")
    late = Taken(steps=[1.0] * 8, failed=[6])  # in a step that the other one never came to
    assert over_best({"auto": late, "cholesky": Taken(steps=[2.0] * 4)}) == pytest.approx(0.5)


def test_the_bench_has_the_rows_that_the_default_is_held_against():
    assert {"organ", "contrast 1e6", "mixed cells", "cut"} <= set(SCENES)
    assert {"liver", "phantom"} <= {row.scene for row in TIMED_ROWS}
    assert {row.threads for row in TIMED_ROWS} == {1, 2}
    assert max(row.size for row in TIMED_ROWS) == 1e6
    assert "counted work" in HEAD
