"""What advise tries of richer cells: families, and models that do not lock."""

from fractions import Fraction

import pytest

import tissu as ts
from beam import beam
from tissu.advice.choices import Choices
from tissu.advice.goal import Goal
from tissu.advice.laboratory import Laboratory
from tissu.advice.measure import watch
from tissu.advice.reference import Reference, find_reference
from tissu.advice.resolution import Resolutions
from tissu.advice.setting import Setting, mesh_words

ONE = Fraction(1)


def soft(cell="tetra", cells=(4, 1, 1), poisson=0.49, **body):
    """A static cantilever that hangs down under its own weight, on one thread."""
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.05, 0.05), cells=cells, cell=cell, **body),
        law=ts.NeoHooke(young="20 kPa", poisson=poisson),
        density=1000,
    )
    scene = beam("20 kPa", bodies={"bar": bar}, gravity=(0, 0, -1.0), threads=1)
    return scene.replace(step=ts.Static(), duration=None)


def laboratory(scene, budget=1e3):
    import time

    simulation = scene.compile()
    resolutions = Resolutions(scene, simulation.meshes)
    return Laboratory(scene, resolutions, watch(simulation), time.perf_counter() + budget)


def own_setting(lab):
    return Setting(ONE, lab.resolutions.order, "", lab.scene.step)


@pytest.mark.parametrize(
    ("cell", "order", "made"),
    [
        ("tetra", 1, "hexahedron"),
        ("tetra", 2, "hexahedron20"),
        ("tetra10", 1, "hexahedron"),
        ("wedge15", 2, "hexahedron20"),
        ("pyramid", 1, "hexahedron"),
    ],
)
def test_a_bar_takes_hexahedra_of_both_orders(cell, order, made):
    resolutions = laboratory(soft(cell)).resolutions
    assert resolutions.families == ("hexahedron",)
    bodies = resolutions.bodies(Fraction(2), order, "hexahedron")
    assert mesh_words(bodies["bar"]) == f"8x2x2 {made}"


def test_a_split_of_tetrahedra_does_not_go_to_hexahedra():
    resolutions = laboratory(soft(split="five")).resolutions
    bar = resolutions.bodies(ONE, 2, "hexahedron")["bar"].mesh
    assert (bar.cell, bar.split) == ("hexahedron20", "six")
    assert resolutions.bodies(ONE, 2)["bar"].mesh.split == "five"


def test_hexahedra_and_files_have_no_richer_family(tmp_path):
    assert laboratory(soft("hexahedron")).resolutions.families == ()
    ts.write_mesh(ts.bar_mesh(size=(0.2, 0.05, 0.05), cells=(2, 1, 1)), tmp_path / "bar.vtu")
    scene = soft()
    body = scene.bodies["bar"].replace(mesh=ts.MeshFile(tmp_path / "bar.vtu"))
    resolutions = laboratory(scene.replace(bodies={"bar": body})).resolutions
    assert resolutions.families == ()
    assert resolutions.bodies(ONE, 1, "hexahedron") is None


def choices_of(lab, finest):
    return Choices(lab, Goal(0.01, False, 1.0, dynamic=False), finest)


def test_second_order_and_hexahedra_are_tried_beyond_the_order_of_the_reference():
    lab = laboratory(soft())
    own = own_setting(lab)
    choices = choices_of(lab, own)  # the reference: cells of first order
    assert any(o.order == 2 and o.scale == 1 for o in choices.of("order", own))
    families = {(o.family, o.order) for o in choices.of("family", own)}
    assert {("hexahedron", 1), ("hexahedron", 2)} <= families


def test_of_a_file_that_locks_second_order_and_mean_dilatation_are_tried(tmp_path):
    ts.write_mesh(ts.bar_mesh(size=(0.2, 0.05, 0.05), cells=(2, 1, 1)), tmp_path / "bar.vtu")
    scene = soft()
    body = scene.bodies["bar"].replace(mesh=ts.MeshFile(tmp_path / "bar.vtu"))
    lab = laboratory(scene.replace(bodies={"bar": body}))
    own = own_setting(lab)
    choices = choices_of(lab, own)
    assert [o.order for o in choices.of("order", own)] == [2]
    assert [o.model for o in choices.of("model", own)][:1] == ["mean_dilatation"]


def reference_of(scene, enough):
    lab = laboratory(scene)
    own = lab.run(own_setting(lab), allowance=1e3)
    lab.end -= 1e3 - 20.0
    return find_reference(lab, own, share=0.2, enough=enough)


def test_a_reference_that_is_not_enough_has_richer_cells_tried():
    asked: list[Reference] = []

    def enough(found):
        asked.append(found)
        return False

    reference_of(soft(cells=(2, 1, 1), poisson=0.3), enough)
    assert [found.tried.setting.family for found in asked] == ["", "hexahedron"]
    assert asked[1].tried.setting.order == 2


def test_a_reference_that_is_enough_has_no_other_cells_tried():
    found = reference_of(soft(cells=(2, 1, 1), poisson=0.3), lambda reference: True)
    assert found.tried.setting.family == ""


def test_an_error_is_not_refused_before_hexahedra_of_second_order_ran():
    advice = ts.advise(soft(cells=(2, 1, 1)), 1e-9, 1e-3, budget=6)
    assert advice.chosen is None
    ran = {row.mesh.split()[1] for row in advice.rows if row.outcome == "finished"}
    assert {"tetra", "tetra10", "hexahedron20"} <= ran


def test_a_reference_of_first_order_does_not_lock(monkeypatch):
    """Where no cells of second order are affordable, it bends as they do (nu 0.49: fem a third)."""

    def tip(scene):
        simulation = scene.compile()
        for _ in simulation.run():
            pass
        return -simulation.displacements("bar")[:, 2].min()

    with monkeypatch.context() as patch:
        all_bodies = Resolutions.bodies
        patch.setattr(
            Resolutions,
            "bodies",
            lambda self, scale, order, family="": (
                all_bodies(self, scale, order, family) if order == 1 else None
            ),
        )
        found = reference_of(soft(cells=(8, 2, 2)), lambda reference: True).tried
    truth = tip(soft("hexahedron20", cells=(8, 2, 2)))
    assert found.setting.order == 1
    assert tip(soft(cells=(8, 2, 2))) < 0.45 * truth
    assert tip(found.scene) == pytest.approx(truth, rel=0.25)
