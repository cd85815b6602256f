"""The calls that build a world: exactly what the scene asks for, with the right numbers."""

import dataclasses

import numpy as np
import pytest

import tissu._core
from tissu import (
    BarMesh,
    Body,
    Box,
    Centroid,
    Cholesky,
    ConjugateGradient,
    Fixed,
    Hooke,
    ImplicitEuler,
    KelvinVoigt,
    Newton,
    NodalLoad,
    Prescribed,
    Pressure,
    Prony,
    PronyBranch,
    Rayleigh,
    Rotation,
    Scene,
    Static,
    StVK,
    Traction,
    _core,
)
from tissu.compile.prepare import prepare
from tissu.compile.world import build_world
from tissu.mesh import bar_mesh

BAR = BarMesh(size=(2, 1, 1), cells=(2, 1, 1))
BODY = Body(mesh=BAR, law=StVK(young=3e3, poisson=0.45), mass=3.0)
LEFT, RIGHT = Box(None, (0, None, None)), Box((2, None, None), None)


class Recorder:
    """Stands for the builder and keeps its calls."""

    def __init__(self, **options):
        self.calls = [("options", options)]

    def __getattr__(self, name):
        return lambda **fields: self.calls.append((name, fields))

    def build(self):
        return self.calls


@pytest.fixture
def calls(monkeypatch):
    monkeypatch.setattr(_core, "WorldBuilder", Recorder)

    def record(**changes):
        made = Scene(**{"bodies": {"bar": BODY}, "step": ImplicitEuler(0.01), **changes})
        prepared = prepare(made)
        assert prepared.findings.problems == []
        return build_world(prepared)

    return record


def only(recorded, name):
    (fields,) = [fields for called, fields in recorded if called == name]
    return fields


def test_nothing_that_is_not_asked_for(calls):
    assert [name for name, _ in calls()] == ["options", "add_body", "add_elastic"]


def test_options(calls):
    # Never more threads than the machine has; the bits are the same.
    usable = min(3, tissu._core.build_info()["threads_available"])
    assert only(calls(threads=3, editing=True), "options") == {
        "threads": usable,
        "editable": True,
        "grabbing": False,
        "consistent_weight": False,
    }


def test_body_and_density_from_mass(calls):
    recorded = calls()
    assert only(recorded, "add_body")["positions"].shape == (12, 3)
    elastic = only(recorded, "add_elastic")
    assert elastic["cells"].shape == (12, 4)
    assert (elastic["cell_type"], elastic["law"], elastic["quadrature"]) == (
        "tetra",
        "stvk",
        "full",
    )
    assert elastic["parameters"] == {"young": [3e3], "poisson": [0.45]}
    np.testing.assert_allclose(elastic["density"], [1.5], rtol=1e-12)


def test_regions_of_one_kind_share_a_block(calls):
    mesh = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1), cell="hexahedron")
    mesh = dataclasses.replace(mesh, regions={"a": np.array([0]), "b": np.array([1])})
    soft, hard = StVK(young=1e3, poisson=0.4), StVK(young=2e3, poisson=0.4)
    elastic = only(
        calls(bodies={"bar": BODY.replace(mesh=mesh, law={"b": soft, "a": hard})}), "add_elastic"
    )
    assert elastic["parameters"]["young"].tolist() == [2e3, 1e3]
    linear = Hooke(young=1e3, poisson=0.4)
    recorded = calls(bodies={"bar": BODY.replace(mesh=mesh, law={"b": soft, "a": linear})})
    blocks = [fields for name, fields in recorded if name == "add_elastic"]
    assert [block["law"] for block in blocks] == ["hooke", "stvk"]
    assert [block["parameters"]["young"].tolist() for block in blocks] == [[1e3], [1e3]]


def test_gravity_viscosity_fixed(calls):
    viscous = BODY.replace(viscosity=Rayleigh(mass=0.1, stiffness=0.2))
    recorded = calls(
        bodies={"bar": viscous}, gravity=(0, 0, -9.81), fixed=[Fixed("bar", on=LEFT, axes="xz")]
    )
    assert only(recorded, "add_rayleigh") == {"body": "bar", "mass": 0.1, "stiffness": 0.2}
    assert only(recorded, "add_gravity")["acceleration"].tolist() == [0, 0, -9.81]
    fixed = only(recorded, "fix")
    assert (len(fixed["nodes"]), fixed["axes"]) == (4, 5)


