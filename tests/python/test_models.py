"""Every model in a scene: closed forms, continuum elements of the same mesh, references."""

from pathlib import Path

import numpy as np
import pytest

import tissu as ts

FOLDER = Path(__file__).parents[1] / "reference"
SIDE, YOUNG = 0.05, 20e3  # m, Pa: the cube of Chendeb 2007, section 3.5.1
NEWTON = ts.Newton(iterations=40, tolerance=1e-10)
STVK = ["fem", "mass-link", "mass-tensor"]  # three forms of one energy


def low(axis):
    """The plane where a coordinate is zero: a plane of symmetry."""
    return ts.Box((None,) * 3, tuple(1e-9 if i == axis else None for i in range(3)))


def stretched_cube(model, poisson, F, law=ts.StVK):
    """The cube between symmetry planes, its top led to the stretch F.

    Its force along z [N], its stretch across, and how far from homogeneous it is [m].
    """
    mesh = ts.bar_mesh(size=(SIDE,) * 3, cells=(2, 2, 2), cell="tetra")
    top = ts.Box((None, None, SIDE - 1e-9), (None,) * 3)
    steps = int(np.ceil(abs(F - 1) / 0.08))
    times = np.linspace(0, steps, steps + 1)
    scene = ts.Scene(
        bodies={
            "cube": ts.Body(mesh=mesh, law=law(young=YOUNG, poisson=poisson), mass=1.0, model=model)
        },
        fixed=[ts.Fixed("cube", on=low(i), axes="xyz"[i]) for i in range(3)],
        prescribed=[
            ts.Prescribed(
                "cube",
                on=top,
                times=list(times),
                displacements=[(0, 0, (F - 1) * SIDE * t / steps) for t in times],
                axes="z",
            )
        ],
        step=ts.Static(solver=ts.Cholesky(), newton=NEWTON),
        duration=steps,
    )
    simulation = scene.compile()
    for report in simulation.run():
        assert report.converged, report
    found = simulation.positions["cube"]
    stretch = found.max(axis=0) / SIDE
    force = simulation.reactions("cube")[mesh.points[:, 2] > SIDE - 1e-9, 2].sum()
    return force, stretch[:2], np.abs(found - mesh.points * [*stretch[:2], F]).max()


@pytest.mark.parametrize("model", STVK)
@pytest.mark.parametrize(
    ("poisson", "F"),
    [(0.3, f) for f in (0.61, 0.7, 0.85, 1.25, 1.6, 2.0)]
    + [(0.45, f) for f in (0.61, 0.7, 1.25, 1.6, 1.78)],
)
def test_the_stretched_cube_meets_the_closed_form_of_the_paper(model, poisson, F):
    """P = E/2 F (F^2 - 1), lateral^2 = 1 - nu (F^2 - 1): to Newton's tolerance, not to 0.1 %."""
    force, across, off = stretched_cube(model, poisson, F)
    assert force == pytest.approx(SIDE**2 * YOUNG / 2 * F * (F**2 - 1), rel=1e-8)
    assert across == pytest.approx(np.sqrt(1 - poisson * (F**2 - 1)), rel=1e-8)
    assert off < 1e-8 * SIDE


def test_beyond_its_largest_pressure_stvk_is_only_inside_out():
    """The force is largest at F = 1/sqrt(3), -9.6225 N here: a property of the law (errata).

    The one root of F (F^2 - 1) E/2 = P that is left is below -1, and the cells there are told.
    """
    mesh = ts.bar_mesh(size=(SIDE,) * 3, cells=(2, 2, 2), cell="tetra")
    limit = SIDE**2 * YOUNG / (3 * np.sqrt(3))
    assert limit == pytest.approx(9.622504486, rel=1e-9)  # the reference's figure

    def pressed(model, share):
        scene = ts.Scene(
            bodies={
                "cube": ts.Body(
                    mesh=mesh, law=ts.StVK(young=YOUNG, poisson=0.3), mass=1.0, model=model
                )
            },
            fixed=[ts.Fixed("cube", on=low(i), axes="xyz"[i]) for i in range(3)],
            loads=[
                ts.Traction(
                    "cube",
                    on=ts.Box((None, None, SIDE - 1e-9), (None,) * 3),
                    traction=(0, 0, -share * limit / SIDE**2),
                )
            ],
            step=ts.Static(solver=ts.Cholesky(), newton=NEWTON, load_steps=8),
        )
        simulation = scene.compile()
        report = simulation.step()
        assert report.converged, report
        top = simulation.meshes["cube"].points[:, 2] > SIDE - 1e-9
        F = simulation.positions["cube"][top, 2].mean() / SIDE
        assert pytest.approx(-share / (3 * np.sqrt(3)), rel=1e-8) == F * (F**2 - 1) / 2
        return F, len(simulation.inverted_cells("cube"))

    for model in STVK:
        F, inverted = pressed(model, 0.98)
        assert 1 / np.sqrt(3) < F  # the branch that a growing load follows
        assert inverted == 0
        F, inverted = pressed(model, 1.02)
        assert F < -1
        assert inverted == len(mesh.cells[0])


