"""Devices over every wire, played by the tests: a process, a pseudo-terminal, memory, plug-ins."""

import os
import shutil
import socket
import struct
import subprocess
import sys
import threading
import time
import tty
import uuid
import zlib
from pathlib import Path

import played_device
import pytest
from typer.testing import CliRunner

import tissu as ts
from tissu import _haptic
from tissu.cli.app import app
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel
from tissu.trocar.states import State

ROOT = Path(__file__).resolve().parents[3]
INFO = {
    "wait": 0.3,
    "count_size": [1e-4] * 5,
    "torque_limit": [6.0, 6.0, 0.2, 5.0, 0.0],
    "rate": 1000.0,
    "delay": 0.0,
}
COUPLING = ts.Coupling((10.0, 10.0, 0.2, 500.0))


def trocar(device, **more):
    """A trocar at the origin, with its axis down."""
    port = ts.Port((0, 0, 0), (0, 0, -1))
    return ts.Trocar(port=port, device=device, coupling=COUPLING, **more)


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def wait_for(condition):
    """Waits; what a busy machine takes is not judged."""
    end = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.005)


def test_a_second_process_plays_the_device_over_udp():
    """In real time: its tool goes 14 mm deeper, and a wall of 400 N/m at 110 mm is felt there."""
    script = Path(played_device.__file__)
    player = subprocess.Popen([sys.executable, str(script), "0"], stdout=subprocess.PIPE, text=True)
    port = int(player.stdout.readline())
    # At 300 Hz the five ticks that may be missed are 17 ms: the machine may be busy.
    udp = ts.UdpDevice("127.0.0.1", port, delay=0.0)
    controller = Controller(trocar(udp, rate=300.0), mode="threaded")
    controller.start(lock_memory=False, pin=False)
    found = controller.report
    wait_for(lambda: found().state is State.free)
    wall = {"through": (0, 0, 0.11), "normal": (0, 0, -1), "stiffness": 400.0}
    controller.publish(LocalModel.plane(found().q, **wall))

    def pressed():
        if found().state is State.held:  # a machine that others use misses ticks
            controller.acknowledge()
        controller.publish(LocalModel.plane(found().q, **wall))
        # 4 mm deep, springs of 400 and 500 N/m behind each other: 0.889 N.
        return found().force[2] == pytest.approx(400 * 500 / 900 * 0.004, rel=1e-3)

    wait_for(pressed)
    with pytest.raises(ts.TissuError, match="has a controller already"):
        Controller(trocar(ts.UdpDevice("127.0.0.1", port)))
    controller.stop()
    out, _ = player.communicate(timeout=60)
    assert "off True" in out  # the motors were switched off at the end
    largest = float(out.split("largest ")[1].split()[0])
    assert largest == pytest.approx(0.889, rel=2e-2)


def test_udp_devices_that_are_not_there_are_refused():
    with pytest.raises(ts.TissuError, match=r"no device answers at 127\.0\.0\.1"):
        _haptic.open_udp(host="127.0.0.1", port=free_port(), **INFO)
    with pytest.raises(ts.ParameterError, match="an address in numbers"):
        _haptic.open_udp(host="device.local", port=7001, **INFO)
    with pytest.raises(ts.ParameterError, match="port of 1 to 65535"):
        _haptic.open_udp(host="127.0.0.1", port=70_000, **INFO)


def test_frames_over_udp_that_are_damaged_late_or_of_others_are_not_taken():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as line:
        line.bind(("127.0.0.1", 0))
        port = line.getsockname()[1]
        starter = threading.Timer(
            0.0, lambda: line.sendto(played_device.frame(5, [1] * 5), line.recvfrom(64)[1])
        )
        starter.start()
        device = _haptic.open_udp(host="127.0.0.1", port=port, **INFO)
        starter.join()
        assert _haptic.read(device) == (
            0,
            {"counts": [1] * 5, "time_ns": 5_000_000, "sequence": 5, "flags": 7, "tag": 1},
        )
        assert _haptic.write(device, [0.5, 0, 0, -2.0, 0], sequence=5) == 0
        line.settimeout(10)
        told = None
        while told is None or not told[2]:
            data, who = line.recvfrom(64)
            told = played_device.answer(data)
        assert told == (5, [0.5, 0, 0, -2.0, 0], 1, 20)
        damaged = bytearray(played_device.frame(6, [2] * 5))
        damaged[20] ^= 1
        line.sendto(damaged, who)
        assert _haptic.read(device)[0] == 2  # broken
        line.sendto(played_device.frame(4, [2] * 5), who)
        assert _haptic.read(device)[0] == 1  # older than the last
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.sendto(played_device.frame(9, [9] * 5), who)
        assert _haptic.read(device)[0] == 1  # of another sender
        for sequence in (7, 8, 6):
            line.sendto(played_device.frame(sequence, [sequence] * 5), who)
        assert _haptic.read(device)[1]["counts"] == [8] * 5  # the newest


