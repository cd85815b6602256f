"""What is shown: a field by colour, edges, layers, and where it is seen from."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.live_view.cameras import PRESETS, look_from
from tissu.live_view.colours import legend
from tissu.live_view.fields import FIELDS, offered
from tissu.live_view.frame import Wanted
from tissu.live_view.panels.panel import Panel
from tissu.live_view.surface import seen

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session

_NONE = "own colours"


class LookPanel(Panel):
    """Fields, layers and cameras."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        self._session = session
        simulations = session.runner.simulations
        names = offered(
            simulations[0], {name: seen(mesh) for name, mesh in simulations[0].meshes.items()}
        )
        self._names = {FIELDS[name].label: name for name in names}
        with gui.add_folder("Look"):
            self._field = gui.add_dropdown("colour", [_NONE, *self._names], initial_value=_NONE)
            self._legend = gui.add_html("", visible=False)
            fit = gui.add_button("Fit the colours", visible=False)
            self._fit = fit
            edges = gui.add_checkbox("edges", session.show_edges)
            self._layers = {
                layer.name: gui.add_checkbox(layer.name, layer.on)
                for layer in session.taker.layers
                if any(layer.offered(simulation) for simulation in simulations)
            }
            cameras: Any = gui.add_dropdown("view from", ["…", *PRESETS], initial_value="…")
        session.on_change(self._field, lambda _: self._want())
        session.on_change(edges, lambda on: setattr(session, "show_edges", on))
        session.on_press(fit, lambda _: setattr(session, "limits", None))
        for box in self._layers.values():
            session.on_change(box, lambda _: self._want())

        async def turn(event: viser.GuiEvent[Any]) -> None:  # of one page; all may
            if event.client is not None and cameras.value in PRESETS:
                look_from(event.client.camera, cameras.value, session.stage)
                cameras.value = "…"

        cameras.on_update(turn)
        self._want()

    def _want(self) -> None:
        """Tell the simulations' thread what is to be computed."""
        field = self._names.get(self._field.value, "")
        if field != self._session.taker.wanted.field:
            self._session.limits = None
        on = frozenset(name for name, box in self._layers.items() if box.value)
        self._session.taker.wanted = Wanted(field=field, layers=on)

    def show(self, frame: Frame) -> None:
        """The legend."""
        limits, field = self._session.limits, FIELDS.get(frame.field)
        shown = field is not None and limits is not None
        self._legend.visible = self._fit.visible = shown
        if field is None or limits is None:
            return
        factor, unit = field.unit(max(abs(limits[0]), abs(limits[1])))
        self._legend.content = legend(field.label, unit, (factor * limits[0], factor * limits[1]))
