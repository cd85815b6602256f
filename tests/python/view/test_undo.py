"""Moments that the live view goes back to."""

import tissu as ts
from tissu.live_view.undo import Undo


def go_on(simulation: ts.Simulation) -> None:
    """For half a second."""
    for _ in range(5):
        simulation.step()


def test_each_press_in_a_pause_is_taken_back_by_itself() -> None:
    """They stand at one simulated time, and had been one moment."""
    mesh = ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(5, 1, 1))
    body = ts.Body(mesh=mesh, law=ts.StVK(young=1e4, poisson=0.3), density=1000)
    scene = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(0.1), editing=True)
    simulation = scene.compile()
    undo = Undo()
    for cell in range(3):
        undo.remember([simulation], True)
        simulation.remove_cells(body="bar", cells=[cell])
    whole = len(simulation.remaining_cells("bar")) + 3
    for left in (whole - 2, whole - 1, whole, whole):
        undo.back([simulation])
        assert len(simulation.remaining_cells("bar")) == left
    for cell in range(2):  # a use that goes on
        undo.remember([simulation], cell == 0)
        simulation.remove_cells(body="bar", cells=[cell])
    undo.back([simulation])
    assert len(simulation.remaining_cells("bar")) == whole


def test_undo_pressed_slowly_goes_further_back_each_time() -> None:
    """It had returned to the same moment wherever the simulation had run on in between."""
    mesh = ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(5, 1, 1))
    body = ts.Body(mesh=mesh, law=ts.StVK(young=1e4, poisson=0.3), density=1000)
    simulation = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(0.1)).compile()
    undo = Undo()
    for _ in range(3):  # uses at 0, 0.5 and 1 s
        undo.remember([simulation])
        go_on(simulation)
    for expected in (1.0, 0.5, 0.0, 0.0):
        undo.back([simulation])
        assert round(simulation.time, 9) == expected
        go_on(simulation)
    undo.remember([simulation])
    go_on(simulation)
    undo.back([simulation])
    assert round(simulation.time, 9) == 0.5
