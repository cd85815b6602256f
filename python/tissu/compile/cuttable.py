"""What instruments and tears ask of the bodies that they cut."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.errors import ParameterError, SceneError
from tissu.scene.instrument import Knife
from tissu.scene.problem import Path as Place
from tissu.scene.problem import Problem

if TYPE_CHECKING:
    from tissu.scene.tear import Tear
    from tissu.simulation import Simulation


def refuse_uncuttable(simulation: Simulation) -> None:
    """Refuse instruments and tears of bodies that cannot be cut.

    Raises:
        SceneError: they cannot, with what stands against it.
    """
    scene, problems = simulation.scene, list[Problem]()
    named: list[tuple[Place, str]] = [
        (("instruments", name, tool.bodies_field, number), body)
        for name, tool in scene.instruments.items()
        for number, body in enumerate(tool.bodies)
    ]
    named += [(("tear", number, "body"), tear.body) for number, tear in enumerate(scene.tear)]
    for path, body in named:
        if body in scene.tissue:
            if body in simulation.touching:
                text = (
                    f"found '{body}', a tissue whose surface meets others, which follows no cut; "
                )
                problems.append(Problem(path, f"{text}leave it out of the contacts, or here"))
            continue
        try:
            simulation._core.require_parting(body)
        except ParameterError as error:
            problems.append(Problem(path, str(error).rstrip(".")))
    problems += pressed(simulation)
    for number, tear in enumerate(scene.tear):
        problems += [] if problems else too_short(simulation, number, tear)
    if problems:
        raise SceneError([problem.sentence(scene.source) for problem in problems])


def pressed(simulation: Simulation) -> list[Problem]:
    """Knives with a toughness in lines, along which no blade goes on, and in tissue."""
    scene, found = simulation.scene, []
    for name, tool in scene.instruments.items():
        if not isinstance(tool, Knife) or tool.toughness is None:
            continue
        for body in tool.cuts:
            of_tissue = body in scene.tissue
            mesh = None if of_tissue else simulation.meshes[body]
            if mesh is not None and (mesh.thin != (1,) or mesh.volume_blocks):
                continue
            kind = "tissue" if of_tissue else "lines"
            text = f"found a toughness of a knife that cuts the {kind} '{body}'; bodies of volume "
            text += "cells and sheets are accepted, or a knife without toughness"
            found.append(Problem(("instruments", name, "toughness"), text))
    return found


def too_short(simulation: Simulation, number: int, tear: Tear) -> list[Problem]:
    """A tear whose length the cells do not resolve, or of a body that has no stress."""
    from tissu.simulation.slicing import cell_size

    try:
        simulation.field("cauchy_stress", "cells", tear.body)
    except ParameterError as error:
        return [Problem(("tear", number, "body"), str(error))]
    size = cell_size(simulation, tear.body)
    if tear.length >= size:
        return []
    text = f"found {tear.length:g} m, below {size:.3g} m, the mean edge of the cells of "
    text += f"'{tear.body}'; at least that is accepted, or a finer mesh"
    return [Problem(("tear", number, "length"), text)]
