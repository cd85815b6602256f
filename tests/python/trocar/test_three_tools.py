"""One port, three tools: recognised by their tags, each felt as it is, each with its work done."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np

EXAMPLES = Path(__file__).parents[3] / "examples"


def test_tissue_is_palpated_cut_and_ablated_through_one_port() -> None:
    """Tools in the order of the script, none between; forces, parts and cells that are gone."""
    names = runpy.run_path(str(EXAMPLES / "three_tools.py"))
    simulation = names["scene"]().compile()
    cells = simulation.meshes["nodule"].cell_count
    opened: list[float] = []
    simulation.on_step(lambda report: opened.extend(cut.area for cut in report.cuts))
    felt = names["felt"](simulation)
    order = [one.tool for one in felt if one.tool is not None]
    assert list(dict.fromkeys(order)) == ["probe", "knife", "ablator"]
    assert order == sorted(order, key=["probe", "knife", "ablator"].index)
    assert {one.state for one in felt} <= {"free", "contact", "empty"}
    largest = {
        tool: max(float(np.linalg.norm(one.fast)) for one in felt if one.tool == tool)
        for tool in ("probe", "knife", "ablator")
    }
    assert 0.5 < largest["probe"] < 3.0
    assert 20.0 * 0.008 < largest["knife"] < 1.5 * 20.0 * 0.02  # J_c times the blade in the band
    assert largest["ablator"] == 0.0
    assert 0.8e-4 <= sum(opened) < 0.95e-4  # its cross-section is 8 mm x 10 mm, across at least
    assert 20 < cells - simulation.meshes["nodule"].cell_count < cells - 200
    assert len(simulation.crossings()) == 0
