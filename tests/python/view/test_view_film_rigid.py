"""Obstacles, instruments and trocars of a film, read back by trimesh and by the specification."""

import numpy as np
import pytest
import trimesh
from test_view_film import Read, bar, stage
from trocar_scenes import PORT, tissue

import tissu as ts
from tissu.live_view import film as film_module
from tissu.live_view.film import Film
from tissu.live_view.film_rigid import instruments
from tissu.live_view.trocars.drawing import GRIP_LENGTH
from tissu.live_view.trocars.film import TrocarFilm
from tissu.live_view.turned import arrow, capsule

FLOAT = 1e-7
"""m: places of some 0.2 m and turns, rounded to float32."""


class Moved(Read):
    """Nodes of a file at a time, by channels of translation, rotation and scale."""

    def channels(self, node):
        (animation,) = self.all["animations"]
        found = {}
        for channel in animation["channels"]:
            if channel["target"]["node"] == node:
                sampler = animation["samplers"][channel["sampler"]]
                times, values = self.numbers(sampler["input"]), self.numbers(sampler["output"])
                found[channel["target"]["path"]] = times[:, 0], values, sampler["interpolation"]
        return found

    def node(self, name):
        (number,) = (k for k, node in enumerate(self.all["nodes"]) if node["name"] == name)
        return number

    def pose(self, name, time):
        """Matrix (4, 4) of a node at a moment, within the root; zeros where it is not there."""
        number = self.node(name)
        node, moved = self.all["nodes"][number], self.channels(number)
        own = {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]} | node
        now = {}
        for what in ("translation", "rotation", "scale"):
            now[what] = np.array(own[what], dtype=float)
            if what in moved:
                times, values, _ = moved[what]
                (at,) = np.flatnonzero(np.abs(times - time) < 1e-6)
                now[what] = values[at].astype(float)
        x, y, z, w = now["rotation"]
        assert x * x + y * y + z * z + w * w == pytest.approx(1.0, abs=1e-6)
        made = trimesh.transformations.quaternion_matrix([w, x, y, z])
        made[:3, :3] *= now["scale"]
        made[:3, 3] = now["translation"]
        return made

    def places(self, name, time):
        """Points of a node's mesh at a moment, in the scene."""
        mesh = self.all["meshes"][self.all["nodes"][self.node(name)]["mesh"]]
        (one,) = mesh["primitives"]
        points = self.numbers(one["attributes"]["POSITION"]).astype(float)
        return trimesh.transform_points(points, self.pose(name, time))


def filmed(simulation, steps, path, keep, step=None, more=()):
    """A film of some steps, and what `keep` gives at its moments by their times."""
    film, kept = Film(stage(simulation), more=more), {}
    for number in range(steps + 1):
        if number:
            (step or simulation.step)()
        before = len(film.times)
        film.look([simulation])
        if len(film.times) > before:
            kept[simulation.time] = keep()
    film.write(path, name="film")
    return kept


def test_obstacles_that_turn_and_go_are_where_the_simulation_has_them(tmp_path):
    """A box led about an axis by more than half a turn, a plane, and a ball of its own mass."""
    turn = ts.Rotation(axis=(1, 2, 2), center=(0.1, 0, 0.1), angles=[0, "300 deg"])
    motion = ts.Motion(times=[0, "0.5 s"], displacements=[(0, 0, 0), (0, 0.1, 0.05)], rotation=turn)
    simulation = bar(
        obstacles={
            "box": ts.BoxObstacle((0.05, 0.1, 0.1), (0.1, 0.15, 0.15), motion=motion),
            "floor": ts.PlaneObstacle((0, 0, -0.2), (0, 0, 1)),
            "ball": ts.SphereObstacle((0.3, 0, -0.1), radius=0.03, mass=1.0, spin=(3, 0, 9)),
        },
        contacts=[ts.Contact(("bar", one)) for one in ("box", "floor", "ball")]
        + [ts.Contact(("floor", "ball"))],
    )
    names, path = ("box", "floor", "ball"), tmp_path / "obstacles.glb"

    def keep():
        return {name: simulation.obstacle_surface(name).points for name in names}

    kept = filmed(simulation, 50, path, keep)
    read = Moved(path)
    assert len(kept) == 13
    for time, surfaces in kept.items():
        for name, points in surfaces.items():
            assert np.abs(read.places(name, time) - points).max() < FLOAT
    first, last = (kept[time]["box"] for time in (min(kept), max(kept)))
    assert np.abs(first - last).max() > 0.05
    assert not read.channels(read.node("floor"))  # what stands still has no motion
    _, turns, way = read.channels(read.node("box"))["rotation"]
    assert way == "LINEAR" and (np.sum(turns[1:] * turns[:-1], axis=1) > 0.0).all()