@pytest.mark.parametrize(
    ("viscosity", "call", "fields"),
    [
        (KelvinVoigt(eta=3.0, zeta=4.0), "add_kelvin_voigt", {"shear": 3.0, "bulk": 4.0}),
        (Centroid(coefficient=5.0), "add_centroid", {"coefficient": 5.0}),
        (
            Prony(branches=[PronyBranch(weight=0.5, time=2.0)]),
            "add_prony",
            {"branches": [(0.5, 2.0)]},
        ),
    ],
)
def test_viscosities(calls, viscosity, call, fields):
    recorded = calls(bodies={"bar": BODY.replace(viscosity=viscosity)})
    assert only(recorded, call) == {"body": "bar", **fields}
    assert not [name for name, _ in recorded if name == "add_rayleigh"]


def test_prescribed(calls):
    turn = Rotation(axis=(1, 0, 0), angles=["0 deg", "180 deg"])
    moved = only(
        calls(prescribed=[Prescribed("bar", on=RIGHT, times=[0, 1], rotation=turn)]), "prescribe"
    )
    assert moved["displacements"].tolist() == [[0, 0, 0]] * 2
    assert moved["angles"].tolist() == [0, np.pi]
    slide = Prescribed("bar", on=RIGHT, times=[0, 1], displacements=[(0, 0, 0), (1, 0, 0)])
    moved = only(calls(prescribed=[slide]), "prescribe")
    assert moved["angles"].tolist() == [0, 0]
    assert np.linalg.norm(moved["axis"]) == 1


def test_nodal_load_is_shared_equally(calls):
    load = only(calls(loads=[NodalLoad("bar", on=RIGHT, force=(0, 0, -1))]), "add_load")
    assert load["forces"].tolist() == [[0, 0, -0.25]] * 4
    assert (load["times"].tolist(), load["factors"].tolist()) == ([0], [1])


def test_traction_times_area(calls):
    load = only(calls(loads=[Traction("bar", on=RIGHT, traction=(0, 0, -100))]), "add_load")
    np.testing.assert_allclose(load["forces"].sum(axis=0), [0, 0, -100], rtol=1e-12)
    # two triangles of 0.5 m^2: nodes of the diagonal carry two thirds, the others one third
    np.testing.assert_allclose(sorted(load["forces"][:, 2] / -50), [1 / 3, 1 / 3, 2 / 3, 2 / 3])


def test_pressure(calls):
    load = Pressure("bar", on=RIGHT, pressure="1 kPa", times=[0, 1], factors=[0, 1])
    added = only(calls(loads=[load]), "add_pressure")
    ((kind, faces),) = added["faces"]
    assert (kind, faces.shape) == ("triangle", (2, 3))
    assert (added["pressure"], added["factors"].tolist()) == (1000.0, [0, 1])


def test_integrators_and_solvers(monkeypatch):
    """Each choice of the scene reaches the core with all its numbers."""
    made = {}
    for name in ("ImplicitEuler", "Static", "ConjugateGradient", "Cholesky"):
        monkeypatch.setattr(
            _core, name, lambda name=name, **fields: made.update({name: fields}), raising=False
        )
    ImplicitEuler(0.01).integrator()
    once = {"newton_iterations": 1, "newton_tolerance": 1e-6, "indefinite": "project"}
    assert made == {"ImplicitEuler": once}
    ImplicitEuler(0.01, newton=Newton(iterations=7, tolerance=1e-9)).integrator()
    Static(load_steps=3).integrator()
    gradient = ConjugateGradient(iterations=5, preconditioner="stale_cholesky", precision="single")
    gradient.linear_solver()
    Cholesky().linear_solver()
    assert made == {
        "ImplicitEuler": {
            "newton_iterations": 7,
            "newton_tolerance": 1e-9,
            "indefinite": "project",
        },
        "Static": {
            "newton_iterations": 25,
            "newton_tolerance": 1e-6,
            "load_steps": 3,
            "total_iterations": 0,
            "arc_length": False,
        },
        "ConjugateGradient": {
            "tolerance": 1e-6,
            "iterations": 5,
            "preconditioner": "stale_cholesky",
            "precision": "single",
            "matrix": "assembled",
        },
        "Cholesky": {},
    }
