"""The folder of each trocar: its state and forces, its hand, its tool, and a curve."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.live_view.layers.grabs import force_text
from tissu.live_view.panels.panel import Panel, table, text, warning
from tissu.live_view.trocars.curve import Curve
from tissu.live_view.trocars.gamepad import reader, sticks_of, word_of
from tissu.trocar.states import ACKNOWLEDGE, AGAIN

if TYPE_CHECKING:
    from collections.abc import Callable

    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session
    from tissu.live_view.trocars.frame import TrocarFrame
    from tissu.live_view.trocars.held import HandKind
    from tissu.live_view.trocars.live import LiveTrocar
    from tissu.live_view.trocars.trocars import LiveTrocars

_HANDS: dict[str, HandKind] = {"of the scene": "scene", "of the browser": "browser"}
_OUT = "none"
_GO_ON, _SWITCH_ON = "Go on", "Switch on again"
_CURES = {"held": _GO_ON, "fault": _SWITCH_ON}
_SETTLED = 0.5
"""s after a page has changed a widget in which it is left as it is."""
_DEGREES = 180.0 / np.pi


class TrocarsPanel(Panel):
    """A folder for each trocar."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        assert session.trocars is not None
        self._folders = [
            TrocarFolder(gui, session, session.trocars, name, place)
            for place, name in enumerate(session.trocars.names)
        ]

    def show(self, frame: Frame) -> None:
        """What each trocar feels."""
        for folder in self._folders:
            folder.show([one for one in frame.trocars if one.name == folder.name])


class TrocarFolder:
    """The folder of one trocar, in all simulations that are shown."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, trocars: LiveTrocars, name: str, place: int
    ) -> None:
        """Add its widgets; `place` is its number among the trocars."""
        self.name = name
        self._session, self._trocars = session, trocars
        first = trocars.called(name)[0]
        with gui.add_folder(f"Trocar {name}"):
            self._said = gui.add_html(text("…"))
            self._problem = gui.add_html("", visible=False)
            self._cure = gui.add_button(_GO_ON, visible=False)
            self._choose_hand_and_tool(gui, first)
            self._add_hand(gui, first, place)
            self._curve = Curve(gui, session)
            arrow = gui.add_number(
                "arrow [mm/N]", 1e3 * trocars.arrow, min=0.0, hint="length of the force of 1 N"
            )
        session.on_press(self._cure, lambda _: self._ask(lambda live: live.cure()))
        session.on_change(arrow, lambda value: setattr(trocars, "arrow", 1e-3 * float(value)))

    def _choose_hand_and_tool(self, gui: viser.GuiApi, live: LiveTrocar) -> None:
        self._hand: Any = None
        self._tool: Any = None
        if live.held is None:
            return
        now = next(word for word, kind in _HANDS.items() if kind == live.hand)
        self._hand = gui.add_dropdown("hand", list(_HANDS), initial_value=now)
        tools = list(dict.fromkeys(live.trocar.tools.values()))
        self._tool = gui.add_dropdown("tool in it", [*tools, _OUT], initial_value=tools[0])
        self._session.on_change(self._hand, self._take_hand)
        self._on_page(
            self._tool,
            lambda word: self._ask(lambda live: live.take(None if word == _OUT else word)),
        )

    def _add_hand(self, gui: viser.GuiApi, live: LiveTrocar, place: int) -> None:
        """Sliders of the joints and the gamepad, where the hand is that of the browser."""
        self._sliders: list[Any] = []
        self._gamepad: list[Any] = []
        if live.held is None:
            return
        limits, shown = live.trocar.limits, live.hand == "browser"
        tilt = round(limits.tilt * _DEGREES, 1)
        ranges = [
            ("pitch [deg]", -tilt, tilt),
            ("roll [deg]", -tilt, tilt),
            ("rotation [deg]", -180.0, 180.0),
            ("depth [mm]", 1e3 * limits.least_depth, 1e3 * limits.depth),
        ]
        values = shown_joints(live.wanted)
        for (label, low, high), value in zip(ranges, values, strict=True):
            slider = gui.add_slider(
                label, low, high, 0.1, round(float(np.clip(value, low, high)), 1), visible=shown
            )
            self._sliders.append(slider)
            self._on_page(slider, partial(self._want, len(self._sliders) - 1))
        field = gui.add_text("gamepad", f"{word_of(place)} at rest", visible=shown)
        self._on_page(field, self._hear)
        self._gamepad = [field, gui.add_html(reader(place), visible=shown)]

    def _on_page(self, widget: Any, act: Callable[[Any], object]) -> None:
        """Do something with a value that a page which may touch has given a widget.

        What the widget shows of the trocar by itself does nothing.
        """

        async def changed(event: viser.GuiEvent[Any]) -> None:
            if event.client_id is not None and self._session.rights.may(event.client_id):
                act(widget.value)

        widget.on_update(changed)

    def _want(self, axis: int, shown: float) -> None:
        value = float(shown) * (1e-3 if axis == 3 else 1.0 / _DEGREES)
        self._ask(lambda live: live.want(axis, value))

    def _take_hand(self, word: str) -> None:
        hand = _HANDS[word]
        self._ask(lambda live: live.hold(hand))
        for widget in (*self._sliders, *self._gamepad):
            widget.visible = hand == "browser"
        if hand == "browser":
            self._session.take_in_hand("hold trocar")

    def _hear(self, said: str) -> None:
        now = time.monotonic()
        self._ask(lambda live: live.hear(sticks_of(said), now))

    def _ask(self, wish: Callable[[LiveTrocar], object]) -> None:
        """Have something done with the trocar in every simulation, between two steps."""

        def each(_: object) -> None:
            for live in self._trocars.called(self.name):
                wish(live)

        self._session.runner.ask(each)

    def show(self, frames: list[TrocarFrame]) -> None:
        """State, sentence, numbers, sliders and curve; of two simulations the first's curve."""
        if not frames:
            return
        first = frames[0]
        self._said.content = "".join(numbers_of(one) for one in frames)
        problem = next((one for one in frames if one.problem), None)
        self._problem.visible = problem is not None
        if problem is not None:
            self._problem.content = warning(f"{problem.state}: {sentence_of(problem)}.")
        cure = next((_CURES[one.state] for one in frames if one.state in _CURES), None)
        self._cure.visible = cure is not None
        self._cure.label = cure or _GO_ON
        if self._tool is not None and time.time() - self._tool.update_timestamp > _SETTLED:
            self._tool.value = first.next_tool or _OUT  # after a reset, say
        if first.hand == "browser":
            for slider, value in zip(self._sliders, shown_joints(first.wanted), strict=True):
                follow(slider, value)
        self._curve.show(first.history)


