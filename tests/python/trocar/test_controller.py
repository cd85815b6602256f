"""The controller: states, tools, walls that are felt, three ways to run, recordings, hard cases."""

import os
import time

import numpy as np
import pytest

import tissu as ts
from tissu import _haptic
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel
from tissu.trocar.recording import Recording
from tissu.trocar.states import Reason, State

DOWN = ts.Port((0.06, -0.09, 0.12), (0, 0, -1))
PALPATION = ts.Hand(
    times=[0, 0.2, 0.7, 1.2, 1.5],
    points=[(0, 0, 0.1), (0, 0, 0.1), (0, 0, 0.112), (0.003, 0, 0.112), (0, 0, 0.098)],
)
WALL = {"through": (0, 0, 0.105), "normal": (0, 0, -1), "stiffness": 400.0}


def trocar(**changes):
    device = ts.SimulatedDevice(hand=PALPATION)
    return ts.Trocar(**{"port": DOWN, "device": device, **changes})


def palpated(controller, ticks, wall=WALL, every=10):
    """Steps, with a wall that is published anew every 10 ms; the reports."""
    reports = []
    for _ in range(ticks // every):
        reports.append(controller.step(every))
        controller.publish(LocalModel.plane(reports[-1].q, **wall))
    return reports


def test_a_wall_is_felt_as_two_springs_behind_each_other():
    with Controller(trocar()) as controller:
        reports = palpated(controller, 1000)
        K = controller.stiffness()[3]
    states = [report.state for report in reports]
    assert states[0] is State.free
    assert State.contact in states
    for report in reports:
        depth = max(0.0, report.q[3] * np.cos(np.hypot(*report.q[:2])) - 0.105)
        # The hand does not tilt before 0.7 s: the force is along the port.
        if report.time < 0.69 and report.share == 1.0 and report.time > 0.35:
            assert report.force[2] == pytest.approx(depth * 400 * K / (400 + K), abs=1e-6)
    assert max(report.force[2] for report in reports) > 1.0
    assert controller.report().state is State.off


def test_three_ways_to_run_the_same_tick():
    """Python and stepped differ by the tolerance of the solver, 1e-6 of the force."""
    torques, apart = {}, {}
    for mode in ("stepped", "python"):
        with Controller(trocar(), mode=mode) as controller:
            reports = palpated(controller, 600)
            torques[mode] = np.array([r.torque for r in reports])
            apart[mode] = np.array([r.disagreement for r in reports])
    assert np.abs(torques["stepped"]).max() > 0.5
    assert np.abs(torques["stepped"] - torques["python"]).max() <= 1e-5
    assert apart["stepped"].max() > 0.1
    assert np.abs(apart["stepped"] - apart["python"]).max() <= 1e-4


@pytest.mark.parametrize("spin", [-1, float("nan"), "1 ms", 1e9])
def test_a_spin_that_is_no_time_is_refused(spin):
    controller = Controller(trocar(), mode="threaded")
    with pytest.raises(ts.ParameterError, match=r"found the spin .*; 0 to 86400 s is accepted"):
        controller.start(spin=spin)


def test_identification_accepts_a_balanced_tool_alone():
    """Gravity would take an axis to its end."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    free = trocar(device=ts.SimulatedDevice(), gravity=(0, 0, -9.81))
    with pytest.raises(ts.ParameterError, match="leave `gravity` out"):
        identify(free, open_device(free, 1), realtime=False)


def test_values_that_friction_hides_are_not_found():
    """The depth had an inertia of -0.007 kg and a damping of -4.4 N s/m."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    strong = ts.TrocarMechanism(damping=(0.1, 0.1, 4e-3, 5), friction=(0.1, 0.1, 0.02, 2))
    free = trocar(device=ts.SimulatedDevice(mechanism=strong))
    axes = identify(free, open_device(free, 1), realtime=False)
    assert [axis.found()[1] for axis in axes] == [False, False, True, False]
    assert axes[2].damping == pytest.approx(4e-3, rel=0.02)
    assert all(axis.efficiency is None for axis in axes)


def test_the_error_of_an_efficiency_has_the_spread_of_the_swings():
    """The own rotation was 0.84 +- 0.010 for 0.7; slow and fast swings differ by 0.09 there."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    own = ts.TrocarMechanism(damping=(0.05, 0.02, 2e-3, 2), friction=(0.01, 4e-3, 2e-3, 0.5))
    eta = (0.6, 0.6, 0.7, 0.7)
    free = trocar(device=ts.SimulatedDevice(efficiency=eta, mechanism=own))
    for axis, known in zip(identify(free, open_device(free, 1), realtime=False), eta, strict=True):
        if axis.name == "rotation":
            assert axis.efficiency is None
        else:
            assert axis.efficiency == pytest.approx(known, abs=axis.error)


def test_in_real_time_the_thread_takes_the_ticks():
    controller = Controller(trocar(), mode="threaded", record=True)
    controller.start(priority=0, lock_memory=False, pin=False)
    with pytest.raises(ts.TissuError, match="real time"):
        controller.step()
    while controller.report().tick < 300:
        controller.publish(LocalModel.plane(controller.report().q, **WALL))
    controller.stop()
    assert not controller.timing().running
    assert controller.timing().ticks >= 299
    recording = controller.recording()
    assert not recording.columns["enable"][-1]  # the motors were switched off
    # Real time and its missed ticks are in the recording: the replay has the same bits.
    assert recording.difference(recording.replay()) == ""


@pytest.mark.parametrize("mode", ["stepped", "python"])
def test_a_model_is_stale_after_100_ms_and_two_steps_of_the_tissue(mode):
    for every, until in ((None, 100), (0.02, 100), (0.08, 160)):
        with Controller(trocar(), mode=mode) as controller:
            if every is not None:
                controller.expect_models(every=every)
            q = controller.step(400).q
            assert not controller.report().stale  # there is none
            controller.publish(LocalModel.plane(q, **WALL))
            assert not controller.step(until).stale
            assert controller.step(5).stale
            assert controller.report().state in (State.free, State.contact)
            controller.publish(LocalModel.plane(q, **WALL))
            assert not controller.step(1).stale
            with pytest.raises(ts.ParameterError, match="a time above 0 s is accepted"):
                controller.expect_models(every=0.0)


def test_two_trocars_tick_in_real_time_at_once():
    """Each thread has its exchange: each hand feels its own wall, and no tick is mixed up."""
    deep = ts.Hand(times=[0, 0.2, 0.5], points=[(0, 0, 0.1), (0, 0, 0.1), (0, 0, 0.112)])
    run = [
        Controller(
            trocar(
                port=ts.Port((x, 0, 0.12), (0, 0, -1)),
                device=ts.SimulatedDevice(hand=deep),
                rate=300.0,  # slow, so that a busy machine seldom misses five ticks in a row
            ),
            mode="threaded",
            record=True,
        )
        for x in (0.0, 0.2)
    ]
    walls, stamps, felt = (200.0, 600.0), [0, 0], [[], []]
    for controller in run:
        controller.start(lock_memory=False)
    end = time.monotonic() + 60.0  # what a busy machine takes is not judged
    while min(c.report().tick for c in run) < 300 or min(map(len, felt)) < 10:
        assert time.monotonic() < end
        time.sleep(0.01)
        for number, controller in enumerate(run):
            report = controller.report()
            if report.state is State.held:  # on a busy machine
                controller.acknowledge()
            wall = {**WALL, "stiffness": walls[number]}
            stamps[number] = controller.publish(LocalModel.plane(report.q, **wall))
            if report.share == report.coupling == 1.0 and report.force[2] > 0.2:
                felt[number].append(report.force[2] / (report.q[3] - 0.105))
    cores = [next(g.what for g in c.timing().grants if "core" in g.what) for c in run]
    if len(os.sched_getaffinity(0)) > 1:
        assert cores[0] != cores[1]
    for number, controller in enumerate(run):
        controller.stop()
        timing, recording = controller.timing(), controller.recording()
        columns = recording.columns
        assert not timing.running
        # Each period has a tick or is missed; after the thread's, one tick switches the motors off.
        numbers = columns["number"].astype(int)
        assert len(numbers) == timing.ticks + 1
        assert numbers[timing.ticks - 1] + 1 == timing.ticks + timing.missed
        assert (np.diff(numbers) > 0).all()
        assert not columns["enable"][-1]
        offered = columns["offered"].astype(int)
        assert (np.diff(offered) >= 0).all()
        assert stamps[number] - 3 <= offered.max() <= stamps[number]
        assert recording.difference(recording.replay()) == ""
        K = controller.stiffness()[3]
        assert np.array(felt[number]) == pytest.approx(
            walls[number] * K / (walls[number] + K), rel=0.02
        )


def test_stepped_runs_have_the_same_bits_and_replay(tmp_path):
    recordings = []
    for _ in range(2):
        device = ts.SimulatedDevice(hand=PALPATION, delay=0.002, jitter=0.001, lost=0.02, seed=4)
        controller = Controller(trocar(device=device), record=True)
        with controller:
            palpated(controller, 900, every=20)
        recordings.append(controller.recording())
    one, other = recordings
    assert np.abs(one.columns["command"]).max() > 0.3
    assert (one.columns["read"] != 0).sum() > 5  # frames were lost
    assert one.difference(other.columns) == ""
    path = tmp_path / "palpation.npz"
    one.save(path)
    back = Recording.read(path)
    assert back.ticks == one.ticks
    assert back.difference(back.replay()) == ""
    one.save(str(path))
    assert Recording.read(str(path)).ticks == one.ticks
    changed = {**back.columns, "torque": back.columns["torque"] * (1 + 2**-52)}
    assert "another torque" in back.difference(changed)


def test_a_recording_is_saved_to_a_path_and_nothing_else():
    with pytest.raises(ts.ParameterError, match="found 3; the path of a recording is accepted"):
        Recording({}, [], []).save(3)


def test_a_file_that_is_no_recording_is_refused(tmp_path):
    path = tmp_path / "scene.npz"
    path.write_text("nothing")
    with pytest.raises(ts.ParameterError, match="not a recording"):
        Recording.read(path)
    np.savez(path, version=np.array(99))
    with pytest.raises(ts.ParameterError, match="version 99"):
        Recording.read(path)


@pytest.mark.parametrize("mode", ["stepped", "python"])
def test_a_grip_is_read_and_never_driven(mode):
    """Its angle is counts times 0.05 degrees; its torque is zero in every state, in contact too."""
    controller = Controller(trocar(), mode=mode)
    states, commands = set(), []
    with controller:
        controller.device.jump(4, 100)
        for _ in range(30):
            report = controller.step(20)
            assert report.grip == pytest.approx(np.radians(5.0), rel=1e-12)
            states.add(report.state)
            through = (0, 0, 0.105)
            wall = LocalModel.plane(report.q, through=through, normal=(0, 0, -1), stiffness=500.0)
            controller.publish(wall)
            commands.append(controller.records()["command"])
    columns = np.concatenate(commands)
    assert State.contact in states and np.abs(columns[:, 3]).max() > 0.1
    assert columns.shape[1] == 5 and not columns[:, 4].any()


TOOLS = {0x51A0: "probe", 0x51A1: "knife"}


def with_tools():
    made = Controller(trocar(tools=TOOLS))
    made.start()
    return made


def test_tools_are_known_by_their_tags():
    controller = with_tools()
    report = controller.step(100)
    assert (report.state, report.tool, report.tag) == (State.free, "probe", 0x51A0)
    controller.device.set_tool(0, False)
    report = controller.step(100)
    assert (report.state, report.tool) == (State.empty, None)
    controller.device.set_tool(0x51A1, True)
    assert controller.step(100).tool == "knife"
    controller.device.set_tool(0, False)
    controller.step(50)
    controller.device.set_tool(0x77, True)
    report = controller.step(100)
    assert report.state is State.empty
    assert "found the tag 0x77, which no tool of the scene has" in report.problem
    assert "0x51A0 (probe), 0x51A1 (knife)" in report.problem


def test_a_tag_that_changes_without_removal_is_held():
    controller = with_tools()
    controller.step(100)
    controller.device.set_tool(0x51A1, True)
    report = controller.step(100)
    assert (report.state, report.reason) == (State.held, Reason.tag_changed)
    assert "take the tool out" in report.problem


def test_unplugged_in_contact_there_is_a_fault_and_no_torque():
    with Controller(trocar(), record=True) as controller:
        palpated(controller, 600)
        assert controller.report().state is State.contact
        controller.device.unplug()
        report = controller.step(20)
        assert (report.state, report.reason) == (State.fault, Reason.reads_failed)
        assert not report.torque.any()
        controller.device.plug_in()
        assert controller.step(50).state is State.fault  # until it is started again
    columns = controller.recording().columns
    failed = np.flatnonzero(columns["read"] != 0)
    assert not columns["command"][failed[4] :].any()  # five failed reads


def test_a_jump_of_the_encoder_is_held_until_acknowledged():
    with Controller(trocar()) as controller:
        controller.step(100)
        controller.device.jump(0, 1000)
        report = controller.step(5)
        assert (report.state, report.reason) == (State.held, Reason.too_fast)
        controller.acknowledge()
        assert controller.step(100).state is State.free


def test_a_device_that_does_not_know_its_zero_is_driven_home():
    device = ts.SimulatedDevice(homed=False, seed=3)
    with Controller(trocar(device=device)) as controller:
        assert controller.step(20).state is State.homing
        report = controller.step(4000)
        assert report.state is not State.homing
        real = controller.device.joints
        # Where it stands is known to some counts: stops give way by motor torque over stiffness.
        assert np.abs(report.q - real)[[0, 1, 3]] == pytest.approx(0.0, abs=1e-3)


def test_homing_against_a_hand_says_what_to_do() -> None:
    hand = ts.Hand(times=(0, 1), points=((0, 0, 0.1), (0, 0, 0.1)))
    with Controller(
        trocar(device=ts.SimulatedDevice(homed=False, hand=hand, seed=3))
    ) as controller:
        report = controller.step(4000)
        assert report.state is State.homing
        assert "let go of the handle" in report.problem
        assert not report.force.any()


def test_a_device_that_is_plugged_in_again_is_driven_home() -> None:
    with Controller(trocar(device=ts.SimulatedDevice(seed=3))) as controller:
        controller.step(100)
        controller.device.unplug()
        assert controller.step(20).state is State.fault
        controller.device.plug_in()
        controller.stop()
        controller.start()
        assert controller.step(20).state is State.homing
        report = controller.step(4000)
        assert report.state is State.contact and not report.problem  # with its own end
        assert np.abs(report.q - controller.device.joints)[[0, 1, 3]] == pytest.approx(
            0.0, abs=1e-3
        )
        assert report.coupling == 1.0 and report.tank > 0.0


def test_a_trocar_that_was_stopped_starts_again():
    controller = Controller(trocar())
    for _ in range(2):
        with controller:
            assert controller.step(100).state is State.free
        assert controller.report().state is State.off
        assert not np.any(controller.records()["command"][-1])


def test_a_delay_makes_the_coupling_softer_and_the_wall_stays_still():
    """5 ms of delay: 0.8 b / (T/2 + t_d) = 145 N/m; on a wall it moves by two counts at most."""
    still = ts.Hand(times=[0, 0.5], points=[(0, 0, 0.1), (0, 0, 0.11)])
    device = ts.SimulatedDevice(hand=still, delay=0.005)
    with Controller(trocar(device=device)) as controller:
        assert controller.stiffness()[3] == pytest.approx(0.8 * 1.0 / 0.0055)
        reports = palpated(controller, 3000, wall={**WALL, "stiffness": 1e5})
        depths = [report.q[3] for report in reports[-50:]]
        assert max(depths) - min(depths) <= 2e-4 + 1e-12
        assert reports[-1].state is State.contact


def test_places_of_the_scene_come_into_the_port():
    port = ts.Port((0.1, 0.2, 0.3), (-0.3, 0.4, -0.9))
    controller = Controller(trocar(port=port))
    report = controller.report()
    inside = controller.into_port(report.tip[None])[0]
    assert inside == pytest.approx([0, 0, report.q[3]], abs=1e-15)
    R = port.frame()
    assert np.abs(R.T @ R - np.eye(3)).max() <= 1e-15
    assert np.linalg.det(R) == pytest.approx(1.0)
    assert controller.turned_into_port(R[:, 2])[0] == pytest.approx([0, 0, 1], abs=1e-15)


def test_models_that_cannot_be_are_refused():
    controller = Controller(trocar())
    good = LocalModel.plane(np.array([0, 0, 0, 0.1]), **WALL)
    for change, said in (
        ({"normals": np.array([[0, 0, 2.0]])}, "unit vectors"),
        ({"friction": np.array([-1.0])}, "at least 0"),
        ({"compliance": -np.eye(3)}, "semi-definite"),
        ({"anchors": np.full((1, 3), np.nan)}, "finite"),
    ):
        fields = {name: getattr(good, name) for name in good.__slots__}
        with pytest.raises(ts.ParameterError, match=said):
            controller.publish(LocalModel(**{**fields, **change}))
    for change, said in (
        ({"stiffness": 0}, "stiffness of 0"),
        ({"stiffness": "hard"}, "does not begin with a number"),
        ({"friction": None}, "a number is accepted"),
        ({"through": (0, 0)}, "3 finite numbers are accepted"),
        ({"normal": (0, 0, np.nan)}, "3 finite numbers are accepted"),
        ({"point": "tip"}, "real numbers are accepted"),
    ):
        with pytest.raises(ts.ParameterError, match=said):
            LocalModel.plane(good.joints, **{**WALL, **change})


def test_what_a_controller_cannot_do_is_refused():
    with pytest.raises(ts.ParameterError, match="the mode 'fast'"):
        Controller(trocar(), mode="fast")
    with pytest.raises(ts.ParameterError, match="stepped and threaded record"):
        Controller(trocar(), mode="python", record=True)
    with pytest.raises(ts.ParameterError, match="nothing was recorded"):
        Controller(trocar()).recording()
    for ticks in (0, 1.5, "ten", float("inf")):
        with pytest.raises(ts.ParameterError, match=f"found {ticks!r} ticks; one or more"):
            Controller(trocar()).step(ticks)
    for places in ("here", [1.0, 2.0], np.zeros((2, 2, 3))):
        with pytest.raises(ts.ParameterError, match="found places of"):
            Controller(trocar()).into_port(places)


def test_a_hand_along_a_file(tmp_path):
    path = tmp_path / "hand.csv"
    path.write_text("# t, x, y, z\n0, 0, 0, 0.1\n0.5, 0, 0, 0.12\n")
    device = ts.SimulatedDevice(hand=ts.Hand(path=path))
    with Controller(trocar(device=device)) as controller:
        assert controller.step(2000).q[3] == pytest.approx(0.12, abs=1e-3)
    for text in ("0, 0, 0\n", "1, 0, 0, 0.1\n0, 0, 0, 0.1\n", "a, b, c, d\n"):
        path.write_text(text)
        with pytest.raises(ts.ParameterError, match="their times growing"):
            Controller(trocar(device=device))


def test_identification_finds_the_friction_of_the_simulated_device():
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    free = trocar(device=ts.SimulatedDevice())
    axes = identify(free, open_device(free, 1), realtime=False)
    mechanism = _haptic.Mechanism()
    # Bristles that bend before they slide, and counts of speeds, leave a tenth.
    for axis, damping, friction in zip(axes, mechanism.viscous, mechanism.coulomb, strict=True):
        assert axis.damping == pytest.approx(damping, rel=0.1)
        assert axis.friction == pytest.approx(friction, rel=0.1)
        assert axis.rest < 0.05
        assert axis.efficiency == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    ("eta", "delay"),
    [((0.95, 0.9, 0.96, 0.7), 0.0), ((0.8, 0.85, 0.9, 0.9), 0.0), ((0.95, 0.9, 0.96, 0.7), 2e-3)],
)
def test_identification_separates_the_efficiency_from_the_friction(eta, delay):
    """By what a braking motor loses; its error, and the model's own."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    free = trocar(device=ts.SimulatedDevice(efficiency=eta, delay=delay))
    axes = identify(free, open_device(free, 1), realtime=False)
    mechanism = _haptic.Mechanism()
    for axis, known, damping, friction in zip(
        axes, eta, mechanism.viscous, mechanism.coulomb, strict=True
    ):
        own, rough = (0.01, 0.1) if axis.name == "rotation" else (0.006, 0.1)
        assert axis.error < 0.03
        assert axis.efficiency == pytest.approx(known, abs=own + axis.error)
        assert axis.damping == pytest.approx(damping, rel=0.1)
        assert axis.friction == pytest.approx(friction, rel=rough)


def test_the_efficiency_of_an_axis_that_cannot_brake_is_not_found():
    """Without inertia the motor always drives: friction is what the motor feels, over eta."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    light = ts.TrocarMechanism(axial=1e-8, cradle=(2e-3, 2e-3, 2e-8, 0.05))
    device = ts.SimulatedDevice(efficiency=(1, 1, 0.8, 1), mechanism=light)
    free = trocar(device=device)
    rotation = identify(free, open_device(free, 1), realtime=False)[2]
    assert rotation.efficiency is None
    assert rotation.damping == pytest.approx(1e-3 / 0.8, rel=0.1)


@pytest.mark.parametrize("other", [None, 3, "right"])
def test_what_is_not_a_trocar_or_a_model_is_refused(other):
    with pytest.raises(ts.ParameterError, match=r"found the trocar .*; one of a scene is accepted"):
        Controller(other)
    with (
        Controller(trocar()) as controller,
        pytest.raises(ts.ParameterError, match=r"found the model .*; a LocalModel is accepted"),
    ):
        controller.publish(other)
