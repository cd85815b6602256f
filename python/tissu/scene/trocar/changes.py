"""The script of a simulated device that says which tool is in, and when."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Annotated

from pydantic import BeforeValidator

from tissu.errors import ParameterError
from tissu.reading import Read, listed, written
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.support import IncreasingTimes, same_length
from tissu.scene.trocar.tool import tag_of, tag_text
from tissu.scene.unknown import rule

__all__ = ["ToolChanges"]


def _tags(value: object) -> object:
    value = listed(value)
    if not isinstance(value, (list, tuple)):
        text = "a list of tags is accepted, such as [0x51A0, none, 0x51A1]"
        raise ParameterError(f"found {written(value)}; {text}")
    return tuple(None if tag in (None, "none") else tag_text(tag_of(tag)) for tag in value)


_Tags = Annotated[Read[tuple[str | None, ...], Sequence[int | str | None]], BeforeValidator(_tags)]


class ToolChanges(Part):
    """Changes of the tool in a simulated device, with their times."""

    times: IncreasingTimes
    """strictly increasing times [s]; before the first time, the first tool of the trocar is in the
    device
    """
    tags: _Tags
    """tag of the tool that is in the device from each time on, or none: a tool is taken out before
    the next is put in
    """

    @rule("tags", "times")
    def _one_at_each_time(self) -> Iterator[Problem]:
        yield from same_length("tag", self.tags, self.times)

    @rule("tags")
    def _is_taken_out_before_the_next(self) -> Iterator[Problem]:
        for number, (before, tag) in enumerate(itertools.pairwise(self.tags)):
            if before is not None and tag is not None and before != tag:
                text = (
                    f"found {tag} right after {before}; none between them is accepted: a tag that "
                )
                yield Problem(("tags", number + 1), f"{text}changes in the port holds the trocar")
