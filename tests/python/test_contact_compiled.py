"""The description of contact that the world is built from: surfaces, gaps and pairs, by hand."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_scenes import SOFT, cube, every_contact_part, scene, sheet
from tissu import _core
from tissu.compile.contact_surface import halves_of
from tissu.compile.prepare import prepare


def described(made):
    """What the core was given."""
    assert made.check().problems == []
    prepared = prepare(made)
    builder = _core.WorldBuilder(threads=1, editable=False, grabbing=False, consistent_weight=False)
    for name, body in prepared.bodies.items():
        builder.add_body(name=name, positions=np.array(body.mesh.points), frames=False)
    assert builder.described_contact() is None
    prepared.contact.add_to(builder)
    return builder.described_contact()


def body(made, name):
    return next(one for one in made["bodies"] if one["name"] == name)


def alone(one, **fields):
    """The surface of one body that lies on the table."""
    made = described(scene(bodies={"one": one}, contacts=[ts.Contact(("one", "table"))], **fields))
    return made["bodies"][0], made["pairs"][0][3]


def volume_inside(points, triangles):
    """By the divergence theorem: sum of a . (b x c) / 6."""
    a, b, c = points[triangles].swapaxes(0, 1)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0


def area(points, triangles):
    a, b, c = points[triangles].swapaxes(0, 1)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "tetra10", "hexahedron20", "wedge"])
def test_a_volume_is_closed_and_its_triangles_look_outward(cell):
    one = cube(cell=cell)
    surface, _ = alone(one)
    points = one.mesh.mesh().points
    assert surface["closed"]
    assert surface["radius"].size == 0
    assert surface["edges"].shape == (0, 2)
    # Sums of a few hundred terms of the size of the result.
    assert volume_inside(points, surface["triangles"]) == pytest.approx(1e-3, rel=1e-12)
    assert area(points, surface["triangles"]) == pytest.approx(6e-2, rel=1e-12)


def test_quads_are_cut_along_their_shorter_diagonal():
    """Of equal ones along that of the lowest node, whichever corner comes first."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    kite = square + np.array([[-0.5, -0.5, 0], [0, 0, 0], [0.5, 0.5, 0], [0, 0, 0]])
    for turn in range(4):
        quad = np.roll(np.arange(4, dtype=np.int32), turn)[None]
        diagonal = {frozenset(t) for t in halves_of(kite, quad).tolist()}
        assert diagonal == {frozenset((0, 1, 3)), frozenset((1, 2, 3))}
        diagonal = {frozenset(t) for t in halves_of(square, quad).tolist()}
        assert diagonal == {frozenset((0, 1, 2)), frozenset((0, 2, 3))}
        for points in (square, kite):
            normals = np.cross(*np.diff(points[halves_of(points, quad)], axis=1).swapaxes(0, 1))
            assert (normals[:, 2] > 0).all()


def test_round_off_does_not_choose_a_diagonal():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    quad = np.arange(4, dtype=np.int32)[None]
    longer = points + np.array([[-1e-13, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
    assert np.array_equal(halves_of(points, quad), halves_of(longer, quad))


def test_default_gap_is_two_percent_of_the_mean_edge():
    # Of the 24 faces of quads: 48 edges of 5 cm, each of two faces, and 24 diagonals.
    _, gap = alone(cube())
    mean = 0.05 * (48 + 24 * math.sqrt(2)) / 72
    assert gap == pytest.approx(0.02 * mean, rel=1e-12)


def test_the_finer_side_gives_the_gap():
    fine = cube((0, 0, 0.2), cells=(4, 4, 4))
    made = scene(bodies={"a": cube(), "b": fine}, contacts=[ts.Contact("all")])
    gaps = {pair[:2]: pair[3] for pair in described(made)["pairs"]}
    edge = 0.05 * (48 + 24 * math.sqrt(2)) / 72
    assert set(gaps) == {(0, 0), (0, 1), (1, 1), (0, 2), (1, 2)}
    for pair, share in {(0, 0): 1, (0, 1): 0.5, (1, 1): 0.5, (0, 2): 1, (1, 2): 0.5}.items():
        assert gaps[pair] == pytest.approx(0.02 * edge * share, rel=1e-12)


def test_sheets_have_half_their_thickness_and_are_met_from_both_sides():
    surface, gap = alone(sheet())
    assert not surface["closed"]
    assert surface["triangles"].shape == (32, 3)
    assert np.array_equal(surface["radius"], np.full(25, 0.001))
    # 40 edges of 2.5 cm, 16 diagonals
    assert gap == pytest.approx(0.02 * 0.025 * (40 + 16 * math.sqrt(2)) / 56, rel=1e-12)


def test_lines_have_the_radius_of_their_section():
    mesh = ts.BarMesh(size=(1, 0, 0), cells=(4, 0, 0), cell="line")
    rope = ts.Body(mesh=mesh, law=SOFT, density=1000.0, section="4 mm^2")
    surface, gap = alone(rope)
    assert surface["edges"].tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]]
    assert surface["triangles"].shape == (0, 3)
    assert surface["radius"] == pytest.approx(np.full(5, math.sqrt(4e-6 / math.pi)), rel=1e-12)
    assert gap == pytest.approx(0.02 * 0.25, rel=1e-12)


def mixed(**blocks):
    """A cube of eight hexahedra, with sheets and lines on its nodes and on one node above it."""
    bar = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="hexahedron")
    points = np.concatenate([bar.points, [[0.05, 0.05, 0.2]]])
    cells = [*bar.cells, *((kind, np.array(nodes)) for kind, nodes in blocks.items())]
    return ts.Mesh(points=points, cells=cells), bar


