"""What viscosity does to a compressed cube and to a turning one: prints docs/measured/viscosity.md.

    python bench/viscosity.py --picture docs/pictures/viscosity.png > docs/measured/viscosity.md

The compression of Chendeb 2007, sections 3.5 and 3.6: a cube of 50 mm between sliding planes,
St-Venant-Kirchhoff, E = 0.02 MPa, its force beside the closed form. Figure 3.8 shows the
oscillations gone at a small coefficient, figure 3.9 the error that a large one brings in.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tissu as ts

Floats = NDArray[np.float64]
SIDE, YOUNG, POISSON, DENSITY = 0.05, 2e4, 0.3, 1e3  # m, Pa, 1, kg/m3
SPEED, DEPTH, STEP = 0.15, 0.015, 1e-4  # m/s, m, s
ETAS = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0)
COEFFICIENTS = (1e4, 1e5, 3e5, 1e6, 3e6, 1e7, 3e7)
SHARES = (3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2)
SMALL, LARGE = 2, 4  # which of the coefficients the picture shows

HEAD = """# Viscosity

How much does each viscosity damp vibrations, and how much too stiff does it make a body under
compression? [The guide](../guide/viscosity.md) describes each viscosity and when to take it.

## A cube under compression

A cube of 50 mm is pressed by 15 mm at 150 mm/s: St-Venant-Kirchhoff with E = 0.02 MPa and nu = 0.3,
1000 kg/m3, 625 tetrahedra, three planes of symmetry. The cube slides on the planes, so the closed
form P = E/2 F (F^2 - 1) holds once the cube is at rest. The method is implicit Euler with 0.1 ms
and Newton's method. The paper presses at 1 mm/s. Its impact at the start is therefore 150 times
weaker, and so is the stress that a given viscosity adds: rho c v = 4.5 Pa there, {blow:.0f} Pa
here, of {largest:.0f} Pa at the end.

The tables compare the pressure from 5 % of compression on with the closed form. **Oscillation** is
the root mean square of the difference about its straight trend, and **bias** is its mean. Both are
in percent of the closed form's mean. A positive bias is too stiff.

![Pressure against compression](../pictures/viscosity.png)

"""

TAIL = """
## What to read from it

- Without viscosity the cube vibrates ({none:.1f} %). The damping of the time steps, omega^2 dt / 2,
  hardly changes this.
- Figure 3.8: `centroid` with c = {good_c:g} N s/m^4 takes the oscillation to
  {good_oscillation:.1f} % at a bias of {good_bias:.1f} %; `kelvin_voigt` does as much with eta =
  {good_eta:g} Pa s.
- Figure 3.9: with c = {bad_c:g} N s/m^4 the bias is {bad_bias:.0f} %. This bias is the
  stress of the viscosity, which is proportional to the speed and to the coefficient.
- Between these extremes, the slowest mode has a damping ratio of about 0.1 to 0.5. Here this is eta
  = 10 to 30 Pa s.
- The coefficient c of `centroid` is not a material property: the damping that it causes grows with
  the square of the cell size. On cells of half the size c must be four times as large: {coarse:.1f}
  % and {fine:.1f} % of oscillation with the same c on cells of 10 mm and 5 mm. The coefficient eta
  of `kelvin_voigt` is a material property.
- The paper's 1e-3 has no unit and cannot be compared.
"""

TURNING = """
## A body that turns

Which viscosities slow down the rotation of a whole body? The same cube is free and spins at one
turn a second, by implicit Euler with 1 ms and Newton's method. Entries are the share of its angular
momentum that remains after half a second, of what remains without viscosity:

