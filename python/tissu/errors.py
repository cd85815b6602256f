"""The errors of tissu: one sentence on what was found, what is accepted, where, what to do."""

from __future__ import annotations

from collections.abc import Sequence


class TissuError(Exception):
    """Base of every error that tissu raises on purpose."""


class MeshError(TissuError):
    """A mesh cannot be read, or cannot be simulated as it is."""


class ParameterError(TissuError, ValueError):
    """A number or an array is outside what the equations accept."""


class OverlapError(ParameterError):
    """Surfaces overlap at the start, where they must begin apart.

    Attributes:
        places: names of both, and in how many places or how deep, in words.
    """

    def __init__(self, message: str, *, places: str = "") -> None:
        self.places = places
        super().__init__(message)


class LawError(TissuError):
    """A user-defined law cannot be used, or cannot be compiled on this machine."""


class SceneError(TissuError):
    """A scene has problems; all of them are reported at once.

    Attributes:
        problems: one sentence for each problem, with its place in the scene.
    """

    def __init__(self, problems: Sequence[str], *, where: str = " in the scene") -> None:
        self.problems = list(problems)
        head = "1 problem" if len(self.problems) == 1 else f"{len(self.problems)} problems"
        super().__init__(f"{head}{where}:\n" + "\n".join(f"- {p}" for p in self.problems))


class CheckpointError(TissuError):
    """A checkpoint cannot be written or resumed: it is absent, damaged, or of another scene."""


class BusyError(TissuError):
    """A thread entered a simulation while another one was in it."""


class Diverged(TissuError):  # noqa: N818 - the field's word for it
    """A step has no solution, or gave a value that is not finite.

    The simulation stands at its last good step.

    Attributes:
        body: name of the body where it was seen.
        element: number of the cell in that body, -1 when no single cell is to blame.
        time: simulated time of the last good step [s].
    """

    def __init__(
        self, message: str, *, body: str = "", element: int = -1, time: float = 0.0
    ) -> None:
        self.body = body
        self.element = element
        self.time = time
        super().__init__(message)
