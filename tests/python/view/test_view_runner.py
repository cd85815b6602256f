"""The thread that owns the simulations, without a page."""

import threading
from concurrent.futures import Future

import numpy as np
import pytest

import tissu as ts
from tissu.live_view.frame import FrameTaker, Wanted, error_between
from tissu.live_view.gizmo import Gizmo
from tissu.live_view.pointer import Pointer
from tissu.live_view.runner import Runner
from tissu.live_view.tools import Tool
from tissu.live_view.touch import Touch


def cube(model="fem", *, step=None, young="5 kPa", **fields):
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(3, 3, 3), cell="tetra"),
        law=ts.StVK(young=young, poisson=0.3),
        model=model,
        law_for_model="nearest",
        density=1000,
    )
    return ts.Scene(
        bodies={"cube": body},
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        gravity=(0, 1, -9.81),
        step=step or ts.ImplicitEuler("10 ms"),
        grabbing=True,
        editing=True,
        **fields,
    ).compile()


@pytest.fixture
def run():
    """Starts runners, and ends them."""
    runners = []

    def start(*simulations, **options):
        runners.append(Runner(simulations, **{"playing": False, **options}))
        runners[-1].start()
        return runners[-1]

    yield start
    for runner in runners:
        runner.stop()


def wait_for_step(runner, number):
    """Until the simulations have taken that many steps."""
    reached = threading.Event()

    def watch(simulations):
        simulations[0].on_step(lambda report: reached.set() if report.number >= number else None)

    runner.ask(watch).result(10)
    runner.play().result(10)
    assert reached.wait(60)
    runner.pause().result(10)


def test_it_gives_the_bits_that_a_loop_gives(run):
    runner, alone = run(cube(), speed=float("inf")), cube()
    wait_for_step(runner, 30)
    number = runner.reports[0].number
    for _ in range(number):
        alone.step()
    found = runner.ask(lambda sims: sims[0].positions["cube"].copy()).result(10)
    assert number >= 30 and np.array_equal(found, alone.positions["cube"])


def test_a_wish_is_granted_between_two_steps_in_its_own_thread(run):
    runner, main = run(cube(), playing=True, speed=float("inf")), threading.current_thread()
    inside = []

    def look(simulations):
        inside.append((threading.current_thread() is main, simulations[0]._entry.inside))
        return simulations[0].step().number

    assert runner.ask(look).result(10) >= 1
    assert inside == [(False, None)]


def test_one_step_and_a_pause(run):
    runner = run(cube())
    for number in (1, 2, 3):
        runner.step_once().result(10)
        assert runner.reports[0].number == number
    assert not runner.playing
    assert runner.ask(lambda sims: sims[0].time).result(10) == pytest.approx(0.03)


def test_a_step_that_diverges_pauses_and_the_last_good_state_stands(run):
    """Ten kilometres a second at one node are refused by the core."""
    runner = run(cube(step=ts.ImplicitEuler("10 ms")))
    runner.step_once().result(10)

    def throw(simulations):
        simulations[0].velocities["cube"][-1] = (1e9, 0, 0)
        return simulations[0].positions["cube"].copy()

    before = runner.ask(throw).result(10)
    runner.play().result(10)
    runner.ask(lambda _: None).result(10)
    while runner.playing:
        runner.ask(lambda _: None).result(10)
    assert "The simulation stands at its last good step" in runner.error
    after = runner.ask(lambda sims: sims[0].positions["cube"].copy()).result(10)
    assert np.array_equal(before, after)
    runner.ask(lambda sims: sims[0].reset()).result(10)
    runner.play().result(10)
    assert runner.error == ""
    wait_for_step(runner, 5)


def test_a_wish_that_is_refused_is_told_and_pauses_nothing(run):
    runner = run(cube(), playing=True)
    wish = runner.ask(lambda sims: sims[0].drag("cub", (0, 0, 0)))
    with pytest.raises(ts.ParameterError, match="did you mean 'cube'"):
        wish.result(10)
    assert "did you mean 'cube'" in runner.error and runner.playing


