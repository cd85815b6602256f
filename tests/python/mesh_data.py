"""Where the real meshes and the reference data lie, for the tests of meshes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]


def shared(*parts: str) -> Path:
    """A file of the shared folder; the test is skipped when it is not there."""
    folder = Path(os.environ.get("TISSU_SHARED", _ROOT.parent / "shared"))
    path = folder.joinpath(*parts)
    if not path.exists():
        pytest.skip(f"{path} is not there; set TISSU_SHARED to the folder that holds it")
    return path