def test_sheets_on_the_boundary_take_its_place_and_those_inside_meet_nothing():
    bar = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="hexahedron")
    at = {tuple(np.round(p / 0.05).astype(int)): n for n, p in enumerate(bar.points)}
    top = [at[0, 0, 2], at[1, 0, 2], at[1, 1, 2], at[0, 1, 2]]
    inner = [at[1, 0, 0], at[1, 1, 0], at[1, 1, 1], at[1, 0, 1]]
    cells = [*bar.cells, ("quad", np.array([top, inner]))]
    mesh = ts.Mesh(points=bar.points, cells=cells)
    one = cube(mesh=mesh, thickness=0.004)
    plain, _ = alone(cube())
    surface, _ = alone(one)
    assert surface["closed"]
    assert np.array_equal(surface["triangles"], plain["triangles"])
    expected = np.zeros(27)
    expected[top] = 0.002
    assert np.array_equal(surface["radius"], expected)


def test_a_sheet_beside_the_volume_opens_the_surface():
    mesh, bar = mixed(triangle=[[26, 24, 27]])
    surface, _ = alone(cube(mesh=mesh, thickness=0.004))
    assert not surface["closed"]
    assert [26, 24, 27] in surface["triangles"].tolist()
    assert len(surface["triangles"]) == 49
    assert len(bar.points) == 27


def test_lines_of_a_volume_meet_only_outside_it():
    mesh, _ = mixed(line=[[0, 13], [26, 27]])
    surface, _ = alone(cube(mesh=mesh, section="3 mm^2"))
    assert surface["closed"]
    assert surface["edges"].tolist() == [[26, 27]]
    assert np.flatnonzero(surface["radius"]).tolist() == [26, 27]


def test_obstacles():
    made = described(every_contact_part())
    names = ["table", "ball", "probe", "brick", "bone", "rod", "needle", "stone", "wedge", "hull"]
    assert [one["name"] for one in made["obstacles"]] == names
    table, ball, probe, brick, bone = made["obstacles"][:5]
    assert table["plane"]
    assert np.array_equal(table["origin"], (0, 0, -0.01))
    assert np.array_equal(table["normal"], (0, 0, 1))
    assert table["vertices"].shape == (0, 3)
    assert (ball["points"].tolist(), ball["radius"].tolist()) == ([0], [0.02])
    assert np.array_equal(ball["vertices"], [(0, 0, 0.4)])
    assert (probe["edges"].tolist(), probe["radius"].tolist()) == ([[0, 1]], [0.003, 0.003])
    assert np.array_equal(probe["vertices"], [(0, 0, 0.5), (0, 0, 0.6)])
    assert probe["origin"] == pytest.approx([0, 0, 0.55], abs=1e-15)
    assert np.array_equal(probe["times"], (0, 1))
    assert np.array_equal(probe["displacements"], [(0, 0, 0), (0, 0, -0.06)])
    assert probe["angles"] == pytest.approx([0, math.pi / 2], rel=1e-15)
    for solid, volume, middle in ((brick, 1.0, 1.5), (bone, 1.0, 3.5)):
        assert solid["closed"]
        assert solid["triangles"].shape == (12, 3)
        assert volume_inside(solid["vertices"], solid["triangles"]) == pytest.approx(volume)
        assert np.array_equal(solid["origin"], np.full(3, middle))