def test_trimesh_reads_obstacles_with_their_place_and_opacity(tmp_path):
    simulation = bar(
        obstacles={"ball": ts.SphereObstacle((0.3, 0.1, -0.1), radius=0.03)},
        contacts=[ts.Contact(("bar", "ball"))],
    )
    path = tmp_path / "ball.glb"
    filmed(simulation, 3, path, lambda: None)
    scene = trimesh.load(path)
    assert set(scene.geometry) == {"bar", "ball"}
    ball = scene.geometry["ball"]
    assert ball.is_watertight and ball.volume == pytest.approx(4 / 3 * np.pi * 0.03**3, rel=0.05)
    (node,) = (n for n in scene.graph.nodes_geometry if scene.graph[n][1] == "ball")
    middle = trimesh.transform_points([ball.centroid], scene.graph[node][0])
    np.testing.assert_allclose(middle, [[0.3, -0.1, -0.1]], atol=1e-6)  # z up is y up
    material = ball.visual.material
    assert material.alphaMode == "BLEND" and material.baseColorFactor[3] == round(0.75 * 255)


class TestTrocar:
    def filmed(self, live, tmp_path, scene=None, change=None):
        trocars = live(scene)
        (one,) = trocars.each

        def keep():
            return one.felt, one.controller.tool

        def step():
            if change is not None:
                change(one)
            trocars.step(one.simulation)

        path = tmp_path / "trocar.glb"
        return one, trocars, filmed(one.simulation, 45, path, keep, step, [trocars.placed]), path

    def test_tool_port_and_force_are_those_of_the_steps(self, live, tmp_path):
        one, trocars, kept, path = self.filmed(live, tmp_path)
        read = Moved(path)
        forces = []
        for time, (felt, _) in list(kept.items())[1:]:
            tip = read.pose("right: tool", time)[:3, 3]
            np.testing.assert_allclose(tip, felt.tip, atol=FLOAT)
            shaft = read.places("right: tool", time)
            # The line through tip and pivot is its axis.
            along = (np.array(PORT) - tip) / np.linalg.norm(np.array(PORT) - tip)
            off = (shaft - tip) - np.outer((shaft - tip) @ along, along)
            np.testing.assert_allclose(np.linalg.norm(off, axis=1).max(), 2.5e-3, rtol=1e-3)
            sphere = read.places("probe", time)
            assert sphere[:, 2].min() == pytest.approx(tip[2], abs=2e-5)
            force = read.pose("right: force", time)
            drawn = force[:3, 2]  # the unit arrow along its own z
            expected = trocars.arrow * felt.fast
            if np.linalg.norm(expected) < 1e-4:
                assert not drawn.any()
            else:
                np.testing.assert_allclose(drawn, expected, atol=FLOAT)
            forces.append(np.linalg.norm(drawn))
        assert forces[0] == 0.0 and forces[-1] > 0.3 * trocars.arrow
        np.testing.assert_allclose(read.pose("right: port", 0.0)[:3, 3], PORT, atol=FLOAT)
        assert read.channels(read.node("right: force"))["scale"][2] == "STEP"
        ends = read.places("right: grip", max(kept))
        length = TrocarFilm(one)._length + GRIP_LENGTH
        assert np.ptp(ends @ along) == pytest.approx(GRIP_LENGTH, rel=1e-3)
        assert ((ends - tip) @ along).max() == pytest.approx(length, rel=1e-3)

    def test_trimesh_reads_all_parts(self, live, tmp_path):
        *_, path = self.filmed(live, tmp_path)
        parts = {f"right: {part}" for part in ("port", "tool", "grip", "force")}
        assert set(trimesh.load(path).geometry) == {"block", "probe", "thin"} | parts

    def test_an_instrument_is_there_while_it_is_in(self, live, tmp_path):
        """Its edge is that of the simulation; when it is taken out, nothing is shown of it."""
        right = tissue().trocars["right"]
        knife = ts.Knife(((0, 0, 0), (0, 0, -0.03)), cuts=["block"])
        hand = ts.Hand(times=(0,), points=((0, 0, 0.1),))
        changes = ts.ToolChanges(times=(0, "0.3 s"), tags=(1, None))
        device = ts.SimulatedDevice(hand=hand, changes=changes)
        scene = tissue(
            obstacles={},
            contacts=[],
            instruments={"scalpel": knife},
            editing=True,
            trocars={"right": right.replace(device=device, tools={1: "scalpel"})},
        )
        trocars = live(scene)
        (one,) = trocars.each
        simulation, path = one.simulation, tmp_path / "knife.glb"

        def keep():
            tool = None if one.felt is None else one.felt.tool
            return tool, simulation.instruments["scalpel"].edge.copy()

        kept = filmed(
            simulation, 45, path, keep, lambda: trocars.step(simulation), [trocars.placed]
        )
        read = Moved(path)
        seen = []
        for time, (tool, edge) in kept.items():
            places = read.places("scalpel", time)
            if tool is not None:
                np.testing.assert_allclose(places, edge, atol=FLOAT)
            else:
                assert not np.ptp(places, axis=0).any()  # a point: nothing is drawn
            seen.append(tool)
        assert "scalpel" in seen and seen[-1] is None


