"""The scene's class of a law of one's own: its parameters as fields, with units and bounds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, create_model

from tissu import units
from tissu.scene.law import UserLaw

if TYPE_CHECKING:
    from tissu.user_law.made import MadeLaw


def scene_class(made: MadeLaw, text: str) -> type[UserLaw]:
    """A class with one field for each parameter.

    Args:
        made: the law.
        text: documentation of the class.
    """
    fields: dict[str, Any] = {"type": (Literal[made.name], made.name)}
    for p in made.law.parameters:
        dimension = units.dimension_of(p.unit)
        unit = "" if p.unit == "1" else f" [{p.unit}]"
        field = Field(
            gt=p.above, ge=p.at_least, lt=p.below, description=f"{p.meaning}{unit}".strip()
        )
        fields[p.name] = (Annotated[float, BeforeValidator(dimension), field], ...)
    title = "".join(part.capitalize() for part in made.name.split("_"))
    cls: type[UserLaw] = create_model(
        title, __base__=UserLaw, __doc__=text, __module__=__name__, **fields
    )
    cls.made = made
    return cls
