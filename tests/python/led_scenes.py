"""A bar whose end is held under the name `hand`, and the same led by the scene."""

from __future__ import annotations

from typing import Any

import numpy as np

import tissu as ts

LENGTH, SIDE, YOUNG = 0.4, 0.1, 2e4
DT, STEPS_TAKEN = 2e-3, 8
END = ts.Plane((LENGTH, 0, 0), (1, 0, 0))
ROOT = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
CENTER, AXIS = (LENGTH, 0.05, 0.05), (0.6, 0.0, 0.8)
LAST, TURN = np.array((0.02, 0.01, -0.03)), 0.7

STEPS = {
    "implicit": ts.ImplicitEuler(DT),
    "iterated": ts.Newmark(DT),
    "bdf2": ts.BDF2(DT),
    "explicit": ts.SymplecticEuler(1e-4),
    "midpoint": ts.ImplicitMidpoint(DT),
    "stages": ts.RK4(1e-4),
}


def led_body(kind: str = "fem") -> ts.Body:
    law = ts.StVK(young=YOUNG, poisson=0.3)
    if kind == "shell":
        mesh = ts.BarMesh(size=(LENGTH, SIDE, 0.0), cells=(6, 2, 0), cell="triangle")
        return ts.Body(
            mesh=mesh, law=ts.Hooke(young=YOUNG, poisson=0.3), thickness=0.02, density=1e3,
            model="shell",
        )  # fmt: skip
    mesh = ts.BarMesh(size=(LENGTH, SIDE, SIDE), cells=(4, 2, 2), cell="hexahedron")
    return ts.Body(mesh=mesh, law=law, density=1e3, model=kind)


def led_scene(step: Any, kind: str = "fem", **changes: Any) -> ts.Scene:
    fields: dict[str, Any] = {
        "bodies": {"bar": led_body(kind)},
        "fixed": [ROOT, ts.Fixed("bar", on=END, name="hand")],
        "step": step,
    }
    return ts.Scene(**{**fields, **changes})


def led_motion(duration: float, *, name: str | None = None) -> ts.Prescribed:
    rotation = ts.Rotation(axis=AXIS, center=CENTER, angles=[0.0, TURN])
    return ts.Prescribed(
        "bar", on=END, times=[0.0, duration], displacements=[(0, 0, 0), LAST], rotation=rotation,
        name=name,
    )  # fmt: skip


def led_by_scene(step: Any, duration: float, kind: str = "fem", **changes: Any) -> ts.Simulation:
    """The end is led by the scene."""
    moved = {"fixed": [ROOT], "prescribed": [led_motion(duration)], **changes}
    return led_scene(step, kind, **moved).compile()


def follow(simulation: ts.Simulation, duration: float, dt: float) -> None:
    """A live target where the scene's motion is after the next step."""
    share = (simulation.time + dt) / duration
    simulation.lead("hand").move(share * LAST, angle=share * TURN, axis=AXIS, center=CENTER)
