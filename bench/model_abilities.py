"""Prints docs/measured/models.md: what models say and what they do: --write, --check.

The words come from the models' classes (`_core.models`), the figures are measured here on a cube of
tetrahedra. `--check` compares the words only: figures of time differ from machine to machine.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.compile.model import models

PAGE = Path(__file__).resolve().parents[1] / "docs" / "measured" / "models.md"
YOUNG = 20e3  # Pa
SIDE = 0.05  # m
CAN = {"yes": "yes", "partly": "partly", "no": "no"}

HEAD = """# Models

What can each model represent? The table gives what the classes of the models declare, and, in
italics, a measurement. [The guide](../guide/models.md) describes each model and when to take it.

The measurements were made by `python bench/model_abilities.py --write` on a cube of 162 tetrahedra
with E = 20 kPa, nu = 0.3. [Frames](frames.md) and [shells](shells.md) have their own pages.

![Error against time of examples/beam.yaml](../pictures/compare.png)

The picture was drawn by `tissu compare examples/beam.yaml`. Cells of this size are too coarse for
bending, and that error is the same for all forms of one energy. Springs have an additional error,
because their stiffness differs.

Related pages are [the bar of 8 m with every model](model-bars.md), [the cost of a tetrahedron in
three forms](models-cost.md), [condensed linear bodies](condensed.md), [the modulus of
springs](apparent-modulus.md) and [viscosity](viscosity.md).

