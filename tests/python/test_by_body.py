"""Arrays by body: a misspelt name gets the names that there are."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts


@pytest.fixture(scope="module")
def simulation() -> ts.Simulation:
    cube = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(1, 1, 1), cell="hexahedron")
    law = ts.StVK(young=1e4, poisson=0.3)
    bodies = {name: ts.Body(mesh=cube, law=law, density=1e3) for name in ("liver", "kidney")}
    return ts.Scene(bodies=bodies, step=ts.ImplicitEuler(0.01)).compile()


@pytest.mark.parametrize("of", ["positions", "velocities"])
def test_a_misspelt_body_gets_the_names_that_there_are(simulation: ts.Simulation, of: str) -> None:
    with pytest.raises(ts.ParameterError) as told:
        getattr(simulation, of)["livr"]
    assert str(told.value) == "found body 'livr'; accepted: liver, kidney"
    with pytest.raises(KeyError):  # as of every mapping
        getattr(simulation, of)["livr"]


def test_it_is_a_mapping_of_views(simulation: ts.Simulation) -> None:
    found = simulation.positions
    assert list(found) == ["liver", "kidney"]
    assert len(found) == 2
    assert "livr" not in found
    assert found.get("livr") is None
    with pytest.raises(TypeError):
        found["liver"] = np.zeros((8, 3))  # type: ignore[index]
    before = found["kidney"][0, 0]
    simulation.positions["kidney"][0, 0] += 1.0
    assert found["kidney"][0, 0] == before + 1.0
