"""Devices of a trocar: simulated, over UDP, a serial line or shared memory, or by a plug-in."""

from __future__ import annotations

import ipaddress
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import AfterValidator, Field, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Read
from tissu.scene.body import PathLike
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.trocar.axes import Counts, Efficiency, MaybeDamping, MaybeFriction
from tissu.scene.trocar.changes import ToolChanges
from tissu.scene.trocar.hand import Hand
from tissu.scene.trocar.mechanism import TrocarMechanism
from tissu.scene.unknown import rule

__all__ = [
    "SimulatedDevice",
    "UdpDevice",
    "SerialDevice",
    "SharedMemoryDevice",
    "PluginDevice",
]

Four = tuple[float, float, float, float]
TABLE_COUNTS: Four = (math.radians(0.01), math.radians(0.01), math.radians(0.05), 1e-4)
"""Position of one count of the thesis' prototype (table 5.4.5) [rad, rad, rad, m]."""
IDEAL: Four = (1.0, 1.0, 1.0, 1.0)
BAUDS = (921_600, 1_000_000, 2_000_000, 4_000_000)


def _from_base(file: Path, info: ValidationInfo) -> Path:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None else file


class TrocarDevice(Part):
    """What all devices share."""

    if TYPE_CHECKING:
        type: str
        counts: Counts
        efficiency: Efficiency

    def identity(self) -> str | None:
        """Which device it is: one controller has it at a time; None: no other one can open it."""
        raise NotImplementedError

    def absent(self) -> str | None:
        """Why the device is not there, as far as it is known without opening it; None: it may be.

        One sentence of a problem.
        """
        return None

    def dissipation(self) -> tuple[Four, Four] | None:
        """Viscous damping and Coulomb friction of the axes; None: not known yet."""
        raise NotImplementedError

    def loop_delay(self) -> float:
        """From reading to the torque on the joint [s]."""
        raise NotImplementedError

    def words(self) -> str:
        """What it is, as `check` says it."""
        raise NotImplementedError


class SimulatedDevice(TrocarDevice):
    """A simulated device, with inertia, friction, counts, delay, lost frames, and a hand."""

    type: Literal["simulated"] = "simulated"
    hand: Hand | None = None
    """the hand that holds the tool; absent: the tool moves freely"""
    changes: ToolChanges | None = None
    """times at which the tool changes; absent: the first tool of the trocar, all the time"""
    delay: units.Time = field(default=0.0, ge=0.0, le=0.1)
    """time from reading to the torque on the joint [s]"""
    jitter: units.Time = field(default=0.0, ge=0.0, le=0.1)
    """random part of the delay, uniform from 0 to this [s]"""
    lost: units.Pure = field(default=0.0, ge=0.0, le=1.0)
    """share of frames that do not arrive"""
    seed: Annotated[int, Field(ge=0)] = 1
    """seed of all random numbers of the device"""
    homed: bool = True
    """whether the zero of its encoders is known at the start; false: it has to be homed first"""
    counts: Counts = field(default=TABLE_COUNTS)
    """position of one count of pitch, roll, rotation [rad] and depth [m]"""
    efficiency: Efficiency = field(default=IDEAL)
    """efficiency of the transmissions of pitch, roll, rotation and depth: the part of a motor's
    torque that arrives at the joint while the motor drives
    """
    mechanism: TrocarMechanism = field(default_factory=TrocarMechanism)
    """masses, friction and ends"""

    def identity(self) -> str | None:
        """None: each trocar has its own."""
        return None

    def dissipation(self) -> tuple[Four, Four] | None:
        """Of the computed mechanism."""
        return self.mechanism.damping, self.mechanism.friction

    def loop_delay(self) -> float:
        """The largest."""
        return self.delay + self.jitter

    def words(self) -> str:
        """What it is."""
        hand = "no hand" if self.hand is None else self.hand.words()
        return f"a simulated device, {hand}, delay {self.delay:g} s, seed {self.seed}"


class RealDevice(TrocarDevice):
    """What devices share that are not computed."""

    delay: units.Time = field(default=1e-3, ge=0.0, le=0.1)
    """time from reading to the torque on the joint [s], from the data sheet; at least 1 ms for a
    device with its own clock at 1 kHz
    """
    damping: MaybeDamping = field(default=None)
    """viscous damping of pitch, roll, rotation [N m s/rad] and depth [N s/m], as measured by `tissu
    trocar identify`; absent: not known, so `coupling` must be given
    """
    friction: MaybeFriction = field(default=None)
    """Coulomb friction of pitch, roll, rotation [N m] and depth [N]; absent: as for `damping`"""
    counts: Counts = field(default=TABLE_COUNTS)
    """position of one count of pitch, roll, rotation [rad] and depth [m]"""
    efficiency: Efficiency = field(default=IDEAL)
    """efficiency of the transmissions of pitch, roll, rotation and depth, as measured by `tissu
    trocar identify`; 1: their losses are not compensated
    """

    @rule("damping", "friction")
    def _knows_both(self) -> Iterator[Problem]:
        if (self.damping is None) != (self.friction is None):
            missing = "damping" if self.damping is None else "friction"
            text = "is missing beside the other; the bound of the coupling needs both"
            yield Problem((missing,), f"{text}: give it, as `tissu trocar identify` finds it")

    def dissipation(self) -> tuple[Four, Four] | None:
        """As the scene gives it."""
        if self.damping is None or self.friction is None:
            return None
        return self.damping, self.friction

    def loop_delay(self) -> float:
        """As measured."""
        return self.delay


