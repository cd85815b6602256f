"""The longest step of a profile, and what it did: checked against the reports of the steps."""

import json

import pytest

import tissu as ts


def scene():
    mesh = ts.bar_mesh(size=(2, 1, 1), cells=(4, 2, 2), cell="tetra")
    return ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=ts.StVK(young=3e3, poisson=0.4), density=1e3)},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.ImplicitEuler(0.01),
    )


def test_the_worst_step_is_the_longest_after_the_first_and_has_its_own_counts():
    simulation = scene().compile()
    assert simulation.profile().worst.step == 0
    assert str(simulation.profile()) == "no step was taken yet"
    reports = [simulation.step() for _ in range(40)]
    longest = max(range(1, 40), key=lambda i: reports[i].milliseconds)
    profile = simulation.profile()
    worst = profile.worst
    assert worst.step == longest + 1
    # the same difference of two clocks, in seconds and in milliseconds
    assert worst.ms == pytest.approx(reports[longest].milliseconds, rel=1e-12)
    assert worst.iterations == reports[longest].solver_iterations
    assert worst.solves == reports[longest].newton_iterations
    assert f"step {worst.step}, {worst.ms:.3f} ms" in str(profile)


def test_its_rows_are_a_part_of_the_step_and_of_all_steps():
    simulation = scene().compile()
    for _ in range(20):
        simulation.step()
    profile = simulation.profile()
    parts = [ms for _, _, ms in profile.worst.rows]
    assert parts == sorted(parts, reverse=True)
    assert 0.0 < sum(parts) <= profile.worst.ms
    whole = {(row.effect, row.stage): 20 * row.ms_per_step for row in profile.rows}
    assert all(ms <= whole[effect, stage] * (1 + 1e-9) for effect, stage, ms in profile.worst.rows)


def test_a_cleared_profile_begins_anew_and_the_only_step_is_its_worst(tmp_path):
    simulation = scene().compile()
    for _ in range(3):
        simulation.step()
    simulation.clear_profile()
    assert simulation.profile().worst.step == 0
    report = simulation.step()
    worst = simulation.profile().worst
    assert (worst.step, worst.iterations) == (1, report.solver_iterations)
    assert str(worst).startswith("only step, ")
    from tissu.output.summary import profile_data

    assert json.loads(json.dumps(profile_data(simulation)))["worst"]["step"] == 1