def test_a_device_at_a_serial_line():
    ours, theirs = os.openpty()
    tty.setraw(ours)
    path = os.ttyname(theirs)
    os.write(ours, b"noise" + played_device.frame(1, [3] * 5))
    device = _haptic.open_serial(path=path, baud=921_600, **INFO)
    assert _haptic.read(device)[1]["counts"] == [3] * 5
    with pytest.raises(ts.TissuError, match="has a controller already"):
        _haptic.open_serial(path=path, baud=921_600, **INFO)
    while os.read(ours, 4096)[-36:][:4] != b"TSA1":
        pass  # questions for the first frame
    assert _haptic.write(device, [0, 0, 0, 1.5, 0], sequence=3) == 0
    assert played_device.answer(os.read(ours, 4096)[-36:])[1][3] == 1.5
    os.write(ours, played_device.frame(2, [4] * 5)[:40])
    assert _haptic.read(device)[0] == 1  # half a frame
    os.write(ours, played_device.frame(2, [4] * 5)[40:])
    assert _haptic.read(device)[1]["counts"] == [4] * 5
    os.close(ours)
    os.close(theirs)
    wait_for(lambda: _haptic.read(device)[0] == 3)  # gone


def test_serial_lines_that_are_none_are_refused(tmp_path):
    file = tmp_path / "file"
    file.write_text("no line")
    with pytest.raises(ts.TissuError, match="is not a serial line"):
        _haptic.open_serial(path=str(file), baud=921_600, **INFO)
    with pytest.raises(ts.TissuError, match="no device is at"):
        _haptic.open_serial(path=str(tmp_path / "none"), baud=921_600, **INFO)
    with pytest.raises(ts.ParameterError, match="9600 baud"):
        _haptic.open_serial(path=str(file), baud=9600, **INFO)
    ours, theirs = os.openpty()
    with pytest.raises(ts.TissuError, match="gives no frame"):
        _haptic.open_serial(path=os.ttyname(theirs), baud=921_600, **INFO)
    os.close(ours)
    os.close(theirs)


