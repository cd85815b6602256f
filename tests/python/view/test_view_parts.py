"""The parts of the view that need neither a browser nor a thread: numbers in, numbers out."""

import math
import sys
import threading
import time

import numpy as np
import pytest

import tissu as ts
from tissu.live_view.bands import MOST_CUT, bands
from tissu.live_view.body_drawing import normals
from tissu.live_view.colours import COUNT, band_colours, legend
from tissu.live_view.fields import FIELDS, offered
from tissu.live_view.latest import Latest
from tissu.live_view.layers import LAYERS
from tissu.live_view.marks import arrows_at
from tissu.live_view.pace import Pace
from tissu.live_view.panels.parameters import span
from tissu.live_view.pointer import met
from tissu.live_view.ration import Ration, processor_time
from tissu.live_view.rights import Rights
from tissu.live_view.runner import speed_of
from tissu.live_view.stage import stage_of
from tissu.live_view.surface import seen
from tissu.simulation.parameters import Parameter


def patch(count, seed=2):
    """A bumpy surface (n, 3), its triangles, and values at its points."""
    line = np.linspace(0.0, 1.0, count)
    x, y = np.meshgrid(line, line, indexing="ij")
    random = np.random.default_rng(seed)
    points = np.stack([x, y, 0.1 * random.random(x.shape)], axis=-1).reshape(-1, 3)
    at = np.arange(count * count).reshape(count, count)
    low, high = [at[:-1, :-1], at[1:, :-1], at[1:, 1:]], [at[:-1, :-1], at[1:, 1:], at[:-1, 1:]]
    triangles = np.concatenate([np.stack(some, axis=-1).reshape(-1, 3) for some in (low, high)])
    return points.astype(np.float32), triangles, random.random(len(points))


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    return 0.5 * np.cross(b - a, c - a)


def value_at(points, triangles, values, at):
    """The linear field of the triangle that a point (on the bumpy patch) lies above or below."""
    corners = points[triangles][:, :, :2].astype(float)
    system = np.concatenate([corners.swapaxes(1, 2), np.ones((len(corners), 1, 3))], axis=1)
    weights = np.linalg.solve(system, np.array([at[0], at[1], 1.0])[None, :, None])[:, :, 0]
    inside = int(weights.min(axis=1).argmax())
    return float(weights[inside] @ values[triangles[inside]])


