"""Every hard case, run as its file has it, with a stated numeric outcome."""

from __future__ import annotations

import numpy as np
import pytest
from outcome import Outcome, case, names, outcome

import tissu as ts


@pytest.fixture(scope="module")
def found() -> dict[str, Outcome]:
    """Outcomes by case, each run once."""
    return {}


def of(name: str, found: dict[str, Outcome]) -> Outcome:
    if name not in found:
        found[name] = outcome(case(name))
    return found[name]
