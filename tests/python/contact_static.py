"""Static steps with contact: what an independent evaluation of their end must find."""

import numpy as np

TOLERANCE = 1e-6
"""of the residual over the load: Newton's default"""


def pushed(simulation):
    """Take a static step, and judge its end from outside: no crossing, no force that pulls, none
    beyond Coulomb's disk, no depth, and balance of all forces on free rows. The report."""
    return judged(simulation, simulation.step())


def judged(simulation, report):
    assert report.converged, report
    assert simulation.crossings() == [], report
    found = simulation.contacts()
    normal = np.einsum("ij,ij->i", found.forces, found.normals)
    along = np.linalg.norm(found.forces - normal[:, None] * found.normals, axis=1)
    size = max(np.abs(normal).max(initial=0.0), 1e-300)
    assert normal.min(initial=0.0) >= -1e-12 * size
    friction = max(getattr(c, "friction", 0.0) for c in simulation.scene.contacts)
    assert (along <= friction * normal * (1 + 1e-9) + 1e-12 * size).all()
    if report.contacts:
        assert report.least_gap >= 0.999 - 1e-9  # 1e-3 of the gap is the step's tolerance
    assert report.residual <= TOLERANCE or "round-off" in report.message
    assert out_of_balance(simulation) <= 2 * max(TOLERANCE, report.residual)
    return report


def out_of_balance(simulation):
    """|forces that supports do not take| over |contact forces|."""
    forces = simulation.forces()
    left = [forces[simulation.rows(b)] + simulation.reactions(b) for b in simulation.bodies]
    load = np.linalg.norm(simulation.contacts().forces)
    return float(np.linalg.norm(np.concatenate(left)) / load)
