"""Prints docs/measured/explicit-implicit.md: explicit, implicit and fixed point: --write."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

sys.path.insert(0, str(Path(__file__).resolve().parent))
from explicit_implicit_text import (
    BY_HAND,
    END,
    EQUILIBRIUM,
    EXPLICIT,
    FIXED_POINT,
    HEAD,
    IMPLICIT,
    TAIL,
)
from faure_tables import PAPER_EXPLICIT, PAPER_IMPLICIT
from fixed_point import fixed_point_table

PAGE = Path(__file__).resolve().parents[1] / "docs" / "measured" / "explicit-implicit.md"
TIME, LEAD = 0.9, 0.05  # s, m
PAIRS = ((1e3, 1e5), (1e4, 1e5), (1e3, 1e4), (1e4, 1e4))  # kg/m3, Pa
LOST = 0.1  # m from the even stretch: the run has blown up
DAMPING, SETTLED = 10.0, 6.0  # of the equilibria: 1/s, s
GROWTH = 0.01  # 1/s: what explicit Euler is allowed


def cube(density: float, young: float, step: Any, **changes: Any) -> ts.Scene:
    """The cube of 1 m and 1000 hexahedra, held at x = 0 and led by 5 % at x = 1."""
    cells = changes.pop("cells", 10)
    body = ts.Body(
        mesh=ts.BarMesh(size=(1, 1, 1), cells=(cells,) * 3, cell="hexahedron"),
        law=ts.StVK(young=young, poisson=0.3),
        density=density,
        viscosity=changes.pop("viscosity", None),
    )
    lead = ts.Prescribed(
        "cube",
        on=ts.Plane((1, 0, 0), (1, 0, 0)),
        times=(0, TIME),
        displacements=[(0, 0, 0), (LEAD, 0, 0)],
    )
    fields = {
        "bodies": {"cube": body},
        "fixed": [ts.Fixed("cube", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "prescribed": [lead],
        "step": step,
    }
    return ts.Scene(**{**fields, **changes})


def growth(omega: float, h: float) -> float:
    """Of the fastest vibration over TIME by explicit Euler: (1 + h^2 omega^2)^(TIME / 2h)."""
    return math.exp(TIME / (2 * h) * math.log1p((h * omega) ** 2))


def euler_limit(omega: float) -> float:
    """Largest step of explicit Euler that lets no vibration grow by e in 100 s [s]."""
    return 2 * GROWTH / omega**2


def forward_euler(simulation: ts.Simulation, h: float) -> float:
    """Explicit Euler by hand to TIME: largest distance of a node from the even stretch [m].

    A step of symplectic Euler moves with the velocity of its end; the difference is taken back.
    Infinite where the run is given up.
    """
    rest = simulation.meshes["cube"].points
    free = np.flatnonzero((rest[:, 0] > 1e-9) & (rest[:, 0] < 1 - 1e-9))
    x, v = simulation.positions["cube"], simulation.velocities["cube"]
    try:
        for _ in range(round(TIME / h)):
            before = v[free]
            simulation.step(h)
            x[free] -= h * (v[free] - before)
    except ts.TissuError:
        return math.inf
    stretched = rest * (1 + np.array([LEAD, 0, 0]))
    return float(np.linalg.norm(x - stretched, axis=1).max())


def steps_cost(scene: ts.Scene, steps: int) -> float:
    """Median wall time of a step [ms], after some to warm up."""
    simulation = scene.compile()
    for _ in range(min(steps, 5)):
        simulation.step()
    simulation.clear_profile()
    for _ in range(steps):
        simulation.step()
    return simulation.profile().p50_ms


@dataclass
class Costs:
    """Wall time of single steps [ms]."""

    explicit: list[float]
    implicit: list[float]


def explicit_rows(pair: tuple[float, float], costs: Costs) -> list[str]:
    """Table 6.1 for a pair."""
    rest = cube(*pair, ts.SymplecticEuler()).compile()
    omega, rows = rest.largest_frequency(), []
    for h, paper in PAPER_EXPLICIT[pair].items():
        said = "not stable" if paper is None else f"{paper[0]:g} s, {paper[1]:g} ms"
        cost = steps_cost(cube(*pair, ts.SymplecticEuler(h)), 300)
        costs.explicit.append(cost)
        refused = "refused" if is_refused(pair, h) else "accepted"
        rows.append(
            f"| {pair[0]:g} | {pair[1]:g} | {h:g} | {said} | {h * omega:.4f} | "
            f"{growth(omega, h):.3g}, {refused} | {cost * TIME / h / 1e3:.2f} s, {cost:.3f} ms |"
        )
    rows.append(own_step_row(pair, costs))
    return rows


def is_refused(pair: tuple[float, float], h: float) -> bool:
    """Whether explicit Euler refuses the step."""
    try:
        cube(*pair, ts.ExplicitEuler(h)).compile()
    except ts.SceneError:
        return True
    return False


def own_step_row(pair: tuple[float, float], costs: Costs) -> str:
    """Symplectic Euler with nine tenths of its limit, run to the end."""
    simulation = cube(*pair, ts.SymplecticEuler()).compile()
    omega, h = simulation.largest_frequency(), simulation.dt
    steps = sum(1 for _ in simulation.run(TIME))
    cost = simulation.profile().p50_ms
    costs.explicit.append(cost)
    return (
        f"| {pair[0]:g} | {pair[1]:g} | **{h:.2g}** | | {h * omega:.2f} | | "
        f"**{cost * steps / 1e3:.3f} s**, {cost:.3f} ms |"
    )


def limits() -> str:
    """Limits of each pair."""
    lines = [
        "| density | E [Pa] | omega [1/s] | paper: 2 sqrt(m/E), m = 1 m^3 rho | 2/omega [s] "
        "| symplectic Euler accepts [s] | explicit Euler accepts [s] |",
        "|---|---|---|---|---|---|---|",
    ]
    for density, young in PAIRS:
        simulation = cube(density, young, ts.SymplecticEuler()).compile()
        euler = cube(density, young, ts.ExplicitEuler()).compile()
        omega = simulation.largest_frequency()
        lines.append(
            f"| {density:g} | {young:g} | {omega:.1f} | {2 * math.sqrt(density / young):.2g} "
            f"| {2 / omega:.4f} | {simulation.stable_step:.4f} | {euler.stable_step:.2g} |"
        )
    return "\n".join(lines)


def explicit_table(costs: Costs) -> str:
    """Table 6.1."""
    head = (
        "| density | E [Pa] | h [s] | paper | h omega | explicit Euler: growth in 0.9 s "
        "| symplectic Euler: 0.9 s, a step |"
    )
    rows = [row for pair in PAIRS for row in explicit_rows(pair, costs)]
    return "\n".join([head, "|" + "---|" * 7, *rows])


def by_hand_table() -> str:
    """Explicit Euler on regardless: the paper's largest step, doubled until it is lost."""
    lines = [
        "| density | E [Pa] | paper: not stable | off the even stretch | still holds at | growth "
        "| blows up at | growth |",
        "|" + "---|" * 8,
    ]
    for pair in PAIRS:
        omega = cube(*pair, ts.SymplecticEuler()).compile().largest_frequency()
        listed = h = max(PAPER_EXPLICIT[pair])
        found = []
        while not found or found[-1] < LOST:
            found.append(forward_euler(cube(*pair, ts.SymplecticEuler(h)).compile(), h))
            h *= 2
        lost = h / 2
        held = f"{lost / 2:g} s | {growth(omega, lost / 2):.2g}" if len(found) > 1 else "– | –"
        off = f"{1e3 * found[0]:.1f} mm" if found[0] < LOST else "blows up"
        lines.append(
            f"| {pair[0]:g} | {pair[1]:g} | {listed:g} s | {off} | {held} "
            f"| {lost:g} s | {growth(omega, lost):.2g} |"
        )
    return "\n".join(lines)


