"""Bodies whose surface in contact is a mesh of its own, which their cells carry."""

import re

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped, weight
from contact_static import pushed
from test_contact_balance import momentum
from tissu.errors import ParameterError, SceneError

SIZE = (0.1, 0.1, 0.1)
IMPLICIT = ("augmented", "barrier", "penalty")
EXPLICIT = ("impulse", "penalty", "geometric")


def bar(cells, origin=(0, 0, 0), size=SIZE):
    """A block of 10 cm, whose boundary is taken."""
    return ts.BarMesh(size=size, cells=cells, origin=origin)


def over_a_table(*, height=0.0, skin=(5, 5, 5), name="auto", body=None, **fields):
    """A block of eight cells over the plane z = 0, with a finer surface of quads cut in two."""
    given = {
        "bodies": {"block": body or block((0, 0, height), young=2e4, viscosity=damped(20.0, 1e-4))},
        "obstacles": {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        "contacts": [ts.Contact(("block", "table"), friction=0.3)],
        "contact": ts.ContactSettings(
            method=name, surface_of={"block": bar(skin, (0, 0, height))} if skin else {}
        ),
        "gravity": (0, 0, -GRAVITY),
        "step": ts.ImplicitEuler("5 ms"),
    }
    return ts.Scene(**(given | fields))


def colliding(step, name="auto", skin=(5, 5, 5), friction=0.3, threads=1):
    """Two blocks that meet off centre at 2 m/s; each has a finer surface than its cells."""
    origins = {"left": (0, 0, 0), "right": (0.102, 0.031, 0.017)}
    speeds = {"left": (1.0, 0, 0), "right": (-1.0, 0, 0)}
    return ts.Scene(
        bodies={
            body: block(at, young=1e5, start=ts.Start(velocity=speeds[body]))
            for body, at in origins.items()
        },
        contacts=[ts.Contact(("left", "right"), friction=friction, gap=4e-4)],
        contact=ts.ContactSettings(
            method=name, surface_of={body: bar(skin, at) for body, at in origins.items()}
        ),
        step=step,
        threads=threads,
    )


# Forces.


@pytest.mark.parametrize("name", IMPLICIT)
def test_a_block_rests_with_its_weight_in_implicit_steps(name):
    """1e-3: what is left of its swing; its skin has 36 vertices below, its cells nine nodes."""
    simulation = over_a_table(name=name).compile()
    report = audited(simulation, 160)
    force = simulation.force_on("table").force
    assert force == pytest.approx([0, 0, -weight()], abs=2e-3 * weight())
    assert simulation.force_on("block").force == pytest.approx(-force, abs=1e-12 * weight())
    assert report.contacts == 36


@pytest.mark.parametrize("name", EXPLICIT)
def test_a_block_rests_with_its_weight_in_explicit_steps(name):
    """The mean of 0.1 s counts, for the response of each step swings. Geometric lifts what is deep
    without a force, and holds the weight to 5 % so."""
    simulation = over_a_table(name=name, step=ts.SymplecticEuler()).compile()
    forces = []
    while simulation.time < 0.8:
        assert simulation.step().converged
        assert simulation.crossings() == []
        forces.append((simulation.time, *simulation.force_on("table").force))
    late = np.array([row[1:] for row in forces if row[0] > 0.7])
    share = 5e-2 if name == "geometric" else 5e-3
    assert late.mean(axis=0) == pytest.approx([0, 0, -weight()], abs=share * weight())


@pytest.mark.parametrize(
    ("step", "name"),
    [(ts.ImplicitEuler("5 ms"), name) for name in IMPLICIT]
    + [(ts.SymplecticEuler("0.5 ms"), name) for name in EXPLICIT],
)
def test_a_surface_that_is_the_cells_boundary_changes_nothing(step, name):
    """Every vertex then rides on one node: the same motion, to the order in which sums are made."""
    ends = []
    for skin in (None, (2, 2, 2)):
        simulation = over_a_table(height=2e-3, skin=skin, name=name, step=step).compile()
        audited(simulation, 60)
        ends.append((simulation.displacements("block"), simulation.force_on("table").force))
    (moved, force), (also, other) = ends
    assert also == pytest.approx(moved, abs=1e-5 * np.abs(moved).max())
    assert other == pytest.approx(force, abs=1e-3 * np.abs(force).max())


@pytest.mark.parametrize(
    ("step", "name", "tolerance"),
    [
        (ts.ImplicitEuler("2 ms"), "augmented", 1e-6),
        (ts.ImplicitEuler("2 ms"), "barrier", 1e-6),
        (ts.ImplicitEuler("2 ms"), "penalty", 1e-6),
        (ts.ImplicitMidpoint("2 ms"), "augmented", 1e-6),
        (ts.SymplecticEuler(), "impulse", 1e-12),
        (ts.SymplecticEuler(), "penalty", 1e-12),
        (ts.SymplecticEuler(), "geometric", 1e-12),
    ],
)
def test_a_collision_keeps_momentum(step, name, tolerance):
    """Linear momentum to round-off, in implicit steps to the tolerance of the linear solver."""
    simulation = colliding(step, name).compile()
    mass = 1000.0 * np.prod(SIZE)
    touched = 0
    while simulation.time < 0.04:
        report = simulation.step()
        assert simulation.crossings() == [], report
        touched += report.contacts
        left, right = (simulation.force_on(body).force for body in ("left", "right"))
        assert left + right == pytest.approx(np.zeros(3), abs=1e-12 * np.abs(left).max() + 1e-300)
    assert touched
    assert momentum(simulation)[0] == pytest.approx(np.zeros(3), abs=tolerance * mass)
    assert simulation.velocities["left"][:, 0].mean() < 0.0  # thrown back


def test_a_pressed_block_bears_the_homogeneous_force():
    """Without friction F = E A (1 - h / L) of linear elasticity, whatever the meshes: hexahedra
    hold the homogeneous state exactly, and h is the height that positions show."""
    law = ts.Hooke(young=1e4, poisson=0.3)
    press = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.0055)))
    scene = ts.Scene(
        bodies={"block": block((0, 0, 2e-4), law=law)},
        obstacles={
            "table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)),
            "plate": ts.PlaneObstacle((0, 0, 0.1005), (0, 0, -1), motion=press),
        },
        contacts=[ts.Contact(("block", ("table", "plate")), gap=1e-4)],
        contact=ts.ContactSettings(surface_of={"block": bar((5, 5, 5), (0, 0, 2e-4))}),
        fixed=[
            ts.Fixed("block", on=ts.Nodes((13,)), axes="xy"),
            ts.Fixed("block", on=ts.Nodes((14,)), axes="y"),
        ],
        step=ts.Static(load_steps=1),
    )
    simulation = scene.compile()
    pushed(simulation)
    height = np.ptp(simulation.positions["block"][:, 2])
    assert height < 0.096
    wanted = 1e4 * 0.01 * (1.0 - height / 0.1)
    assert simulation.force_on("plate").force[2] == pytest.approx(wanted, rel=1e-3)
    assert simulation.force_on("table").force[2] == pytest.approx(-wanted, rel=1e-3)