def test_an_error_of_a_program_pauses_and_is_told_in_full(run, capsys):
    runner = run(cube(), playing=True)
    with pytest.raises(ZeroDivisionError):
        runner.ask(lambda _: 1 / 0).result(10)
    assert not runner.playing and runner.error == "ZeroDivisionError: division by zero"
    assert "Traceback" in capsys.readouterr().err


def test_a_program_that_looks_in_holds_it_up_and_stops_nothing(run):
    simulation = cube()
    runner = run(simulation, speed=float("inf"))
    with simulation._entry.entered("a long look"):
        runner.play()
        runner._ended.wait(0.05)
    wait_for_step(runner, 10)
    assert runner.error == ""


def test_two_simulations_go_by_the_same_time(run):
    runner = run(cube(), cube("corotational"), speed=float("inf"))
    wait_for_step(runner, 20)
    one, other = runner.ask(lambda sims: [sim.time for sim in sims]).result(10)
    assert one == other
    mean, most = runner.ask(lambda sims: error_between(*sims)).result(10)
    one, other = runner.simulations
    apart = np.linalg.norm(one.positions["cube"] - other.positions["cube"], axis=1)
    assert 0 < mean < most and (mean, most) == pytest.approx((apart.mean(), apart.max()))


def test_a_static_scene_solves_again_and_again(run):
    runner = run(cube(step=ts.Static()))
    runner.step_once().result(10)
    first = runner.ask(lambda sims: sims[0].positions["cube"].copy()).result(10)
    runner.ask(lambda sims: sims[0].parameters.__setitem__("gravity.z", -5.0)).result(10)
    runner.step_once().result(10)
    second = runner.ask(lambda sims: sims[0].positions["cube"].copy()).result(10)
    assert np.abs(first - second).max() > 1e-4


def at(lane, place, there=None, *, client=1, eye=(0.05, 0.05, 1.0)):
    there = place if there is None else there
    return Pointer(lane, "cube", client, *(np.array(p, dtype=float) for p in (eye, there, place)))


