"""Pictures of surfaces as PNG files, drawn by a z-buffer of our own: no GL, no display."""

from tissu.picture.camera import Camera, look_at
from tissu.picture.draw import draw
from tissu.picture.overlay import draw_overlay
from tissu.picture.surface import render_surface

__all__ = ["Camera", "draw", "draw_overlay", "look_at", "render_surface"]
