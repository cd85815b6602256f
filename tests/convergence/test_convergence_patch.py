"""Patch tests: constant strain on distorted cells, for every element, law and quadrature.

What is affine on the boundary is affine inside, the energy is W(F) times the volume, and the volume
that quadrature sees is that of the box.
"""

import numpy as np
import pytest

import tissu as ts
from distorted import MESHES
from order import cube, lead, on_faces, rested
from shape_basis import VOLUMES

LAMBDA, MU = 1.2, 0.8  # Pa
ENGINEERING = {"young": MU * (3 * LAMBDA + 2 * MU) / (LAMBDA + MU), "poisson": 0.3}
PARAMETERS = {
    "hooke": ENGINEERING,
    "stvk": ENGINEERING,
    "neo_hooke": ENGINEERING,
    "stable_neo_hooke": ENGINEERING,
    "mooney_rivlin": {"c1": 0.3, "c2": 0.1, "kappa": 1.7},
    "yeoh": {"c1": 0.4, "c2": 0.1, "c3": 0.05, "kappa": 1.7},
    "arruda_boyce": {"mu": 0.7, "lambda_m": 1.8, "kappa": 1.7},
}
# Stretches of 0.8 to 1.2, shear, and a little turn; det F = 1.02.
F = np.array([[1.15, 0.12, -0.05], [0.04, 0.85, 0.10], [-0.08, 0.06, 1.05]])
SHIFT = np.array([0.3, -0.2, 0.1])
# Newton stops at 1e-11 of forces of 1 Pa m2; stiffnesses are of 1 Pa times cells of half a metre.
SETTLED = 1e-10


def energy_density(law):
    """W(F) [Pa], written from the laws' publications; see docs/guide/own-laws.md."""
    C = F.T @ F
    J, I1 = np.linalg.det(F), np.trace(C)
    I2 = (I1**2 - np.trace(C @ C)) / 2
    Ibar1, Ibar2 = I1 * J ** (-2 / 3), I2 * J ** (-4 / 3)
    p = PARAMETERS[law]
    volumetric = p.get("kappa", 0.0) / 2 * (J - 1) ** 2
    if law in ("hooke", "stvk"):
        E = (F + F.T) / 2 - np.eye(3) if law == "hooke" else (C - np.eye(3)) / 2
        return LAMBDA / 2 * np.trace(E) ** 2 + MU * np.trace(E @ E)
    if law == "neo_hooke":
        return MU / 2 * (I1 - 3) - MU * np.log(J) + LAMBDA / 2 * np.log(J) ** 2
    if law == "stable_neo_hooke":  # Smith, de Goes and Kim 2018, equations 14 and 42
        mu, lam = 4 / 3 * MU, LAMBDA + 5 / 6 * MU
        alpha = 1 + mu / lam - mu / (4 * lam)
        rest = lam / 2 * (1 - alpha) ** 2
        return mu / 2 * (I1 - 3 - np.log((I1 + 1) / 4)) + lam / 2 * (J - alpha) ** 2 - rest
    if law == "mooney_rivlin":
        return p["c1"] * (Ibar1 - 3) + p["c2"] * (Ibar2 - 3) + volumetric
    if law == "yeoh":
        return sum(p[f"c{i}"] * (Ibar1 - 3) ** i for i in (1, 2, 3)) + volumetric
    terms = zip((1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750), range(1, 6), strict=True)
    series = sum(c / p["lambda_m"] ** (2 * i - 2) * (Ibar1**i - 3**i) for c, i in terms)
    return p["mu"] * series + volumetric


def off_affine(mesh, law, quadrature):
    """Largest distance [m] from the affine field that the boundary follows; and the simulation."""
    builder = cube(mesh, law, PARAMETERS[law], quadrature)
    affine = mesh.points @ F.T + SHIFT
    boundary = on_faces(mesh)
    assert len(boundary) < mesh.node_count  # there is something to be found
    lead(builder, boundary, affine - mesh.points)
    simulation = rested(builder)
    return np.abs(simulation.positions - affine).max(), simulation


@pytest.mark.parametrize("quadrature", ["full", "over"])
@pytest.mark.parametrize("law", PARAMETERS)
@pytest.mark.parametrize("cell", VOLUMES)
def test_an_affine_boundary_gives_an_affine_body_and_its_energy(cell, law, quadrature):
    off, simulation = off_affine(MESHES["jittered"](cell, 2), law, quadrature)
    assert off < SETTLED
    # At a minimum the error of the energy is that of the places squared: round-off is left.
    assert simulation.energy()["elastic"] == pytest.approx(energy_density(law), rel=1e-12)


@pytest.mark.parametrize("quadrature", ["full", "over"])
@pytest.mark.parametrize("cell", VOLUMES)
def test_curved_cells_pass_where_the_rule_is_exact_enough(cell, quadrature):
    # P cof(J) grad N has to be integrated exactly: of third degree on a curved tetra10, whose full
    # rule (four points, degree 2) is made for affine cells. Its error falls with the curvature.
    found = [off_affine(MESHES["smooth"](cell, n), "stvk", quadrature)[0] for n in (4, 8)]
    if (cell, quadrature) == ("tetra10", "full"):
        assert 1e-9 < found[1] < found[0] / 8, found  # of third order: below what it interpolates
    else:
        assert max(found) < SETTLED, found


@pytest.mark.parametrize("kind", MESHES)
@pytest.mark.parametrize("cell", VOLUMES)
def test_quadrature_sees_the_whole_volume(cell, kind):
    mesh = MESHES[kind](cell, 2)
    for quadrature in ("full", "over"):
        mass = cube(mesh, "stvk", PARAMETERS["stvk"], quadrature).build().mass
        assert mass == pytest.approx(1.0, rel=1e-13), quadrature  # 1 kg/m3; weights to round-off


@pytest.mark.parametrize("law", PARAMETERS)
def test_cells_of_every_shape_pass_together(law):
    segments = [(cell, "") for cell in ("hexahedron", "wedge", "pyramid", "tetra")]
    mesh = ts.mixed_bar_mesh(size=(1, 1, 1), cells=(4, 3, 3), segments=segments)
    inner = ((mesh.points > 1e-9) & (mesh.points < 1 - 1e-9)).all(axis=1)
    shift = np.random.default_rng(3).uniform(-0.02, 0.02, mesh.points.shape) * inner[:, None]
    mesh = ts.Mesh(points=mesh.points + shift, cells=mesh.cells)
    assert len({block.type for block in mesh.volume_blocks}) == 4
    off, simulation = off_affine(mesh, law, "full")
    assert off < SETTLED
    assert simulation.energy()["elastic"] == pytest.approx(energy_density(law), rel=1e-12)
