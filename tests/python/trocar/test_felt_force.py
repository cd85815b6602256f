"""What a moving hand feels through a transmission with losses: bench/trocar_hand.py."""

import sys
from pathlib import Path

import numpy as np
import pytest

from tissu import _haptic

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "bench"))
from trocar_cases import CASES, COMPENSATED, LOSSES, Trial, outcome, with_losses
from trocar_hand import at_pose

POSE = (np.radians(20), np.radians(42), 0.2)


def felt(device):
    """Felt force over that of the contact, less one: while the hand goes in, and out."""
    contact, hand, speeds = at_pose(POSE, device, moves=True)
    size = np.linalg.norm(contact, axis=1)
    ratio = -np.einsum("ij,ij->i", hand, contact) / size**2 - 1.0
    return [
        float(ratio[w].mean()) for w in (speeds > 0.6 * speeds.max(), speeds < 0.6 * speeds.min())
    ]


def test_efficiency_and_friction_are_made_up_for_while_a_hand_palpates():
    """At some 20 mm/s the sense of the motion is known, and with it that of the losses.

    A fifth of the friction is left: it is 20 % of about 0.14 of the force. Blended over two counts
    a tick, that is 0.2 m/s, the hand felt half as much again on its way in.
    """
    bare = felt({"mechanism": LOSSES})
    assert bare[0] > 0.3
    inwards, outwards = felt({"mechanism": LOSSES, **COMPENSATED})
    assert abs(inwards) < 0.08
    assert abs(outwards) < 0.08


@pytest.mark.parametrize(
    "name", ["hand lets go in contact", "pushed between two walls", "end stop"]
)
def test_what_makes_up_for_losses_gives_out_no_more_than_its_bound(name):
    (case,) = [case for case in CASES if case[0] == name]
    with with_losses():
        _, given, bound, swing = outcome(*case[1:])
    assert 0.0 < given <= bound
    if name != "pushed between two walls":  # there the hand moves until 0.1 s before the end
        assert swing < 2.0  # counts: no limit cycle


@pytest.mark.parametrize("eta", [1.0, 0.7, 0.4])
def test_compensated_friction_is_the_same_share_whatever_the_efficiency(eta):
    """A motor that overcomes friction drives: 0.8 of 0.3 N take 0.24 N / eta of it."""
    fast, slow = np.array([1.0, 1.0, 1.0, 0.1]), np.full(4, 1e-3)
    for sign in (1.0, -1.0):
        motor = _haptic.motor_torques(
            tau=np.zeros(4),
            v=sign * fast,
            slow=slow,
            efficiency=(eta,) * 4,
            coulomb=(6e-3, 6e-3, 1e-3, 0.3),
            share=0.8,
        )
        assert motor == pytest.approx(sign * 0.8 / eta * np.array([6e-3, 6e-3, 1e-3, 0.3]))


def test_a_weight_beyond_the_motor_is_reported_as_limited():
    """A tool of 1 kg along the depth asks for 9.81 N of a motor of 5 N."""
    heavy = {"gravity": (0.0, 0.0, 9.81), "tool_mass": 1.0, "tool_centre": 0.15}
    rows = Trial(**heavy).run(0.05)
    assert rows["limited"][-1]
    assert not Trial(**{**heavy, "tool_mass": 0.3}).run(0.05)["limited"][-1]
