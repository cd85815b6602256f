"""Trocars of a scene: read, written, checked; what is refused; absent ones cost nothing."""

import json
import subprocess
import sys

import numpy as np
import pytest

import tissu as ts
from tissu import _haptic
from tissu.scene.schema import scene_schema
from tissu.scene.trocar.passive import passive_bound
from tissu.scene.trocar.trocar import LONGEST_STEP

HEAD = """
bodies:
  bar:
    mesh: {type: bar, size: [2 cm, 1 cm, 1 cm], cells: [2, 1, 1]}
    law: {type: stvk, young: 3 kPa, poisson: 0.3}
    density: 1000
obstacles: {probe: {type: sphere, center: [0, 0, 5 cm], radius: 2 mm}}
contacts: [{between: [bar, probe]}]
step: {type: implicit_euler, dt: 10 ms}
trocars:
"""
RIGHT = """
  right:
    port: {at: [6 cm, -9 cm, 12 cm], axis: [-0.3, 0.4, -0.9]}
    device: {type: simulated, hand: {times: [0, 1], points: [[0, 0, 0.1], [0, 0, 0.12]]}}
    tools: {0x51A0: probe}
    rate: 1 kHz
    limits: {force: 4 N, torque: 5 N m, speed: 1 m/s, tilt: 40 deg}
"""


def problems(text, base=None):
    try:
        return ts.Scene.from_yaml_text(HEAD + text, base=base).check().problems
    except ts.SceneError as refused:
        return refused.problems


def test_a_trocar_is_read_and_written():
    scene = ts.Scene.from_yaml_text(HEAD + RIGHT)
    made = scene.trocars["right"]
    assert made.rate == 1000.0
    assert made.tools == {"0x51A0": "probe"}
    assert made.limits.torques() == (5.0, 5.0, 0.2, 4.0)
    assert made.limits.tilt == pytest.approx(np.radians(40))
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
    check = scene.check()
    assert check.ok
    assert "haptics" not in check.absent
    effect = next(str(effect) for effect in check.effects if effect.name == "trocar right")
    assert "a simulated device, a hand along 2 points" in effect
    assert "48, 48, 1.6, 1600 N m/rad and N/m" in effect


def test_a_trocar_is_made_in_python():
    made = ts.Trocar(
        port=ts.Port((0, 0, 0), (0, 0, -1)),
        device=ts.UdpDevice("192.168.1.20", 7001, damping=[1, 1, "1 N m s", 2], friction=[1] * 4),
        tools={0x10: "probe"},
        coupling=ts.Coupling([1, 1, "0.2 N m/rad", "300 N/m"]),
    )
    assert made.stiffness() == (1.0, 1.0, 0.2, 300.0)
    assert made.device.dissipation() == ((1, 1, 1, 2), (1, 1, 1, 1))


def test_automatic_gains_are_those_of_the_design():
    """48 N m/rad, 1.6 N m/rad, 1,600 N/m; a delay of 1 ms a third; of 5 ms 4.4, 0.15, 145."""
    expected = {0: (48.0, 1.6, 1600.0), 1: (16.0, 0.533, 533.0), 5: (4.36, 0.145, 145.0)}
    for delay, values in expected.items():
        device = ts.SimulatedDevice(delay=delay * 1e-3)
        made = ts.Trocar(port=ts.Port((0, 0, 0), (0, 0, 1)), device=device)
        pitch, roll, rotation, depth = made.stiffness()
        assert pitch == roll
        assert (pitch, rotation, depth) == pytest.approx(values, rel=4e-3)


