"""The file of a checkpoint: whole at every moment, checked to the last byte, refused in words."""

import errno
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from tissu.checkpoint import checkpoint as checkpoints
from tissu.checkpoint.archive import pack, unpack
from tissu.errors import CheckpointError


def made(**changes):
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)),
        law=ts.StVK(young=1e4, poisson=0.3),
        density=1e3,
    )
    left = ts.Box((None, None, None), (1e-6, None, None))
    fields = {
        "bodies": {"bar": bar},
        "gravity": (0, 0, -9.81),
        "fixed": [ts.Fixed("bar", on=left)],
        "step": ts.ImplicitEuler(0.01),
    }
    return ts.Scene(**{**fields, **changes})


BAR = made().bodies["bar"]


@pytest.fixture
def file(tmp_path):
    simulation = made().compile()
    simulation.step()
    simulation.save_checkpoint(tmp_path / "run.checkpoint")
    return tmp_path / "run.checkpoint"


def refusal(file, scene=None):
    with pytest.raises(CheckpointError) as refused:
        (scene or made()).compile(checkpoint=file)
    text = str(refused.value)
    assert text.startswith(f"checkpoint {file}: ")
    assert "\n" not in text
    return text


def test_a_kill_at_any_moment_leaves_the_one_before_or_the_new_one(tmp_path):
    killed = Path(__file__).with_name("checkpoint_killed.py")
    command = [sys.executable, str(killed), str(tmp_path), "60", "5"]
    told = json.loads(subprocess.run(command, capture_output=True, check=True, timeout=300).stdout)
    assert told["wrong"] == []
    # Some of these kills came while a file was being written, and in the span before its rename.
    assert told["halves"] >= 5
    assert told["before"] >= 5
    assert told["most"] <= 1  # what a killed process left was gone after the next write
    assert told["left"] == ["log", "run.checkpoint"]


def test_any_flipped_byte_and_any_cut_is_refused(file):
    data = file.read_bytes()
    places = {0, 1, 2, 3, 4, 10, *range(0, len(data), len(data) // 150), *range(-90, 0)}
    for place in places:
        flipped = bytearray(data)
        flipped[place] ^= 1 << (place % 8)
        file.write_bytes(flipped)
        assert "checksum" in refusal(file)
    for length in (0, 1, 63, 64, 65, len(data) // 2, len(data) - 64, len(data) - 1):
        file.write_bytes(data[:length])
        assert "cut short" in refusal(file)
    file.write_bytes(data + b"0")
    assert "checksum" in refusal(file)
    file.write_bytes(data)
    assert made().compile(checkpoint=file).time == 0.01


def test_numpy_opens_it_and_equal_states_are_equal_bytes(file, tmp_path):
    with np.load(file, allow_pickle=False) as members:
        assert members["positions"].shape == members["velocities"].shape == (12, 3)
        header = json.loads(members["header.json"])
    assert (header["format"], header["tissu"], header["steps"]) == (5, ts.__version__, 1)
    assert header["physics"]["bodies"]["bar"]["law"]["young"] == 1e4
    assert zipfile.ZipFile(file).testzip() is None
    made().compile(checkpoint=file).save_checkpoint(tmp_path / "again")
    assert (tmp_path / "again").read_bytes() == file.read_bytes()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"gravity": (0, 0, -1.0)}, "gravity is [0.0, 0.0, -9.81] there and [0.0, 0.0, -1.0] here"),
        ({"gravity": None}, "gravity is [0.0, 0.0, -9.81] there and absent here"),
        ({"step": ts.ImplicitEuler(0.02)}, "step.dt is 0.01 there and 0.02 here"),
        ({"editing": True}, "editing is absent there and given here"),
        (
            {"step": ts.ImplicitEuler(0.01, solver=ts.Cholesky())},
            "step.solver.type is auto there and cholesky here",
        ),
        ({"step": ts.Static()}, "step.type is implicit_euler there and static here"),
        (
            {"bodies": {"bar": BAR.replace(law=ts.StVK(young=2e4, poisson=0.3))}},
            "bodies.bar.law.young is 10000.0 there and 20000.0 here; go on with the scene",
        ),
        (
            {
                "bodies": {
                    "bar": BAR.replace(mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(3, 1, 1)))
                }
            },
            "bodies.bar.mesh is 12 nodes, 12 cells, digest",
        ),
        (
            {
                "bodies": {
                    "bar": BAR.replace(mesh=ts.BarMesh(size=(0.3, 0.1, 0.1), cells=(2, 1, 1)))
                }
            },
            "bodies.bar.mesh is 12 nodes, 12 cells, digest",
        ),
        ({"fixed": ()}, "fixed[0] is given there and absent here"),
        (
            {"loads": [ts.NodalLoad("bar", on=ts.Nodes([3]), force=(0, 0, 1))]},
            "loads[0] is absent there and nodal here",
        ),
    ],
)
def test_another_scene_is_refused_with_what_differs(file, changes, said):
    text = refusal(file, made(**changes))
    assert "another scene" in text
    assert said in text