class TestBands:
    def test_they_cover_the_surface_once_and_face_as_it_does(self):
        """Areas as vectors add up to those of the triangles; float32 points, 1e-6 of the whole."""
        points, triangles, values = patch(12)
        found = bands(triangles, values, limits=(0.0, 1.0), count=7)
        parts = [areas(band.points(points), band.triangles) for band in found]
        whole = areas(points, triangles)
        assert np.abs(sum(part.sum(axis=0) for part in parts) - whole.sum(axis=0)).max() < 1e-6
        size = sum(np.linalg.norm(part, axis=1).sum() for part in parts)
        assert size == pytest.approx(np.linalg.norm(whole, axis=1).sum(), rel=1e-6)
        assert all((part[:, 2] > -1e-9).all() for part in parts)

    def test_each_has_the_values_of_its_band(self):
        points, triangles, values = patch(6)
        for band in bands(triangles, values, limits=(0.0, 1.0), count=5):
            middles = band.points(points)[band.triangles].mean(axis=1)
            for at in middles:
                found = value_at(points, triangles, values, at)
                assert band.number / 5 - 1e-5 <= found <= (band.number + 1) / 5 + 1e-5

    def test_neighbours_share_points_so_that_shading_is_smooth(self):
        """Of a field that is constant, the band is the surface itself, with as many points."""
        points, triangles, _ = patch(8)
        (one,) = bands(triangles, np.full(len(points), 0.3), limits=(0, 1), count=4)
        assert (one.number, len(one.points(points)), len(one.triangles)) == (1, 64, len(triangles))
        ramp = bands(triangles, points[:, 0].astype(float), limits=(0, 1), count=3)
        for band in ramp:  # each is one strip, a disc: Euler's number of it is one
            sides = np.sort(band.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
            count = len(np.unique(sides, axis=0))
            assert len(band.points(points)) - count + len(band.triangles) == 1

    def test_values_beyond_the_limits_and_values_that_are_none(self):
        points, triangles, values = patch(5)
        values[3], wide = np.nan, 10.0 * values - 5.0
        found = bands(triangles, wide, limits=(0.0, 1.0), count=4)
        size = sum(
            np.linalg.norm(areas(b.points(points), b.triangles), axis=1).sum() for b in found
        )
        assert size == pytest.approx(
            np.linalg.norm(areas(points, triangles), axis=1).sum(), rel=1e-6
        )
        assert {0, 3} <= {band.number for band in found}
        (flat,) = bands(triangles, values, limits=(0.5, 0.5), count=4)
        assert flat.number == 0

    def test_they_move_with_the_nodes(self):
        """Points on edges keep their share of the way: what is linear in space stays so.

        Of an affine motion the bands of the moved surface are the moved bands, to float32.
        """
        points, triangles, values = patch(9)
        found = bands(triangles, values, limits=(0.0, 1.0), count=6)
        turn = np.array([[0.5, -0.3, 0.1], [0.2, 0.9, 0.0], [0.0, 0.4, 1.2]], dtype=np.float32)
        for band in found:
            moved = band.points(points @ turn.T)
            assert np.abs(moved - band.points(points) @ turn.T).max() < 1e-6

    def test_a_fine_surface_is_not_cut(self):
        """Every triangle has the band of its mean, and every point is a node."""
        points, triangles, values = patch(102)
        assert len(triangles) > MOST_CUT
        found = bands(triangles, values, limits=(0.0, 1.0), count=7)
        rows = np.concatenate([band.nodes[band.triangles] for band in found])
        assert np.array_equal(np.unique(rows, axis=0), np.unique(triangles, axis=0))
        assert len(rows) == len(triangles)
        for band in found:
            mean = values[band.nodes[band.triangles]].mean(axis=1)
            assert np.array_equal(np.floor(mean * 7), np.full(len(mean), band.number))
            assert np.array_equal(band.points(points), points[band.nodes])


class TestRation:
    def test_work_waits_for_its_share(self):
        """2 ms of work at a share of a twentieth: the next begins 40 ms after it began."""
        ration = Ration(0.05, shortest=0.01, longest=1.0)
        assert ration.is_due(100.0)
        ration.spent(0.002, begun=100.0)
        assert not ration.is_due(100.0399) and ration.is_due(100.0401)

    def test_it_has_a_shortest_and_a_longest_wait(self):
        ration = Ration(0.05, shortest=0.01, longest=1.0)
        ration.spent(0.0, begun=0.0)
        ration.spent(0.0, begun=0.012)  # late by 2 ms, which the next one is not
        assert not ration.is_due(0.0199) and ration.is_due(0.0201)
        ration.spent(7.0, begun=5.0)
        assert not ration.is_due(5.99) and ration.is_due(6.0)

    def test_the_time_of_a_processor_is_that_of_the_threads_named(self):
        ended, ready = threading.Event(), threading.Event()

        def work():
            while not ended.is_set():
                ready.set()

        busy = threading.Thread(target=work)
        busy.start()
        ready.wait()
        mine = threading.get_ident()
        before = processor_time([mine]), processor_time([mine, busy.ident])
        until = time.monotonic() + 20.0
        while processor_time([mine, busy.ident]) - before[1] < 0.2 and time.monotonic() < until:
            time.sleep(0.01)
        own, both = processor_time([mine]) - before[0], processor_time([mine, busy.ident])
        ended.set()
        busy.join()
        if sys.platform == "linux":
            assert both - before[1] >= 0.2 > own + 0.1
        else:
            assert both >= before[1]


class TestPace:
    def test_steps_wait_for_their_time(self):
        pace = Pace(0.5)
        assert pace.wait(now=100.0, time=2.0) == 0.0
        assert pace.wait(now=100.0, time=2.01) == pytest.approx(0.02)
        assert pace.wait(now=100.015, time=2.01) == pytest.approx(0.005)

    def test_what_it_lags_is_forgiven(self):
        pace = Pace(1.0)
        pace.wait(now=0.0, time=0.0)
        assert pace.wait(now=10.0, time=0.01) == 0.0
        # 0.1 s of the 10 s are caught up, then it waits again
        assert pace.wait(now=10.0, time=0.11) == pytest.approx(0.0, abs=1e-9)
        assert pace.wait(now=10.0, time=0.21) == pytest.approx(0.1)

    def test_as_fast_as_it_goes_never_waits_and_a_pause_is_not_caught_up(self):
        assert Pace(math.inf).wait(now=0.0, time=1e9) == 0.0
        pace = Pace(1.0)
        pace.wait(now=0.0, time=0.0)
        pace.restart()
        pace.wait(now=50.0, time=0.01)
        assert pace.wait(now=50.0, time=0.02) == pytest.approx(0.01)

    def test_speeds_as_the_page_writes_them(self):
        assert (speed_of("0.25 x"), speed_of("as fast as it goes")) == (0.25, math.inf)


def test_only_the_newest_value_is_taken():
    latest = Latest()
    assert latest.take(0.0) is None
    for number in range(100):
        latest.put(number)
    assert latest.waiting and latest.take(0.0) == 99
    assert not latest.waiting and latest.take(0.0) is None


def test_the_first_page_may_touch_then_the_next():
    rights = Rights(shared=False)
    for page in (4, 7, 9):
        rights.come(page)
    assert [rights.may(page) for page in (4, 7, 9, None)] == [True, False, False, True]
    rights.leave(4)
    assert [rights.may(page) for page in (4, 7, 9)] == [False, True, False]
    assert rights.count == 2
    shared = Rights(shared=True)
    shared.come(1), shared.come(2)
    assert shared.may(2)


@pytest.mark.parametrize("size", [1e-4, 0.2, 30.0])
def test_there_and_back_on_a_stage_of_any_size(size):
    random = np.random.default_rng(0)
    points = size * random.random((50, 3))
    stage = stage_of([points], (0, 0, 2.0), lanes=2)
    assert 1.0 <= np.linalg.norm(np.ptp(points, axis=0)) * stage.factor < 10.0
    for lane in (0, 1):
        back = stage.in_space(stage.on_page(points, lane), lane)
        assert np.abs(back - points).max() < 1e-6 * size  # float32 on the page
    left, right = stage.on_page(points, 0), stage.on_page(points, 1)
    along = (right - left)[0] / np.linalg.norm((right - left)[0])
    assert (left @ along).max() < (right @ along).min()  # side by side
    assert abs(along @ stage.up) < 1e-6


def test_a_ray_meets_the_nearer_side_of_a_sphere():
    """Against |x| = 1: a fine sphere's triangles lie inside it by less than 2 %."""
    mesh = ts.bar_mesh(size=(2, 2, 2), cells=(8, 8, 8), cell="hexahedron", origin=(-1, -1, -1))
    points = mesh.points / np.maximum(np.linalg.norm(mesh.points, axis=1), 1e-12)[:, None]
    corners = points[mesh.surface().triangles]
    random = np.random.default_rng(1)
    for eye in 4.0 * random.normal(size=(20, 3)):
        through = 0.5 * random.normal(size=3) / 3
        along = (through - eye) / np.linalg.norm(through - eye)
        half = eye @ along
        exact = eye + (-half - math.sqrt(half**2 - eye @ eye + 1.0)) * along
        found = met(eye, through, corners)
        assert np.linalg.norm(found - exact) < 0.05
        assert np.linalg.norm(np.cross(found - eye, along)) < 1e-9
    assert met(np.array([4.0, 0, 0]), np.array([4.0, 1, 0]), corners) is None
    assert met(np.array([4.0, 0, 0]), np.array([5.0, 0, 0]), corners) is None  # behind the eye


def test_normals_point_out_of_a_cube():
    mesh = ts.bar_mesh(size=(2, 2, 2), cells=(4, 4, 4), cell="tetra", origin=(-1, -1, -1))
    of_mesh = seen(mesh)
    points = mesh.points[of_mesh.nodes].astype(np.float32)
    found = normals(points, of_mesh.triangles)
    assert np.allclose(np.linalg.norm(found, axis=1), 1.0, atol=1e-5)
    assert (np.einsum("ni,ni->n", found, points) > 0.5).all()


class TestSeen:
    def test_edges_are_those_of_faces_without_diagonals(self):
        """A box of a x b x c bricks: each side's grid lines, each once."""
        mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 3, 4), cell="hexahedron")
        found = seen(mesh)
        a, b, c = 2, 3, 4
        faces = 2 * (a * b + b * c + c * a)
        assert len(found.edges) == 2 * faces  # of a closed surface of quads
        assert len(found.triangles) == 2 * faces
        assert len(found.nodes) == faces + 2  # Euler
        ends = mesh.points[found.nodes][found.edges]
        assert (np.count_nonzero(np.abs(ends[:, 0] - ends[:, 1]) > 1e-12, axis=1) == 1).all()

    def test_lines_are_seen_as_lines(self):
        scene = ts.Scene.from_yaml_text(
            "bodies: {l: {mesh: {type: bar, cell: line, size: [1, 0, 0], cells: [4, 0, 0]},"
            " law: {type: stvk, young: 1 kPa, poisson: 0}, density: 1000, section: 1 mm^2}}\n"
            "step: {type: implicit_euler, dt: 10 ms}"
        )
        found = seen(scene.compile().meshes["l"])
        assert found.lines.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]]
        assert len(found.triangles) == 0