class TestTouch:
    TOP = (0.05, 0.06, 0.1)

    def test_a_drag_pulls_the_point_under_the_pointer_and_lets_go(self, run):
        runner = run(cube())
        touch = Touch(runner)
        assert touch.chosen == "drag"
        touch.feel("start", at(0, self.TOP)).result(10)
        touch.feel("update", at(0, self.TOP, (0.05, 0.06, 0.16))).result(10)
        for _ in range(100):
            runner.step_once().result(10)
        (grab,) = runner.ask(lambda sims: sims[0].grabs).result(10)
        assert np.array_equal(grab.target, (0.05, 0.06, 0.16))
        mesh, moved = (
            runner.simulations[0].meshes["cube"],
            runner.simulations[0].displacements("cube"),
        )
        nearest = np.linalg.norm(mesh.points - self.TOP, axis=1).argmin()
        assert moved[:, 2].argmax() == nearest  # the node that is pulled rises most
        touch.feel("end", at(0, self.TOP)).result(10)
        assert runner.ask(lambda sims: sims[0].grabs).result(10) == ()

    def test_moves_between_two_steps_are_one(self, run):
        runner, gate = run(cube()), threading.Event()
        touch = Touch(runner)
        touch.feel("start", at(0, self.TOP)).result(10)
        runner.ask(lambda _: gate.wait(10))
        asked = [touch.feel("update", at(0, self.TOP, (0, 0, z))) for z in (0.2, 0.3, 0.4)]
        gate.set()
        assert [type(one) for one in asked] == [Future, type(None), type(None)]
        asked[0].result(10)
        (grab,) = runner.ask(lambda sims: sims[0].grabs).result(10)
        assert grab.target[2] == 0.4

    def test_two_simulations_are_dragged_as_one(self, run):
        runner = run(cube(), cube("corotational"))
        touch = Touch(runner)
        touch.feel("start", at(1, self.TOP)).result(10)
        touch.feel("update", at(1, self.TOP, (0.05, 0.06, 0.2))).result(10)
        grabs = runner.ask(lambda sims: [sim.grabs[0] for sim in sims]).result(10)
        assert np.array_equal(grabs[0].target, grabs[1].target)
        assert np.array_equal(grabs[0].point.nodes, grabs[1].point.nodes)

    def test_two_pages_hold_a_point_each(self, run):
        runner = run(cube())
        touch = Touch(runner)
        for client in (1, 2):
            touch.feel("start", at(0, self.TOP, client=client)).result(10)
        touch.feel("end", at(0, self.TOP, client=1)).result(10)
        assert len(runner.ask(lambda sims: sims[0].grabs).result(10)) == 1

    def test_cells_under_the_pointer_are_removed_and_the_mesh_is_open_there(self, run):
        runner = run(cube())
        touch = Touch(runner)
        touch.choose("remove cells")
        touch.tools["remove cells"].numbers[0].value = 25.0  # mm
        mesh = runner.simulations[0].meshes["cube"]
        touch.feel("click", at(0, (0, 0, 0), self.TOP, eye=(0.05, 0.06, 1.0))).result(10)
        left = runner.simulations[0].meshes["cube"]
        gone = np.setdiff1d(
            np.arange(mesh.cell_count), runner.simulations[0].remaining_cells("cube")
        )
        centres = mesh.points[mesh.cells[0].nodes].mean(axis=1)
        near = np.linalg.norm(centres - self.TOP, axis=1) <= 0.025
        assert len(gone) > 0 and np.array_equal(gone, np.flatnonzero(near))
        assert left.surface().triangles.max() < mesh.node_count
        assert len(left.surface().triangles) > len(mesh.surface().triangles)

    def test_a_press_beside_every_body_removes_nothing(self, run):
        runner = run(cube())
        touch = Touch(runner)
        touch.choose("remove cells")
        count = runner.simulations[0].meshes["cube"].cell_count
        touch.feel("click", at(0, (0, 0, 0), (5, 5, 0), eye=(5, 5, 1))).result(10)
        assert runner.simulations[0].meshes["cube"].cell_count == count

    def test_a_tool_is_one_class_and_a_wrong_name_is_refused(self, run):
        felt = []

        class Poke(Tool):
            name, hint = "poke", "Press."

            @classmethod
            def offered(cls, simulation):
                return True

            def press(self, simulations, pointer):
                felt.append(("press", pointer.body))

            def release(self, simulations, pointer):
                felt.append(("release", pointer.body))

        touch = Touch(run(cube()), tools=(Poke,))
        touch.feel("start", at(0, self.TOP)).result(10)
        touch.feel("end", at(0, self.TOP)).result(10)
        assert felt == [("press", "cube"), ("release", "cube")]
        with pytest.raises(ts.ParameterError, match="accepted: poke"):
            touch.choose("drag")


