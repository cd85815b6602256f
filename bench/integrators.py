"""Prints docs/measured/integrators.md: orders and energies of every method: --write."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tissu as ts

sys.path.insert(0, str(Path(__file__).resolve().parent))
import itertools

from integrators_picture import draw
from integrators_text import END, HEAD, TAIL

Floats = NDArray[np.float64]
DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE, PICTURE = DOCS / "measured" / "integrators.md", DOCS / "pictures" / "integrators.png"
SOLVED = {"newton": ts.Newton(iterations=40, tolerance=1e-10), "solver": ts.Cholesky()}
ONCE = {"solver": ts.Cholesky()}
METHODS: dict[str, Callable[[float], Any]] = {
    "explicit_euler": lambda h: ts.ExplicitEuler(h),
    "symplectic_euler": lambda h: ts.SymplecticEuler(h),
    "rk2": lambda h: ts.RK2(h),
    "rk4": lambda h: ts.RK4(h),
    "implicit_euler": lambda h: ts.ImplicitEuler(h, **SOLVED),
    "implicit_midpoint": lambda h: ts.ImplicitMidpoint(h, **SOLVED),
    "newmark": lambda h: ts.Newmark(h, **SOLVED),
    "bdf2": lambda h: ts.BDF2(h, **SOLVED),
    "bdf2_fixed_point": lambda h: ts.BDF2FixedPoint(h, iterations=200, tolerance=1e-12),
}
LINEARISED_ONCE: dict[str, Callable[[float], Any]] = {
    "implicit_euler": lambda h: ts.ImplicitEuler(h, **ONCE),
    "implicit_midpoint": lambda h: ts.ImplicitMidpoint(h, **ONCE),
    "newmark": lambda h: ts.Newmark(h, **ONCE),
    "bdf2": lambda h: ts.BDF2(h, **ONCE),
}
EXPLICIT = ("explicit_euler", "symplectic_euler", "rk2", "rk4")
EDGE, YOUNG, POISSON, DENSITY = 0.1, 1e4, 0.3, 1e3  # of the oscillator: m, Pa, 1, kg/m3
DAMPING = 0.2  # of the oscillator for the orders, in omega
OSCILLATOR_STEPS = (40, 80, 160, 320)  # in a period
BAR_DAMPING = 1e-3  # stiffness' share of the bar's damping for the orders [s]
BAR_TIME, BAR_STEPS = 0.256, (320, 640, 1280, 2560)
TIP_SPEED = 0.6  # m/s
PER_PERIOD, PERIODS = (50, 200), 100


def omega_of_oscillator() -> float:
    """Closed form [rad/s]: k = (lambda + 4 mu) a / 9, a node's eighth of the mass rho a^3."""
    mu = YOUNG / (2 * (1 + POISSON))
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    return math.sqrt(8 * (lame + 4 * mu) / (9 * DENSITY * EDGE**2))


def oscillator(step: Any, damping: float = 0.0) -> ts.Simulation:
    """A hexahedron of which one node moves, along x; drawn out by a tenth of its edge."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(EDGE,) * 3, cells=(1, 1, 1), cell="hexahedron"),
        law=ts.Hooke(young=YOUNG, poisson=POISSON),
        density=DENSITY,
        viscosity=ts.Rayleigh(mass=damping) if damping else None,
    )
    held = [ts.Fixed("cell", on=ts.Nodes(range(7)))]
    guided = [ts.Fixed("cell", on=ts.Nodes([7]), axes="yz")]
    simulation = ts.Scene(bodies={"cell": body}, fixed=held + guided, step=step).compile()
    simulation.positions["cell"][7, 0] += EDGE / 10
    return simulation


def bar(step: Any, damping: float = 0.0) -> ts.Simulation:
    """A bar of four hexahedra, held at one end, struck: its speed is TIP_SPEED (x / L)^2."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.05, 0.05), cells=(4, 1, 1), cell="hexahedron"),
        law=ts.StVK(young=6e4, poisson=0.3),
        density=1e3,
        viscosity=ts.Rayleigh(stiffness=damping) if damping else None,
    )
    held = [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))]
    simulation = ts.Scene(bodies={"bar": body}, fixed=held, step=step).compile()
    share = simulation.meshes["bar"].points[:, 0] / 0.2
    simulation.velocities["bar"][:, 2] = TIP_SPEED * share**2
    return simulation