class TestFields:
    @pytest.fixture
    def stretched(self):
        """A bar of two moduli that is stretched evenly by 2 % along x."""
        mesh = ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(10, 2, 2), cell="hexahedron")
        middle = mesh.points[mesh.cells[0].nodes].mean(axis=1)
        mesh = type(mesh)(
            points=mesh.points,
            cells=mesh.cells,
            regions={"near": np.flatnonzero(middle[:, 0] < 0.05).astype(np.int32)},
        )
        laws = {"near": ts.StVK(young=1e3, poisson=0), "rest": ts.StVK(young=4e3, poisson=0)}
        body = ts.Body(mesh=mesh, law=laws, density=1000)
        step = ts.ImplicitEuler(0.01)
        simulation = ts.Scene(bodies={"bar": body}, step=step).compile()
        simulation.positions["bar"][:, 0] *= 1.02
        return simulation

    def of(self, simulation, name):
        of_body = seen(simulation.meshes["bar"])
        return FIELDS[name].values(simulation, "bar", of_body), simulation.meshes["bar"].points[
            of_body.nodes
        ]

    def test_displacement_is_the_distance_from_rest(self, stretched):
        found, rest = self.of(stretched, "displacement")
        assert np.abs(found - 0.02 * rest[:, 0]).max() < 1e-15

    def test_stress_and_energy_are_those_of_the_stretch(self, stretched):
        """St-Venant-Kirchhoff in one direction: sigma = F E young / 1, E = (F^2 - 1) / 2."""
        strain = (1.02**2 - 1) / 2
        for name, of_young in (
            ("von_mises", lambda young: 1.02 * young * strain),
            ("energy_density", lambda young: young * strain**2 / 2),
            ("stiffness", lambda young: young),
            ("volume_ratio", lambda young: 1.02),
        ):
            found, rest = self.of(stretched, name)
            for young, where in ((1e3, rest[:, 0] < 0.045), (4e3, rest[:, 0] > 0.055)):
                assert np.allclose(found[where], of_young(young), rtol=1e-9)

    def test_what_a_model_lacks_is_not_offered(self, stretched):
        found = offered(stretched, {"bar": seen(stretched.meshes["bar"])})
        assert found == [name for name in FIELDS if name != "contact_pressure"]
        scene = stretched.scene
        body = ts.Body(
            mesh=ts.BarMesh(size=(0.1, 0.02, 0.02), cells=(5, 2, 2), cell="tetra"),
            law=ts.Hooke(young=1e3, poisson=0.25),
            model="mass_spring",
            density=1000,
        )
        springs = ts.Scene(bodies={"bar": body}, step=scene.step).compile()
        known = offered(springs, {"bar": seen(springs.meshes["bar"])})
        assert "von_mises" not in known and "energy_density" in known


