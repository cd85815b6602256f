"""Checkpoints with a right digest that tissu did not write: a digest is easy to compute."""

import hashlib
import io
import zipfile

import numpy as np
import pytest

import tissu as ts
from tissu.checkpoint.archive import pack, unpack
from tissu.errors import CheckpointError


def made(step=None):
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)),
        law=ts.StVK(young=1e4, poisson=0.3),
        density=1e3,
    )
    left = ts.Box((None, None, None), (1e-6, None, None))
    return ts.Scene(
        bodies={"bar": bar},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=left)],
        step=step or ts.ImplicitEuler(0.01),
        editing=True,
    )


def contents(tmp_path, step=None):
    simulation = made(step).compile()
    simulation.step()
    simulation.remove_cells(body="bar", cells=[11])
    simulation.step()
    simulation.save_checkpoint(tmp_path / "whole")
    return unpack((tmp_path / "whole").read_bytes())


def refusal(tmp_path, data, step=None):
    (tmp_path / "forged").write_bytes(data)
    with pytest.raises(CheckpointError) as refused:
        made(step).compile(checkpoint=tmp_path / "forged")
    assert str(refused.value).startswith(f"checkpoint {tmp_path / 'forged'}: ")
    assert "\n" not in str(refused.value)
    return str(refused.value)


def test_each_entry_that_is_absent_or_of_another_kind(tmp_path):
    header, arrays = contents(tmp_path)
    assert made().compile(checkpoint=tmp_path / "whole").time == pytest.approx(0.02)
    for name in header:
        rest = {key: value for key, value in header.items() if key != name}
        refusal(tmp_path, pack(rest, arrays))
        for odd in (None, [], "x", 1.5, -(10**30), {}):
            if odd != header[name] and not (name == "scene" and odd == "x"):
                if name in ("build", "physics", "snapshot") and odd == {}:
                    continue
                refusal(tmp_path, pack({**header, name: odd}, arrays))
    for name in header["snapshot"]:
        rest = {key: value for key, value in header["snapshot"].items() if key != name}
        if not name.startswith("body_"):
            refusal(tmp_path, pack({**header, "snapshot": rest}, arrays))
        for odd in (None, [], "x", {"a": 1}):
            refusal(tmp_path, pack({**header, "snapshot": {**rest, name: odd}}, arrays))
    for name, values in arrays.items():
        rest = {key: value for key, value in arrays.items() if key != name}
        refusal(tmp_path, pack(header, rest))
        longer = np.concatenate([values.ravel(), np.ones(7, dtype=values.dtype)])
        for odd in (values.astype(np.float32), longer, np.array(["x"]), np.full(3, np.nan)):
            if name in ("integrator", "rotations") and odd.size == values.size:
                continue
            if name.startswith(("cells", "loose")) and odd is longer:
                longer[-7:] = 10**6  # no such cells and nodes
            if name == "integrator" and odd.dtype == np.float64:
                continue  # implicit Euler keeps nothing, and looks at nothing
            refusal(tmp_path, pack(header, {**rest, name: odd}))


@pytest.mark.parametrize("step", [ts.BDF2(0.01), ts.Newmark(0.01)], ids=["bdf2", "newmark"])
def test_what_an_integrator_keeps_has_its_length(tmp_path, step):
    header, arrays = contents(tmp_path, step)
    for kept in (arrays["integrator"][:-1], np.ones(1), np.ones(10**6)):
        said = refusal(tmp_path, pack(header, {**arrays, "integrator": kept}), step)
        assert "numbers of the integrator" in said


def test_a_memory_that_the_world_does_not_have(tmp_path):
    header, arrays = contents(tmp_path)
    for memory, sizes in (([1.0] * 11, [11]), ([], [0]), ([1.0], []), ([], [-1]), ([1.0], [2])):
        odd = {
            "memory": np.array(memory, dtype=float),
            "memory_sizes": np.array(sizes, dtype=np.int32),
        }
        assert "remember" in refusal(tmp_path, pack(header, {**arrays, **odd}))


def signed(data):
    """An archive of one's own with the digest that makes it whole."""
    body = data[:-64]
    return body + hashlib.sha256(body).hexdigest().encode()


def archive(members, compression=zipfile.ZIP_STORED):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", compression) as file:
        file.comment = b"0" * 64
        for name, data in members.items():
            file.writestr(name, data)
    return signed(buffer.getvalue())


def test_archives_that_are_none_of_tissu(tmp_path):
    header = b'{"format": 1}'
    huge = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        huge, {"descr": "<f8", "fortran_order": False, "shape": (10**15,)}
    )
    pickled = io.BytesIO()
    np.lib.format.write_array(pickled, np.array([{}], dtype=object), allow_pickle=True)
    for data in (
        signed(b"x" * 100),
        signed(b"PK\x05\x06" + b"\0" * 200),
        archive({"header.json": header, "a.npy": huge.getvalue()}),
        archive({"header.json": header, "a.npy": pickled.getvalue()}),
        archive({"header.json": header, "a.npy": b"\0" * 10**8}, zipfile.ZIP_DEFLATED),
        archive({"header.json": b"[" * 100_000}),
        archive({"header.json": b"[1]"}),
        archive({"header.json": b"\xff"}),
        archive({"a.npy": b""}),
    ):
        assert "no checkpoint of tissu" in refusal(tmp_path, data)
