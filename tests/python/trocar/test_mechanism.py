"""Mechanism, gravity, efficiency, compensation and damping of a scene's trocar are simulated."""

import numpy as np
import pytest

import tissu as ts
from tissu import _haptic
from tissu.cli.trocar import _words_of
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel
from tissu.trocar.opened import open_device
from tissu.trocar.settings import settings_of

HELD = ts.Hand(times=(0.0, 1.0), points=((0, 0, 0.15), (0, 0, 0.15)))
DOWN = (0.0, 0.0, -9.81)
ETA = (0.9, 0.8, 0.95, 0.7)


def trocar(axis=(0, 0, -1), compensation=None, gravity=None, coupling="automatic", **device):
    """A trocar whose axis points down, with a hand that stays 15 cm deep."""
    return ts.Trocar(
        port=ts.Port((0, 0, 0), axis),
        device=ts.SimulatedDevice(**{"hand": HELD, **device}),
        gravity=gravity,
        coupling=coupling,
        compensation=compensation or ts.TrocarCompensation(),
    )


def sag(**given):
    """How much deeper than the hand's path the tool comes to rest [m]."""
    with Controller(trocar(**given)) as controller:
        controller.step(2000)
        return controller.device.joints[3] - 0.15


def test_a_heavier_tool_sags_unless_the_motors_carry_it():
    """By m g / k of the hand's spring, up to what Coulomb friction holds."""
    friction = 0.01
    light = ts.TrocarMechanism(mass="120 g", friction=(6e-3, 6e-3, 1e-3, friction))
    heavy = light.replace(mass="300 g")
    coupling = ts.Coupling((1.0, 1.0, 0.1, 100.0))
    common = {"gravity": DOWN, "coupling": coupling}
    for mechanism in (light, heavy):
        weight = mechanism.mass * 9.81
        found = sag(mechanism=mechanism, **common)
        assert found == pytest.approx(weight / HELD.stiffness, abs=1.1 * friction / HELD.stiffness)
        carried = ts.TrocarCompensation(mass=mechanism.mass)
        # 12 bits of 5 N are 2.4 mN
        found = sag(mechanism=mechanism, compensation=carried, **common)
        assert abs(found) < 1.5 * friction / HELD.stiffness
    assert sag(mechanism=heavy, coupling=coupling) == pytest.approx(0.0, abs=1e-5)


def test_gravity_turns_into_the_axes_of_the_port():
    settings = settings_of(trocar(axis=(1, 0, 0), gravity=DOWN))
    assert np.linalg.norm(settings.gravity) == pytest.approx(9.81)
    assert settings.gravity[2] == pytest.approx(0.0, abs=1e-12)
    assert settings_of(trocar(gravity=DOWN)).gravity == pytest.approx([0, 0, 9.81])
    assert settings_of(trocar()).gravity == pytest.approx([0, 0, 0])


