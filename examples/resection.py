"""An aspirator works its way into an organ: what is near its tip is removed while it presses.

Prints the force on the tip before and after every removal, and how many cells are left.

    python examples/resection.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import tissu as ts

SCENE = Path(__file__).with_name("palpation.yaml")
TIP = (-0.046, 0.006, 0.082)
"""middle of the round end at rest [m]"""
RADIUS = 0.012
"""of the tip [m]"""
REACH = 0.02
"""Cells whose middle is nearer than that to the middle of the end are removed [m]."""
EVERY = 0.1
"""time between two removals [s]"""


def scene() -> ts.Scene:
    """The scene of palpation.yaml, in which cells may be removed."""
    return ts.Scene.from_yaml(SCENE).replace(name="resection", editing=True)


def near_tip(simulation: ts.Simulation) -> np.ndarray:
    """Numbers of the cells near the tip where both are now."""
    tip = simulation.obstacle("probe").place_of(TIP)
    places = simulation.positions["organ"]
    blocks = simulation.meshes["organ"].volume_blocks
    middles = np.concatenate([places[block.nodes].mean(axis=1) for block in blocks])
    near = np.linalg.norm(middles - tip, axis=1) < REACH
    return np.asarray(simulation.remaining_cells("organ")[near])


def work(simulation: ts.Simulation) -> None:
    """Steps to the end; every tenth of a second what presses the probe is removed."""
    then = EVERY
    for _ in simulation.run():
        if simulation.time < then - 1e-9:
            continue
        then += EVERY
        before = simulation.force_on("probe").force
        if not before.any():
            continue
        simulation.remove_cells(body="organ", cells=near_tip(simulation))
        after = simulation.force_on("probe").force
        left = simulation.meshes["organ"].cell_count
        print(
            f"t = {simulation.time:.2f} s: {before[2]:.3f} N, then {after[2]:.3f} N; {left} cells"
        )


def main() -> None:
    """Runs it."""
    simulation = scene().compile()
    work(simulation)
    print(len(simulation.crossings()), "places cross")


if __name__ == "__main__":
    main()