def same_mesh(poisson):
    data = np.load(FOLDER / f"A_mesh_12x2x2_tet4_nu{round(10 * poisson):02d}.npz")
    cells = ts.CellBlock("tetra", data["elements"].astype(np.int32))
    return data, ts.Mesh(points=data["nodes"], cells=(cells,))


def bar(model, mesh, law, law_for_model="exact", **changes):
    """The bar of 8 m, E = 1e8 Pa, held at x = 0."""
    body = ts.Body(mesh=mesh, law=law, density=1e3, model=model, law_for_model=law_for_model)
    fields = {
        "bodies": {"bar": body},
        "fixed": [ts.Fixed("bar", on=ts.Box((None, None, None), (1e-9, None, None)))],
        "gravity": (0.0, -9.81, 0.0),
        "step": ts.Static(solver=ts.Cholesky(), newton=NEWTON),
    }
    return ts.Scene(**{**fields, **changes})


def sagged(model, mesh, law):
    simulation = bar(model, mesh, law).compile()
    report = simulation.step()
    assert report.converged, report
    return simulation.displacements("bar")


@pytest.mark.parametrize("poisson", [0.0, 0.3])
@pytest.mark.parametrize(
    ("model", "law"),
    [
        ("mass-link", "stvk"),
        ("mass-tensor", "stvk"),
        ("mass-tensor", "hooke"),
        ("condensed", "hooke"),
        (ts.Corotational(rotation="small"), "hooke"),
    ],
)
def test_the_bent_bar_is_that_of_the_reference_node_by_node(model, law, poisson):
    data, mesh = same_mesh(poisson)
    made = {"stvk": ts.StVK, "hooke": ts.Hooke}[law](young=1e8, poisson=poisson)
    off = np.abs(sagged(model, mesh, made) - data[f"u_{law}"]).max()
    assert off < 1e-7  # m: twice what the seven printed digits of the reference leave open


@pytest.mark.parametrize("tangent", ["approximate", "exact"])
@pytest.mark.parametrize("rotation", ["polar", "frame"])
def test_the_bent_corotational_bar_stays_near_stvk(rotation, tangent):
    """Both laws agree at small strain; it is 4 % here: the tip differs by some thousandths."""
    data, mesh = same_mesh(0.3)
    model = ts.Corotational(rotation=rotation, tangent=tangent)
    moved = sagged(model, mesh, ts.Hooke(young=1e8, poisson=0.3))
    reference = data["u_stvk"]
    assert np.abs(moved - reference).max() < 5e-3 * np.abs(reference).max()


def turned(model, law, mesh, angle=np.pi):
    """The bar twisted about its axis: displacements in equilibrium, and the moment [N m]."""
    end = ts.Box((8 - 1e-9, None, None), (None,) * 3)
    steps = 12
    times = [float(t) for t in range(steps + 1)]
    scene = bar(
        model,
        mesh,
        law,
        gravity=None,
        prescribed=[
            ts.Prescribed(
                "bar",
                on=end,
                times=times,
                rotation=ts.Rotation(
                    axis=(1, 0, 0), center=(0, 0, 0), angles=[angle * t / steps for t in times]
                ),
            )
        ],
        step=ts.Static(solver=ts.Cholesky(), newton=ts.Newton(iterations=60, tolerance=1e-9)),
        duration=steps,
    )
    simulation = scene.compile()
    for report in simulation.run():
        assert report.converged, report
    at, forces = simulation.positions["bar"], simulation.reactions("bar")
    held = mesh.points[:, 0] > 8 - 1e-9
    return simulation.displacements("bar"), np.cross(at[held], forces[held])[:, 0].sum()


@pytest.mark.parametrize("model", ["mass-link", "mass-tensor"])
def test_half_a_turn_is_that_of_the_continuum_elements(model):
    """The same energy: to Newton's tolerance."""
    _, mesh = same_mesh(0.3)
    law = ts.StVK(young=1e8, poisson=0.3)
    wanted, moment = turned("fem", law, mesh)
    found, of_model = turned(model, law, mesh)
    assert np.abs(found - wanted).max() < 1e-6
    assert of_model == pytest.approx(moment, rel=1e-6)


