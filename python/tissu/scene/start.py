"""How a body begins: where its nodes are, and how fast they move."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from tissu import units
from tissu.scene.part import Part

Shape = Literal["rest", "point", "plane", "random", "inside_out"]


class Start(Part):
    """The state of a body at time zero; nodes that are held stay in their places."""

    velocity: units.Velocity | None = None
    """velocity of all nodes [m/s]; absent: at rest"""
    spin: units.Spin | None = None
    """angular velocity about the centre of mass [rad/s]; absent: none"""
    shape: Shape = "rest"
    """where nodes begin: at rest; all in one point, the centre of mass; pressed into the plane
    z = 0 through it; at random within the body's box; or inside out, mirrored in that plane
    """
    seed: Annotated[int, Field(ge=0)] = 0
    """of the random places"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            velocity: units.VectorLike | None = ...,
            spin: units.VectorLike | None = ...,
            shape: Shape = ...,
            seed: int = ...,
        ) -> None: ...