def test_the_passive_bound_is_the_smaller_of_both():
    by_damping = passive_bound(1.0, 10.0, 1e-4, 1e-3, 0.0)
    assert by_damping.stiffness == pytest.approx(2000.0)  # 2 b / T
    assert "Colgate" in by_damping.why
    by_friction = passive_bound(1.0, 0.05, 1e-4, 1e-3, 0.0)
    assert by_friction.stiffness == pytest.approx(1000.0)  # 2 f_c / Delta
    assert "Abbott" in by_friction.why


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("rate: 1 kHz", "rate: 299 Hz", "right.rate: found 299 Hz; 300 Hz to 10 kHz"),
        ("rate: 1 kHz", "rate: 11 kHz", "found 11000 Hz; 300 Hz to 10 kHz"),
        ("rate: 1 kHz", "coupling: {stiffness: [61, 48, 1, 1]}", "above the passive bound of 60 "),
        ("rate: 1 kHz", "coupling: {stiffness: [48, 48, 1, 0]}", "depth: found 0 N/m"),
        ("rate: 1 kHz", "coupling: {stiffness: 48}", "four numbers are accepted"),
        ("rate: 1 kHz", "coupling: strong", "automatic is accepted"),
        ("0x51A0: probe", "0x51A0: prob", "no obstacle or instrument is named 'prob'; did you"),
        ("0x51A0: probe", "probe: probe", "the number of a tag is accepted"),
        ("0x51A0: probe", "0x51A0: probe, 20896: probe", "found the tag 0x51A0 twice"),
        ("axis: [-0.3, 0.4, -0.9]", "axis: [0, 0, 0]", "a direction into the body is accepted"),
        ("tilt: 40 deg", "tilt: 80 deg", "tilt"),
        ("tilt: 40 deg", "depth: 1 cm", "a depth above the least one is accepted"),
        ("points: [[0, 0, 0.1], [0, 0, 0.12]]", "points: [[0, 0, 0.1]]", "one for each time"),
        ("times: [0, 1], points: [[0, 0, 0.1], [0, 0, 0.12]]", "mass: 1 kg", "neither points nor"),
        ("type: simulated,", "type: simulated, delay: 1 s,", "delay"),
        (
            "type: simulated,",
            "type: simulated, changes: {times: [0, 1], tags: [0x51A0]},",
            "found 1 tag for 2 times",
        ),
        (
            "type: simulated,",
            "type: simulated, changes: {times: [0, 1], tags: [0x51A0, 7]},",
            "found 0x7 right after 0x51A0; none between them is accepted",
        ),
        (
            "type: simulated,",
            "type: simulated, changes: {times: [1, 2], tags: [none, 7]},",
            "found the tag 0x7, which no tool of the trocar has; accepted: 0x51A0, or none",
        ),
        (
            "type: simulated,",
            "type: simulated, changes: {times: [-1, 2], tags: [none, 0x51A0]},",
            "found -1 s; times from 0 s on are accepted",
        ),
        ("rate: 1 kHz", "compliance: exact", "compliance"),
        ("type: simulated,", "type: falcon,", "accepted types: simulated, udp, serial"),
        ("device: {type: simulated,", "devise: {type: simulated,", "did you mean 'device'"),
    ],
)
def test_bad_input_is_refused_in_one_sentence(old, new, said):
    assert old in RIGHT
    found = problems(RIGHT.replace(old, new))
    assert len(found) == 1
    assert said in found[0].replace("Accepted", "accepted")
    assert "trocars.right" in found[0]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "radius: 2 mm}",
            "radius: 2 mm, mass: 60 g}",
            "a tool of a trocar is led by its hand alone",
        ),
        ("between: [bar, probe]", "between: [bar, bar]", "found 'probe', which no contact"),
    ],
)
def test_a_tool_that_the_hand_cannot_lead_is_refused(old, new, said):
    assert old in HEAD
    try:
        found = ts.Scene.from_yaml_text(HEAD.replace(old, new) + RIGHT).check().problems
    except ts.SceneError as refused:
        found = refused.problems
    assert any(said in one and "trocars.right.tools" in one for one in found)


def test_changes_of_tools_need_tools():
    for tools in ("tools: {}", ""):
        text = RIGHT.replace("tools: {0x51A0: probe}", tools).replace(
            "type: simulated,", "type: simulated, changes: {times: [0], tags: [7]},"
        )
        (found,) = problems(text)
        assert "trocars.right.device.changes" in found
        assert "changes are accepted where `tools` names what a tag stands for" in found


DEVICE = "device: {type: simulated, hand: {times: [0, 1], points: [[0, 0, 0.1], [0, 0, 0.12]]}}"


@pytest.mark.parametrize(
    ("device", "said"),
    [
        ("{type: serial, path: /dev/tty-none}", "/dev/tty-none, which is not there; plug"),
        ("{type: shared_memory, name: /tissu-none}", "/tissu-none, which no program has; start"),
        ("{type: shared_memory, name: none}", "a name that begins with a slash"),
        ("{type: plugin, library: none.so}", "none.so, which is not there; build the plug-in"),
        ("{type: serial, path: /dev/null, baud: 9600}", "found 9600; 921600, 1000000, 2000000 or"),
        ("{type: udp, host: here, port: 7}", "an address of four numbers is accepted"),
        ("{type: udp, host: 10.0.0.1, port: 70000}", "port"),
    ],
)
def test_devices_that_are_not_there_are_refused(device, said, tmp_path):
    text = RIGHT.replace(DEVICE, f"device: {device}").replace(
        "rate: 1 kHz", "coupling: {stiffness: [1, 1, 1, 1]}"
    )
    found = problems(text, base=tmp_path)
    assert len(found) == 1
    assert said in found[0]


