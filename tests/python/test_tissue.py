"""Connective tissue: frames and points without a mesh, alone and between two bodies."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from tissu.output.series import Series

SOFT = ts.StVK(young=6e3, poisson=0.3)


def _box(low: tuple[float, float, float], cells: int = 3, **body: Any) -> ts.Body:
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.05), cells=(cells, cells, 2), cell="hexahedron", origin=low)
    return ts.Body(**{"mesh": mesh, "law": ts.StVK(young=2e4, poisson=0.3), "density": 1e3, **body})


def _pair(**tissue: Any) -> dict[str, Any]:
    given = {"between": ("upper", "lower"), "reach": 0.06, "frames": 12, "points": 90}
    return {
        "bodies": {"upper": _box((0, 0, 0.08)), "lower": _box((0, 0, 0), cells=4)},
        "tissue": {"fascia": ts.Tissue(law=SOFT, density=1e3, **{**given, **tissue})},
        "fixed": [ts.Fixed("upper", on=ts.Plane((0, 0, 0.13), (0, 0, 1)))],
    }


def test_tissue_alone_is_the_block_that_it_fills() -> None:
    """A block drawn by its end pulls with E A e, and a little more where its root is held."""
    block = ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron")
    tissue = ts.Tissue(inside=block, frames=45, points=400, sampling="grid", shape="trilinear",
                       law=SOFT, mass=2.0)  # fmt: skip
    end = ts.Plane((0.2, 0, 0), (1, 0, 0))
    scene = ts.Scene(
        tissue={"block": tissue},
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        prescribed=[
            ts.Prescribed(
                "block",
                on=end,
                axes="x",
                rotations="held",
                times=(0, 1),
                displacements=[(0, 0, 0), (0.002, 0, 0)],
            )
        ],
        step=ts.Static(newton=ts.Newton(iterations=20), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    at_end = np.isclose(simulation.tissue["block"].points[:, 0], 0.2)
    pull = simulation.reactions("block")[at_end, 0].sum()
    # Plane strain at the root for a length of about its width: nu^2 of a third of the block.
    assert 1.0 < pull / (6e3 * 0.01 * 0.01) < 1.05
    assert float(simulation._world.mass) == pytest.approx(2.0)
    assert len(simulation.points("block")) == 540
    assert len(simulation.cell_fields("block")["volume_ratio"]) == 540


@pytest.mark.parametrize("shape", ["shepard", "wendland", "moving_least_squares"])
def test_tissue_passes_on_what_holds_the_other_body(shape: str) -> None:
    """The lower body hangs on the upper one by the tissue; without it, it falls."""
    fields = _pair(shape=shape)
    step = ts.ImplicitEuler(dt=0.02, newton=ts.Newton(iterations=40))
    scene = ts.Scene(**fields, gravity=(0, 0, -9.81), step=step, duration=1.0)
    simulation = scene.compile()
    assert all(report.converged for report in simulation.run())
    drop = -simulation.displacements("lower")[:, 2].mean()
    assert 1e-4 < drop < 0.05
    alone = ts.Scene(**{**fields, "tissue": {}}, gravity=(0, 0, -9.81), step=step, duration=1.0)
    fallen = alone.compile()
    list(fallen.run())
    assert -fallen.displacements("lower")[:, 2].mean() > 4.0


def test_tied_bodies_carried_together_are_free_of_force() -> None:
    """All that is tied is turned and moved as one: no energy, whatever rides on what."""
    simulation = ts.Scene(**_pair(), step=ts.ImplicitEuler(dt=0.01)).compile()
    assert simulation.energy()["elastic"] == pytest.approx(0.0, abs=1e-15)
    spun = ts.Scene(
        **{**_pair(), "fixed": ()},
        prescribed=[
            ts.Prescribed(
                "upper",
                on=ts.SurfaceNodes(),
                times=(0, 1),
                rotation=ts.Rotation(axis=(0, 1, 0), angles=(0, "90 deg")),
            )
        ],
        step=ts.Static(load_steps=4, newton=ts.Newton(iterations=30), solver=ts.Cholesky()),
    ).compile()
    report = spun.step()
    assert report.converged
    size = 6e3 * 0.05**3
    assert spun.energy()["elastic"] < 1e-9 * size
    points = spun.meshes["lower"].points
    turned = np.stack([points[:, 2], points[:, 1], -points[:, 0]], axis=1)
    assert spun.positions["lower"] == pytest.approx(turned, abs=1e-6)


def test_momentum_is_kept_across_the_tissue() -> None:
    fields = _pair()
    fields["fixed"] = ()
    fields["bodies"]["lower"] = fields["bodies"]["lower"].replace(
        start=ts.Start(velocity=(0.1, 0, -0.2))
    )
    simulation = ts.Scene(**fields, step=ts.ImplicitEuler(dt=0.01), duration=0.2).compile()
    before = simulation.velocities["lower"].copy()
    for _ in simulation.run():
        pass
    assert np.isfinite(simulation.positions["upper"]).all()
    assert np.abs(simulation.velocities["upper"]).max() > 1e-3  # the pull has come through
    assert np.abs(before).max() == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"reach": None}, "neither of reach"),
        ({"reach": 0.01}, "reach"),
        ({"between": ("upper", "lover")}, "no body is named 'lover'"),
        ({"between": ("upper", "upper")}, "twice"),
        ({"mass": 1.0}, "both of density and mass"),
        ({"shape": "trilinear"}, "grid"),
        ({"frames": 2, "neighbours": 500}, "neighbours|frames"),
        ({"sampling": "grid", "reach": 0.031, "frames": 2}, "no frame of the grid inside"),
    ],
)
def test_tissue_refuses_in_one_sentence(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(ts.TissuError, match=words):
        ts.Scene(**_pair(**fields), step=ts.ImplicitEuler(dt=0.01)).compile()


def test_tissue_is_told_and_absent_where_it_is_not() -> None:
    with_tissue = ts.Scene(**_pair(), step=ts.ImplicitEuler(dt=0.01)).check()
    assert any("connective tissue fascia" in str(effect) for effect in with_tissue.effects)
    without = ts.Scene(**{**_pair(), "tissue": {}}, step=ts.ImplicitEuler(dt=0.01)).check()
    assert "connective tissue" in without.absent


def test_example_writes_its_points(tmp_path: Any) -> None:
    """examples/tissue.yaml hangs together, and ParaView gets blocks and points."""
    meshio = pytest.importorskip("meshio")
    example = Path(__file__).resolve().parents[2] / "examples" / "tissue.yaml"
    scene = ts.Scene.from_yaml(example)
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
    simulation = scene.compile()
    series = Series(simulation, tmp_path)
    series.write()
    for report in simulation.run("0.1 s"):
        assert report.converged, report
    series.write()
    found = meshio.read(tmp_path / "frames" / "fascia_00001.vtu")
    assert found.points == pytest.approx(simulation.points("fascia"))
    assert -0.05 < found.point_data["displacement"][:, 2].mean() < -1e-4
    assert series.index.read_text().count("<DataSet") == 6


def test_no_sampling_of_a_tissue_is_made_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the search for the frames' distance found is taken over; it was three quarters of it."""
    from tissu.sampling import poisson

    asked: list[tuple[float, int]] = []
    sampled = poisson.poisson_points

    def counted(region: object, distance: float, *, seed: int = 0) -> object:
        asked.append((distance, seed))
        return sampled(region, distance, seed=seed)

    example = Path(__file__).resolve().parents[2] / "examples" / "tissue.yaml"
    for module in (poisson, ts.sampling):
        monkeypatch.setattr(module, "poisson_points", counted)
    simulation = ts.Scene.from_yaml(example).compile()
    assert len(asked) == len(set(asked))
    assert simulation.tissue["fascia"].node_count == pytest.approx(22, abs=2)