def test_refined_carriers_bear_the_force_of_the_fine_body():
    """A ball pressed into a surface of 8 x 8 quads carried by 2, 4 and 8 cells along each edge: the
    force falls towards that of the fine body's own surface, which the last one has."""

    def force(cells, skin=(8, 8, 8)):
        law = ts.StVK(young=1e4, poisson=0.3)
        path = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.008)))
        scene = ts.Scene(
            bodies={"block": block(cells=cells, law=law)},
            obstacles={"ball": ts.SphereObstacle((0.05, 0.05, 0.131), 0.03, motion=path)},
            contacts=[ts.Contact(("block", "ball"), gap=2e-4)],
            contact=ts.ContactSettings(surface_of={"block": bar(skin)} if skin else {}),
            fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
            step=ts.ImplicitEuler("50 ms"),
        )
        simulation = scene.compile()
        audited(simulation, 40)
        return simulation.force_on("ball").force[2]

    fine = force((8, 8, 8), None)
    coarse, middle, same = (force((n, n, n)) for n in (2, 4, 8))
    assert same == pytest.approx(fine, rel=1e-3)
    assert 0.0 < middle - fine < 0.5 * (coarse - fine)


# Bits.


@pytest.mark.parametrize("step", [ts.ImplicitEuler("2 ms"), ts.SymplecticEuler("0.2 ms")])
def test_threads_broad_phases_and_a_run_that_is_resumed_change_no_bit(step, tmp_path):
    ends = []
    for threads in (1, 2):
        simulation = colliding(step, threads=threads).compile()
        audited(simulation, 5)
        while not len(simulation.contacts()):
            audited(simulation, 1)
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        audited(simulation, 10)
        ends.append(simulation.positions["left"].tobytes())
    again = colliding(step, threads=1).compile(checkpoint=tmp_path / "middle.ckpt")
    assert len(again.contacts())
    audited(again, 10)
    ends.append(again.positions["left"].tobytes())
    assert ends[0] == ends[1] == ends[2]