def implicit_table(costs: Costs) -> str:
    """Table 6.2."""
    lines = [
        "| density | E [Pa] | h [s] | paper | steps | 0.9 s | a step | iterations a step |",
        "|" + "---|" * 8,
    ]
    for pair in PAIRS:
        for h, (seconds, per_step) in PAPER_IMPLICIT[pair].items():
            simulation = cube(*pair, ts.ImplicitEuler(h)).compile()
            reports = list(simulation.run(TIME))
            assert all(report.converged for report in reports)
            cost = float(np.median([report.milliseconds for report in reports]))
            costs.implicit.append(cost)
            mean = np.mean([report.solver_iterations for report in reports])
            lines.append(
                f"| {pair[0]:g} | {pair[1]:g} | {h:g} | {seconds:g} s, {per_step:g} ms "
                f"| {len(reports)} | {cost * len(reports) / 1e3:.3f} s | {cost:.1f} ms "
                f"| {mean:.0f} |"
            )
    return "\n".join(lines)


def equilibrium(step: Any, changes: dict[str, Any]) -> np.ndarray:
    """Displacements of the damped cube once it is at rest [m]."""
    viscosity = None if isinstance(step, ts.Static) else ts.Rayleigh(mass=DAMPING)
    simulation = cube(*PAIRS[0], step, viscosity=viscosity, **changes).compile()
    for _ in simulation.run(SETTLED):
        pass
    return np.array(simulation.displacements("cube"))


def equilibrium_table() -> str:
    """How far the two methods are apart at rest."""
    falling = {"gravity": (0, 0, -9.81), "prescribed": []}
    lines = [
        "| test | paper | largest displacement | explicit beside implicit, farthest node |",
        "|---|---|---|---|",
    ]
    for name, paper, changes in (("gravity", 6, falling), ("traction", 1, {})):
        explicit = equilibrium(ts.SymplecticEuler(), changes)
        implicit = equilibrium(ts.ImplicitEuler(0.1), changes)
        apart = 1e6 * np.linalg.norm(explicit - implicit, axis=1).max()
        size = 1e3 * np.linalg.norm(implicit, axis=1).max()
        lines.append(f"| {name} | {paper} um | {size:.1f} mm | {apart:.1g} um |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    costs = Costs([], [])
    rest = cube(*PAIRS[0], ts.SymplecticEuler()).compile()
    omega = rest.largest_frequency()
    parts = [
        HEAD + limits(),
        EXPLICIT.format(ratio=rest.dt / 5e-5, limit=euler_limit(omega)) + explicit_table(costs),
        BY_HAND + by_hand_table(),
        IMPLICIT + implicit_table(costs),
        TAIL.format(
            ratio=np.mean(costs.implicit) / np.mean(costs.explicit),
            explicit=np.mean(costs.explicit),
            implicit=np.mean(costs.implicit),
        ),
        EQUILIBRIUM + equilibrium_table(),
        FIXED_POINT + fixed_point_table(lambda step, **c: cube(*PAIRS[0], step, **c)),
        END + machine_line() + "\n",
    ]
    return "\n\n".join(parts)


if __name__ == "__main__":
    text = page()
    if "--write" in sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)
