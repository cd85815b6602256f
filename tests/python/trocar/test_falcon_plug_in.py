"""The example plug-in of a Falcon, built against a stand-in for libnifalcon: no arm is here."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from tissu import _haptic

ROOT = Path(__file__).resolve().parents[3]
COMPILER = shutil.which("c++") or shutil.which("g++")
NAMES = (
    "falcon/core/FalconDevice.h",
    "falcon/firmware/FalconFirmwareNovintSDK.h",
    "falcon/kinematic/FalconKinematicStamper.h",
    "falcon/util/FalconFirmwareBinaryNvent.h",
)
"""Headers of the library that the plug-in includes; each is the stand-in."""
PLACES = (Path("/usr/include/eigen3"), Path("/usr/local/include/eigen3"))


def eigen() -> Path | None:
    """Where Eigen's headers are, of the machine or of a build of tissu."""
    built = ROOT.glob("build/*/_deps/eigen*-src")
    return next((path for path in (*PLACES, *built) if (path / "Eigen" / "Core").is_file()), None)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plug-in; its own warnings are errors, those of Eigen are not looked at."""
    headers = eigen()
    if COMPILER is None or headers is None:
        pytest.skip("no compiler, or no Eigen")
    folder = tmp_path_factory.mktemp("falcon")
    made = folder / "falcon.so"
    for name in NAMES:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(Path(__file__).parent / "falcon_stand_in.h", folder / name)
    flags = ["-std=c++20", "-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror"]
    include = [f"-I{ROOT / 'cpp' / 'include'}", "-isystem", str(headers)]
    include.append(f"-I{folder}")
    sources = [ROOT / "examples" / "plugin" / "falcon.cpp", ROOT / "cpp/src/haptic/kinematics.cpp"]
    subprocess.run([COMPILER, *flags, *include, *map(str, sources), "-o", str(made)], check=True)
    return made


def test_without_an_arm_it_says_which_number_it_looked_for(library: Path) -> None:
    with pytest.raises(ts.TissuError, match="no Falcon has the number '0'"):
        _haptic.open_plugin(library=str(library), address="0")


def test_an_arm_is_felt_as_a_trocar(library: Path) -> None:
    """Its place is that of the tip, and each torque moves its own joint its own way."""
    arm = _haptic.open_plugin(library=str(library), address="7")
    count = np.asarray(arm.info()["count_size"])

    def joints() -> np.ndarray:
        status, sample = _haptic.read(arm)
        assert status == 0
        assert sample["flags"] & 1  # homed
        return np.asarray(sample["counts"])[:4] * count[:4]

    # The Falcon's y is up and its z towards the hand; the pivot lies 100 mm before its middle.
    tip = np.array([0.01, -0.02, 0.1 + 0.125 - 0.11])
    rest = joints()
    assert _haptic.point(rest, np.zeros(3)) == pytest.approx(tip, abs=5e-5)
    for axis, torque in ((0, 0.1), (1, 0.1), (3, 2.0)):
        tau = np.zeros(5)
        tau[axis] = torque
        assert _haptic.write(arm, tau) == 0
        moved = joints() - rest
        expected = 1e-3 * _haptic.Fulcrum().force(rest, tau[:4])
        J = _haptic.jacobian(rest, np.zeros(3))
        assert J @ moved == pytest.approx(expected, abs=1e-4)
        assert moved[axis] * torque > 0.0
        _haptic.write(arm, np.zeros(5), enable=False)
        assert joints() == pytest.approx(rest, abs=1e-9)