@pytest.mark.parametrize("broad_phase", ["sweep_and_prune", "grid", "octree"])
def test_broad_phases_change_no_bit(broad_phase):
    ends = []
    for kind in ("hierarchy", broad_phase):
        scene = colliding(ts.ImplicitEuler("2 ms"))
        settings = scene.contact.replace(broad_phase=kind)
        simulation = scene.replace(contact=settings).compile()
        audited(simulation, 8)
        assert len(simulation.contacts())
        ends.append(simulation.positions["left"].tobytes())
    assert ends[0] == ends[1]


# What the surface may be.


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge", "pyramid", "tetra10"])
def test_every_volume_cell_carries_a_surface(cell):
    """A surface that bulges beyond the cells by a tenth of them rests with the body's weight."""
    body = block((0, 0, 0.01), cell=cell, young=2e4, viscosity=damped(20.0, 1e-4))
    mesh = ts.bar_mesh(size=SIZE, cells=(4, 4, 4), origin=(0, 0, 0.01)).surface()
    outer = ts.bar_mesh(size=SIZE, cells=(4, 4, 4), origin=(0, 0, 0.01))
    points = 1.1 * (outer.points - [0.05, 0.05, 0.06]) + [0.05, 0.05, 0.06]
    skin = ts.Mesh(points=points, cells=(ts.CellBlock("triangle", mesh.triangles),))
    settings = ts.ContactSettings(surface_of={"block": skin})
    simulation = over_a_table(body=body, contact=settings).compile()
    audited(simulation, 160)
    force = simulation.force_on("table").force
    assert force == pytest.approx([0, 0, -weight()], abs=2e-3 * weight())
    low = simulation.contact_surface("block").points[:, 2].min()
    assert 0.0 < low < 1e-3 < simulation.positions["block"][:, 2].min()


def test_springs_and_condensed_regions_carry_surfaces():
    for model, law in (("mass_link", "stvk"), ("condensed", "hooke")):
        young = {"stvk": ts.StVK(young=2e4, poisson=0.3), "hooke": ts.Hooke(young=2e4, poisson=0.3)}
        body = block(cells=(4, 4, 4), cell="tetra", law=young[law], model=model)
        scene = over_a_table(
            body=body,
            skin=(5, 5, 5),
            fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0.1), (0, 0, 1)))],
            gravity=None,
            obstacles={
                "table": ts.PlaneObstacle(
                    (0, 0, -1e-3),
                    (0, 0, 1),
                    motion=ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, 0.011))),
                )
            },
        )
        simulation = scene.compile()
        audited(simulation, 20)
        force = simulation.force_on("table").force
        assert force[2] < 0.0
        points = simulation.contact_surface("block").points
        assert points[:, 2].min() == pytest.approx(0.1 * 0.011 - 1e-3, abs=2e-3)


def test_a_selection_takes_vertices_of_the_surface():
    """Vertices with x < 3 cm; of nodes of the body the vertices that they alone carry."""
    low = ts.Box(max=(0.03, None, 1e-6))
    of_body = ts.Nodes((0, 1, 3, 4))
    for on, width in ((low, 0.03), (of_body, 0.051)):
        scene = over_a_table(contacts=[ts.Contact(("block", "table"), on=on)])
        simulation = scene.compile()
        audited(simulation, 2)
        found = simulation.contacts()
        vertices = -2 - found.nodes[:, 0]
        rest = simulation.contact_surface("block").rest[vertices]
        assert len(found) > 2, found
        assert (rest[:, 0] < width).all() and (rest[:, 2] == 0.0).all()
        if on is of_body:
            assert (rest[:, 1] < width).all()


def test_the_surface_follows_the_cells():
    simulation = over_a_table(height=2e-3).compile()
    audited(simulation, 20)
    surface = simulation.contact_surface("block")
    mesh = ts.bar_mesh(size=SIZE, cells=(5, 5, 5), origin=(0, 0, 2e-3))
    assert len(surface.points) == 6**3 - 4**3
    assert surface.weights.sum(axis=1) == pytest.approx(np.ones(len(surface.rest)))
    shell = np.unique(mesh.surface().triangles)
    assert surface.rest == pytest.approx(mesh.points[shell], abs=1e-12)
    whole = ts.bar_mesh(size=SIZE, cells=(2, 2, 2), origin=(0, 0, 2e-3))
    corner = np.flatnonzero((whole.points == whole.points.min(axis=0)).all(axis=1))[0]
    there = np.flatnonzero((np.abs(surface.rest - whole.points[corner]) < 1e-9).all(axis=1))[0]
    assert surface.points[there] == pytest.approx(simulation.positions["block"][corner], abs=1e-12)
    at_nodes = simulation.contact_at_nodes("block")
    assert at_nodes.pressure.max() > 0.0