def test_friction_that_is_not_known_leaves_no_automatic_coupling():
    text = RIGHT.replace(DEVICE, "device: {type: udp, host: 10.0.0.1, port: 7}")
    assert "measure them with `tissu trocar identify`" in problems(text)[0]
    half = text.replace("port: 7", "port: 7, damping: [1, 1, 1, 1]")
    assert "is missing beside the other" in problems(half)[0]


def test_ports_that_collide_and_a_second_controller_are_refused():
    second = RIGHT.replace("right:", "left:").replace("{0x51A0: probe}", "{}")
    assert "at least 0.1 m is accepted" in problems(RIGHT + second)[0]
    away = second.replace("[6 cm, -9 cm, 12 cm]", "[17 cm, -9 cm, 12 cm]")
    assert ts.Scene.from_yaml_text(HEAD + RIGHT + away).check().ok
    udp = "device: {type: udp, host: 10.0.0.1, port: 7}"
    given = {DEVICE: udp, "rate: 1 kHz": "coupling: {stiffness: [1, 1, 1, 1]}"}
    both = RIGHT + away
    for old, new in given.items():
        both = both.replace(old, new)
    assert "which trocars.right has too; a device has one controller" in problems(both)[0]


def test_two_trocars_do_not_lead_one_tool():
    """The obstacle would go where the second hand is, and both would feel its contacts."""
    second = RIGHT.replace("right:", "left:").replace("6 cm, -9 cm", "17 cm, -9 cm")
    (found,) = problems(RIGHT + second)
    assert "trocars.left.tools: found 'probe', which trocars.right has too" in found


def test_the_frame_of_a_port_is_right_handed_with_its_axis_inwards():
    for axis in ((0, 0, -1), (1, 0, 0), (-0.3, 0.4, -0.9), (0, 1, 0)):
        R = ts.Port((0, 0, 0), axis).frame()
        assert R[:, 2] == pytest.approx(np.array(axis) / np.linalg.norm(axis))
        assert np.linalg.det(R) == pytest.approx(1.0)
    R = ts.Port((0, 0, 0), (0, 0, -1), right=(0, 1, 0)).frame()
    assert R[:, 0] == pytest.approx([0, 1, 0])
    with pytest.raises(ts.SceneError, match="does not lie across"):
        ts.Port((0, 0, 0), (0, 0, -1), right=(0, 0, 1))


def test_the_schema_has_trocars():
    schema = scene_schema()
    assert "trocars" in schema["properties"]
    assert {"Trocar", "SimulatedDevice", "PluginDevice"} <= set(schema["$defs"])
    json.dumps(schema)


def test_a_scene_without_trocars_loads_none_of_it():
    """Neither the library of the ticks nor the controller: in a process of its own."""
    code = (
        "import sys, tissu as ts\n"
        f"scene = ts.Scene.from_yaml_text('''{HEAD}''' + ' {{}}')\n"
        "simulation = scene.compile()\n"
        "simulation.step()\n"
        "found = [m for m in sys.modules if m.startswith(('tissu.trocar', 'tissu._haptic'))]\n"
        "print(found, scene.check().absent[-1])\n"
        "maps = open('/proc/self/maps').read()\n"
        "print('_core' in maps, 'haptic' in maps)\n"
        "import tissu._haptic\n"
        "print('haptic' in open('/proc/self/maps').read())\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    # What is not mapped takes no instruction; that a map would show it is seen after the import.
    assert done.stdout.split() == ["[]", "haptics", "True", "False", "True"]


@pytest.mark.parametrize(
    ("step", "said"),
    [
        ("{type: static}", "step: found static, whose steps of 1 s are too long for a hand"),
        ("{type: implicit_euler, dt: 0.6 s}", "step: found a dt of 0.6 s, too long for a hand"),
    ],
)
def test_steps_that_a_hand_would_wait_for_are_refused(step, said):
    """The ticks let go of tissue that is older than 0.5 s; without tools nothing waits for it."""
    assert _haptic.Settings().stall == LONGEST_STEP
    head = HEAD.replace("{type: implicit_euler, dt: 10 ms}", step)
    with pytest.raises(ts.SceneError) as refused:
        ts.Scene.from_yaml_text(head + RIGHT)
    assert len(refused.value.problems) == 1
    assert said in refused.value.problems[0]
    assert ts.Scene.from_yaml_text(head + RIGHT.replace("{0x51A0: probe}", "{}")).check().ok
    longest = HEAD.replace("dt: 10 ms", "dt: 0.5 s")
    assert ts.Scene.from_yaml_text(longest + RIGHT).check().ok