def oscillator_error(make: Callable[[float], Any], per_period: int) -> float:
    """After two periods, of x and v / omega, in amplitudes; the closed form is e^(-ct/2) cos."""
    omega = omega_of_oscillator()
    c = DAMPING * omega
    damped = math.sqrt(omega**2 - c**2 / 4)
    period = 2 * math.pi / omega
    simulation = oscillator(make(period / per_period), c)
    for _ in range(2 * per_period):
        simulation.step()
    t = 2 * period
    decay, turn = math.exp(-c * t / 2), damped * t
    x = decay * (math.cos(turn) + c / (2 * damped) * math.sin(turn))
    v = -decay * omega**2 / damped * math.sin(turn)
    amplitude = EDGE / 10
    found_x = simulation.displacements("cell")[7, 0] / amplitude
    found_v = simulation.velocities["cell"][7, 0] / amplitude
    return math.hypot(found_x - x, (found_v - v) / omega)


def bar_end(make: Callable[[float], Any], steps: int, damping: float = BAR_DAMPING) -> Floats:
    """Displacements of the bar after BAR_TIME [m]."""
    simulation = bar(make(BAR_TIME / steps), damping)
    for _ in range(steps):
        simulation.step()
    return np.array(simulation.displacements("bar"))


def bar_errors(
    make: Callable[[float], Any], reference: Floats, damping: float = BAR_DAMPING
) -> list[float]:
    """For each of BAR_STEPS, of the largest displacement."""
    size = np.abs(reference).max()
    ends = [bar_end(make, n, damping) for n in BAR_STEPS]
    return [float(np.abs(end - reference).max() / size) for end in ends]


def undamped_orders() -> str:
    """Of methods that are linearised once, where their tangent is whole."""
    reference = bar_end(METHODS["rk4"], 2 * BAR_STEPS[-1], 0.0)
    found = [
        f"{name} {orders(bar_errors(LINEARISED_ONCE[name], reference, 0.0))[-1]:.2f}"
        for name in ("implicit_midpoint", "newmark", "bdf2")
    ]
    return ", ".join(found)


def orders(errors: list[float]) -> list[float]:
    """From each halving of the step."""
    return [math.log2(a / b) for a, b in itertools.pairwise(errors)]


def energies(simulation: ts.Simulation, per_period: int, periods: int = PERIODS) -> Floats:
    """Of each step, in the energy of the start: a row for each period."""
    first = simulation.energy()["total"]
    shares = np.empty((periods, per_period))
    for share in shares.reshape(-1, 1):
        simulation.step()
        share[0] = simulation.energy()["total"] / first
    return shares


def bar_period() -> float:
    """Of the bar's slow swing [s]: from its first ten returns, with rk4."""
    simulation = bar(ts.RK4(5e-4))
    tip = []
    while simulation.time < 8.0:
        simulation.step()
        tip.append(simulation.displacements("bar")[4, 2])
    heights = np.array(tip)
    up = np.flatnonzero((heights[:-1] < 0) & (heights[1:] >= 0))
    crossings = up + heights[up] / (heights[up] - heights[up + 1])
    return float(np.diff(crossings[:11]).mean() * 5e-4)


def order_table(found: dict[str, list[float]], heads: list[str]) -> str:
    """Errors, and the order of the last halving."""
    lines = ["| method | " + " | ".join(heads) + " | order |", "|---" * (len(heads) + 2) + "|"]
    for name, errors in found.items():
        numbers = " | ".join(f"{error:.2e}" for error in errors)
        lines.append(f"| {name} | {numbers} | {orders(errors)[-1]:.2f} |")
    return "\n".join(lines)


def of_the_last(shares: Floats, period: int) -> str:
    """Mean share over a period, and how far it strays within."""
    row = shares[period - 1]
    if row.mean() < 1e-4:
        return f"{row.mean():.0e}"
    return f"{row.mean():.4f} ± {np.abs(row - row.mean()).max():.1e}"


def attempt(make: Callable[[float], ts.Simulation], h: float, per_period: int) -> Floats | str:
    """Energies of a run, or why it was refused."""
    try:
        return energies(make(h), per_period)
    except ts.TissuError as error:
        return str(error)


