"""The view from a program and from the command line, and the examples of its page in the docs."""

import contextlib
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import tissu as ts
from tissu.live_view.frame import Wanted

ROOT = Path(__file__).parents[3]
EXAMPLES = re.findall(
    r"```python\n(.*?)```",
    (ROOT / "docs/guide/live-view.md").read_text(encoding="utf-8"),
    re.DOTALL,
)


def liver(**changes):
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra"),
        law=ts.StVK(young="5 kPa", poisson=0.4),
        density=1050,
    )
    end = ts.Plane((0, 0, 0.1), (0, 0, 1))
    fields = {
        "bodies": {"liver": body},
        "fixed": [ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        "loads": [ts.NodalLoad("liver", on=end, force=(0, 0, 0.1), name="pull")],
        "gravity": (0, 0, -9.81),
        "step": ts.ImplicitEuler("10 ms"),
        **changes,
    }
    return ts.Scene(**fields).compile()


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_examples_of_the_page_run(example):
    simulation = liver()
    exec(compile(example, "view.md", "exec"), {"simulation": simulation, "ts": ts})
    assert simulation.step().converged


def test_there_are_two():
    assert len(EXAMPLES) == 2


def test_a_view_runs_and_gives_the_simulation_back_when_it_is_closed():
    simulation = liver()
    told = []
    simulation.on_step(lambda report: told.append(report.number))
    with simulation.view(browser=False, playing=False) as view:
        view.step()
        assert view.ask(lambda sims: sims[0] is simulation).result(10)
        assert "127.0.0.1" in repr(view) and view.url in view._repr_html_()
        view.reset().result(10)
        view.step()
    assert told == [1, 1]
    assert simulation.time == 0.01 and simulation.scene.grabbing
    view.close()  # once more does nothing


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ({"speed": 0.0}, "a positive one is accepted"),
        ({"speed": float("nan")}, "a positive one is accepted"),
        ({"record": "page.mp4"}, "ends with .html or .glb is accepted"),
        ({"token": "two words"}, "letters, digits"),
    ],
)
def test_what_is_not_accepted_is_refused_and_leaves_no_thread(options, why):
    import threading

    before = {thread.name for thread in threading.enumerate()}
    with pytest.raises(ts.ParameterError, match=re.escape(why)):
        ts.view(liver(), browser=False, **options)
    left = {thread.name for thread in threading.enumerate()} - before
    assert not {name for name in left if name.startswith("tissu")}


def test_other_time_steps_do_not_stand_side_by_side():
    with pytest.raises(ts.ParameterError, match=r"time steps 0\.01 and 0\.02"):
        ts.view(liver(), beside=liver(step=ts.ImplicitEuler("20 ms")), browser=False)


@contextlib.contextmanager
def started(*words):
    """The command; it does not outlive a test that failed."""
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        [sys.executable, "-m", "tissu", "view", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=environment,
        # Where the tests run in the background of a shell, they ignore SIGINT, and so would it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    ) as command:
        try:
            yield command
        finally:
            command.kill()


def test_the_command_says_where_the_page_is_and_ends_with_ctrl_c(tmp_path):
    file = tmp_path / "organ.html"
    words = ("examples/organ.yaml", "--no-browser", "--record", str(file), "--beside", "fem")
    with started(*words) as command:
        line = command.stdout.readline()
        assert re.fullmatch(r"the view is at http://127\.0\.0\.1:\d+/ \(Ctrl-C ends it\)\n", line)
        command.send_signal(signal.SIGINT)
        out, err = command.communicate(timeout=120)
    assert (command.returncode, err) == (0, "")
    assert out == f"written: {file}\n" and file.stat().st_size > 100_000


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("examples/organ.yaml", "--beside", "fen"), "did you mean 'fem'"),
        (("examples/organ.yaml", "--record", "a.mp4"), "ends with .html or .glb is accepted"),
        (("examples/none.yaml",), "none.yaml"),
    ],
)
def test_the_command_refuses_with_a_sentence(words, why):
    with started(*words, "--no-browser") as command:
        _, err = command.communicate(timeout=120)
    assert command.returncode == 2 and why in err and "Traceback" not in err


def test_frames_do_not_pile_up_where_no_page_takes_them():
    """Twenty thousand messages or so are put in the place of one another: less than 1 MB stays."""
    import tracemalloc

    with ts.view(liver(), browser=False, playing=False) as view:
        view._taker.wanted = Wanted(
            field="displacement", layers=frozenset({"fixed nodes", "grabs"})
        )

        def one(_):
            for simulation in view._runner.simulations:
                simulation.step()
            return view._taker.take(view._runner)

        def show(count):
            for _ in range(count):
                view._page.show(view.ask(one).result(60))

        show(100)
        tracemalloc.start()
        show(50)
        early, _ = tracemalloc.get_traced_memory()
        show(500)
        late, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    assert late - early < 1_000_000
