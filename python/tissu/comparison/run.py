"""Running the scene with each model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tissu.comparison.reference import errors, finest, with_model
from tissu.comparison.table import Comparison, Row
from tissu.comparison.trace import Trace, trace
from tissu.counted import counted
from tissu.errors import ParameterError, SceneError, TissuError
from tissu.reading import written
from tissu.scene.model import MODELS
from tissu.scene.part import spelled, type_name
from tissu.scene.problem import nearest, one_of_words
from tissu.scene.scene import require_scene

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.mesh import Mesh


def model_names() -> list[str]:
    """The names of the models."""
    return [type_name(cls) for cls in MODELS]


def compare(
    scene: Scene, *, models: Sequence[object] = (), reference: Scene | str = "finest"
) -> Comparison:
    """Run the same scene with each of several models, and measure them.

    If a model does not take the scene (its cells, law, viscosity, loads), its row gives the reason.
    If a model computes another law, it has the Young's modulus and Poisson's ratio of the scene
    (`tissu check` notes this). In a scene that is cut, the nodes that its bodies begin with are
    compared: they keep their numbers, and those that cuts add differ from run to run.

    Args:
        scene: with a duration, or static.
        models: their names, or models with their own fields, each once; empty: all.
        reference: what errors are measured against: "finest", which is fem with elements of second
            order on the same cells; the name of a model; or another scene with the same step and
            duration, whose bodies have nodes wherever this one's have.

    Raises:
        ParameterError: no scene, an unknown model or one twice, or a reference that does not fit.
        SceneError: the scene itself does not compile.
    """
    require_scene(scene, "compare")
    asked = listed_models(models) or model_names()
    reference = spelled(reference) if isinstance(reference, str) else reference
    for model in [*asked, *([reference] if isinstance(reference, str) else [])]:
        check_model(model, also=("finest",) if model is reference else ())
    words = [_word(model) for model in asked]
    for word in words:
        if words.count(word) > 1:
            raise ParameterError(f"found the model {word} twice; each is accepted once")
    meshes = scene.compile().meshes  # from here on a refusal is that of a model
    traces: dict[str, Trace | TissuError] = {}
    for model in asked:
        traces[_word(model)] = _tried(scene, model)
    richest, against = _reference(scene, dict(meshes), reference, traces)
    rows = [_row(word, found, richest) for word, found in traces.items()]
    cells = sum(mesh.cell_count for mesh in meshes.values())
    return Comparison(scene.name, cells, against, tuple(rows))


def listed_models(models: object) -> list[object]:
    """The models of a list, their names as they are spelled in scenes.

    Raises:
        ParameterError: not a list; a single text would be taken for a list of its letters.
    """
    if not isinstance(models, (list, tuple)):
        example = f"['{models}']" if isinstance(models, str) else "['fem', 'mass_spring']"
        raise ParameterError(
            f"found the models {written(models)}; a list is accepted, such as {example}"
        )
    return [spelled(model) if isinstance(model, str) else model for model in models]


def check_model(model: object, *, also: Sequence[str] = ()) -> None:
    """Refuse a name that no model has.

    Raises:
        ParameterError: which are accepted.
    """
    names = [*model_names(), *also]
    if isinstance(model, str) and model not in names:
        raise ParameterError(
            f"unknown model '{model}'{nearest(model, names)} Accepted: {one_of_words(names)}"
        )


def _word(model: object) -> str:
    """What a row is called."""
    if isinstance(model, str):
        return model
    given = [
        f"{n} {getattr(model, n)}" for n in getattr(model, "model_fields_set", ()) if n != "type"
    ]
    return str(getattr(model, "type", model)) + (f" ({', '.join(sorted(given))})" if given else "")


def _tried(scene: Scene, model: object) -> Trace | TissuError:
    try:
        return trace(with_model(scene, model))
    except TissuError as error:
        return error


def _reference(
    scene: Scene,
    meshes: dict[str, Mesh],
    reference: Scene | str,
    traces: dict[str, Trace | TissuError],
) -> tuple[Trace, str]:
    try:
        found, words = _reference_run(scene, meshes, reference, traces)
    except SceneError as error:
        name = reference if isinstance(reference, str) else f"the scene {reference.name}"
        raise ParameterError(
            f"the reference ({name}) is refused, so name another with --reference: {_why(error)}"
        ) from None
    if found.stopped:
        raise ParameterError(
            f"the reference ({words}) stopped before its end, so name another with --reference: "
            f"{found.stopped}"
        )
    return found, words + _doubts(found)


def _reference_run(
    scene: Scene,
    meshes: dict[str, Mesh],
    reference: Scene | str,
    traces: dict[str, Trace | TissuError],
) -> tuple[Trace, str]:
    if reference == "finest":
        found, words = finest(scene, meshes)
    elif isinstance(reference, str):
        known = traces.get(reference)
        found = known if isinstance(known, Trace) else trace(with_model(scene, reference))
        words = f"{reference} on the same mesh"
    else:
        found, words = trace(reference), f"the scene {reference.name}"
    return found, words


def _doubts(reference: Trace) -> str:
    """Why a reference may be no measure of others; empty: no sign of it."""
    doubts = []
    if reference.unconverged:
        doubts.append(f"{reference.unconverged} of its {reference.steps} steps did not converge")
    if reference.inverted:
        doubts.append(f"{counted(reference.inverted, 'cell')} of it inside out at the end")
    return f" (beware: {', '.join(doubts)})" if doubts else ""


def _why(error: TissuError) -> str:
    return "; ".join(error.problems) if isinstance(error, SceneError) else str(error)


def _row(word: str, found: Trace | TissuError, reference: Trace) -> Row:
    if isinstance(found, TissuError):
        return Row(word, "refused", why=_why(found))
    known = found.times.size > 0
    mean, largest, size = errors(found, reference) if known else (None, None, 0.0)
    return Row(
        model=word,
        outcome="stopped" if found.stopped else "finished",
        mean_error=mean,
        largest_error=largest,
        mean_percent=100.0 * mean / size if mean is not None and size > 0.0 else None,
        ms_per_step=found.ms_per_step if found.steps else None,
        iterations_per_step=found.iterations_per_step,
        unconverged=found.unconverged,
        bytes_per_cell=found.model_bytes / max(1, found.cells),
        megabytes=(found.model_bytes + found.matrix_bytes) / 1e6,
        stable_step=2.0 / found.frequency if found.frequency > 0.0 else None,
        inverted=found.inverted,
        why=found.stopped,
    )
