"""Checking a scene without running it: its problems, and in plain words what it switches on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from tissu.compile.doubts import doubts
from tissu.compile.prepare import prepare
from tissu.effects import absent_of, effects_of
from tissu.errors import SceneError

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.front import Scene
    from tissu.scene.effect import Effect
    from tissu.scene.scene import SceneData


@dataclass(frozen=True, slots=True)
class Check:
    """The effects that a scene would run, and its problems.

    Attributes:
        problems: what compile() refuses, one sentence each, with its place.
        notes: facts that are accepted but worth knowing.
        effects: effects switched on, each with the field that asks for it.
        absent: effects the scene does not ask for; they run no code.
    """

    problems: list[str]
    notes: list[str]
    effects: list[Effect]
    absent: list[str]

    @property
    def ok(self) -> bool:
        """Whether the scene compiles."""
        return not self.problems

    def __str__(self) -> str:
        sections = {
            "Problems": self.problems,
            "Notes": self.notes,
            "Switched on": [str(effect) for effect in self.effects],
            "Absent (not asked for, so no code of it runs)": [", ".join(self.absent)]
            if self.absent
            else [],
        }
        return "\n".join(
            f"{title}:\n" + "\n".join(f"  - {line}" for line in lines)
            for title, lines in sections.items()
            if lines
        )


def check_scene(scene: Scene) -> Check:
    """Everything that compile() would refuse, and what the scene switches on; raises nothing."""
    prepared = prepare(scene)
    check = check_of(prepared)
    cuts = bool(scene.instruments or scene.tear)
    if not check.ok or (prepared.contact is None and not cuts):
        return check
    from tissu.compile.world import simulation_of, world_and_start

    try:  # whether surfaces overlap at the start, and whether bodies can be cut, the core says
        apart = simulation_of(scene, prepared, check)[1] if cuts else world_and_start(prepared)[1]
    except SceneError as error:
        return replace(check, problems=error.problems)
    return check if apart is None else replace(check, notes=[*check.notes, apart.words])


def problems_of(scene: SceneData) -> list[str]:
    """All that is wrong with a scene, whose fields may have problems of their own."""
    return _sentences(prepare(scene))


def check_of(prepared: Prepared) -> Check:
    """The same as check_scene for a scene that is resolved already."""
    scene = prepared.scene
    problems = _sentences(prepared)
    return Check(
        problems=problems,
        notes=[
            *prepared.findings.notes,
            *doubts(prepared),
            *_outputs_between_steps(scene),
        ],
        effects=effects_of(scene, prepared.counts()),
        absent=absent_of(scene),
    )


def _outputs_between_steps(scene: SceneData) -> list[str]:
    """A note when results are asked for more often than there are steps."""
    dt = getattr(scene.step, "dt", None)
    if scene.output is None or not isinstance(dt, float) or scene.output.every >= dt * (1.0 - 1e-6):
        return []
    every = scene.output.every
    return [f"output.every: {every:g} s is shorter than the step of {dt:g} s: each step is written"]


def _sentences(prepared: Prepared) -> list[str]:
    """The problems, in the order of the file's lines where there is a file."""
    source, problems = prepared.scene.source, list(prepared.findings.problems)
    if source is not None:
        problems.sort(key=lambda problem: source.line(problem.path))
    return [problem.sentence(source) for problem in problems]