def test_half_a_turn_of_corotational_cells():
    """Twist per length 0.39/m, so strains of 20 % at the edges: near StVK, which stiffens."""
    mesh = ts.bar_mesh(size=(8, 1, 1), cells=(24, 4, 4), cell="hexahedron", origin=(0, -0.5, -0.5))
    wanted, moment = turned("fem", ts.StVK(young=1e8, poisson=0.3), mesh)
    found, of_model = turned("corotational", ts.Hooke(young=1e8, poisson=0.3), mesh)
    # Saint-Venant's torsion of a square, 0.1406 G a^4 per twist, plus what large twist adds.
    saint_venant = 0.1406 * 1e8 / 2.6 * np.pi / 8
    assert moment == pytest.approx(saint_venant, rel=0.2)
    assert of_model == pytest.approx(moment, rel=0.1)
    assert np.abs(found - wanted).max() < 0.1  # of displacements of 1.4 m


@pytest.mark.parametrize("model", ["mass-spring", "mass-link", "mass-tensor"])
def test_models_of_tetrahedra_refuse_other_cells(model):
    mesh = ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1), cell="wedge")
    with pytest.raises(
        ts.SceneError, match=f"found {model.replace('-', '_')} for 2 wedge cells; it takes tetra"
    ):
        bar(model, mesh, ts.StVK(young=1e8, poisson=0.3)).compile()


@pytest.mark.parametrize(
    ("model", "law", "used"),
    [
        ("mass-link", ts.Hooke, "stvk"),
        ("mass-link", ts.StableNeoHooke, "neo_hooke"),
        ("mass-tensor", ts.NeoHooke, "stvk"),
        ("corotational", ts.StVK, "hooke"),
        ("mass-spring", ts.NeoHooke, "stvk"),
    ],
)
def test_a_model_takes_the_nearest_law_where_it_is_asked_for(model, law, used):
    """Bit for bit what the body of that law does; `check` says so."""
    _, mesh = same_mesh(0.3)
    name = law(young=1, poisson=0).type
    other = {"stvk": ts.StVK, "neo_hooke": ts.NeoHooke, "hooke": ts.Hooke}[used]
    near = bar(model, mesh, law(young=1e8, poisson=0.3), "nearest")
    check = near.check()
    assert check.ok, check.problems
    told = f"the model {model.replace('-', '_')} computes {used} in place of {name}"
    assert sum(told in note for note in check.notes) == 1
    step = ts.ImplicitEuler("10 ms")
    ran = [near, bar(model, mesh, other(young=1e8, poisson=0.3))]
    found = [one_step(scene.replace(step=step)) for scene in ran]
    assert np.array_equal(*found)


def one_step(scene):
    simulation = scene.compile()
    simulation.step()
    return simulation.positions["bar"].copy()


@pytest.mark.parametrize(
    ("model", "law", "takes", "near"),
    [
        ("mass-link", ts.Hooke(young=1e8, poisson=0.3), "stvk, neo_hooke", "stvk"),
        ("corotational", ts.StVK(young=1e8, poisson=0.3), "hooke", "hooke"),
        ("mass-tensor", ts.MooneyRivlin(c1=1e6, c2=1e6, kappa=1e8), "hooke, stvk", None),
    ],
)
def test_a_law_that_a_model_does_not_take_is_refused(model, law, takes, near):
    _, mesh = same_mesh(0.3)
    (problem,) = bar(model, mesh, law).check().problems
    found = f"found {model.replace('-', '_')} for the law {law.type}; it takes {takes}; "
    assert problem.startswith(f"bodies.bar.model: {found}")
    assert ("law_for_model: nearest" in problem) == (near is not None)
    assert near is None or f"which computes {near} with the same young and poisson" in problem
    if near is None:  # no law of it has the parameters of this one
        (still,) = bar(model, mesh, law, "nearest").check().problems
        assert still.startswith(f"bodies.bar.model: {found}")


def test_regions_have_their_own_models():
    """One half mass-link, one fem: the same energy everywhere, so the same answer."""
    data, mesh = same_mesh(0.3)
    middle = mesh.points[mesh.cells[0].nodes].mean(axis=1)[:, 0]
    halves = {"near": np.flatnonzero(middle < 4), "far": np.flatnonzero(middle >= 4)}
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions=halves)
    models = {"near": "mass-link", "far": "fem"}
    moved = sagged(models, mesh, ts.StVK(young=1e8, poisson=0.3))
    assert np.abs(moved - data["u_stvk"]).max() < 1e-7


def test_each_cell_needs_one_model():
    _, mesh = same_mesh(0.3)
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions={"near": np.arange(10)})
    with pytest.raises(ts.SceneError, match=r"bar\.model: 278 of 288 cells are in no region"):
        bar({"near": "fem"}, mesh, ts.StVK(young=1e8, poisson=0.3)).compile()
