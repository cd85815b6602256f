"""Severed tissue under a hand, in the files of a run, and in forged checkpoints."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from severing_scenes import MIDDLE, hanging, simulated, steps
from tissu.live_view.layers.tissue import TISSUE
from tissu.simulation.resuming import _severed_of


def _around(simulation: ts.Simulation, frame: int) -> ts.Box:
    """All points that follow a frame: what it takes to leave it without any."""
    left = simulation._left("fascia")
    follow = (left.weights.frames == frame) & left.weights.listed()
    points = simulation.points("fascia")[follow.any(axis=1)]
    return ts.Box(tuple(points.min(axis=0) - 1e-6), tuple(points.max(axis=0) + 1e-6))


def test_a_frame_without_points_is_let_go() -> None:
    """A grab of it is released, the report says so; another one goes on pulling."""
    simulation = hanging(grabbing=True).compile()
    lost = simulation.grab("fascia", 3, (0, 0, 0), "1 N/m")
    kept = simulation.grab("upper", 0, (0, 0, 0), "1 N/m")
    report = simulation.ablate("fascia", _around(simulation, 3))
    assert len(report.released) == 1
    assert lost.released
    assert not kept.released
    assert [grab.body for grab in simulation.grabs] == ["upper"]
    steps(simulation, 2)
    with pytest.raises(ts.ParameterError, match="held"):
        simulation.grab("fascia", 3, (0, 0, 0), "1 N/m")


def test_a_frame_that_is_led_keeps_its_points() -> None:
    """A live lead has a target for each of its frames: until its release the cut is refused."""
    where = hanging().compile().tissue["fascia"].points[[3]]
    hand = ts.Fixed("fascia", on=ts.Sphere(tuple(where[0]), 1e-4), name="hand")
    simulation = hanging(fixed=[*hanging().fixed, hand]).compile()
    lead = simulation.lead("hand", where + np.array([0, 0, 0.001]))
    with pytest.raises(ts.ParameterError, match="'hand', which is led live"):
        simulation.ablate("fascia", _around(simulation, 3))
    assert simulation._severed == {}
    lead.release()
    steps(simulation, 2)
    assert lead.released
    assert simulation.ablate("fascia", _around(simulation, 3)).links_severed > 0
    steps(simulation, 2)


def test_what_is_drawn_and_written_has_the_points_that_are_left(tmp_path: Any) -> None:
    simulation = simulated()
    draw = TISSUE.begin(simulation)
    assert sum(len(marks.points) for marks in draw()) == 150
    simulation.ablate("fascia", ts.Sphere((0.05, 0.05, 0.055), "15 mm"))
    simulation.cut("fascia", MIDDLE)
    steps(simulation, 1)
    count = len(simulation.points("fascia"))
    assert count < 150
    assert sum(len(marks.points) for marks in draw()) == count
    assert len(simulation.field("von_mises", "points", "fascia")) == count
    ts.draw(simulation, tmp_path / "severed.png")
    series = ts.Series(simulation, tmp_path)
    series.write()
    (file,) = tmp_path.rglob("fascia_*.vtu")
    written = ts.read_mesh(file)
    assert written.points == pytest.approx(simulation.points("fascia"))


@pytest.mark.parametrize("kind", ["odd", "beyond", "no link", "all", "none"])
def test_links_that_no_cut_severed_are_refused(kind: str) -> None:
    links = simulated()._links
    pairs = links["fascia"].all()
    first = pairs[pairs[:, 0] == 0]
    stranger = np.setdiff1d(np.arange(len(links["fascia"].origins)), first[:, 1])[0]
    found = {
        "odd": pairs[:4].ravel()[:-1],
        "beyond": np.array([10**6, 0], dtype=np.int32),
        "no link": np.array([0, stranger], dtype=np.int32),
        "all": pairs.ravel(),
        "none": np.empty(0, dtype=np.int32),
    }[kind]
    with pytest.raises(ts.ParameterError, match="severed links of tissue 'fascia' do not fit"):
        _severed_of(links, {"severed_0": found})
    assert _severed_of(links, {}) == {}