"""


def low(axis: int) -> ts.Box:
    """The plane where a coordinate is zero."""
    return ts.Box((None,) * 3, tuple(1e-9 if i == axis else None for i in range(3)))


def law(name: str, poisson: float) -> ts.StVK | ts.Hooke:
    """The law a model is asked for: StVK where it takes it."""
    taken = models()[name].laws
    return (ts.StVK if not taken or "stvk" in taken else ts.Hooke)(young=YOUNG, poisson=poisson)


def cube(name: str, *, poisson: float = 0.3, F: float = 1.0, **changes: object) -> ts.Scene:
    """The cube between planes of symmetry, its top led to the stretch F in steps of 5 %."""
    steps = max(1, int(np.ceil(abs(F - 1) / 0.05)))
    times = [float(t) for t in range(steps + 1)]
    model = ts.Condensed(keep="surface") if name == "condensed" else name
    fields: dict[str, object] = {
        "bodies": {
            "cube": ts.Body(
                mesh=ts.BarMesh(size=(SIDE,) * 3, cells=(3, 3, 3), cell="tetra"),
                law=law(name, poisson),
                density=1000,
                model=model,
            )
        },
        "fixed": [ts.Fixed("cube", on=low(i), axes="xyz"[i]) for i in range(3)],
        "prescribed": [
            ts.Prescribed(
                "cube",
                on=ts.Box((None, None, SIDE - 1e-9), (None,) * 3),
                times=times,
                displacements=[(0, 0, (F - 1) * SIDE * t / steps) for t in times],
                axes="z",
            )
        ],
        "step": ts.Static(solver=ts.Cholesky(), newton=ts.Newton(iterations=60, tolerance=1e-9)),
        "duration": steps,
    }
    return ts.Scene(**{**fields, **changes})  # type: ignore[arg-type]


def stretched(name: str, poisson: float, F: float) -> tuple[float, float]:
    """Force over E A, and contraction across over stretch along; not a number where it fails."""
    simulation = cube(name, poisson=poisson, F=F).compile()
    try:
        if not all([report.converged for report in simulation.run()]):
            return float("nan"), float("nan")
    except ts.Diverged:
        return float("nan"), float("nan")
    rest = simulation.meshes["cube"].points
    top, side = rest[:, 2] > SIDE - 1e-9, rest[:, 0] > SIDE - 1e-9
    force = simulation.reactions("cube")[top, 2].sum() / (YOUNG * SIDE**2)
    across = simulation.displacements("cube")[side, 0].mean() / SIDE
    return float(force), float(-across / (F - 1))


def of_poisson(name: str) -> str:
    """Contraction of a cube stretched by 0.1 %, for two ratios."""
    found = [stretched(name, poisson, 1.001)[1] for poisson in (0.3, 0.45)]
    return f"0.3 gives {found[0]:.3f}, 0.45 gives {found[1]:.3f}"


def of_rotation(name: str) -> str:
    """Energy of a quarter turn, over that of a strain of one tenth."""
    simulation = cube(name).compile()
    here, rest = simulation.positions["cube"], simulation.meshes["cube"].points
    here[:] = rest * [1.1, 1.0, 1.0]
    scale = simulation.energy()["elastic"]
    here[:] = rest @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    share = abs(simulation.energy()["elastic"]) / scale
    return (
        f"a quarter turn costs {share:.0e} of a tenth of strain"
        if share < 1e-3
        else (f"a quarter turn costs {share:.0f} times a tenth of strain")
    )


def of_strain(name: str) -> str:
    """Force at two stretches, over E A."""

    def show(F: float) -> str:
        force = stretched(name, 0.3, F)[0]
        return f"{force:+.3f}" if np.isfinite(force) else "no equilibrium"

    return f"force / E A at stretch 0.7: {show(0.7)}, 1.5: {show(1.5)}"


def mirrored(model: object, made: ts.StVK | ts.Hooke | ts.StableNeoHooke) -> str:
    """Where a tetrahedron goes whose top starts at nine tenths of its mirror image."""
    points = SIDE * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    mesh = ts.Mesh(points=points, cells=(ts.CellBlock("tetra", np.array([[0, 1, 2, 3]])),))
    body = ts.Body(mesh=mesh, law=made, density=1000, model=model, viscosity=ts.Rayleigh(mass=5.0))
    scene = ts.Scene(
        bodies={"cell": body},
        fixed=[ts.Fixed("cell", on=ts.Nodes([0, 1, 2]))],
        step=ts.ImplicitEuler(0.005, newton=ts.Newton(iterations=20), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    simulation.positions["cell"][3, 2] = -0.9 * SIDE
    try:
        for _ in range(600):
            simulation.step()
    except ts.Diverged:
        return "stops with `Diverged`"
    top = simulation.positions["cell"][3] / SIDE
    if np.abs(top - [0, 0, 1]).max() < 1e-3:
        return "comes back"
    return "stays inside out" if top[2] < 0 else f"rests at {top.round(2)}"


def of_inversion(name: str) -> str:
    """A tetrahedron pushed through its base, held by that base."""
    kept = ts.Condensed(keep="surface") if name == "condensed" else name
    found = f"a cell pushed through its base {mirrored(kept, law(name, 0.3))}"
    if name != "fem":
        return found
    stable = mirrored("fem", ts.StableNeoHooke(young=YOUNG, poisson=0.3))
    return f"with stvk {found}, with stable_neo_hooke it {stable}"


def of_topology(name: str) -> str:
    """Whether a cell can be taken out while it runs."""
    scene = cube(name, prescribed=[], editing=True, step=ts.ImplicitEuler(0.01))
    simulation = scene.compile()
    simulation.step()
    simulation.remove_cells(body="cube", cells=[5])
    simulation.step()
    return "one of 162 cells goes between two steps"


MEASURES: dict[str, tuple[str, Callable[[str], str]]] = {
    "poisson": ("Poisson's ratio", of_poisson),
    "rotation": ("large rotations", of_rotation),
    "strain": ("large strains", of_strain),
    "inversion": ("inverted cells", of_inversion),
    "topology": ("topology change", of_topology),
}


UNMEASURED = {"shell": tuple(MEASURES), "frames": tuple(MEASURES)}
"""nodes that turn are not held by planes of symmetry alone: shells.md and frames.md do"""


def measured(name: str, key: str) -> str:
    """In italics, behind the words."""
    return "" if key in UNMEASURED.get(name, ()) else f". *{MEASURES[key][1](name)}*"


def words(name: str) -> str:
    """What a class says: laws, cells, and whether it can."""
    info = models()[name]
    laws = f"the laws {', '.join(info.laws)}" if info.laws else "any law"
    cells = f"the cells {', '.join(info.elements)}" if info.elements else "any cell"
    said = " ".join(
        f"{MEASURES[key][0][:1].upper()}{MEASURES[key][0][1:]}: {CAN[can]} ({how})."
        for key, (can, how) in info.abilities.items()
    )
    return f"**`{name}`**: {info.form}. It takes {laws} and {cells}. {said}"


def cell_bytes(name: str) -> str:
    """Of the model, for each cell of the cube; nothing where it takes none of its cells."""
    if name == "shell":
        return ""
    simulation = cube(name).compile()
    return f"{simulation.model_bytes() / simulation.meshes['cube'].cell_count:.0f}"


def table() -> str:
    """Abilities and what was measured, a row for each model."""
    heads = [title for title, _ in MEASURES.values()]
    lines = [f"| model | {' | '.join(heads)} | bytes a cell |", "|---" * (len(heads) + 2) + "|"]
    for name, info in models().items():
        cells = []
        for key in MEASURES:
            can, how = info.abilities[key]
            cells.append(f"{CAN[can]}: {how}{measured(name, key)}")
        lines.append(f"| `{name}` | {' | '.join(cells)} | {cell_bytes(name)} |")
    return "\n".join(lines)


def page() -> str:
    """The whole page."""
    listed = "\n".join(f"- {words(name)}" for name in models())
    return f"{HEAD}{table()}\n\n## As the classes declare it\n\n{listed}\n"


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        text = PAGE.read_text(encoding="utf-8")
        missing = [name for name in models() if words(name) not in text]
        sys.exit(
            f"docs/measured/models.md is not current for {', '.join(missing)}" if missing else 0
        )
    if "--write" in sys.argv[1:]:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        print(page())
