"""What lies inside another surface at the start without crossing it is run and said."""

import math
import re

import numpy as np
import pytest

import tissu as ts
from contact_scenes import cube, scene, sheet
from tissu.compile.inside import winding_number

SMALL = {"size": (0.02, 0.02, 0.02), "cells": (1, 1, 1)}
MIDDLE = (0.04, 0.04, 0.04)


def said(bodies, contacts, **obstacles):
    """Notes on what lies inside something."""
    made = scene(bodies=bodies, obstacles=obstacles, contacts=contacts)
    check = made.check()
    assert check.problems == []
    return [note for note in check.notes if "lies inside" in note]


def test_a_body_inside_another_one():
    bodies = {"liver": cube(), "stone": cube(MIDDLE, **SMALL)}
    (note,) = said(bodies, [ts.Contact(("liver", "stone"))])
    assert note.startswith("contacts: 'stone' lies inside 'liver', which is met from outside only")
    beside = {"liver": cube(), "stone": cube((0.12, 0.04, 0.04), **SMALL)}
    assert said(beside, [ts.Contact(("liver", "stone"))]) == []
    assert said(bodies, [ts.SelfContact("liver")]) == []


def test_obstacles_inside_and_around():
    liver = {"liver": cube()}
    ball = ts.SphereObstacle((0.05, 0.05, 0.05), 0.01)
    (note,) = said(liver, [ts.Contact(("liver", "ball"))], ball=ball)
    assert "'ball' lies inside 'liver'" in note
    hall = ts.BoxObstacle((-1, -1, -1), (1, 1, 1))
    (note,) = said(liver, [ts.Contact(("liver", "hall"))], hall=hall)
    assert "'liver' lies inside 'hall'" in note


def test_a_body_in_the_hollow_of_another_one_is_where_it_belongs():
    """The hollow is outside of what is around it."""
    around = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(5, 5, 5), cell="hexahedron")
    nodes = around.volume_blocks[0].nodes
    middles = around.points[nodes].mean(axis=1)
    shell = nodes[(np.abs(middles - 0.05) > 0.031).any(axis=1)]
    assert len(shell) == 98
    used, numbers = np.unique(shell, return_inverse=True)
    cells = numbers.reshape(shell.shape).astype(np.int32)
    mesh = ts.Mesh(points=around.points[used], cells=[("hexahedron", cells)])
    bodies = {"shell": cube(mesh=mesh), "stone": cube(MIDDLE, **SMALL)}
    assert said(bodies, [ts.Contact(("shell", "stone"))]) == []
    # But not in its wall.
    walled = {"size": (0.01, 0.01, 0.01), "cells": (1, 1, 1)}
    bodies["stone"] = cube((0.005, 0.04, 0.04), **walled)
    assert len(said(bodies, [ts.Contact(("shell", "stone"))])) == 1


@pytest.mark.parametrize("part", [0, 1])
def test_one_part_of_a_body_is_enough(part):
    """Of a body of two pieces that no cell joins."""
    one = ts.bar_mesh(size=(0.02, 0.02, 0.02), cells=(1, 1, 1), cell="hexahedron")
    places = [np.array((0.5, 0.0, 0.0)), np.array(MIDDLE)]
    points = np.concatenate([one.points + places[part], one.points + places[1 - part]])
    cells = np.concatenate([one.volume_blocks[0].nodes, one.volume_blocks[0].nodes + 8])
    both = cube(mesh=ts.Mesh(points=points, cells=[("hexahedron", cells)]))
    notes = said({"liver": cube(), "stones": both}, [ts.Contact(("liver", "stones"))])
    assert len(notes) == 1


def test_winding_numbers_of_a_box():
    box = ts.bar_mesh(size=(1, 2, 3), cells=(2, 2, 2)).surface()
    corners = ts.bar_mesh(size=(1, 2, 3), cells=(2, 2, 2)).points[box.triangles]
    rng = np.random.default_rng(3)
    for point in rng.uniform(-1, 4, (50, 3)):
        inside = bool(((point > 0) & (point < (1, 2, 3))).all())
        assert winding_number(point, corners) == pytest.approx(float(inside), abs=1e-12)


def overlapping(**fields):
    """The sentence that refuses two things that are inside each other; none: how far they moved."""
    made = scene(**fields)
    try:
        simulation = made.compile()
    except ts.errors.SceneError as error:
        return str(error)
    assert simulation.crossings() == []
    return max(np.abs(simulation.displacements(name)).max() for name in simulation.bodies)


DEEP = re.compile(r'overlap at the start: "(\w+)" and "(\w+)" by ([0-9.e-]+) m of their thickness')


