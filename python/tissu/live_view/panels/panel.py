"""A folder of the page: widgets, and what they show of each frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session


class Panel(ABC):
    """Widgets of one purpose."""

    @abstractmethod
    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""

    def show(self, frame: Frame) -> None:
        """Show what a frame says; at most a few times a second."""
        return


def text(*lines: str, colour: str = "inherit") -> str:
    """Lines of plain text as HTML."""
    inner = "<br>".join(escape(line) for line in lines)
    return f'<div style="padding:0 1em;font-size:0.85em;color:{colour}">{inner}</div>'


def warning(*lines: str) -> str:
    """What went wrong, as HTML that is seen."""
    inner = "<br>".join(escape(line) for line in lines)
    return (
        '<div style="margin:0.3em 1em 0.6em;padding:0.5em 0.7em;border-left:3px solid #b3261e;'
        'background:#fdecea;color:#8c1d18;font-size:0.85em;overflow-wrap:anywhere">'
        f"{inner}</div>"
    )


def table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """A table as HTML; the first column is left, the others right."""

    def line(cells: tuple[str, ...], tag: str) -> str:
        return "".join(
            f'<{tag} style="text-align:{"right" if i else "left"};padding-right:0.5em;'
            f"white-space:{'nowrap' if i else 'normal'};"
            f'font-weight:{600 if tag == "th" else 400}">{escape(cell)}</{tag}>'
            for i, cell in enumerate(cells)
        )

    body = "".join(f"<tr>{line(row, 'td')}</tr>" for row in rows)
    return (
        '<table style="margin:0 1em;font-size:0.78em;width:calc(100% - 2em)">'
        f"<tr>{line(head, 'th')}</tr>{body}</table>"
    )
