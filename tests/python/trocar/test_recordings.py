"""Recordings that are damaged: refused in one sentence, never taken for others."""

import numpy as np
import pytest
from test_controller import trocar

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel
from tissu.trocar.recording import Recording


def _recorded(path):
    """The arrays of a short recording."""
    controller = Controller(trocar(), record=True)
    with controller:
        report = controller.step(400)
        through = (0, 0, 0.11)
        wall = LocalModel.plane(report.q, through=through, normal=(0, 0, -1), stiffness=500.0)
        controller.publish(wall)
        controller.step(50)
    controller.recording().save(path)
    return dict(np.load(path))


def test_damaged_recordings_are_refused_in_one_sentence(tmp_path):
    """Each array that is missing, too short or of text; none ends in another error."""
    path = tmp_path / "ticks.npz"
    whole = _recorded(path)
    for name, array in whole.items():
        if name.startswith("settings/0/") and name != "settings/0/stiffness":
            continue  # one stands for all
        texts = np.array("text")
        for changed in (None, texts, *([array[:-1]] if array.ndim and len(array) else [])):
            arrays = {**whole, name: changed} if changed is not None else dict(whole)
            if changed is None:
                del arrays[name]
            np.savez(path, **arrays)
            with pytest.raises(ts.ParameterError) as refused:
                recording = Recording.read(path)
                recording.replay()
                raise AssertionError(f"{name} was taken as {changed}")
            assert "\n" not in str(refused.value)
    for change in ("tick/settings", "tick/offered"):  # what is named is not there
        np.savez(path, **{**whole, change: whole[change] + np.asarray(9, whole[change].dtype)})
        with pytest.raises(ts.ParameterError, match="a tick names"):
            Recording.read(path)


def test_flipped_bytes_never_pass_as_other_ticks(tmp_path):
    """A file with a flipped byte is refused, or holds what was recorded."""
    path = tmp_path / "ticks.npz"
    whole = _recorded(path)
    data, random = path.read_bytes(), np.random.default_rng(3)
    refused = 0
    for place in random.integers(0, len(data), 60):
        changed = bytearray(data)
        changed[place] ^= int(random.integers(1, 256))
        path.write_bytes(changed)
        try:
            found = Recording.read(path)
        except ts.ParameterError:
            refused += 1
            continue
        for name, column in found.columns.items():
            assert np.array_equal(column, whole[f"tick/{name}"])
    assert refused > 30
