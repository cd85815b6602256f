"""The live view: simulations that run, seen and touched in the browser."""

from tissu.live_view.view import View

__all__ = ["View", "view"]

view = View