class TestLead:
    """A gizmo moves and turns held nodes as one rigid piece: x = R (X - c) + p."""

    def test_the_nodes_are_where_the_gizmo_is(self, run):
        simulation = cube()
        simulation.allow_touch()
        runner = run(simulation, cube("corotational"))
        runner.ask(lambda sims: sims[1].allow_touch()).result(10)
        touch = Touch(runner)
        touch.choose("lead")
        gizmo, other = runner.ask(lambda sims: touch.gizmos(sims)).result(10)
        assert (gizmo.name, gizmo.lane, other.lane) == ("fixed[0]", 0, 1)
        assert np.allclose(gizmo.place, (0.05, 0.05, 0.0), atol=1e-15)
        angle = 0.4  # about z
        place = gizmo.place + np.array([0.01, -0.005, 0.002])
        wxyz = np.array([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])
        touch.turn(Gizmo(gizmo.name, 0, place, wxyz)).result(10)
        for _ in range(8):
            runner.step_once().result(10)
        c, s = np.cos(angle), np.sin(angle)
        rotation = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        for one in runner.simulations:
            foot = np.flatnonzero(one.meshes["cube"].points[:, 2] == 0.0)
            rest = one.meshes["cube"].points[foot]
            expected = (rest - gizmo.place) @ rotation.T + place
            assert np.abs(one.positions["cube"][foot] - expected).max() < 1e-12
        now = runner.ask(lambda sims: touch.gizmos(sims)).result(10)[0]
        assert np.allclose(now.place, place, atol=1e-12) and np.array_equal(now.wxyz, wxyz)

    def test_turns_between_two_steps_are_one_and_the_longer_way_round_is_not_taken(self, run):
        simulation = cube()
        simulation.allow_touch()
        runner, gate = run(simulation), threading.Event()
        touch = Touch(runner)
        touch.choose("lead")
        (gizmo,) = runner.ask(lambda sims: touch.gizmos(sims)).result(10)
        runner.ask(lambda _: gate.wait(10))
        turns = [np.array([np.cos(a / 2), 0, 0, np.sin(a / 2)]) for a in (1.0, 6.0)]
        asked = [touch.turn(Gizmo(gizmo.name, 0, gizmo.place, wxyz)) for wxyz in turns]
        gate.set()
        asked[0].result(10)
        assert asked[1] is None
        for _ in range(8):  # 6 rad is -0.28 rad, the shorter way: no node goes far in a step
            before = simulation.positions["cube"].copy()
            runner.step_once().result(10)
            moved = np.linalg.norm(simulation.positions["cube"] - before, axis=1)
            assert moved[simulation.lead("fixed[0]").nodes].max() < 0.01

    def test_without_held_nodes_it_is_not_offered(self, run):
        body = cube().scene.bodies["cube"]
        free = ts.Scene(bodies={"cube": body}, step=ts.ImplicitEuler(0.01)).compile()
        free.allow_touch()
        assert "lead" not in Touch(run(free)).tools


class TestFrames:
    def test_a_frame_is_a_copy_of_what_is_seen(self, run):
        runner = run(cube())
        taker = FrameTaker()
        taker.wanted = Wanted(field="displacement", layers=frozenset({"fixed nodes"}))
        runner.step_once().result(10)
        frame = runner.ask(lambda _: taker.take(runner)).result(10)
        body, simulation = frame.bodies[0, "cube"], runner.simulations[0]
        assert body.positions.dtype == np.float32
        now = simulation.positions["cube"][body.seen.nodes]
        assert np.abs(body.positions - now).max() < 1e-7
        shift = np.linalg.norm(simulation.displacements("cube"), axis=1)[body.seen.nodes]
        assert np.array_equal(body.values, shift)
        assert len(frame.marks[0, "fixed nodes"][0].points) == 16
        kept = body.positions.copy()
        runner.step_once().result(10)
        assert np.array_equal(kept, body.positions)

    def test_colours_follow_the_cells_that_are_left(self, run):
        runner = run(cube())
        taker = FrameTaker()
        taker.wanted = Wanted(field="energy_density")
        first = runner.ask(lambda _: taker.take(runner)).result(10).bodies[0, "cube"]
        runner.ask(lambda sims: sims[0].remove_cells(body="cube", cells=[1, 2, 30])).result(10)
        second = runner.ask(lambda _: taker.take(runner)).result(10).bodies[0, "cube"]
        assert second.seen is not first.seen
        assert len(second.values) == len(second.positions) == len(second.seen.nodes)


def test_what_is_asked_of_a_closed_runner_is_refused_and_never_waits():
    runner = Runner([cube()], playing=False)
    runner.start()
    runner.stop()
    for wish in (runner.ask(len), runner.pause(), runner.play(), runner.step_once()):
        with pytest.raises(ts.TissuError, match="view that is closed"):
            wish.result(10)


def test_what_waits_when_a_runner_ends_is_refused():
    runner = Runner([cube()], playing=False)
    waiting = runner.ask(len)  # it has not begun
    runner.start()
    runner.stop()
    try:
        assert waiting.result(10) == 1
    except ts.TissuError as error:
        assert "view that is closed" in str(error)


@pytest.mark.parametrize("given", ["corotational", 3])
def test_a_view_of_something_else_is_refused(given):
    with pytest.raises(ts.ParameterError, match="a simulation is accepted"):
        ts.view(cube(), beside=given, browser=False)
    with pytest.raises(ts.ParameterError, match="a simulation is accepted"):
        ts.view(given, browser=False)
