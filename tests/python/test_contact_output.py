"""Contacts in files and pictures: pressure and gap at nodes, obstacles, forces in the summary."""

import json

import matplotlib.image
import meshio
import numpy as np
import pytest

import tissu as ts
from contact_scenes import cube, scene
from tissu.errors import ParameterError
from tissu.output import ContactTally, Series, StepTally, summarise, write_summary

WEIGHT = 1000.0 * 1e-3 * 9.81
"""of the cube [N]"""


def resting(**changes):
    """A cube on a table, and a ball above it that is led down beside it."""
    path = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.02)))
    given = {
        "bodies": {"liver": cube(cell="tetra", viscosity=ts.Rayleigh(mass=5.0, stiffness=0.01))},
        "obstacles": {
            "table": ts.PlaneObstacle((0, 0, -0.0012), (0, 0, 1)),
            "ball": ts.SphereObstacle((0.2, 0.05, 0.1), "2 cm", motion=path),
        },
        "contacts": [ts.Contact(("liver", ("table", "ball")), friction=0.5)],
        "gravity": (0, 0, -9.81),
    }
    return scene(**(given | changes)).compile()


@pytest.fixture(scope="module")
def rested():
    """The cube after 3 s, with the tally of its run."""
    simulation = resting()
    tally = ContactTally(simulation)
    for _ in range(300):
        assert simulation.step().converged
    return simulation, tally