def test_a_plane_has_a_normal_of_length_one():
    table = ts.PlaneObstacle((0, 0, 0), (0, 3, 4))
    made = described(scene(obstacles={"table": table}, contacts=[ts.Contact(("liver", "table"))]))
    assert made["obstacles"][0]["normal"] == pytest.approx([0, 0.6, 0.8], rel=1e-15)


def test_a_mesh_that_looks_inward_is_turned_and_an_open_one_said():
    box = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(1, 1, 1)).surface_mesh()
    faces = box.cells[0].nodes[:, ::-1]
    inward = ts.Mesh(points=box.points, cells=[("triangle", faces)])
    opened = ts.Mesh(points=box.points, cells=[("triangle", faces[1:])])
    for mesh, closed, words in ((inward, True, "look inward"), (opened, False, "not closed")):
        made = scene(
            obstacles={"bone": ts.MeshObstacle(mesh)}, contacts=[ts.Contact(("gut", "bone"))]
        )
        bone = described(made)["obstacles"][0]
        assert bone["closed"] is closed
        assert any(words in note and "obstacles.bone.mesh" in note for note in made.check().notes)
        if closed:
            assert volume_inside(bone["vertices"], bone["triangles"]) == pytest.approx(1e-3)


def test_a_mesh_obstacle_in_the_wrong_unit_is_noted():
    large = ts.MeshObstacle(ts.BarMesh(size=(120, 1, 1), cells=(1, 1, 1)))
    made = scene(obstacles={"bone": large}, contacts=[ts.Contact(("gut", "bone"))])
    (note,) = made.check().notes
    assert note.startswith("obstacles.bone.mesh: is 120 m long; where the file is written in")


def test_pairs_and_settings():
    """The body stands first; `all` is what no other contact names; bodies come before obstacles."""
    made = described(every_contact_part())
    assert [one["name"] for one in made["bodies"]] == ["liver", "gut", "skin"]
    liver, gut, skin, table, ball, probe, *others_of_all = range(3 + len(made["obstacles"]))
    pairs = [pair[:2] for pair in made["pairs"]]
    assert pairs[:4] == [(liver, probe), (liver, table), (liver, ball), (skin, skin)]
    others = {(liver, liver), (liver, gut), (liver, skin), (gut, gut), (gut, skin)}
    others |= {(liver, o) for o in others_of_all}
    others |= {(b, o) for b in (gut, skin) for o in (table, ball, probe, *others_of_all)}
    assert set(pairs[4:]) == others
    assert len(pairs) == 4 + len(others)
    assert made["pairs"][0][2:6] == (0.2, 0.0005, None, None)
    assert made["pairs"][3][2:4] == (0.1, 1e-4)
    settings = {key: made[key] for key in ("method", "broad_phase", "iterations", "travel")}
    assert settings == {
        "method": "augmented",
        "broad_phase": "grid",
        "iterations": 5,
        "travel": False,
    }


def test_on_selects_nodes_of_the_first_on_its_surface():
    made = described(every_contact_part())
    points = cube().mesh.mesh().points
    low = np.flatnonzero(points[:, 2] < 0.01)
    assert len(low) == 9
    assert np.array_equal(made["pairs"][1][6], low)
    assert made["pairs"][0][6].size == 0
    every = scene(contacts=[ts.Contact(("liver", "gut"), on=ts.Box())])
    assert np.array_equal(described(every)["pairs"][0][6], np.delete(np.arange(27), 13))


def test_an_obstacle_written_first_and_a_body_that_meets_nothing():
    made = described(scene(contacts=[ts.Contact(("table", ("gut", "skin")), friction=0.3)]))
    assert [one["name"] for one in made["bodies"]] == ["gut", "skin"]
    assert [pair[:3] for pair in made["pairs"]] == [(0, 2, 0.3), (1, 2, 0.3)]


def test_a_scene_without_contacts_gives_the_world_nothing():
    assert prepare(scene()).contact is None


@pytest.mark.parametrize("step", ["implicit_euler", "bdf2"])
def test_auto_is_augmented_with_implicit_steps(step):
    text = f"type: {step}"
    made = scene(contacts=[ts.Contact("all")], step={"type": step, "dt": 0.01})
    assert text in made.to_yaml()
    assert described(made)["method"] == "augmented"
    assert described(made)["broad_phase"] == "hierarchy"
    assert (described(made)["iterations"], described(made)["travel"]) == (20, True)
