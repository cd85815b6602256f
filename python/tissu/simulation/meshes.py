"""The meshes of the bodies of a simulation, which edits change."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.mesh import Mesh


class Meshes(Mapping[str, "Mesh"]):
    """Body -> mesh; that of a body that was edited is made when it is asked for.

    Args:
        meshes: as they are.
        made: the mesh of a body after edits.
    """

    def __init__(self, meshes: Mapping[str, Mesh], made: Callable[[str], Mesh]) -> None:
        self._known = dict(meshes)
        self._made = made
        self._stale: set[str] = set()

    def __getitem__(self, body: str) -> Mesh:
        """The mesh of a body."""
        if body in self._stale:
            self._known[body] = self._made(body)
            self._stale.discard(body)
        return self._known[body]

    def __iter__(self) -> Iterator[str]:
        """Over the names of the bodies."""
        return iter(self._known)

    def __len__(self) -> int:
        """How many bodies there are."""
        return len(self._known)

    def follow(self, body: str) -> None:
        """A body was edited."""
        self._stale.add(body)

    def become(self, meshes: Mapping[str, Mesh]) -> None:
        """Take meshes as they were at another moment."""
        self._known.update(meshes)
        self._stale.clear()
