"""Which tool is in hand, and the numbers it works with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.live_view.panels.panel import Panel, text

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session
    from tissu.live_view.tools import Number

_NONE = "turn the view"


class TouchPanel(Panel):
    """The tools."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        touch = session.touch
        self._said: viser.GuiHtmlHandle | None = None
        if not touch.tools:
            return
        with gui.add_folder("Touch"):
            chosen = gui.add_dropdown(
                "tool", [*touch.tools, _NONE], initial_value=touch.chosen or _NONE
            )
            hint = gui.add_html("")
            self._said = gui.add_html("", visible=False)
            fields = {
                name: [self._number(gui, session, number) for number in tool.numbers]
                for name, tool in touch.tools.items()
            }

        def choose(word: str) -> None:
            touch.choose("" if word == _NONE else word)
            tool = touch.tools.get(touch.chosen)
            hint.content = text(
                tool.hint if tool else "Drag with the mouse to turn, wheel to zoom."
            )
            for name, widgets in fields.items():
                for widget in widgets:
                    widget.visible = name == touch.chosen

        choose(chosen.value)
        session.on_change(chosen, choose)
        session.on_tool.append(lambda name: setattr(chosen, "value", name))

    def show(self, frame: Frame) -> None:
        """What the tool feels."""
        if self._said is not None:
            self._said.visible = bool(frame.said)
            self._said.content = text(frame.said, colour="#146ec8")

    @staticmethod
    def _number(gui: viser.GuiApi, session: Session, number: Number) -> viser.GuiInputHandle[float]:
        widget = gui.add_number(
            f"{number.label} [{number.unit}]", float(number.value), min=float(number.least)
        )
        session.on_change(widget, lambda value: setattr(number, "value", float(value)))
        return widget