@pytest.mark.parametrize(
    ("obstacle", "depth"),
    [
        (ts.SphereObstacle((0.05, 0.05, 0.115), 0.02), 0.005),  # above the top, at 10 cm
        (ts.CapsuleObstacle(((0, 0.05, 0.102), (0.1, 0.05, 0.102)), 0.004), 0.002),
        (ts.SphereObstacle((0.105, 0.105, 0.05), 0.01), 0.01 - 0.005 * math.sqrt(2)),  # an edge
    ],
)
def test_round_obstacles_that_reach_into_a_body_are_refused(obstacle, depth):
    """Their middles cross nothing."""
    contacts = [ts.Contact(("liver", "tool"), gap=1e-3)]
    found = DEEP.search(
        overlapping(bodies={"liver": cube()}, obstacles={"tool": obstacle}, contacts=contacts)
    )
    assert found.group(1, 2) == ("liver", "tool")
    assert float(found.group(3)) == pytest.approx(depth, rel=1e-4)


def test_sheets_that_are_inside_each_other_or_a_plane_are_refused():
    """2 mm thick: half of it each."""
    contacts = [ts.Contact(("one", "other"), gap=1e-4)]
    both = {"one": sheet(0.25), "other": sheet(0.2515)}
    found = DEEP.search(overlapping(bodies=both, contacts=contacts))
    assert float(found.group(3)) == pytest.approx(0.5e-3, rel=1e-4)
    table = {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))}
    contacts = [ts.Contact(("one", "table"), gap=1e-4)]
    found = DEEP.search(
        overlapping(bodies={"one": sheet(0.0004)}, obstacles=table, contacts=contacts)
    )
    assert float(found.group(3)) == pytest.approx(0.6e-3, rel=1e-4)


@pytest.mark.parametrize("depth", [-1e-5, 0.0, 0.5e-4, 0.99e-4])
def test_no_deeper_than_the_gap_they_are_moved_apart_by_no_more(depth):
    table = {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))}
    contacts = [ts.Contact(("one", "table"), gap=1e-4)]
    moved = overlapping(bodies={"one": sheet(1e-3 - depth)}, obstacles=table, contacts=contacts)
    assert moved <= depth + 1e-4 + 1e-12
    below = {"ball": ts.SphereObstacle((0.05, 0.05, -0.02 + depth), 0.02)}
    contacts = [ts.Contact(("liver", "ball"), gap=1e-4)]
    moved = overlapping(bodies={"liver": cube()}, obstacles=below, contacts=contacts)
    assert moved <= 4 * (depth + 1e-4)  # of the nodes of a triangle whose inside touches


def test_overlaps_say_how_deep_balls_and_sheets_are_inside():
    """Closed forms, of bodies that are put there: a ball over a face, a rod over a sheet."""
    made = scene(
        bodies={"liver": cube(), "skin": sheet(0.25)},
        obstacles={
            "ball": ts.SphereObstacle((0.05, 0.05, 0.13), 0.02),
            "rod": ts.CapsuleObstacle(((0.01, 0.05, 0.3), (0.09, 0.05, 0.3)), radius=0.004),
        },
        contacts=[ts.Contact(("liver", "ball")), ts.Contact(("skin", "rod"))],
    )
    simulation = made.compile()
    assert simulation.overlaps() == []
    simulation.positions["liver"][:, 2] += 0.0135  # its top is at 11.35 cm, the ball's low at 11 cm
    simulation.positions["skin"][:, 2] += 0.0475  # 2.5 mm below the axis of the rod
    liver, skin = simulation.overlaps()
    assert liver[:2] == ("liver", "ball")
    assert liver.depth == pytest.approx(0.0035, rel=1e-9)
    assert skin[:2] == ("skin", "rod")
    assert skin.depth == pytest.approx(0.001 + 0.004 - 0.0025, rel=1e-9)
    assert simulation.crossings() == []


def test_a_pressed_ball_is_no_deeper_than_the_gap():
    """Between the points that meet it the surface rises by at most the gap."""
    down = ts.Motion(times=(0, 0.1), displacements=((0, 0, 0), (0, 0, -0.025)))
    made = scene(
        bodies={"liver": cube(viscosity=ts.Rayleigh(mass=5.0, stiffness=0.01))},
        obstacles={"ball": ts.SphereObstacle((0.05, 0.05, 0.131), 0.03, motion=down)},
        contacts=[ts.Contact(("liver", "ball"), gap=5e-4)],
        fixed=[ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
    )
    simulation = made.compile()
    for _ in range(20):
        simulation.step()
        assert all(overlap.depth <= 5e-4 for overlap in simulation.overlaps())
    assert simulation.force_on("ball").force[2] > 0.1