| viscosity | left |
|---|---|
"""

METHODS = """
Whether the stiffness term of `rayleigh` does depends on [the
method](../guide/integrators.md#linearised-once). With 1 ms as above, in steps of 0.2 ms, the share
of its angular momentum that the cube keeps for half a second is

| method | left, without viscosity | left, rayleigh, stiffness 1 ms |
|---|---|---|
"""


@dataclass(frozen=True)
class Run:
    """A compression: stretch and pressure at each step."""

    stretch: Floats
    pressure: Floats

    @property
    def closed_form(self) -> Floats:
        """P = E/2 F (F^2 - 1), positive where it presses [Pa]."""
        return YOUNG / 2 * self.stretch * (1 - self.stretch**2)

    def figures(self) -> tuple[float, float]:
        """Oscillation and bias in percent of the mean pressure."""
        late = self.stretch < 0.95
        off = (self.pressure - self.closed_form)[late]
        place = self.stretch[late]
        trend = np.polyval(np.polyfit(place, off, 1), place)
        mean = self.closed_form[late].mean()
        return 100 * float((off - trend).std() / mean), 100 * float(off.mean() / mean)


def plane(axis: int, *, low: bool) -> ts.Box:
    """Nodes of the cube on a face across an axis."""
    edge = tuple((1e-9 if low else SIDE - 1e-9) if i == axis else None for i in range(3))
    return ts.Box(None, edge) if low else ts.Box(edge, None)


def cube(viscosity: Any, cells: int) -> ts.Body:
    """The cube of the paper."""
    mesh = ts.bar_mesh(size=(SIDE,) * 3, cells=(cells,) * 3, cell="tetra", split="five")
    law = ts.StVK(young=YOUNG, poisson=POISSON)
    return ts.Body(mesh=mesh, law=law, density=DENSITY, viscosity=viscosity)


def step() -> ts.ImplicitEuler:
    """Small steps, solved to the end."""
    return ts.ImplicitEuler(
        STEP, newton=ts.Newton(iterations=8, tolerance=1e-6), solver=ts.Cholesky()
    )


def pressed(viscosity: Any = None, cells: int = 5) -> Run:
    """The cube pressed at a constant speed."""
    time = DEPTH / SPEED
    simulation = ts.Scene(
        bodies={"cube": cube(viscosity, cells)},
        fixed=[ts.Fixed("cube", on=plane(i, low=True), axes="xyz"[i]) for i in range(3)],
        prescribed=[
            ts.Prescribed(
                "cube",
                on=plane(2, low=False),
                times=[0, time],
                displacements=[(0, 0, 0), (0, 0, -DEPTH)],
                axes="z",
            )
        ],
        step=step(),
    ).compile()
    base = simulation.meshes["cube"].points[:, 2] < 1e-9
    stretch, pressure = [], []
    for _ in range(round(time / STEP)):
        simulation.step()
        stretch.append(1 - SPEED * simulation.time / SIDE)
        pressure.append(simulation.reactions("cube")[base, 2].sum() / SIDE**2)
    return Run(np.array(stretch), np.array(pressure))


def spin_left(viscosity: Any, step: Any) -> float:
    """Share of its angular momentum that a free cube keeps for half a second at a turn a second."""
    simulation = ts.Scene(bodies={"cube": cube(viscosity, 3)}, step=step).compile()
    position, velocity = simulation.positions["cube"], simulation.velocities["cube"]
    mass = simulation.mass_matrix().diagonal().reshape(-1, 3)
    spin = np.array([0, 0, 2 * np.pi])
    velocity[:] = np.cross(spin, position - SIDE / 2)

    def moment() -> float:
        return float(np.cross(position - SIDE / 2, mass * velocity)[:, 2].sum())

    before = moment()
    for _ in simulation.run(0.5):
        pass
    return moment() / before


def print_spin(viscosities: list[tuple[str, Any]]) -> None:
    """Print which viscosities slow a turn, and by which methods Rayleigh's does."""
    print(TURNING, end="")
    step = ts.ImplicitEuler(1e-3, newton=ts.Newton())
    free = spin_left(None, step)
    for name, viscosity in viscosities:
        print(f"| {name} | {100 * spin_left(viscosity, step) / free:.2f} % |")
    print(METHODS, end="")
    for method in (
        *(ts.ImplicitEuler, ts.BDF2, ts.Newmark, ts.ImplicitMidpoint),
        *(ts.EnergyMomentum, ts.BDF2FixedPoint, ts.SymplecticEuler, ts.RK4),
    ):
        step = method(2e-4)
        found = [100 * spin_left(v, step) for v in (None, ts.Rayleigh(stiffness=1e-3))]
        print(f"| {step.type} | {found[0]:.2f} % | {found[1]:.2f} % |")


def row(name: str, unit: str, coefficient: float, run: Run) -> str:
    """A line of the table."""
    oscillation, bias = run.figures()
    return f"| {name} | {coefficient:g} {unit} | {oscillation:.2f} | {bias:+.2f} |"


def draw(path: Path, none: Run, runs: dict[str, dict[float, Run]]) -> None:
    """Small coefficient, large coefficient, and both figures against eta."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (small, large, both) = pyplot.subplots(1, 3, figsize=(14, 4.4), layout="constrained")
    compression = 100 * (1 - none.stretch)
    of_centroid = runs["centroid"]
    for panel, which, title in (
        (small, SMALL, "a small coefficient (figure 3.8)"),
        (large, LARGE, "a large coefficient (figure 3.9)"),
    ):
        c = COEFFICIENTS[which]
        panel.plot(compression, none.pressure / 1e3, color="0.7", lw=1, label="no viscosity")
        panel.plot(compression, none.closed_form / 1e3, "k--", lw=1.2, label="closed form")
        label = f"centroid, c = {c:g} N s/m$^4$"
        panel.plot(compression, of_centroid[c].pressure / 1e3, color="C3", lw=1.2, label=label)
        panel.set(title=title, xlabel="compression [%]", ylabel="pressure [kPa]")
        panel.legend(loc="upper left", frameon=False)
        panel.set_ylim(-0.5, 6.5)
    etas = list(runs["kelvin_voigt"])
    figures = np.array([run.figures() for run in runs["kelvin_voigt"].values()])
    both.loglog(etas, figures[:, 0], "o-", color="C0", label="oscillation")
    both.loglog(etas, np.abs(figures[:, 1]), "s-", color="C3", label="bias, positive or negative")
    both.axhline(none.figures()[0], color="0.7", lw=1, label="oscillation without viscosity")
    both.set(title="kelvin_voigt", xlabel="eta [Pa s]", ylabel="% of the mean pressure")
    both.legend(frameon=False)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Runs everything, prints the page and draws its picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--picture", type=Path)
    picture = parser.parse_args().picture
    none = pressed()
    runs = {
        "kelvin_voigt": {eta: pressed(ts.KelvinVoigt(eta=eta)) for eta in ETAS},
        "centroid": {c: pressed(ts.Centroid(coefficient=c)) for c in COEFFICIENTS},
        "rayleigh": {beta: pressed(ts.Rayleigh(stiffness=beta)) for beta in SHARES},
    }
    blow = DENSITY * np.sqrt(YOUNG / DENSITY) * SPEED
    print(HEAD.format(blow=blow, largest=none.closed_form[-1]), end="")
    print("| viscosity | coefficient | oscillation, % | bias, % |\n|---|---|---|---|")
    oscillation, bias = none.figures()
    print(f"| none | | {oscillation:.2f} | {bias:+.2f} |")
    units = {"kelvin_voigt": "Pa s", "centroid": "N s/m^4", "rayleigh": "s"}
    for name, of_kind in runs.items():
        for coefficient, run in of_kind.items():
            print(row(name, units[name], coefficient, run))
    c, large = COEFFICIENTS[SMALL], COEFFICIENTS[LARGE]
    good, bad = runs["centroid"][c].figures(), runs["centroid"][large].figures()
    fine = pressed(ts.Centroid(coefficient=c), cells=10).figures()[0]
    near = min(ETAS, key=lambda eta: abs(np.log(runs["kelvin_voigt"][eta].figures()[0] / good[0])))
    words = {
        **{"none": oscillation, "good_c": c, "good_oscillation": good[0], "good_bias": good[1]},
        **{"good_eta": near, "bad_c": large, "bad_bias": bad[1], "coarse": good[0], "fine": fine},
    }
    print(TAIL.format(**words), end="")
    print_spin(
        [
            ("none", None),
            (f"kelvin_voigt, eta {near:g} Pa s", ts.KelvinVoigt(eta=near)),
            (f"centroid, c {c:g} N s/m^4", ts.Centroid(coefficient=c)),
            ("rayleigh, stiffness 1 ms", ts.Rayleigh(stiffness=1e-3)),
            ("rayleigh, mass 1 1/s", ts.Rayleigh(mass=1.0)),
        ]
    )
    if picture is not None:
        draw(picture, none, runs)


if __name__ == "__main__":
    main()
