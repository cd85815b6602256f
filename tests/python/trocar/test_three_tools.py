"""One port, three tools: recognised by their tags, each felt as it is, each with its work done."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np

EXAMPLES = Path(__file__).parents[3] / "examples"
VISITS = ["probe", "knife", "ablator", "probe"]


def test_an_organ_is_palpated_cut_ablated_and_felt_in_its_wound() -> None:
    """Tools in the order of the script, none between; forces, an incision, and what is gone."""
    names = runpy.run_path(str(EXAMPLES / "three_tools.py"))
    simulation = names["scene"]().compile()
    volume = simulation.pieces("organ")[0].volume
    opened: list[float] = []
    crossings: list[int] = []

    def look(report: object) -> None:
        opened.extend(cut.area for cut in report.cuts)  # type: ignore[attr-defined]
        if round(simulation.time / simulation.dt) % 20 == 0:
            crossings.append(len(simulation.crossings()))

    simulation.on_step(look)
    felt = names["felt"](simulation)
    visits: list[list[object]] = []
    before = None
    for one in felt:
        if one.tool is not None and one.tool != before:
            visits.append([])
        if one.tool is not None:
            visits[-1].append(one)
        before = one.tool
    assert [visit[0].tool for visit in visits] == VISITS  # type: ignore[attr-defined]
    assert {one.state for one in felt} <= {"free", "contact", "empty"}
    largest = [max(float(np.linalg.norm(one.fast)) for one in visit) for visit in visits]  # type: ignore[attr-defined]
    # Pressed 8 mm: as in examples/palpate.py, about a newton.
    assert 0.5 < largest[0] < 3.0
    # J_c for each metre of the blade in the organ, of which 3.5 cm is all.
    assert 0.2 < largest[1] / names["TOUGHNESS"] / 0.01 < 3.5 + 0.5
    assert largest[2] == 0.0
    # The floor of the wound is felt, deeper than where the surface was felt.
    assert largest[3] > 0.1
    deep = [min(one.tip[2] for one in visit if one.force.any()) for visit in (visits[0], visits[3])]  # type: ignore[attr-defined]
    assert deep[1] < deep[0] - 0.01
    # Across the organ, 11 cm wide there, about 1 cm deep on the way.
    assert 4e-4 < sum(opened) < 16e-4
    whole = simulation.pieces("organ")
    gone = volume - sum(piece.volume for piece in whole)
    # The ball of 12 mm goes in to its middle and deeper: half of its volume to a ball and its way.
    ball = 4.0 / 3.0 * np.pi * 0.012**3
    assert 0.3 * ball < gone < 3.0 * ball
    assert simulation.surface("organ").cut.any()
    assert set(crossings) == {0}
