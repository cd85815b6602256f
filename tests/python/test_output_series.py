"""The files of a run: complete, readable, and saying what the simulation says."""

import json
import os
import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np
import pytest

import tissu
from tissu.errors import TissuError
from tissu.files import file_name, whole_file
from tissu.output import Series, StepTally, prepare_folder, summarise, write_summary


def make(cell="tetra", name="two bars"):
    bodies = {
        body: tissu.Body(
            mesh=tissu.bar_mesh(
                size=(0.1, 0.02, 0.02), cells=(4, 1, 1), cell=cell, origin=(0, y, 0)
            ),
            law=tissu.StVK(young=1e4, poisson=0.3),
            density=1000.0,
        )
        for body, y in (("left", 0.0), ("right/hand", 0.1))
    }
    held = tissu.Box((-0.01, None, None), (1e-6, None, None))
    return tissu.Scene(
        name=name,
        bodies=bodies,
        gravity=(0, 0, -9.81),
        fixed=[tissu.Fixed(body, on=held) for body in bodies],
        step=tissu.ImplicitEuler(dt=0.01),
        duration=0.05,
    ).compile()


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_frames_hold_the_state(tmp_path, cell):
    simulation = make(cell)
    series = Series(simulation, tmp_path)
    series.write()
    for _ in simulation.run(0.03):
        series.write()
    sets = ElementTree.parse(series.index).getroot().findall("./Collection/DataSet")
    assert len(sets) == 8
    times = [float(s.get("timestep")) for s in sets]
    assert times == pytest.approx(np.repeat([0, 0.01, 0.02, 0.03], 2))
    assert {s.get("name") for s in sets} == {"left", "right/hand"}
    last = meshio.read(tmp_path / sets[-2].get("file"))
    mesh = simulation.meshes["left"]
    moved = last.point_data["displacement"]
    assert last.points == pytest.approx(np.array(simulation.positions["left"]))
    assert last.points - moved == pytest.approx(mesh.points)
    assert np.abs(moved).max() > 1e-4
    assert last.point_data["velocity"] == pytest.approx(np.array(simulation.velocities["left"]))
    assert last.cells[0].type == cell
    assert np.array_equal(last.cells[0].data, mesh.volume_blocks[0].nodes)
    fields = simulation.cell_fields("left")
    assert last.cell_data["von_mises"][0] == pytest.approx(fields["von_mises"])
    assert last.cell_data["strain_energy_density"][0] == pytest.approx(fields["energy_density"])
    assert last.cell_data["von_mises"][0].max() > 0


def test_a_new_series_takes_the_old_frames_away_and_nothing_else(tmp_path):
    simulation = make()
    series = Series(simulation, tmp_path)
    series.write()
    (tmp_path / "frames" / "mine.vtu").write_text("mine")
    (tmp_path / "mine.png").write_text("mine")
    picture = series.index.with_suffix(".png")
    picture.write_text("of the run before")
    Series(simulation, tmp_path)
    assert not picture.exists() and (tmp_path / "mine.png").exists()
    assert [p.name for p in (tmp_path / "frames").iterdir()] == ["mine.vtu"]
    assert not series.index.exists()


def test_a_file_is_whole_or_absent(tmp_path):
    path = tmp_path / "a.txt"
    with pytest.raises(KeyboardInterrupt), whole_file(path) as partial:
        partial.write_text("half")
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []
    with whole_file(path) as partial:
        partial.write_text("all")
        assert not path.exists()
    assert path.read_text() == "all"


def test_a_file_that_cannot_be_written_is_one_sentence(tmp_path):
    with (
        pytest.raises(TissuError, match=r"a\.txt: cannot be written"),
        whole_file(tmp_path / "absent" / "a.txt") as partial,
    ):
        partial.write_text("x")


def test_folder_is_refused_before_the_run(tmp_path):
    assert prepare_folder(tmp_path / "a" / "b").is_dir()
    (tmp_path / "file").write_text("")
    with pytest.raises(TissuError, match="it is a file, a folder is accepted"):
        prepare_folder(tmp_path / "file")
    with pytest.raises(TissuError, match="cannot be written"):
        prepare_folder(tmp_path / "file" / "sub")
    if os.geteuid() != 0:
        (tmp_path / "closed").mkdir(mode=0o500)
        with pytest.raises(TissuError, match="cannot be written"):
            prepare_folder(tmp_path / "closed")


def test_names_become_file_names():
    assert file_name("right/hand") == "right_hand"
    assert file_name("../..") == "scene"


def test_summary_says_what_was_run(tmp_path):
    simulation, tally = make(), StepTally()
    for step in simulation.run(0.03):
        tally.add(step)
    summary = summarise(
        simulation,
        tally=tally,
        status="finished",
        wall_seconds={"steps": 0.1, "picture": float("nan")},
        files={"series": "two_bars.pvd"},
        notes=["a note"],
    )
    write_summary(tmp_path / "summary.json", summary)
    read = json.loads((tmp_path / "summary.json").read_text())
    assert read["status"] == "finished"
    assert read["tissu"] == tissu.__version__
    assert read["instruction_set"]
    assert read["meshes"]["left"]["cells"] == {"tetra": 24}
    assert read["meshes"]["left"]["volume_m3"] == pytest.approx(4e-5)
    assert read["steps"]["steps"] == 3
    assert read["steps"]["unconverged"] == 0
    assert read["simulated_seconds"] == pytest.approx(0.03)
    assert read["energy_joules"]["total"] == pytest.approx(simulation.energy()["total"])
    assert read["scene"]["step"]["dt"] == pytest.approx(0.01)
    assert read["timings"]
    assert read["notes"][-1] == "a note"
    assert read["wall_seconds"] == {"steps": 0.1, "picture": None}


def test_the_volume_of_a_cut_body_is_that_of_its_material():
    bar = tissu.Body(
        mesh=tissu.BarMesh(size=(0.1, 0.02, 0.02), cells=(5, 2, 2)),
        law=tissu.StVK(young="10 kPa", poisson=0.3),
        density=1000.0,
    )
    simulation = tissu.Scene(
        bodies={"bar": bar}, editing=True, step=tissu.ImplicitEuler("10 ms")
    ).compile()
    simulation.cut("bar", tissu.Plane((0.05, 0, 0), (1, 0, 0)))
    assert simulation.meshes["bar"].volume() > 4.1e-5  # copies overlap
    data = summarise(
        simulation, tally=StepTally(), status="finished", wall_seconds={}, files={}, notes=[]
    )["meshes"]["bar"]
    assert data["volume_m3"] == pytest.approx(4e-5, rel=1e-12)
    assert data["surface_triangles"] == len(simulation.surface("bar").triangles)
