"""Pause, step, undo, reset, speed; time and how fast it passes; what went wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.live_view.panels.panel import Panel, table, text, warning
from tissu.live_view.runner import speed_of

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session

SPEEDS = ("0.05 x", "0.1 x", "0.25 x", "0.5 x", "1 x", "2 x", "5 x", "as fast as it goes")


class RunPanel(Panel):
    """The first things on the page."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        runner = session.runner
        self._runner = runner
        self._numbers = gui.add_html(text("…"))
        self._message = gui.add_html("", visible=False)
        self._pause = gui.add_button("Pause" if runner.playing else "Play")
        step = gui.add_button_group("", ("Step", "Undo", "Reset"))
        speeds = list(SPEEDS)
        now = next((s for s in speeds if speed_of(s) == runner.speed), None)
        if now is None:
            now = f"{runner.speed:g} x"
            speeds.insert(0, now)
        self._speed = gui.add_dropdown("speed", speeds, initial_value=now)
        session.on_press(self._pause, lambda _: runner.pause() if runner.playing else runner.play())
        acts = {
            "Step": runner.step_once,
            "Undo": lambda: runner.ask(session.go_back),
            "Reset": session.begin_again,
        }
        session.on_press(step, lambda word: acts[word]())
        session.on_change(self._speed, self._set_speed)

    def _set_speed(self, word: str) -> None:
        self._runner.speed = speed_of(word)

    def show(self, frame: Frame) -> None:
        """Time, rates, and the message."""
        self._pause.label = "Pause" if frame.playing else "Play"
        clock = f"t = {frame.time:.3f} s" + ("" if frame.playing else ", paused")
        if frame.playing:
            clock += f", {frame.achieved:.2f} x real time"
        rows = [
            (of, f"{one.p50_ms:.2f}", f"{one.p99_ms:.2f}", f"{one.real_time_factor:.2f} x")
            for of, one in zip(self._called(), frame.profiles, strict=True)
        ]
        said = text(clock) + table(("a step [ms]", "p50", "p99", "real time"), rows)
        if frame.error is not None:
            mean, largest = (1e3 * value for value in frame.error)
            said += text(f"apart by {mean:.3g} mm in the mean, {largest:.3g} mm at most")
        self._numbers.content = said
        self._message.visible = bool(frame.message)
        if frame.message:
            self._message.content = warning(*frame.message.splitlines())

    def _called(self) -> list[str]:
        """What each simulation is called: its models, and its place where there are two."""
        models = []
        for simulation in self._runner.simulations:
            found = [m.type for b in simulation.scene.bodies.values() for m in b.models().values()]
            models.append(", ".join(dict.fromkeys(found)) or "tissue")
        if len(models) == 1:
            return models
        return [f"{side}: {model}" for side, model in zip(("left", "right"), models, strict=True)]