def test_instruments_that_no_trocar_leads_are_there():
    """A knife as a line, an ablator as the capsule that it is."""
    knife = ts.Knife(((0, 0, 0), (0, 0, 0.02), (0, 0.01, 0.02)), cuts=["bar"], position=(0, 0, 0.3))
    burner = ts.Ablator(
        radius=0.004, ends=((0, 0, 0), (0, 0.02, 0)), removes=["bar"], position=(0, 0, 0.4)
    )
    simulation = bar(editing=True, instruments={"knife": knife, "burner": burner})
    line, tip = instruments(simulation, 0)
    assert line.shape.corners.tolist() == [[0, 1], [1, 2]]
    np.testing.assert_array_equal(line.shape.points, knife.edge)
    np.testing.assert_array_equal(line.place, (0, 0, 0.3))
    made = trimesh.Trimesh(tip.shape.points, tip.shape.corners)
    volume = np.pi * 0.004**2 * (0.02 + 4 / 3 * 0.004)
    assert made.is_watertight and made.volume == pytest.approx(volume, rel=0.04)
    np.testing.assert_allclose(made.bounds, [[-0.004] * 3, [0.004, 0.024, 0.004]], atol=1e-4)


@pytest.mark.parametrize("shape", [arrow(0.03, 0.08, 0.25), capsule((1, 2, 3), (1, 2, 3), 0.5)])
def test_turned_surfaces_are_closed_and_face_out(shape):
    made = trimesh.Trimesh(*shape)
    assert made.is_watertight and made.is_winding_consistent and made.volume > 0.0


def test_a_long_film_keeps_the_poses_of_its_moments(tmp_path, monkeypatch):
    monkeypatch.setattr(film_module, "MOST_MOMENTS", 8)
    motion = ts.Motion(times=[0, "1 s"], displacements=[(0, 0, 0), (0.5, 0, 0)])
    simulation = bar(
        obstacles={"ball": ts.SphereObstacle((0, 0.2, 0), radius=0.03, motion=motion)},
        contacts=[ts.Contact(("bar", "ball"))],
    )
    path = tmp_path / "long.glb"
    filmed(simulation, 60, path, lambda: None)
    times, places, _ = Moved(path).channels(Moved(path).node("ball"))["translation"]
    assert 4 <= len(times) <= 9
    np.testing.assert_allclose(places[:, 0], 0.5 * times, atol=FLOAT)


def test_two_simulations_have_their_obstacles_beside_each_other(views, tmp_path):
    """Both simulations' balls, side by side, under names of their own."""
    path = tmp_path / "two.glb"
    fields = {
        "obstacles": {"ball": ts.SphereObstacle((0.1, 0.2, 0), radius=0.03)},
        "contacts": [ts.Contact(("bar", "ball"))],
    }
    view = views(bar(**fields), beside=bar(**fields), record=path, playing=False)
    shifts, factor = view._session.stage.shifts, view._session.stage.factor
    for _ in range(5):
        view.step()
    view.close()
    read = Moved(path)
    for lane, name in enumerate(("ball", "ball (beside)")):
        place = read.pose(name, 0.0)[:3, 3]
        np.testing.assert_allclose(place, [0.1, 0.2, 0] + shifts[lane] / factor, atol=1e-6)