def node_areas(mesh):
    """A third of the surface's triangles at rest at each node (n,) [m2]."""
    triangles = mesh.surface().triangles
    a, b, c = (mesh.points[triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    return np.bincount(triangles.ravel(), np.repeat(area / 3.0, 3), minlength=mesh.node_count)


def test_the_pressure_carries_the_weight(rested):
    """Times the area of the nodes, to a thousandth, the design's goal for bodies at rest."""
    simulation, _ = rested
    mesh = simulation.meshes["liver"]
    found = simulation.contact_at_nodes("liver")
    below = mesh.points[:, 2] == 0
    assert (found.pressure * node_areas(mesh)).sum() == pytest.approx(WEIGHT, rel=1e-3)
    assert not found.pressure[~below].any() and (found.pressure[below] >= 0.0).all()
    contacts = simulation.contacts()
    assert np.array_equal(found.gap[contacts.nodes[:, 0]], contacts.gaps)
    assert (found.gap[~below] == 1e30).all()


def test_two_bodies_press_each_other_with_one_force():
    """What contacts of all kinds give to the nodes of both sums to the force between them."""
    bodies = {"liver": cube(cell="tetra"), "gut": cube((0.013, 0.017, 0.1005), cell="tetra")}
    simulation = scene(
        bodies=bodies,
        obstacles={},
        contacts=[ts.Contact(("liver", "gut"), gap="0.4 mm")],
        fixed=[ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        gravity=(0, 0, -9.81),
    ).compile()
    for _ in range(20):
        simulation.step()
    contacts = simulation.contacts()
    normal = np.einsum("ij,ij->i", contacts.forces, contacts.normals).sum()
    assert normal > 0.1 * WEIGHT
    for body in bodies:
        found = simulation.contact_at_nodes(body)
        pressed = found.pressure * node_areas(simulation.meshes[body])
        assert pressed.sum() == pytest.approx(normal, rel=1e-12)
        assert found.gap.min() == contacts.gaps.min()


def test_files_have_pressure_gap_and_obstacles(rested, tmp_path):
    simulation, _ = rested
    series = Series(simulation, tmp_path)
    series.write()
    index = series.index.read_text()
    assert [index.count(f'name="{name}"') for name in ("liver", "table", "ball")] == [1, 1, 1]
    liver = meshio.read(tmp_path / "frames" / "liver_00000.vtu")
    found = simulation.contact_at_nodes("liver")
    assert np.array_equal(liver.point_data["contact_pressure"], found.pressure)
    assert np.array_equal(liver.point_data["contact_gap"], found.gap)
    ball = meshio.read(tmp_path / "frames" / "ball_00000.vtu")
    away = np.linalg.norm(ball.points - (0.2, 0.05, 0.08), axis=1)
    assert np.abs(away - 0.02).max() < 1e-15
    assert ball.point_data["displacement"] == pytest.approx(np.tile([0, 0, -0.02], (len(away), 1)))
    table = meshio.read(tmp_path / "frames" / "table_00000.vtu")
    assert np.abs(table.points[:, 2] + 0.0012).max() < 1e-15


def test_the_summary_has_the_forces(rested, tmp_path):
    simulation, tally = rested
    given = {"tally": StepTally(), "status": "finished", "wall_seconds": {}, "files": {}}
    write_summary(tmp_path / "s.json", summarise(simulation, **given, contacts=tally))
    found = json.loads((tmp_path / "s.json").read_text())["contacts"]
    assert found["forces"]["table"]["force"] == simulation.force_on("table").force.tolist()
    assert found["forces"]["table"]["largest"] >= (1.0 - 1e-3) * WEIGHT
    assert found["forces"]["ball"] == {"force": [0, 0, 0], "largest": 0}
    assert found["most"] == 9 and 0.9 < found["least_gap"] <= 1.0
    assert found["steps_held_back"] == 0


def test_a_scene_without_contacts_has_none_of_it(tmp_path):
    bare = resting(contacts=[])
    assert bare.touching == bare.obstacles == ()
    tally = ContactTally(bare)
    bare.step()
    assert tally.record() is None
    given = {"tally": StepTally(), "status": "finished", "wall_seconds": {}, "files": {}}
    assert "contacts" not in summarise(bare, **given, contacts=tally)
    series = Series(bare, tmp_path)
    series.write()
    (file,) = (tmp_path / "frames").iterdir()
    assert set(meshio.read(file).point_data) == {"displacement", "velocity"}
    assert not [row for row in bare.profile().rows if row.effect == "contact"]
    for call in (lambda: bare.contact_at_nodes("liver"), lambda: bare.obstacle_surface("table")):
        with pytest.raises(ParameterError, match="this scene has no contacts"):
            call()


def test_what_is_refused(rested):
    simulation, _ = rested
    with pytest.raises(ParameterError, match="found 'table'; a body that meets something"):
        simulation.contact_at_nodes("table")
    with pytest.raises(ParameterError, match="found obstacle 'liver'; accepted: table, ball"):
        simulation.obstacle_surface("liver")


def test_the_profile_says_what_contact_costs(rested):
    simulation, _ = rested
    stages = {row.stage for row in simulation.profile().rows if row.effect == "contact"}
    assert {"detection", "travel", "response"} <= stages


ENDS = np.array([[0.3, 0.1, 0.2], [0.36, 0.18, 0.2]])
"""10 cm apart"""


@pytest.mark.parametrize(
    ("obstacle", "volume"),
    [
        (ts.SphereObstacle((0.3, 0.1, 0.2), 0.02), 4 / 3 * np.pi * 0.02**3),
        (ts.CapsuleObstacle(ENDS, radius=0.02), np.pi * 0.02**2 * (0.1 + 4 / 3 * 0.02)),
        (ts.BoxObstacle((1, 1, 1), (1.1, 1.2, 1.3)), 0.1 * 0.2 * 0.3),
    ],
)
def test_surfaces_are_closed_and_look_outward(obstacle, volume):
    """Round ones lie inside by less than 4 %: polygons of 24 and 24 sides, 1.2 and 1.4 %."""
    simulation = resting(obstacles={"tool": obstacle}, contacts=[ts.Contact(("liver", "tool"))])
    surface = simulation.obstacle_surface("tool")
    sides = surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert set(np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)[1]) == {2}
    a, b, c = (surface.rest[surface.triangles[:, k]] for k in range(3))
    found = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
    assert 0.96 * volume < found < (1.0 + 1e-12) * volume
    if obstacle.type != "box":
        ends = ENDS if obstacle.type == "capsule" else ENDS[[0, 0]]
        along = ends[1] - ends[0]
        share = ((surface.rest - ends[0]) @ along) / max(along @ along, 1e-300)
        near = ends[0] + np.clip(share, 0.0, 1.0)[:, None] * along
        assert np.abs(np.linalg.norm(surface.rest - near, axis=1) - 0.02).max() < 1e-15


def stone(picture):
    """How many pixels are grey and not white, of the right half."""
    red, green, blue = picture[:, 800:1400, :3].transpose(2, 0, 1)
    spread = np.maximum(np.abs(red - blue), np.abs(red - green))
    return int(((spread < 0.04) & (red > 0.3) & (red < 0.85)).sum())


def test_the_picture_shows_obstacles(rested, tmp_path):
    """Of the same simulation with its obstacles left out, hardly a pixel is grey."""
    from tissu.picture import draw
    from tissu.picture.draw import draw_shape, shape_of

    simulation, _ = rested
    draw(simulation, tmp_path / "with.png")
    shape = shape_of(simulation, "displacement")
    draw_shape(shape, tmp_path / "without.png", title="", time=0.0)
    grey = [stone(matplotlib.image.imread(tmp_path / f"{n}.png")) for n in ("with", "without")]
    assert grey[0] > 40_000 and grey[1] < 2_000
