"""What the folder of a trocar tells its user to do names the buttons of the page."""

from types import SimpleNamespace

import pytest

from tissu.live_view.trocars.panel import _CURES, sentence_of
from tissu.trocar.states import Reason

FAULTS = (Reason.reads_failed, Reason.writes_failed, Reason.device_fault, Reason.not_finite)


@pytest.mark.parametrize("reason", FAULTS)
def test_a_fault_is_ended_by_the_button_of_the_page(reason):
    for hand in ("scene", "browser", "device"):
        said = sentence_of(SimpleNamespace(hand=hand, problem=reason.words))
        assert f"press '{_CURES['fault']}'" in said
        assert "start it again" not in said
        assert ("let go of the handle" in said) == (hand == "device")


@pytest.mark.parametrize("reason", [Reason.too_fast, Reason.late])
def test_a_held_trocar_goes_on_by_the_button_of_the_page(reason):
    said = sentence_of(SimpleNamespace(hand="scene", problem=reason.words))
    assert f"press '{_CURES['held']}' when the " in said
    assert "acknowledge" not in said