def test_many_differences_are_counted(file):
    changes = {"gravity": None, "step": ts.ImplicitEuler(0.02), "editing": True}
    scene = made(bodies={"bar": BAR.replace(density=900.0)}, **changes)
    assert "0.02 here, and 1 more difference; go on" in refusal(file, scene)


def test_what_does_not_change_the_motion_may_differ(file):
    changes = {"name": "b", "threads": 2, "duration": 3.0, "output": ts.Output(every=0.1)}
    assert made(**changes).compile(checkpoint=file).time == 0.01


def test_a_mesh_from_a_file_is_known_by_its_cells(file, tmp_path):
    ts.write_mesh(made().compile().meshes["bar"], tmp_path / "bar.vtu")
    body = BAR.replace(mesh=ts.MeshFile(file=tmp_path / "bar.vtu"))
    read = made(bodies={"bar": body})
    read.compile().save_checkpoint(tmp_path / "from_file")
    (tmp_path / "bar.vtu").rename(tmp_path / "other.vtu")
    body = BAR.replace(mesh=ts.MeshFile(file=tmp_path / "other.vtu"))
    moved = made(bodies={"bar": body})
    assert moved.compile(checkpoint=tmp_path / "from_file").time == 0.0


def test_absent_files_and_folders(tmp_path):
    assert "there is no such file" in refusal(tmp_path / "absent")
    assert "found a folder; a regular file is accepted" in refusal(tmp_path)


def rewritten(file, **header):
    before, arrays = unpack(file.read_bytes())
    file.write_bytes(pack({**before, **header}, arrays))


def test_other_versions_are_refused_and_other_kernels_told(file):
    rewritten(file, tissu="7.5.1")
    assert "format 5 of tissu 7.5.1; format 5 of tissu" in refusal(file)
    rewritten(file, tissu=ts.__version__, format=9)
    assert "it has format 9" in refusal(file)
    rewritten(file, format=5, build={**checkpoints.build(), "instruction_set": "mmx"})
    told = made().compile(checkpoint=file).resumed_from.note
    assert "mmx" in told
    assert "not with the same bits" in told


def test_a_write_that_fails_leaves_the_one_before(file, monkeypatch):
    before = file.read_bytes()
    simulation = made().compile(checkpoint=file)
    simulation.step()

    def full(descriptor):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(CheckpointError, match=r"cannot be written \(No space left on device\)"):
        simulation.save_checkpoint(file)
    assert file.read_bytes() == before
    assert [p.name for p in file.parent.iterdir()] == [file.name]


def test_places_that_cannot_be_written(tmp_path):
    simulation = made().compile()
    for place in (tmp_path / "absent" / "a", tmp_path):
        with pytest.raises(CheckpointError, match="cannot be written"):
            simulation.save_checkpoint(place)
    assert list(tmp_path.iterdir()) == []


def test_a_link_is_followed_and_other_files_are_left_alone(file, tmp_path):
    link = tmp_path / "latest"
    link.symlink_to(file)
    mine = tmp_path / ".run.checkpoint.mine.partial"
    mine.write_text("mine")
    living = tmp_path / f".run.checkpoint.{os.getppid()}.partial"
    living.write_text("of a process that runs")
    dead = tmp_path / ".run.checkpoint.999999999.partial"
    dead.write_text("of one that does not")
    simulation = made().compile(checkpoint=link)
    simulation.step()
    simulation.save_checkpoint(link)
    assert link.is_symlink()
    assert made().compile(checkpoint=file).time == 0.02
    assert mine.exists()
    assert living.exists()
    assert not dead.exists()
