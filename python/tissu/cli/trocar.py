"""Trocars from the command line: is the device there, what is its friction, how late are ticks."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tissu.cli.inputs import input_files, require_apart
from tissu.cli.outcome import DIVERGED, FINISHED
from tissu.errors import ParameterError, SceneError

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.scene.trocar.passive import Bound
    from tissu.scene.trocar.trocar import Trocar
    from tissu.trocar.controller import Controller, Mode
    from tissu.trocar.identify import Axis
    from tissu.trocar.touch import Touch

_LOOK = 0.04
"""s between two reports: the rate of a display."""
_NOTHING = 1e-9
"""s: what rounding may leave of a time."""


def trocars_of(scene: Path, name: str | None) -> dict[str, Trocar]:
    """The trocars of a scene, or the one that is named.

    Raises:
        SceneError: the scene has problems, or no trocar of this name.
    """
    return _named(scene, _checked(scene), name)


def _checked(scene: Path) -> Scene:
    """The scene of a file, without problems."""
    from tissu.front import Scene

    found = Scene.from_yaml(scene)
    problems = found.check().problems
    if problems:
        raise SceneError(problems)
    return found


def _named(scene: Path, found: Scene, name: str | None) -> dict[str, Trocar]:
    """All trocars, or the one that is named."""
    from tissu.scene.problem import nearest

    trocars = dict(found.trocars)
    if not trocars:
        raise SceneError([f"{scene}: found no trocars; at least one is accepted, as `trocars:`"])
    if name is None:
        return trocars
    if name not in trocars:
        text = f"{scene}: no trocar is named '{name}'{nearest(name, trocars)}"
        raise SceneError([f"{text} Trocars: {', '.join(trocars)}"])
    return {name: trocars[name]}


def one_trocar(scene: Path, name: str | None) -> tuple[str, Trocar]:
    """The trocar that is named, or the only one.

    Raises:
        SceneError: there are several, and none is named.
    """
    return _the_one(scene, trocars_of(scene, name))


def _the_one(scene: Path, found: dict[str, Trocar]) -> tuple[str, Trocar]:
    """The trocar where there is one."""
    if len(found) > 1:
        text = f"{scene}: found the trocars {', '.join(found)}; name one of them by --trocar"
        raise SceneError([text])
    return next(iter(found.items()))


def check_trocars(scene: Path, name: str | None, *, trusted: bool) -> None:
    """Opens each device, takes some samples, and says what it is."""
    from tissu.trocar.controller import Controller

    for key, trocar in trocars_of(scene, name).items():
        real = trocar.device.type != "simulated"
        mode: Mode = "threaded" if real else "stepped"
        with Controller(trocar, mode=mode, trust_plugins=trusted) as controller:
            if real:
                time.sleep(0.3)
                report = controller.report()
            else:
                report = controller.step(300)
            print(f"trocar {key}: {trocar.device.words()}")
            print(f"  now: {report}")
            print("\n".join(_words_of(trocar)))


def _words_of(trocar: Trocar) -> list[str]:
    """A line for the coupling of each axis, and for what else the motors do."""
    found = [f"  {axis}: coupling {felt}, {bound}" for axis, felt, bound in _couplings(trocar)]
    return found + [f"  {words}" for words in trocar.carried_words()]


def _couplings(trocar: Trocar) -> list[tuple[str, str, str]]:
    """Of each axis: its name, its coupling and what bounds it."""
    from tissu.scene.trocar.axes import AXIS_NAMES

    rows = []
    known = trocar.bounds()
    bounds: Sequence[Bound | None] = [None] * len(AXIS_NAMES) if known is None else known
    for axis, stiffness, bound in zip(AXIS_NAMES, trocar.stiffness(), bounds, strict=True):
        unit = "N/m" if axis == "depth" else "N m/rad"
        text = "whose passive bound is not known: tissu trocar identify"
        if bound is not None:
            text = f"passive up to {bound.stiffness:.4g} {unit}, {bound.why}"
        rows.append((axis, f"{stiffness:.4g} {unit}", text))
    return rows


def identify_trocar(scene: Path, name: str | None, *, trusted: bool) -> None:
    """Drives each axis to and fro, and prints damping, friction, efficiency as a scene has them."""
    from tissu.trocar.identify import identify
    from tissu.trocar.opened import open_device

    key, trocar = one_trocar(scene, name)
    real = trocar.device.type != "simulated"
    free = trocar if real else trocar.replace(device=trocar.device.replace(hand=None))
    axes = identify(free, open_device(free, 1, trust_plugins=trusted), realtime=real)
    print(f"trocar {key}:")
    for axis in axes:
        print(f"  {axis.name}: {_values(axis)}, {_loss(axis)}; rest {axis.rest:.1%}")
    print("for the device of the scene:")
    found = [axis.found() for axis in axes]
    _print_field(
        "damping", [a.damping if ok[1] else None for a, ok in zip(axes, found, strict=True)]
    )
    _print_field(
        "friction", [a.friction if ok[2] else None for a, ok in zip(axes, found, strict=True)]
    )
    _print_field("efficiency", [axis.efficiency for axis in axes])


def _print_field(name: str, values: list[float | None]) -> None:
    """A line of a scene, or that there is none because a value was not found."""
    known = [f"{value:.3g}" for value in values if value is not None]
    if len(known) == len(values):
        print(f"  {name}: [{', '.join(known)}]")
    else:
        print(f"  no line for {name}: a value of it was not found")


def _values(axis: Axis) -> str:
    """Inertia, damping and friction of an axis with their spread; why one was not found."""
    rows = zip(
        ("inertia", "damping", "friction"),
        (axis.inertia, axis.damping, axis.friction),
        axis.spread,
        axis.found(),
        strict=True,
    )
    text = ", ".join(
        f"{name} {value:.3g} +- {spread:.1g}" if ok else f"{name} not found"
        for name, value, spread, ok in rows
    )
    if all(axis.found()):
        return f"{text} (SI)"
    why = "the motor's swing is too weak against its friction, raise the torque limit of the axis"
    return f"{text} (SI; {why})"


def _loss(axis: Axis) -> str:
    """The efficiency of an axis, and how well it is known."""
    if axis.efficiency is None:
        why = "the axis brakes too little; the others are what the motor feels, 1/eta larger"
        return f"efficiency not found: {why}"
    return f"efficiency {axis.efficiency:.3f} +- {axis.error:.3f}"


def jitter_trocar(
    scene: Path, name: str | None, seconds: float, spin: float, *, trusted: bool
) -> None:
    """Ticks in real time, and prints how late they were."""
    from tissu.trocar.controller import Controller

    for key, trocar in trocars_of(scene, name).items():
        controller = Controller(trocar, mode="threaded", trust_plugins=trusted)
        controller.start(spin=spin)
        try:
            time.sleep(seconds)
        finally:
            controller.stop()
        print(f"trocar {key}, {trocar.rate:g} Hz for {seconds:g} s")
        print("\n".join(f"  {line}" for line in str(controller.timing()).splitlines()))


@dataclass(frozen=True, slots=True)
class Recorded:
    """What is recorded.

    Attributes:
        scene: file of the scene.
        name: of the trocar; None: the only one.
        out: file of the recording.
        seconds: how long.
        realtime: whether by the thread; else stepped, in simulated time.
        wall: depth of a wall across the port that is felt in place of the tissue [m]; None: the
            tissue of the scene is felt, where the trocar has tools.
        stiffness: of the wall [N/m].
        trusted: whether a plug-in may run.
    """

    scene: Path
    name: str | None
    out: Path
    seconds: float
    realtime: bool
    wall: float | None
    stiffness: float
    trusted: bool


def check_writable(out: Path) -> None:
    """Before anything is recorded: the file can be written.

    Raises:
        ParameterError: it is a folder, or in a folder that is not there.
    """
    if out.is_dir():
        raise ParameterError(f"found the folder {out}; a file is accepted, such as ticks.npz")
    if not out.resolve().parent.is_dir():
        text = (
            f"found no folder {out.resolve().parent}; one that is there is accepted: make it first"
        )
        raise ParameterError(text)


def record_trocar(job: Recorded) -> None:
    """Ticks for a while, with the tissue or a wall that is felt, and writes what happened."""
    from tissu.trocar.controller import Controller

    scene = _checked(job.scene)
    key, trocar = _the_one(job.scene, _named(job.scene, scene, job.name))
    require_apart(f"recording {job.out}", [job.out], input_files(job.scene, trocar))
    mode: Mode = "threaded" if job.realtime else "stepped"
    controller = Controller(trocar, mode=mode, record=True, trust_plugins=job.trusted)
    touch = _touch(scene, controller, job)
    with controller:
        left = job.seconds
        if touch is not None:
            left -= _touching(touch, job)
        while left > _NOTHING:
            _look(controller, job, trocar, min(_LOOK, left))
            left -= _LOOK
        print(f"trocar {key}: {controller.report()}")
    recording = controller.recording()
    recording.save(job.out)
    print(f"recorded: {job.out} ({recording.ticks} ticks, {len(recording.models)} models)")


def _touch(scene: Scene, controller: Controller, job: Recorded) -> Touch | None:
    """The scene that the tools of the trocar touch; None where a wall stands in, or it has none."""
    from tissu.trocar.touch import Touch

    if job.wall is not None or not controller.trocar.tools:
        return None
    return Touch(scene.compile(), controller)


def _touching(touch: Touch, job: Recorded) -> float:
    """Whole steps of the scene and their ticks; the time that they took on its clock [s]."""
    dt = touch.simulation.dt
    steps = int(job.seconds / dt + _NOTHING)
    begin = time.monotonic()
    for number in range(steps):
        touch.step()
        if job.realtime:
            time.sleep(max(0.0, begin + (number + 1) * dt - time.monotonic()))
    return steps * dt


def _look(controller: Controller, job: Recorded, trocar: Trocar, seconds: float) -> None:
    """One period of a display: the wall is published anew where the tool is now."""
    from tissu.trocar.model import LocalModel

    if job.realtime:
        time.sleep(seconds)
        report = controller.report()
    else:
        report = controller.step(max(1, round(seconds * trocar.rate)))
    if job.wall is not None:
        through, out = (0.0, 0.0, job.wall), (0.0, 0.0, -1.0)
        controller.publish(
            LocalModel.plane(report.q, through=through, normal=out, stiffness=job.stiffness)
        )


def replay_recording(file: Path) -> int:
    """Takes the ticks of a recording again; the exit code: 0 where all bits are the same."""
    from tissu.trocar.recording import Recording

    if not file.is_file():
        what = "the folder" if file.is_dir() else "no file"
        raise ParameterError(f"found {what} {file}; a file of `tissu trocar record` is accepted")
    recording = Recording.read(file)
    different = recording.difference(recording.replay())
    if different:
        print(f"{file}: {different}")
        return DIVERGED
    print(f"{file}: {recording.ticks} ticks, {len(recording.models)} models, the same bits")
    return FINISHED