def sentence_of(one: TrocarFrame) -> str:
    """What is wrong and what to do, with the button of the page in place of the call."""
    press = f"press '{_SWITCH_ON}'"
    if one.hand == "device":
        press = f"let go of the handle and {press}: the device homes before it gives force"
    return one.problem.replace(AGAIN, press).replace(ACKNOWLEDGE, f"press '{_GO_ON}'")


def numbers_of(one: TrocarFrame) -> str:
    """What a trocar feels, as HTML."""
    pitch, roll, rotation, depth = (round(value, 1) + 0.0 for value in shown_joints(one.joints))
    torque = np.round(1e3 * one.torque, 1) + 0.0
    head = f"{one.state}, " + (one.tool or "no tool")
    rows = [
        ("force on the hand", force_text(one.fast)),
        ("of the tissue's step", force_text(one.slow)),
        ("torque, pitch and roll", f"{torque[0]:.1f}, {torque[1]:.1f} mN m"),
        ("depth", f"{depth:.1f} mm"),
        ("pitch, roll, rotation", f"{pitch:.1f}, {roll:.1f}, {rotation:.1f} deg"),
        ("hand before the tool", f"{1e3 * one.ahead:.2f} mm"),
        ("arrow of 1 N", f"{1e3 * one.length:.3g} mm"),
    ]
    return table((head, ""), rows)


def shown_joints(q: Any) -> tuple[float, float, float, float]:
    """Joints (4,) in degrees and millimetres; own rotation from -180 to 180."""
    pitch, roll, rotation = (float(angle) * _DEGREES for angle in q[:3])
    return pitch, roll, (rotation + 180.0) % 360.0 - 180.0, 1e3 * float(q[3])


def follow(slider: Any, value: float) -> None:
    """Put a slider where the hand is, unless a page has moved it just now."""
    value = round(float(np.clip(value, slider.min, slider.max)), 1)
    if abs(slider.value - value) > 0.05 and time.time() - slider.update_timestamp > _SETTLED:
        slider.value = value