def test_the_legend_says_its_limits_and_has_every_colour():
    text = legend("von Mises stress", "kPa", (0.0, 12.0))
    assert "von Mises stress [kPa]" in text and ">0<" in text and ">6<" in text and ">12<" in text
    assert text.count("rgb(") == COUNT == len(set(band_colours()))


def test_arrows_end_at_their_places_and_the_longest_is_as_long_as_asked():
    places = np.arange(12.0).reshape(4, 3)
    vectors = np.array([[1.0, 0, 0], [0, 2, 0], [0, 0, 0], [0, 0, -4]])
    found = arrows_at(places, vectors, longest=0.5)
    assert np.array_equal(found[:, 1], places)
    assert np.allclose(found[:, 1] - found[:, 0], vectors / 8.0)
    assert len(arrows_at(places, np.zeros(3), longest=0.5)) == 0


def test_layers_show_what_the_scene_holds_leads_and_loads():
    end, foot = ts.Plane((0, 0, 0.1), (0, 0, 1)), ts.Plane((0, 0, 0), (0, 0, 1))
    cube = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra")
    body = ts.Body(mesh=cube, law=ts.StVK(young=1e3, poisson=0.3), density=1000)
    simulation = ts.Scene(
        bodies={"cube": body},
        fixed=[ts.Fixed("cube", on=foot)],
        loads=[
            ts.NodalLoad("cube", on=end, force=(0, 2, 0)),
            ts.Pressure("cube", on=end, pressure=5),
        ],
        step=ts.ImplicitEuler("10 ms"),
        grabbing=True,
    ).compile()
    shown = {layer.name: layer for layer in LAYERS if layer.offered(simulation)}
    assert set(shown) == {"fixed nodes", "loads", "grabs"}
    (fixed,) = shown["fixed nodes"].begin(simulation)()
    assert len(fixed.points) == 9 and np.abs(fixed.points[:, 2]).max() == 0.0
    pull, press = shown["loads"].begin(simulation)()
    along = pull.arrows[:, 1] - pull.arrows[:, 0]
    assert np.allclose(along / np.linalg.norm(along, axis=1)[:, None], (0, 1, 0))
    inwards = (press.arrows[:, 1] - press.arrows[:, 0])[4]  # the middle of the top face
    assert inwards[2] < 0 and abs(inwards[0]) < 1e-9
    assert shown["grabs"].begin(simulation)() == []
    grab = simulation.drag("cube", (0.05, 0.05, 0.1), stiffness=10)
    grab.target = grab.position + np.array([0, 0, 0.03])
    (pulled,) = shown["grabs"].begin(simulation)()
    assert pulled.labels[0][1] == "0.3 N"
    assert np.allclose(pulled.lines[0, 1] - pulled.lines[0, 0], (0, 0, 0.03))


@pytest.mark.parametrize(
    ("parameter", "expected"),
    [
        (Parameter("a.young", 5e3, "Pa", 0.0), (150.0, 15e3)),
        (Parameter("a.poisson", 0.45, "", -1.0, 0.5), (0.0, 0.495)),
        (Parameter("gravity.z", -9.81, "m/s^2"), (-29.43, 29.43)),
        (Parameter("gravity.x", 0.0, "m/s^2"), (-20.0, 20.0)),
        (Parameter("a.zeta", 0.0, "Pa s", 0.0), (0.01, 1.0)),
        (Parameter("loads.0.factor", 1.0, ""), (-3.0, 3.0)),
    ],
)
def test_sliders_reach_around_the_value_and_stay_within_what_is_accepted(parameter, expected):
    low, high = span(parameter)
    if parameter.value == 0.0 and parameter.least == 0.0:
        expected = (0.0, 1.0)  # the value itself is reached
    assert (low, high) == pytest.approx(expected)