def stable_limit(found: str) -> str:
    """The limit that a refusal names."""
    for words in ("stable up to ", "take dt below "):
        if words in found:
            return f"refused above {1e3 * float(found.split(words)[1].split()[0]):.2g} ms"
    raise AssertionError(found)


def energy_table(
    problem: Callable[[Any], ts.Simulation], period: float
) -> tuple[str, dict[tuple[str, int], Floats]]:
    """Shares of the energy after 10 and 100 periods with each step; and the energies."""
    heads = [f"h = T/{n}: after {p}" for n in PER_PERIOD for p in (10, PERIODS)]
    lines = ["| method | " + " | ".join(heads) + " |", "|---" * (len(heads) + 1) + "|"]
    kept = {}
    for name, make in METHODS.items():
        entries = []
        for n in PER_PERIOD:
            found = attempt(lambda h, make=make: problem(make(h)), period / n, n)  # type: ignore[misc]
            if isinstance(found, str):
                entries += [stable_limit(found), "–"]
                continue
            kept[name, n] = found
            entries += [of_the_last(found, 10), of_the_last(found, PERIODS)]
        lines.append(f"| {name} | " + " | ".join(entries) + " |")
    return "\n".join(lines), kept


def own_steps(period: float) -> str:
    """Explicit methods on the bar with nine tenths of their stable step."""
    lines = ["| method | step [ms] | steps in T | after 10 | after 100 |", "|---" * 5 + "|"]
    for name in EXPLICIT[1:]:
        h = 0.9 * bar(METHODS[name]("auto")).stable_step  # type: ignore[arg-type]
        n = math.ceil(period / h)
        shares = energies(bar(METHODS[name](period / n)), n)
        ends = f"{of_the_last(shares, 10)} | {of_the_last(shares, PERIODS)}"
        lines.append(f"| {name} | {1e3 * period / n:.3g} | {n} | {ends} |")
    return "\n".join(lines)


def refusal() -> dict[str, Any]:
    """What explicit Euler says to the undamped oscillator, and what its limit is."""
    omega = omega_of_oscillator()
    auto = oscillator(ts.ExplicitEuler())
    try:
        oscillator(ts.ExplicitEuler(1.1 * auto.stable_step))
    except ts.SceneError as error:
        said = str(error).splitlines()[-1].lstrip("- ")
    return {"said": said, "limit": auto.stable_step, "closed": 0.02 / omega**2, "omega": omega}


def page() -> str:
    """The whole page; draws its picture."""
    of_oscillator = {
        name: [oscillator_error(make, n) for n in OSCILLATOR_STEPS]
        for name, make in METHODS.items()
    }
    reference = bar_end(METHODS["rk4"], 10 * BAR_STEPS[-1])
    of_bar = {name: bar_errors(make, reference) for name, make in METHODS.items()}
    once = {name: bar_errors(make, reference) for name, make in LINEARISED_ONCE.items()}
    period = 2 * math.pi / omega_of_oscillator()
    swing = bar_period()
    oscillator_table, oscillator_energies = energy_table(oscillator, period)
    bar_table, bar_energies = energy_table(bar, swing)
    draw(PICTURE, of_oscillator, OSCILLATOR_STEPS, of_bar, oscillator_energies, bar_energies)
    steps = [f"{1e3 * BAR_TIME / n:g} ms" for n in BAR_STEPS]
    parts = {
        "oscillator_orders": order_table(of_oscillator, [f"T/{n}" for n in OSCILLATOR_STEPS]),
        "bar_orders": order_table(of_bar, steps),
        "once_orders": order_table(once, steps),
        "oscillator_energies": oscillator_table,
        "bar_energies": bar_table,
        "own_steps": own_steps(swing),
        "undamped_orders": undamped_orders(),
        "swing": f"{swing:.4f}",
        "bar_omega": f"{bar(METHODS['rk4']('auto')).largest_frequency():.0f}",  # type: ignore[arg-type]
    }
    numbers = refusal()
    return HEAD.format(**parts) + TAIL.format(**numbers) + END


if __name__ == "__main__":
    text = page()
    if "--write" in sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)
