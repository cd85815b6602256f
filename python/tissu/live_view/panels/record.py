"""A recording, or a picture, saved by the browser."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from tissu.live_view.panels.panel import Panel

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session


class RecordPanel(Panel):
    """Begin and end a recording; take a picture."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        self._recorder = session.recorder
        name = session.runner.simulations[0].scene.name
        with gui.add_folder("Record", expand_by_default=False):
            self._button = gui.add_button("Record")
            picture = gui.add_button("Picture")

        @self._button.on_click
        def _(event: viser.GuiEvent[Any]) -> None:  # in a thread: the page is made meanwhile
            if event.client is None or not session.rights.may(event.client_id):
                return
            if not self._recorder.running:
                self._recorder.begin()
                return
            page = self._recorder.html().encode()
            event.client.send_file_download(f"{name}.html", page)

        @picture.on_click
        def _(event: viser.GuiEvent[Any]) -> None:
            if event.client is not None:
                event.client.send_file_download(f"{name}.png", picture_of(event.client))

    def show(self, frame: Frame) -> None:
        """What the button does next."""
        self._button.label = "Stop and save" if self._recorder.running else "Record"


def picture_of(client: viser.ClientHandle) -> bytes:
    """What a page shows of the scene, as the bytes of a PNG file."""
    from matplotlib.image import imsave

    camera = client.camera
    pixels = client.get_render(
        height=camera.image_height, width=camera.image_width, transport_format="png"
    )
    file = io.BytesIO()
    imsave(file, pixels, format="png")
    return file.getvalue()
