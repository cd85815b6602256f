"""BDF2 by fixed-point iteration on a body: contraction, iterations and cost beside Newton's."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import tissu as ts

Floats = NDArray[np.float64]
Make = Callable[..., ts.Scene]
STEPS = (0.3, 0.6, 0.9, 1.2, 1.4, 1.6, 2.0, 3.0, 4.0)  # h omega
COUNTED = 20  # steps whose iterations are counted
SMALL = 1e-5  # displacement in m: within it the law is linear


def first_contraction(h_omega: float) -> float:
    """Of an iteration of the first step, implicit Euler, without damping."""
    return h_omega**2


def later_contraction(h_omega: float) -> float:
    """Of an iteration of a step of BDF2 after one of its own length."""
    return 4 / 9 * h_omega**2


def fastest_mode(scene: ts.Scene, rounds: int = 400) -> tuple[Floats, float]:
    """Shape (n, 3) of the fastest vibration, of length 1, and its frequency, by power iteration.

    Accelerations at a displaced shape are the velocities after a tiny step from rest.
    """
    h = 1e-6
    simulation = scene.replace(step=ts.SymplecticEuler(h), prescribed=[], gravity=None).compile()
    (name,) = simulation.bodies
    rest = simulation.meshes[name].points
    simulation.velocities[name][:] = 1.0
    simulation.step()  # what is held stops
    free = np.abs(simulation.velocities[name]) > 0.5
    mode = np.where(free, np.random.default_rng(5).normal(size=rest.shape), 0.0)
    omega2 = 0.0
    for _ in range(rounds):
        mode /= np.linalg.norm(mode)
        simulation.positions[name][:] = rest + SMALL * mode
        simulation.velocities[name][:] = 0.0
        simulation.step()
        pulled = -simulation.velocities[name] / (h * SMALL)
        omega2, mode = float((pulled * mode).sum()), pulled
    return mode / np.linalg.norm(mode), math.sqrt(omega2)


def residual_after(scene: ts.Scene, steps: list[float], iterations: int, speed: Floats) -> float:
    """Of the last of some steps, all of `iterations`, from rest with the speed of a mode [m/s]."""
    method = ts.BDF2FixedPoint(steps[0], iterations=iterations, tolerance=1e-15)
    simulation = scene.replace(step=method, prescribed=[], gravity=None).compile()
    (name,) = simulation.bodies
    simulation.velocities[name][:] = speed
    return [simulation.step(h) for h in steps][-1].residual


def contraction(scene: ts.Scene, steps: list[float], predicted: float, speed: Floats) -> float:
    """Residual after n + 1 iterations over that after n; not a number where it is refused."""
    few = 2 if predicted >= 1 else max(2, min(12, int(math.log(1e-6) / math.log(predicted))))
    try:
        before, after = (residual_after(scene, steps, n, speed) for n in (few, few + 1))
    except ts.TissuError:
        return math.nan
    return after / before


def iterations(scene: ts.Scene, first: float, h: float) -> tuple[str, float]:
    """Mean iterations of a step, or "refused"; and its median time [ms]."""
    simulation = scene.compile()
    try:
        simulation.step(first)
        simulation.clear_profile()
        reports = [simulation.step(h) for _ in range(COUNTED)]
    except ts.TissuError:
        return "refused", math.nan
    counted = np.mean([r.solver_iterations or r.newton_iterations for r in reports])
    missed = sum(not r.converged for r in reports)
    star = f", {missed} of {COUNTED} unsolved" if missed else ""
    return f"{counted:.1f}{star}", simulation.profile().p50_ms


def fixed_point_table(make: Make, values: tuple[float, ...] = STEPS) -> str:
    """For each h omega: contraction, iterations without and with Anderson, and cost."""
    lines = [
        "| h omega | first step: predicted | measured | later: predicted | measured | iterations "
        "| with Anderson's | ms a step | with Anderson's | bdf2, Newton: ms |",
        "|" + "---|" * 10,
    ]
    scene = make(ts.BDF2(1e-3))
    mode, omega = fastest_mode(scene)
    speed = SMALL * omega * mode
    for value in values:
        h, first = value / omega, min(value, 0.9) / omega
        starts = [h, h] if value <= 0.9 else [first, h, h]
        measured = [
            contraction(scene, [h], first_contraction(value), speed),
            contraction(scene, starts, later_contraction(value), speed),
        ]
        lines.append(f"| {value:g} | {_contractions(value, measured)} | {_costs(make, first, h)} |")
    return "\n".join(lines)


def _contractions(value: float, measured: list[float]) -> str:
    words = ["refused" if math.isnan(number) else f"{number:.3f}" for number in measured]
    first, later = first_contraction(value), later_contraction(value)
    return f"{first:.3f} | {words[0]} | {later:.3f} | {words[1]}"


def _costs(make: Make, first: float, h: float) -> str:
    falling = {"gravity": (0, 0, -9.81), "prescribed": []}
    counts, times = [], []
    newton = ts.BDF2(h, newton=ts.Newton(tolerance=1e-6))
    for step in (ts.BDF2FixedPoint(h), ts.BDF2FixedPoint(h, anderson=5), newton):
        count, cost = iterations(make(step, **falling), first, h)
        counts.append(count)
        times.append("–" if math.isnan(cost) else f"{cost:.1f}")
    return f"{counts[0]} | {counts[1]} | {times[0]} | {times[1]} | {times[2]}"
