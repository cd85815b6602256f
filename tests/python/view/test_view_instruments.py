"""A knife on a gizmo: it cuts on its way, and the page says the force on it."""

import numpy as np
import pytest
from test_view_browser import organ

import tissu as ts
from tissu.live_view.gizmo import Gizmo
from tissu.live_view.layers import LAYERS
from tissu.live_view.tools import TOOLS
from tissu.live_view.tools.instrument import MoveInstrument
from tissu.live_view.tools.obstacle import quaternion

EDGE = [(0, -0.1, 0), (0, 0.2, 0)]


def knife(**changes):
    return ts.Knife(EDGE, cuts=["organ"], **{"position": (0.1, 0, 0.12)} | changes)


def test_a_knife_goes_with_its_gizmo_and_cuts_in_every_simulation():
    made = {"editing": True, "gravity": None, "instruments": {"scalpel": knife()}}
    simulations = [organ(**made), organ(**made)]
    assert MoveInstrument in TOOLS and MoveInstrument.offered(simulations[0])
    tool = MoveInstrument(simulations)
    assert [(one.name, one.lane) for one in tool.gizmos(simulations)] == [
        ("scalpel", 0),
        ("scalpel", 1),
    ]
    turned = np.array([[np.cos(0.1), 0, np.sin(0.1)], [0, 1, 0], [-np.sin(0.1), 0, np.cos(0.1)]])
    for z in (0.06, -0.05):
        tool.turn(simulations, Gizmo("scalpel", 0, np.array([0.1, 0, z]), quaternion(turned)))
    for simulation in simulations:
        np.testing.assert_allclose(simulation.instruments["scalpel"].rotation, turned, atol=1e-12)
        assert simulation.step().cuts
        assert len(simulation.pieces("organ")) == 2
    ((drawn,), _) = tool.draw(simulations)
    np.testing.assert_allclose(drawn.lines[0], simulations[0].instruments["scalpel"].edge)
    assert tool.say(simulations) == ""


def test_a_tough_knife_says_its_force():
    simulations = [
        organ(editing=True, gravity=None, instruments={"scalpel": knife(toughness=50.0)})
    ]
    tool = MoveInstrument(simulations)
    for z in (0.075, 0.074, 0.073):
        tool.turn(simulations, Gizmo("scalpel", 0, np.array([0.1, 0, z]), np.array([1.0, 0, 0, 0])))
        simulations[0].step()
    assert tool.say(simulations).startswith("scalpel ")


def test_it_is_offered_only_where_an_instrument_has_no_path():
    assert not MoveInstrument.offered(organ(editing=True))
    path = ts.ToolPath(times=[0], positions=[(0.1, 0, 0.2)])
    led = organ(editing=True, instruments={"scalpel": ts.Knife(EDGE, cuts=["organ"], path=path)})
    assert not MoveInstrument.offered(led)
    with pytest.raises(ts.ParameterError, match="which its path leads"):
        led.instruments["scalpel"].place((0, 0, 0))


def test_an_instrument_on_a_path_is_drawn_where_it_is():
    path = ts.ToolPath(times=[0, 0.1], positions=[(0.1, 0, 0.2), (0.1, 0, 0.1)])
    hook = ts.Ablator(radius=0.01, removes=["organ"], position=(0, 0, 0.3))
    scalpel = ts.Knife(EDGE, cuts=["organ"], path=path)
    simulation = organ(editing=True, instruments={"scalpel": scalpel, "hook": hook})
    (layer,) = (one for one in LAYERS if one.name == "instruments")
    assert layer.offered(simulation) and not layer.offered(organ(editing=True))
    draw = layer.begin(simulation)
    simulation.step()
    knife_marks, ball = draw()
    # The path goes down by 1 m/s; the instrument's axes are not turned.
    there = np.array(EDGE) + np.array((0.1, 0, 0.2 - simulation.time))
    np.testing.assert_allclose(knife_marks.lines, [there], atol=1e-12)
    np.testing.assert_allclose(ball.points, [(0, 0, 0.3)], atol=1e-12)
    assert len(ball.lines) == 0
