"""What a compiled scene will run, why, and what it will not."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from tissu.counted import counted

if TYPE_CHECKING:
    from tissu.scene.effect import Effect


@dataclass(frozen=True, slots=True)
class Plan:
    """The effects, the method and the solver of a run.

    Attributes:
        effects: each with the field of the scene that switches it on.
        absent: effects that the scene does not switch on; none of their code runs.
        notes: facts that are accepted but worth knowing.
        unknowns: three for each node, held ones too; without the room that editing leaves for cuts.
        matrix_blocks: 3x3 blocks of the system matrix.
        integrator: its name.
        solver: name of the linear solver.
        stable_step: the largest stable step of an explicit method at rest [s]; else infinite.
        threads: how many.
        instruction_set: of the hot kernels.
    """

    effects: tuple[Effect, ...]
    absent: tuple[str, ...]
    notes: tuple[str, ...]
    unknowns: int
    matrix_blocks: int
    integrator: str
    solver: str
    stable_step: float
    threads: int
    instruction_set: str

    @property
    def matrix_bytes(self) -> int:
        """Bytes of the system matrix: nine numbers and a column for each block."""
        return self.matrix_blocks * (9 * 8 + 4)

    def __str__(self) -> str:
        """In plain words."""
        threads = counted(self.threads, "thread")
        blocks = counted(self.matrix_blocks, "block")
        limit = f", stable up to {self.stable_step:.4g} s" if isfinite(self.stable_step) else ""
        lines = [
            f"{counted(self.unknowns, 'unknown')}, {blocks} in the matrix",
            f"{self.integrator}{limit}; {self.solver}; {threads}, {self.instruction_set} kernels",
            "runs:",
            *(f"  - {effect}" for effect in self.effects),
        ]
        if self.absent:
            lines += ["absent: " + ", ".join(self.absent)]
        if self.notes:
            lines += ["worth knowing:", *(f"  - {note}" for note in self.notes)]
        return "\n".join(lines)
