"""A film of a run as binary glTF, read back by trimesh and by the words of the specification."""

import json
import os
import struct

import numpy as np
import pytest
import trimesh

import tissu as ts
from tissu.errors import ParameterError, TissuError
from tissu.live_view import film as film_module
from tissu.live_view.film import Film
from tissu.live_view.gltf import Gltf
from tissu.live_view.stage import stage_of
from tissu.live_view.surface import seen

KINDS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


def bar(**changes):
    mesh = ts.BarMesh(size=(0.2, 0.05, 0.05), cells=(6, 2, 2), cell="tetra")
    body = ts.Body(mesh=mesh, law=ts.StVK(young="20 kPa", poisson=0.3), density=1000)
    fields = {
        "bodies": {"bar": body},
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "gravity": (0, 0, -9.81),
        "step": ts.ImplicitEuler("10 ms"),
        **changes,
    }
    return ts.Scene(name="bar", **fields).compile()


def stage(simulation, lanes=1):
    return stage_of([m.points for m in simulation.meshes.values()], (0, 0, 1), lanes=lanes)


class Read:
    """A file, by the specification alone: header, two chunks, accessors through views."""

    def __init__(self, path):
        data = path.read_bytes()
        magic, version, size = struct.unpack_from("<4sII", data)
        assert (magic, version, size) == (b"glTF", 2, len(data))
        length, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and length % 4 == 0
        self.all = json.loads(data[20 : 20 + length])
        held, kind = struct.unpack_from("<I4s", data, 20 + length)
        assert kind == b"BIN\0" and 28 + length + held == len(data)
        self.held = data[28 + length :]
        assert self.all["buffers"] == [{"byteLength": held}]

    def numbers(self, place):
        found = self.all["accessors"][place]
        view = self.all["bufferViews"][found["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[found["componentType"]]
        width = KINDS[found["type"]]
        assert view["byteLength"] == 4 * found["count"] * width
        rows = np.frombuffer(self.held, kind, found["count"] * width, view["byteOffset"])
        rows = rows.reshape(found["count"], width)
        if "min" in found:
            assert np.array_equal(rows.min(axis=0), np.float32(found["min"]))
            assert np.array_equal(rows.max(axis=0), np.float32(found["max"]))
        return rows

    def mesh(self, name):
        (number,) = (k for k, mesh in enumerate(self.all["meshes"]) if mesh["name"] == name)
        return number

    def motion(self, mesh, what):
        """Times and values of what moves the node of a mesh."""
        (animation,) = self.all["animations"]
        for channel in animation["channels"]:
            node = self.all["nodes"][channel["target"]["node"]]
            if node["mesh"] == mesh and channel["target"]["path"] == what:
                sampler = animation["samplers"][channel["sampler"]]
                times, values = self.numbers(sampler["input"]), self.numbers(sampler["output"])
                return times[:, 0], values.reshape(len(times), -1), sampler["interpolation"]
        raise AssertionError(f"nothing moves {what}")

    def at(self, mesh, time, attribute="POSITION"):
        """The points of a mesh at a time: the base, and targets by their weights."""
        (first, *_) = self.all["meshes"][mesh]["primitives"]
        base = self.numbers(first["attributes"][attribute]).astype(float)
        times, weights, way = self.motion(mesh, "weights")
        assert way == "LINEAR"
        now = [np.interp(time, times, column) for column in weights.T]
        targets = [self.numbers(target[attribute]) for target in first["targets"]]
        assert len(now) == len(targets)
        return base + sum(w * target.astype(float) for w, target in zip(now, targets, strict=True))


def taken(simulation, steps, path):
    """A film of some steps, and the places and times that the simulation had at its moments."""
    film, kept = Film(stage(simulation)), []
    nodes = seen(simulation.meshes["bar"]).nodes
    for number in range(steps + 1):
        if number:
            simulation.step()
        before = len(film.times)
        film.look([simulation])
        if len(film.times) > before:
            kept.append((simulation.time, simulation.positions["bar"][nodes].copy()))
    film.write(path, name="bar")
    return kept


def test_every_moment_is_the_state_of_the_simulation_then(tmp_path):
    """To float32: of the place, and of its way from the first moment, each 6e-8 of its size."""
    simulation, path = bar(), tmp_path / "bar.glb"
    kept = taken(simulation, 40, path)
    read = Read(path)
    times, _, _ = read.motion(0, "weights")
    # steps of 10 ms; the first that is 1/30 s or more after the one before is taken
    assert [round(time, 6) for time, _ in kept] == [round(0.04 * k, 6) for k in range(11)]
    assert times == pytest.approx([time for time, _ in kept], rel=1e-6)
    for time, places in kept:
        assert np.abs(read.at(0, time) - places).max() < 3e-8
    middle = 0.5 * (kept[4][1] + kept[5][1])  # between two moments it goes straight
    assert np.abs(read.at(0, 0.5 * (kept[4][0] + kept[5][0])) - middle).max() < 1e-6


def test_normals_are_those_of_the_moved_surface(tmp_path):
    simulation, path = bar(), tmp_path / "bar.glb"
    kept = taken(simulation, 20, path)
    read, triangles = Read(path), seen(simulation.meshes["bar"]).triangles
    for time, places in kept:
        mesh = trimesh.Trimesh(places, triangles, process=False)
        across = mesh.face_normals * mesh.area_faces[:, None]
        expected = np.zeros_like(places)
        for k in range(3):
            np.add.at(expected, triangles[:, k], across)
        expected /= np.linalg.norm(expected, axis=1, keepdims=True)
        assert np.abs(read.at(0, time, "NORMAL") - expected).max() < 1e-4


def test_trimesh_reads_surface_colour_and_place(tmp_path):
    """The root turns up to y: the bar hangs on, and is as long as it is."""
    simulation, path = bar(), tmp_path / "bar.glb"
    taken(simulation, 3, path)
    scene = trimesh.load(path)
    (mesh,) = scene.geometry.values()
    surface = seen(simulation.meshes["bar"])
    assert np.array_equal(mesh.faces, surface.triangles)
    rest = simulation.meshes["bar"].points[surface.nodes].astype(np.float32)
    assert np.array_equal(mesh.vertices.astype(np.float32), rest)
    (node,) = scene.graph.nodes_geometry
    turned = trimesh.transform_points(rest, scene.graph[node][0])
    assert np.abs(turned - np.stack([rest[:, 0], rest[:, 2], -rest[:, 1]], axis=1)).max() < 1e-6
    factor = mesh.visual.material.baseColorFactor[:3] / 255.0  # linear
    shown = np.where(factor < 0.0031308, 12.92 * factor, 1.055 * factor ** (1 / 2.4) - 0.055)
    assert 255 * shown == pytest.approx([204, 120, 102], abs=2)  # bytes of the linear colour


@pytest.mark.parametrize("up", [(0, 0, 1), (0, 1, 0), (0, -1, 0), (1, 2, -2)])
def test_up_is_y(tmp_path, up):
    gltf = Gltf(name="one", up=up)
    x, y, z, w = gltf._root["rotation"]
    turn = trimesh.transformations.quaternion_matrix([w, x, y, z])[:3, :3]
    assert turn @ up / np.linalg.norm(up) == pytest.approx([0, 1, 0], abs=1e-7)


def test_removed_cells_begin_another_mesh_that_takes_the_place(tmp_path):
    simulation, path = bar(editing=True), tmp_path / "bar.glb"
    film = Film(stage(simulation))
    film.look([simulation])
    for number in range(12):
        if number == 5:
            simulation.remove_cells(body="bar", cells=[140, 141, 142, 143])
        simulation.step()
        film.look([simulation])
    film.write(path, name="bar")
    read = Read(path)
    assert [mesh["name"] for mesh in read.all["meshes"]] == ["bar", "bar"]
    counts = [len(read.numbers(m["primitives"][0]["indices"])) for m in read.all["meshes"]]
    assert counts[0] != counts[1] == 3 * len(seen(simulation.meshes["bar"]).triangles)
    shown = [read.motion(number, "scale") for number in (0, 1)]
    for times, scales, way in shown:
        assert way == "STEP" and times == pytest.approx([0.0, 0.08])
        assert np.array_equal(np.ptp(scales, axis=1), [0, 0])
    assert [scales[:, 0].tolist() for _, scales, _ in shown] == [[1, 0], [0, 1]]


def test_a_long_film_keeps_every_second_moment(tmp_path, monkeypatch):
    monkeypatch.setattr(film_module, "MOST_MOMENTS", 8)
    simulation, path = bar(), tmp_path / "bar.glb"
    film, nodes, states = Film(stage(simulation)), seen(simulation.meshes["bar"]).nodes, {}
    film.look([simulation])
    for _ in range(60):
        simulation.step()
        states[round(simulation.time, 6)] = simulation.positions["bar"][nodes].copy()
        film.look([simulation])
    film.look([simulation], last=True)
    film.write(path, name="bar")
    read = Read(path)
    times, _, _ = read.motion(0, "weights")
    assert 4 <= len(times) <= 9 and times[-1] == pytest.approx(0.6)
    assert np.all(np.diff(times) > 0)
    for time in times[1:]:
        assert np.abs(read.at(0, time) - states[round(float(time), 6)]).max() < 3e-8


def test_a_reset_goes_on_in_the_film(tmp_path):
    simulation, path = bar(), tmp_path / "bar.glb"
    film = Film(stage(simulation))
    film.look([simulation])
    for again in range(2):
        for _ in range(8):
            simulation.step()
            film.look([simulation])
        if not again:
            simulation.reset()
            film.look([simulation])
    film.write(path, name="bar")
    times, _, _ = Read(path).motion(0, "weights")
    assert np.all(np.diff(times) > 0.03)
    begin = simulation.meshes["bar"].points[seen(simulation.meshes["bar"]).nodes]
    read = Read(path)
    assert np.abs(read.at(0, times[3]) - begin).max() < 3e-8  # 0, 0.04, 0.08, then again


def test_a_view_records_two_simulations_side_by_side(views, tmp_path):
    path, one = tmp_path / "two.glb", bar()
    body = one.scene.bodies["bar"].replace(model="corotational", law_for_model="nearest")
    other = one.scene.replace(bodies={"bar": body}).compile()
    view = views(one, beside=other, record=path, playing=False)
    for _ in range(9):
        view.step()
    view.close()
    read, nodes = Read(path), seen(one.meshes["bar"]).nodes
    for name, simulation in (("bar", one), ("bar (beside)", other)):
        last = read.at(read.mesh(name), 0.09)
        assert np.abs(last - simulation.positions["bar"][nodes]).max() < 3e-8
    places = [node["translation"] for node in read.all["nodes"] if "mesh" in node]
    assert np.linalg.norm(np.subtract(*places)) > 0.05  # beside, not within


def test_places_that_cannot_be_are_refused_before_it_runs(tmp_path):
    for name in ("film.mp4", "film", "film.gltf"):
        with pytest.raises(ParameterError, match=r"ends with \.html or \.glb is accepted"):
            ts.view(bar(), browser=False, record=tmp_path / name)
    (tmp_path / "folder.glb").mkdir()
    with pytest.raises(TissuError, match="found a folder"):
        ts.view(bar(), browser=False, record=tmp_path / "folder.glb")
    (tmp_path / "device.glb").symlink_to(os.devnull)
    with pytest.raises(TissuError, match="found a device"):
        ts.view(bar(), browser=False, record=tmp_path / "device.glb")
    with pytest.raises(TissuError, match="found no folder"):
        ts.view(bar(), browser=False, record=tmp_path / "nowhere" / "film.glb")