def _host(value: str) -> str:
    try:
        return str(ipaddress.IPv4Address(value))
    except ValueError:
        text = "an address of four numbers is accepted, such as 192.168.1.20"
        raise ParameterError(f"found '{value}'; {text}") from None


class UdpDevice(RealDevice):
    """A device that exchanges frames of 64 bytes over UDP (docs/guide/trocar.md)."""

    type: Literal["udp"] = "udp"
    host: Annotated[str, AfterValidator(_host)] = field(kw_only=False)
    """numeric address of the device"""
    port: Annotated[int, Field(ge=1, le=65535)] = field(kw_only=False)
    """port of the device"""

    def identity(self) -> str | None:
        """Its address."""
        return f"udp {self.host}:{self.port}"

    def words(self) -> str:
        """What it is."""
        return f"a device over UDP at {self.host}:{self.port}"


class SerialDevice(RealDevice):
    """A device that exchanges frames of 64 bytes over a serial line (docs/guide/trocar.md)."""

    type: Literal["serial"] = "serial"
    path: Read[Path, PathLike] = field(kw_only=False)
    """path of the line, such as /dev/ttyACM0"""
    baud: int = 921_600
    """speed of the line; 921600, 1000000, 2000000 or 4000000"""

    @rule("baud")
    def _is_fast_enough(self) -> Iterator[Problem]:
        if self.baud not in BAUDS:
            text = f"found {self.baud}; {', '.join(map(str, BAUDS[:-1]))} or {BAUDS[-1]} is "
            yield Problem(
                ("baud",), f"{text}accepted: a slower line does not carry 1,000 frames a second"
            )

    def identity(self) -> str | None:
        """Its line."""
        return f"serial {self.path}"

    def absent(self) -> str | None:
        """Where no such line is."""
        if self.path.exists():
            return None
        return f"found {self.path}, which is not there; plug the device in, or name another line"

    def words(self) -> str:
        """What it is."""
        return f"a device at the serial line {self.path}, {self.baud} baud"


class SharedMemoryDevice(RealDevice):
    """A device that another program on this machine simulates (docs/guide/trocar.md)."""

    type: Literal["shared_memory"] = "shared_memory"
    name: str = field(kw_only=False)
    """name of the memory, such as /trocar"""

    @rule("name")
    def _is_a_name(self) -> Iterator[Problem]:
        if not self.name.startswith("/") or "/" in self.name[1:] or len(self.name) < 2:
            text = f"found '{self.name}'; a name that begins with a slash and has no other is "
            yield Problem(("name",), f"{text}accepted, such as /trocar")

    def identity(self) -> str | None:
        """Its memory."""
        return f"shared memory {self.name}"

    def absent(self) -> str | None:
        """Where no such memory is."""
        if Path("/dev/shm", self.name[1:]).exists():
            return None
        text = f"found {self.name}, which no program has; start the one that plays the device"
        return f"{text}, or name another"

    def words(self) -> str:
        """What it is."""
        return f"a device in the shared memory {self.name}"


class PluginDevice(RealDevice):
    """A device that a plug-in reads and writes: a shared library of five functions."""

    type: Literal["plugin"] = "plugin"
    library: Annotated[Read[Path, PathLike], AfterValidator(_from_base)] = field(kw_only=False)
    """file of the plug-in; it is a program, and is opened only where plug-ins are trusted"""
    address: Read[str | None, str | None] = field(default=None)
    """which device, in the plug-in's own words; absent: its first"""

    def identity(self) -> str | None:
        """Its library and address."""
        return f"plugin {self.library} {self.address or ''}".strip()

    def absent(self) -> str | None:
        """Where no such library is."""
        if self.library.is_file():
            return None
        return f"found {self.library}, which is not there; build the plug-in, or name its file"

    def words(self) -> str:
        """What it is."""
        return f"a device by the plug-in {self.library}"


DEVICES: tuple[type[TrocarDevice], ...] = (
    *(SimulatedDevice, UdpDevice, SerialDevice),
    *(SharedMemoryDevice, PluginDevice),
)
OneDevice = Annotated[TrocarDevice, one_of(*DEVICES)]
