"""Tissue in contact: the surface that it fills, carried by its frames."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited
from tissu.errors import ParameterError, SceneError
from tissu.simulation.twist import rows_of

SIZE = (0.1, 0.1, 0.1)


def cube(origin=(0, 0, 0), cells=(4, 4, 4)):
    return ts.BarMesh(size=SIZE, cells=cells, origin=origin)


def tissue(origin=(0, 0, 0), **fields):
    """A cube of 10 cm of about 1 kg, filled with frames."""
    given = {
        "inside": cube(origin), "frames": 27, "points": 200, "sampling": "grid",
        "shape": "trilinear", "law": ts.StVK(young=2e4, poisson=0.3), "mass": 1.0,
    }  # fmt: skip
    return ts.Tissue(**(given | fields))


def on_a_table(**fields):
    given = {
        "tissue": {"fat": tissue()},
        "obstacles": {"table": ts.PlaneObstacle((0, 0, -1e-4), (0, 0, 1))},
        "contacts": [ts.Contact(("fat", "table"), friction=0.3)],
        "gravity": (0, 0, -GRAVITY),
        "step": ts.ImplicitEuler("5 ms"),
    }
    return ts.Scene(**(given | fields))


@pytest.mark.parametrize("shape", ["trilinear", "shepard", "moving_least_squares"])
def test_tissue_rests_with_its_weight(shape):
    """1e-2: what is left of its swing, for tissue has no viscosity but that of the step."""
    simulation = on_a_table(tissue={"fat": tissue(shape=shape)}).compile()
    audited(simulation, 200)
    forces = []
    for _ in range(100):
        audited(simulation, 1)
        forces.append(simulation.force_on("table").force)
    assert np.mean(forces, axis=0) == pytest.approx([0, 0, -GRAVITY], abs=1e-2 * GRAVITY)
    surface = simulation.contact_surface("fat")
    assert 0.0 < surface.points[:, 2].min() + 1e-4 < 2e-3


def test_the_surface_follows_its_frames():
    """Where frames and vertices move as a whole, Shepard's weights keep the shape by the rotations:
    p = sum w (x + R l) is exact, and sum w x alone would draw all vertices towards the middle."""
    low = ts.PlaneObstacle((0, 0, -1), (0, 0, 1))
    scene = on_a_table(
        gravity=None, obstacles={"table": low}, tissue={"fat": tissue(shape="shepard")}
    )
    simulation = scene.compile()
    mesh = ts.bar_mesh(size=SIZE, cells=(4, 4, 4))
    shell = np.unique(mesh.surface().triangles)
    surface = simulation.contact_surface("fat")
    assert surface.rest == pytest.approx(mesh.points[shell], abs=1e-12)
    assert surface.points == pytest.approx(surface.rest, abs=1e-12)
    assert np.abs(surface.carried(simulation.positions["fat"]) - surface.rest).max() > 5e-3
    rows = rows_of(simulation._core)
    middle = np.full(3, 0.05)
    rows.v[rows.turning[rows.turning >= 0]] = (0, 0, 5.0)
    turning = rows.turning >= 0
    rows.v[turning] = np.cross((0, 0, 5.0), rows.x[turning] - middle)
    for _ in range(20):
        simulation.step()
    surface = simulation.contact_surface("fat")
    x = simulation.positions["fat"] - middle
    rest = simulation.tissue["fat"].points - middle
    flat = [points[:, 0] + 1j * points[:, 1] for points in (x, rest)]
    angle = np.angle(np.vdot(flat[1], flat[0]))
    assert angle > 0.3
    c, s = np.cos(angle), np.sin(angle)
    wanted = (surface.rest - middle) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + middle
    # It is a little wider by the centrifugal force: rho (omega L)^2 / E = 1 %.
    assert np.abs(surface.points - wanted).max() < 2e-2 * 0.1


@pytest.mark.parametrize("other", ["body", "tissue"])
def test_a_collision_keeps_momentum(other):
    step = ts.ImplicitEuler("2 ms", solver=ts.Cholesky())
    origin = (0.02, 0.03, 0.102)
    fields = {"tissue": {"fat": tissue()}}
    if other == "body":
        law = ts.StVK(young=2e4, poisson=0.3)
        mesh = ts.BarMesh(size=SIZE, cells=(3, 3, 3), origin=origin)
        start = ts.Start(velocity=(0, 0, -1))
        fields["bodies"] = {"other": ts.Body(mesh=mesh, law=law, mass=1.0, start=start)}
    else:
        fields["tissue"]["other"] = tissue(origin)
    contact = [ts.Contact(("fat", "other"), friction=0.2, gap=5e-4)]
    scene = ts.Scene(contacts=contact, step=step, **fields)
    simulation = scene.compile()
    if other == "tissue":
        simulation.velocities["other"][:] = (0, 0, -1)
    rows = rows_of(simulation._core)
    before, touched = rows.momenta(), 0
    assert before[2] == pytest.approx(-1.0)
    for _ in range(30):
        report = simulation.step()
        assert simulation.crossings() == [], report
        touched += report.contacts
    assert touched
    after = rows_of(simulation._core).momenta()
    assert after[:3] == pytest.approx(before[:3], abs=1e-11)
    assert simulation.velocities["fat"][:, 2].mean() < -0.1


def tied(**contacts):
    """Two blocks, and tissue that fills a box around the gap between them."""
    law = ts.StVK(young=2e4, poisson=0.3)

    def slab(z, **fields):
        mesh = ts.BarMesh(size=(0.1, 0.1, 0.04), cells=(4, 4, 2), origin=(0, 0, z))
        return ts.Body(mesh=mesh, law=law, density=1e3, **fields)

    box = ts.BarMesh(size=(0.06, 0.06, 0.05), cells=(3, 3, 3), origin=(0.021, 0.019, 0.036))
    fascia = ts.Tissue(
        between=("upper", "lower"), inside=box, frames=8, points=100, law=law, density=1e3
    )
    return ts.Scene(
        bodies={"lower": slab(0), "upper": slab(0.081)},
        tissue={"fascia": fascia},
        fixed=[ts.Fixed("upper", on=ts.Plane((0, 0, 0.121), (0, 0, 1)))],
        step=ts.ImplicitEuler("5 ms"),
        **contacts,
    )


def test_surfaces_that_follow_the_same_rows_never_meet():
    """The box reaches into both blocks, on whose cells its frames ride: those parts of the surfaces
    are one material. A ball beside it meets all of it."""
    path = ts.Motion(times=(0, 0.2), displacements=((0, 0, 0), (0, 0.03, 0)))
    ball = ts.SphereObstacle((0.05, -0.02, 0.06), 0.02, motion=path)
    scene = tied(
        obstacles={"ball": ball},
        contacts=[ts.Contact(("fascia", "ball"), gap=5e-4)],
    )
    simulation = scene.compile()
    audited(simulation, 40)
    assert simulation.force_on("ball").force[1] < 0.0
    surface = simulation.contact_surface("fascia")
    assert surface.points[:, 1].min() > 0.019 - 5e-3
    assert tied(contacts=[ts.Contact("all")]).check().ok


def test_what_is_refused():
    law = ts.StVK(young=2e4, poisson=0.3)
    fascia = ts.Tissue(between=("upper", "lower"), reach="5 cm", frames=8, points=100, law=law,
                       density=1e3)  # fmt: skip
    named = [ts.Contact(("fascia", "upper"))]
    with pytest.raises(SceneError, match="between bodies, which has no surface"):
        tied().replace(tissue={"fascia": fascia}, contacts=named).compile()
    simulation = on_a_table(editing=True).compile()
    with pytest.raises(ParameterError, match="its surface meets others"):
        simulation.cut("fat", ts.Plane((0.05, 0, 0), (1, 0, 0)))


def test_a_hand_that_feels_places_alone_is_refused():
    """Hands of trocars feel what places of nodes carry; rotations carry these surfaces, too."""
    trocar = ts.Trocar(port=ts.Port((0, 0, 0.3), (0, 0, -1)), device=ts.SimulatedDevice())
    with pytest.raises(SceneError, match="found 'fat' with trocars"):
        on_a_table(trocars={"right": trocar})
    low = ts.ContactSettings(surface_of={"block": cube(cells=(5, 5, 5))})
    law = ts.StVK(young=2e4, poisson=0.3)
    body = ts.Body(mesh=cube(cells=(2, 2, 2)), law=law, density=1e3, model="frames")
    with pytest.raises(SceneError, match=r"contact\.surface_of\.block: found 'block' with trocars"):
        ts.Scene(
            bodies={"block": body},
            obstacles={"table": ts.PlaneObstacle((0, 0, -1e-4), (0, 0, 1))},
            contacts=[ts.Contact(("block", "table"))],
            contact=low,
            trocars={"right": trocar},
            step=ts.ImplicitEuler("5 ms"),
        )


def test_a_run_that_is_resumed_and_threads_change_no_bit(tmp_path):
    ends = []
    for threads in (1, 2):
        simulation = on_a_table(threads=threads).compile()
        audited(simulation, 5)
        assert len(simulation.contacts())
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        audited(simulation, 5)
        ends.append(simulation.contact_surface("fat").points.tobytes())
    again = on_a_table().compile(checkpoint=tmp_path / "middle.ckpt")
    audited(again, 5)
    ends.append(again.contact_surface("fat").points.tobytes())
    assert ends[0] == ends[1] == ends[2]


def test_the_picture_and_the_series_have_the_surface(tmp_path):
    from tissu.output.series import Series
    from tissu.picture.draw import shape_of

    simulation = on_a_table().compile()
    audited(simulation, 5)
    Series(simulation, tmp_path).write()
    (file,) = tmp_path.glob("*/fat-surface_00000.vtu")
    wanted = simulation.contact_surface("fat").points
    assert ts.read_mesh(file).points == pytest.approx(wanted)
    for field in ("displacement", "von_mises"):
        assert shape_of(simulation, field).now == pytest.approx(wanted)