def test_the_series_and_the_picture_have_the_surface(tmp_path):
    from tissu.output.series import Series
    from tissu.picture.draw import shape_of

    simulation = over_a_table().compile()
    audited(simulation, 2)
    series = Series(simulation, tmp_path)
    series.write()
    text = series.index.read_text()
    assert 'name="block-surface"' in text
    (file,) = re.findall(r'name="block-surface" file="([^"]+)"', text)
    written = ts.read_mesh(tmp_path / file)
    assert written.points == pytest.approx(simulation.contact_surface("block").points)
    for field in ("displacement", "von_mises"):
        assert len(shape_of(simulation, field).rest) == 6**3 - 4**3


# Edits.


def test_cells_that_carry_the_surface_are_not_removed():
    """Of 4 x 4 x 4 cells the inner ones carry nothing."""
    body = block(cells=(4, 4, 4), young=2e4, viscosity=damped(20.0, 1e-4))
    simulation = over_a_table(body=body, editing=True).compile()
    audited(simulation, 5)
    before = simulation.contacts()
    with pytest.raises(ParameterError, match=r"carry 14 vertices of the surface that surface_of"):
        simulation.remove_cells(body="block", cells=[0, 3])
    assert len(simulation.contacts()) == len(before)
    inner = [i + 4 * j + 16 * k for i in (1, 2) for j in (1, 2) for k in (1, 2)]
    simulation.remove_cells(body="block", cells=inner)
    assert (simulation.contacts().forces == before.forces).all()
    audited(simulation, 155)
    weighs = weight() * (1 - 8 / 64)
    assert simulation.force_on("table").force[2] == pytest.approx(-weighs, rel=5e-3)
    with pytest.raises(ParameterError, match=r"its surface in contact is a mesh of its own"):
        simulation.cut("block", ts.Plane((0, 0, 0.05), (0, 0, 1)))


# Words.


def test_a_scene_is_written_and_read(tmp_path):
    scene = over_a_table()
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
    made = ts.ContactSettings(surface_of={"block": ts.bar_mesh(size=SIZE, cells=(3, 3, 3))})
    with pytest.raises(SceneError, match=r"contact\.surface_of\.block: made in memory"):
        over_a_table(contact=made).to_yaml()
    over_a_table(contact=made).save(tmp_path / "scene.yaml")
    read = ts.Scene.from_yaml(tmp_path / "scene.yaml")
    assert read.contact.surface_of["block"].file.name == "scene-block-surface.vtu"
    assert read.check().ok
    words = "\n".join(str(effect) for effect in read.check().effects)
    assert "surface_of block; 108 surface triangles" in words


REFUSED = {
    "unknown": ({"surface_of": {"blck": bar((3, 3, 3))}}, "no body is named 'blck'"),
    "far": (
        {"surface_of": {"block": bar((3, 3, 3), (0, 0, 1.0))}},
        r"found 56 points of 56 farther from all cells than",
    ),
    "outside": (
        {"surface_of": {"block": bar((3, 3, 3), (0.05, 0, 0))}},
        r"found 16 points of 56 farther outside the cells of 'block' than half a cell",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case):
    fields, words = REFUSED[case]
    with pytest.raises(SceneError, match=words) as caught:
        over_a_table(contact=ts.ContactSettings(**fields)).compile()
    assert "contact.surface_of.bl" in caught.value.problems[0]


def test_a_surface_that_no_contact_uses_is_refused():
    own = ts.ContactSettings(surface_of={"block": bar((3, 3, 3))})
    with pytest.raises(SceneError, match="'block', which no contact names"):
        over_a_table(contact=own, contacts=[]).check().raise_problems()


def test_bodies_that_carry_no_surface_are_refused():
    sheet = ts.BarMesh(size=(0.1, 0.1, 0), cells=(2, 2, 0), cell="quad", origin=(0, 0, 0.01))
    law = ts.StVK(young=2e4, poisson=0.3)
    thin = ts.Body(mesh=sheet, law=law, density=1000.0, thickness=1e-3)
    with pytest.raises(SceneError, match="which has no volume cells to carry a surface"):
        over_a_table(body=thin).compile()
    with pytest.raises(SceneError, match="overlap at the start"):
        over_a_table(obstacles={"table": ts.PlaneObstacle((0, 0, 0.01), (0, 0, 1))}).compile()