def test_a_device_in_shared_memory():
    name = f"/tissu-test-{uuid.uuid4().hex}"
    file = Path("/dev/shm", name[1:])
    try:
        file.write_bytes(bytes(256))
        with file.open("r+b") as memory:
            done = threading.Event()

            def play():
                version = 0
                while not done.wait(0.002):
                    version += 2
                    memory.seek(0)
                    memory.write(struct.pack("<I", version - 1))
                    memory.flush()
                    memory.seek(64)
                    memory.write(played_device.frame(version // 2, [version] * 5))
                    memory.flush()
                    memory.seek(0)
                    memory.write(struct.pack("<I", version))
                    memory.flush()

            player = threading.Thread(target=play)
            player.start()
            opened = [_haptic.open_shared_memory(name=name, **INFO)]  # held by this list alone
            while _haptic.read(opened[0])[0] != 0:
                time.sleep(0.001)
            with pytest.raises(ts.TissuError, match="has a controller already"):
                _haptic.open_shared_memory(name=name, **INFO)
            _haptic.write(opened[0], [0, 0, 0, 2.5, 0], sequence=77)
            done.set()
            player.join()
            told = played_device.answer(file.read_bytes()[192:228])
            assert told[0] == 77
            assert told[1][3] == 2.5
            _haptic.read(opened[0])
            assert _haptic.read(opened[0])[0] == 1  # nothing new
            with pytest.raises(ts.TissuError, match="has a controller already"):
                Controller(trocar(ts.SharedMemoryDevice(name)))
            opened.clear()
            # Memory that its player has left behind.
            with pytest.raises(ts.TissuError, match="gets no new frame"):
                _haptic.open_shared_memory(name=name, **INFO)
        file.write_bytes(bytes(10))
        with pytest.raises(ts.TissuError, match="has 10 bytes"):
            _haptic.open_shared_memory(name=name, **INFO)
    finally:
        file.unlink()
    with pytest.raises(ts.TissuError, match="no device has the shared memory"):
        _haptic.open_shared_memory(name=name, **INFO)


COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("c++")
HEADERS = [ROOT / "cpp" / "include"]


def built(source, library):
    """Builds a plug-in with the compiler of this machine."""
    command = [COMPILER, "-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror"]
    command += [f"-I{path}" for path in HEADERS]
    subprocess.run([*command, str(source), "-o", str(library), "-lm"], check=True)
    return library


def test_the_example_plug_in_is_built_opened_and_held(tmp_path):
    """A weight of 0.2 kg falls onto a wall and rests there: its weight is felt, 1.96 N."""
    library = built(ROOT / "examples" / "plugin" / "weight.c", tmp_path / "weight.so")
    known = {"damping": [1, 1, 1, 1], "friction": [0.1, 0.1, 0.1, 0.1]}
    device = ts.PluginDevice(library, address="0.2", delay=0.0, **known)
    with pytest.raises(ts.ParameterError, match="is a program, and was not run"):
        Controller(trocar(device))
    with Controller(trocar(device), trust_plugins=True) as controller:
        for _ in range(500):
            q = controller.step(10).q
            wall = {"through": (0, 0, 0.11), "normal": (0, 0, -1), "stiffness": 1e4}
            controller.publish(LocalModel.plane(q, **wall))
        report = controller.report()
        assert report.state is State.contact
        # The scene's z is against the port's; the coupling gives way by counts of 0.1 mm.
        assert report.force[2] == pytest.approx(0.2 * 9.81, abs=500 * 1e-4)
        with pytest.raises(ts.TissuError, match="has a controller already"):
            Controller(trocar(device), trust_plugins=True)


def test_a_scene_with_a_plug_in_runs_where_it_is_trusted(tmp_path):
    """`tissu run --realtime`, refused without --trust-plugins."""
    built(ROOT / "examples" / "plugin" / "weight.c", tmp_path / "weight.so")
    text = (ROOT / "examples" / "trocar.yaml").read_text()
    given = text[text.index("      type: simulated") : text.index("    tools:")]
    scene = tmp_path / "weight.yaml"
    plugin = (
        "      {type: plugin, library: weight.so}\n    coupling: {stiffness: [1, 1, 0.1, 100]}\n"
    )
    scene.write_text(text.replace(given, plugin).replace("duration: 0.1 s", "duration: 0.02 s"))
    command = ["run", str(scene), "--realtime", "--out", str(tmp_path / "out"), "--no-picture"]
    refused = CliRunner().invoke(app, command)
    assert refused.exit_code == 2 and "take --trust-plugins" in refused.output
    done = CliRunner().invoke(app, [*command, "--trust-plugins"])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "out" / "trocar-right.csv").is_file()


def test_plug_ins_that_are_none_are_refused(tmp_path):
    none = tmp_path / "none.so"
    with pytest.raises(ts.TissuError, match="cannot be loaded"):
        _haptic.open_plugin(library=str(none), address="")
    source = tmp_path / "empty.c"
    source.write_text("int unrelated(void) { return 1; }\n")
    with pytest.raises(ts.TissuError, match="has no function tissu_device_abi"):
        _haptic.open_plugin(library=str(built(source, tmp_path / "empty.so")), address="")
    weight = ROOT / "examples" / "plugin" / "weight.c"
    library = built(weight, tmp_path / "weight.so")
    with pytest.raises(ts.TissuError, match="kilogrammes above 0"):
        _haptic.open_plugin(library=str(library), address="-1")
    old = tmp_path / "old.c"
    old.write_text(weight.read_text().replace("return TISSU_DEVICE_ABI;", "return 0;"))
    with pytest.raises(ts.TissuError, match="has version 0 of the interface"):
        _haptic.open_plugin(library=str(built(old, tmp_path / "old.so")), address="")
    wrong = tmp_path / "wrong.c"
    wrong.write_text(weight.read_text().replace("info->axes = 4", "info->axes = 9"))
    with pytest.raises(ts.TissuError, match="9 axes"):
        _haptic.open_plugin(library=str(built(wrong, tmp_path / "wrong.so")), address="")


def test_the_checksum_is_that_of_zlib():
    for data in (b"", b"123456789", bytes(range(256))):
        assert _haptic.crc32(data) == zlib.crc32(data)
