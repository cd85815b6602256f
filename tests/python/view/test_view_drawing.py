"""What the page is sent: meshes of bodies and their colours, and marks; by viser's own handles."""

from types import SimpleNamespace

import numpy as np
import pytest

from tissu.live_view.body_drawing import BodyDrawing
from tissu.live_view.colouring import Colouring
from tissu.live_view.frame import BodyFrame
from tissu.live_view.marks import Marks
from tissu.live_view.marks_drawing import MarksDrawing
from tissu.live_view.server import open_server
from tissu.live_view.stage import stage_of
from tissu.live_view.surface import seen
from tissu.mesh import bar_mesh


@pytest.fixture
def scene():
    server = open_server("drawing", "a word")
    yield server.scene
    server.stop()


def cube(cells=3):
    return bar_mesh(size=(0.1, 0.1, 0.1), cells=(cells, cells, cells), cell="tetra")


def stage(mesh):
    return stage_of([mesh.points], (0, 0, 1), lanes=1)


def frame(mesh, values, field="displacement", shift=0.0):
    of_body = seen(mesh)
    places = (mesh.points[of_body.nodes] + shift).astype(np.float32)
    body = BodyFrame(of_body, places, values)
    return SimpleNamespace(field=field, bodies={(0, "cube"): body})


def colouring():
    session = SimpleNamespace(limits=None, share=lambda least: least)
    return Colouring(session), session


def body_drawing(scene, mesh):
    return BodyDrawing(
        scene, "0/cube", stage=stage(mesh), lane=0, colour=(9, 9, 9), felt=lambda _: None
    )


def test_bands_follow_the_nodes_while_their_colours_stay(scene):
    mesh = cube()
    values = mesh.points[seen(mesh).nodes][:, 0].copy()
    drawing, first = body_drawing(scene, mesh), frame(mesh, values)
    drawing.colour(first.bodies[0, "cube"], (0.0, 0.1))
    drawing.show(first.bodies[0, "cube"], edges=False)
    painted = {number: handle.vertices.copy() for number, handle in drawing._painted.items()}
    assert len(painted) == 16 and drawing.surface.opacity == 0.0
    factor = stage(mesh).factor
    for number, places in painted.items():  # sixteenths of the way along x
        x = places[:, 0] / factor
        assert x.min() == pytest.approx(0.1 * number / 16, abs=1e-7)
        assert x.max() == pytest.approx(0.1 * (number + 1) / 16, abs=1e-7)
    drawing.show(frame(mesh, values, shift=0.02).bodies[0, "cube"], edges=False)
    for number, places in painted.items():
        moved = drawing._painted[number].vertices
        assert np.abs(moved - places - 0.02 * factor).max() < 1e-6 * factor
    drawing.colour(first.bodies[0, "cube"], None)
    drawing.show(first.bodies[0, "cube"], edges=False)
    assert drawing.surface.opacity is None
    assert not any(handle.visible for handle in drawing._painted.values())


def test_colours_are_found_anew_when_values_change_and_the_time_allows():
    mesh = cube()
    values = np.linspace(0.0, 1.0, len(seen(mesh).nodes))
    colours, session = colouring()
    first = frame(mesh, values)
    assert colours.are_due(first)
    with colours.anew(first) as limits:
        assert limits == (0.0, 1.0)
    assert not colours.are_due(frame(mesh, values))  # the same values
    colours._ration.spent(1.0, begun=float("inf"))  # dear: not for a long time
    other = frame(mesh, 3.0 * values)
    assert not colours.are_due(other)
    session.limits = None  # they are fitted
    assert colours.are_due(other)
    with colours.anew(other) as limits:
        assert limits == (0.0, 3.0)
    colours._ration.spent(1.0, begun=float("inf"))
    assert colours.are_due(frame(mesh, values, field="von_mises"))
    assert colours.are_due(frame(cube(2), values[: len(seen(cube(2)).nodes)]))
    colours._ration._due = 0.0
    assert colours.are_due(frame(mesh, values.copy()))


def test_without_a_field_nothing_is_coloured():
    mesh = cube()
    colours, _ = colouring()
    assert not colours.are_due(frame(mesh, None, field=""))
    values = np.linspace(0.0, 1.0, len(seen(mesh).nodes))
    with colours.anew(frame(mesh, values)):
        pass
    off = frame(mesh, None, field="")
    assert colours.are_due(off)
    with colours.anew(off) as limits:
        assert limits is None
    assert not colours.are_due(off)


def test_marks_of_every_kind_are_drawn_moved_and_taken_away(scene):
    mesh = cube()
    drawing = MarksDrawing(scene, "0/contact", stage=stage(mesh), lane=0)
    factor = stage(mesh).factor
    corners = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 1], [1, 0, 1], [0, 1, 1]]])
    ends = corners[:, :2]
    marks = Marks((1, 2, 3), points=corners[0], arrows=ends, lines=ends, surface=corners)
    drawing.show([marks])
    drawn = {kind: handle for (kind, _), handle in drawing._drawn.items()}
    assert set(drawn) == {"points", "arrows", "lines", "surface"}
    surface = drawn["surface"]
    assert np.allclose(surface.vertices[surface.faces], factor * corners)
    drawing.show([Marks((1, 2, 3), surface=corners[:1] + 0.5)])
    assert np.allclose(surface.vertices[surface.faces], factor * (corners[:1] + 0.5))
    assert [drawn[kind].visible for kind in ("points", "arrows", "lines")] == [False] * 3
    drawing.show([])
    assert not surface.visible