def pressed(times, depths, **device):
    """Columns of the ticks of a hand that presses the tool along its axis on a wall 12 cm deep."""
    hand = ts.Hand(times=times, points=[(0, 0, depth) for depth in depths])
    with Controller(trocar(hand=hand, **device)) as controller:
        wall = LocalModel.plane(
            (0, 0, 0, 0.12), through=(0, 0, 0.12), normal=(0, 0, -1), stiffness=60.0
        )
        rows = []
        for _ in range(round(1000 * times[-1] / 40)):
            controller.publish(wall)
            controller.step(40)
            rows.append(controller.records())
    return {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def test_the_motor_gives_the_torque_times_or_over_the_efficiency():
    """The hand drives while it presses: tau eta. The motor drives while it yields: tau / eta."""
    for eta in (1.0, 0.7):
        efficiency = (1.0, 1.0, 1.0, eta)
        found = pressed((0.0, 0.5, 0.65, 0.8), (0.1, 0.1, 0.16, 0.1), efficiency=efficiency)
        speed = np.gradient(np.convolve(found["q"][:, 3], np.ones(11) / 11, "same"), 1e-3)
        tau, motor = found["torque"][:, 3], found["command"][:, 3]
        fast = (tau < -0.5) & (np.abs(speed) > 0.25)  # slower than 0.2 m/s the two are blended
        for way, factor in ((1.0, eta), (-1.0, 1.0 / eta)):
            on = fast & (way * speed > 0.0)
            assert on.sum() > 20
            assert motor[on] / tau[on] == pytest.approx(factor, rel=0.02)


def test_the_law_s_command_has_the_efficiency_of_the_scene():
    settings = settings_of(trocar(efficiency=ETA))
    fast = np.array([1.0, 1.0, 10.0, 1.0])
    tau = np.array([0.2, 0.2, 0.01, 2.0])
    slow = np.full(4, 1e-3)
    for sign in (1.0, -1.0):
        motor = _haptic.motor_torques(
            tau=tau,
            v=sign * fast,
            slow=slow,
            efficiency=settings.efficiency,
            coulomb=settings.compensated,
            share=0.0,
        )
        assert motor == pytest.approx(tau / np.array(ETA) ** sign)


def test_compensated_friction_is_the_share_of_the_device_s():
    friction = (7e-3, 8e-3, 2e-3, 0.4)
    made = trocar(
        mechanism=ts.TrocarMechanism(friction=friction),
        compensation=ts.TrocarCompensation(friction="80 %"),
    )
    settings = settings_of(made)
    assert settings.compensation == 0.8
    assert settings.compensated == pytest.approx(friction)
    assert settings.coulomb == pytest.approx(friction)


def test_damping_of_the_mechanism_bounds_the_coupling():
    plain, damped = trocar(), trocar(mechanism=ts.TrocarMechanism(damping=(0.06, 0.03, 1e-3, 1.0)))
    assert damped.stiffness()[0] == pytest.approx(min(2 * plain.stiffness()[0], 55.004), rel=1e-3)
    assert damped.stiffness()[1:] == plain.stiffness()[1:]


def test_a_tool_falls_to_the_mechanical_end_of_the_depth():
    """The end is a spring: the tool's weight goes 24 um into it."""
    mechanism = ts.TrocarMechanism(depth="25 cm", friction=(6e-3, 6e-3, 1e-3, 0.01))
    given = trocar(gravity=DOWN, hand=None, mechanism=mechanism)
    device = open_device(given, 1)
    for _ in range(3000):
        _haptic.read(device)
    assert device.joints[3] == pytest.approx(0.25, abs=1e-4)
    assert settings_of(given).end_high[3] == 0.25


def test_rollers_that_slip_are_not_seen_by_an_encoder_on_the_motor():
    drift = {}
    for encoder in ("tool", "motor"):
        mechanism = ts.TrocarMechanism(roller_force="0.2 N", encoder=encoder)
        hand = ts.Hand(times=(0.0, 0.2, 0.6), points=((0, 0, 0.1), (0, 0, 0.1), (0, 0, 0.14)))
        device = open_device(trocar(hand=hand, mechanism=mechanism), 1)
        for _ in range(900):
            _, sample = _haptic.read(device)
            _haptic.write(device, [0, 0, 0, -3.0, 0])
        drift[encoder] = abs(sample["counts"][3] * 1e-4 - device.joints[3])
    assert drift["tool"] <= 1e-4
    assert drift["motor"] > 1e-2


def test_virtual_damping_arrives_and_is_bounded_by_what_the_stiffness_leaves():
    coupling = ts.Coupling((20.0, 20.0, 0.5, 500.0), damping=(0.01, 0.01, 1e-4, "0.5 N s/m"))
    assert settings_of(trocar(coupling=coupling)).damping == pytest.approx([0.01, 0.01, 1e-4, 0.5])
    with pytest.raises(ts.SceneError, match=r"coupling.damping\[3\]: found 0.9 N s/m on depth; at"):
        trocar(coupling=ts.Coupling((20.0, 20.0, 0.5, 500.0), damping=(0, 0, 0, 0.9)))


def test_virtual_damping_brakes_a_free_tool():
    speeds = {}
    for damping in (0.0, 0.7):
        coupling = ts.Coupling((20.0, 20.0, 0.5, 500.0), damping=(0, 0, 0, damping))
        light = ts.TrocarMechanism(friction=(6e-3, 6e-3, 1e-3, 0.04))
        given = trocar(coupling=coupling, hand=None, mechanism=light)
        with Controller(given) as controller:
            controller.step(500)
            controller.device.push([0, 0, 0, 0.1], [0, 0, 0, 0.5])
            controller.step(100)
            speeds[damping] = controller.device.rates[3]
    # exp(-b t / m) with m = 0.17 kg, b = 1 and 1.7 N s/m, t = 0.1 s
    assert speeds[0.7] / speeds[0.0] == pytest.approx(np.exp(-0.7 * 0.1 / 0.17), rel=0.1)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: trocar(efficiency=(1, 1, 1, 1.2)), "depth: found 1.2; one of at most 1 is"),
        (lambda: trocar(efficiency=(1, 1, 1, 0)), "depth: found 0; one of at least 0.01 is"),
        (lambda: ts.TrocarMechanism(mass="0 g"), "mass"),
        (lambda: ts.TrocarMechanism(cradle=(1, 1, 1)), "four numbers are accepted"),
        (lambda: ts.TrocarMechanism(friction=(1, 1, 0, 1)), "rotation: found 0 N m; one above 0"),
        (lambda: ts.TrocarMechanism(encoder="both"), "encoder"),
        (lambda: ts.TrocarCompensation(friction=0.9), "friction"),
        (
            lambda: trocar(compensation=ts.TrocarCompensation(mass="0.1 kg")),
            "compensation.mass: found 0.1 kg without gravity; `gravity` of the trocar",
        ),
        (
            lambda: ts.Trocar(
                port=ts.Port((0, 0, 0), (0, 0, -1)),
                device=ts.UdpDevice("127.0.0.1", 7001),
                coupling=ts.Coupling((1, 1, 1, 1)),
                compensation=ts.TrocarCompensation(friction=0.5),
            ),
            "compensation.friction: found 0.5 of a friction that is not known",
        ),
    ],
)
def test_bad_input_is_refused_in_one_sentence(make, said):
    with pytest.raises(ts.SceneError) as refused:
        make()
    assert len(refused.value.problems) == 1
    assert said in str(refused.value)


def test_check_says_what_pulls_at_the_tool_and_what_is_carried():
    given = trocar(
        gravity=DOWN,
        efficiency=ETA,
        compensation=ts.TrocarCompensation(mass="120 g", friction="50 %"),
    )
    said = "\n".join(_words_of(given))
    for part in ("gravity (0, 0, -9.81)", "0.12 kg carried", "efficiency 0.9, 0.8", "50% of the"):
        assert part in said
    assert part in given.effect("right").why
