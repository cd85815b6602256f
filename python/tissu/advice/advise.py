"""Running a scene with several settings, to find the cheapest that is good enough."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from tissu.advice.advice import Advice
from tissu.advice.answer import doubts, reference_words
from tissu.advice.choices import Choices
from tissu.advice.explore import explore
from tissu.advice.goal import Goal, budget_seconds, goal
from tissu.advice.laboratory import Laboratory, Tried
from tissu.advice.measure import Watch, watch
from tissu.advice.reference import Reference, find_reference
from tissu.advice.resolution import Resolutions
from tissu.advice.rows import largest_move, row_of
from tissu.advice.setting import Setting
from tissu.errors import ParameterError
from tissu.reading import names_of
from tissu.scene.model import MODELS
from tissu.scene.part import spelled, type_name
from tissu.scene.problem import nearest, one_of_words
from tissu.scene.scene import require_scene
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu import units
    from tissu.front import Scene

_SHARE_OF_REFERENCE = 0.4  # of the budget, for the reference and its order
_SMALL = 0.5  # of the error asked for: more of the reference leaves little to the settings
_STILL = 1e-9  # of the extent: no node that moves less is said to move


def advise(
    scene: Scene,
    error: units.Number = 0.01,
    rate: units.Number = 30.0,
    *,
    budget: units.Number = 60.0,
    models: Sequence[str] = (),
    told: Callable[[str], None] | None = None,
) -> Advice:
    """Run a scene with several settings, and find the cheapest that meets an error and a rate.

    What is varied, one after the other from the scene's own setting: the time step and its method,
    the number, the order and the family of cells, Newton's iteration, the linear solver and its
    tolerance, and the models that keep the scene's laws. Errors are mean distances, over the nodes
    (n, 3) of the scene's own mesh and up to 20 times, from the richest run that two fifths of the
    budget afford; where its own error is too large, bars try richer cells for it as well.

    Args:
        scene: with a duration, or static.
        error: the mean error accepted: a share of the reference's largest displacement such as
            "1%" or 0.01, or a length such as "0.5 mm".
        rate: updates a second of wall time; each brings the scene 1/rate seconds of simulated time
            further, so that it runs in real time. An update of a static scene is one solve.
        budget: wall time that all runs together may take [s].
        models: names of models to try in addition to those that keep the scene's laws.
        told: called with a line for each run as it ends.

    Raises:
        ParameterError: no scene, an error, a rate or a budget that is not positive, a scene
            without duration, an unknown model, a budget that does not suffice for one run of the
            scene, or a share of the motion of a scene in which nothing moves.
        SceneError: the scene itself does not compile.
    """
    require_scene(scene, "advise")
    models = [spelled(model) for model in names_of(models, "models", example="fem")]
    _check_models(models)
    begin = time.perf_counter()
    dynamic = not isinstance(scene.step, Static)
    asked, seconds = goal(error, rate, dynamic=dynamic), budget_seconds(budget)
    if scene.duration is None and dynamic:
        raise ParameterError(
            "the scene has no duration; a time to be simulated is needed, such as duration: 1 s"
        )
    simulation = scene.compile()
    resolutions = Resolutions(scene, simulation.meshes)
    lab = Laboratory(scene, resolutions, watch(simulation), begin + seconds, _teller(told))
    own = _own_run(lab, Setting(Fraction(1), resolutions.order, "", scene.step), seconds)
    _check_motion(own, lab.watched, asked)

    def enough(found: Reference) -> bool:
        largest = largest_move(found.moved)
        return found.error is not None and asked.share_of(found.error, largest) <= _SMALL

    reference = find_reference(lab, own, share=_SHARE_OF_REFERENCE, enough=enough)
    explore(lab, own, reference, Choices(lab, asked, reference.tried.setting, models))
    rows = tuple(
        row_of(tried, reference, asked)
        for tried in lab.tried.values()
        if not tried.refused or tried.setting.model in models
    )
    largest = largest_move(reference.moved)
    return Advice(
        name=scene.name,
        goal=asked,
        reference=reference_words(reference, row_of(reference.tried, reference, asked), largest),
        largest=largest,
        reference_error=reference.error,
        space_order=None if reference.space is None else reference.space.order,
        time_order=None if reference.time is None else reference.time.order,
        rows=rows,
        seconds=time.perf_counter() - begin,
        notes=tuple(f"'{name}' keeps its mesh: {why}" for name, why in resolutions.fixed.items()),
        doubt=doubts(reference, asked, largest),
    )


def _own_run(lab: Laboratory, setting: Setting, budget: float) -> Tried:
    """The scene as it is.

    Raises:
        ParameterError: the budget does not suffice, or the run stops and nothing can be compared.
    """
    own = lab.run(setting, allowance=max(lab.left, 1e-9))
    assert own is not None
    measured = own.measured
    if measured is not None and measured.foreseen > 0.0:
        raise ParameterError(
            f"budget: found {budget:g} s; one run of the scene takes about "
            f"{measured.foreseen:.2g} s: give more than that, or the scene a shorter duration"
        )
    return own


def _check_motion(own: Tried, watched: Watch, asked: Goal) -> None:
    """Refuse a share of a motion that is none.

    Raises:
        ParameterError: the scene's own run moves by round-off only.
    """
    if own.measured is None or own.measured.stopped or asked.is_length:
        return
    extent = max(float(np.ptp(points, axis=0).max()) for points in watched.points.values())
    if largest_move(own.measured.moved) <= _STILL * extent:
        raise ParameterError(
            "error: found a share of the largest displacement of a scene in which nothing moves; "
            "a length is accepted, such as '0.5 mm'"
        )


def _check_models(models: Sequence[str]) -> None:
    names = [type_name(cls) for cls in MODELS]
    for model in models:
        if model not in names:
            raise ParameterError(
                f"unknown model '{model}'{nearest(model, names)} Accepted: {one_of_words(names)}"
            )


def _teller(told: Callable[[str], None] | None) -> Callable[[Tried], None]:
    def tell(tried: Tried) -> None:
        if told is not None:
            told(tried.words())

    return tell
