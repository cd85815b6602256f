"""Orders of convergence of surfaces in a plane and of lines, by manufactured solutions.

Surfaces lie in z = 0 and stay there, under plane strain and under plane stress; lines lie along x,
under uniaxial stress. A solution of the other setting, or of another thickness, does not converge
to the field: it shows as order 0. Theory and tolerance are those of test_convergence_orders;
between meshes of 6 and 18 cells along an edge the orders measured are at most 0.04 off, on meshes
drawn at random too.
"""

import numpy as np
import pytest

from distorted_flat import FLAT_MESHES
from order import Integrals, errors, orders
from shape_basis import LINES, ORDER, SURFACES, cubature, family, shapes

COUNTS = (6, 18)  # grid cells along an edge
TOLERANCE = 0.2
ROUND_OFF = 1e-14  # displacements of 0.1 m, some hundred unknowns
SETTLED = 1e-11  # what Newton's residual leaves
LAWS = ("hooke", "stvk")
ELEMENTS = [
    *((cell, setting) for setting in ("plane strain", "plane stress") for cell in SURFACES),
    *((cell, "uniaxial stress") for cell in LINES),
]


def kinds_of(cell):
    return [kind for kind in FLAT_MESHES if kind != "trapezoids" or cell in SURFACES]


def optimal_cases():
    """The eight-node quad holds all quadratics on regular meshes and on those of a smooth map."""
    return [
        (kind, cell, setting)
        for cell, setting in ELEMENTS
        for kind in kinds_of(cell)
        if cell != "quad8" or kind in ("regular", "smooth")
    ]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("kind", "cell", "setting"), optimal_cases())
def test_displacements_and_strains_converge_with_the_order_of_the_element(kind, cell, setting, law):
    found = [errors(FLAT_MESHES[kind](cell, n), cell, law, setting=setting) for n in COUNTS]
    p = ORDER[cell]
    assert orders(COUNTS, [e.displacement for e in found])[0] >= p + 1 - TOLERANCE, found
    assert orders(COUNTS, [e.strain for e in found])[0] >= p - TOLERANCE, found


@pytest.mark.parametrize("setting", ["plane strain", "plane stress"])
def test_the_eight_node_quad_loses_an_order_on_trapezoids(setting):
    # Arnold, Boffi and Falk, Math. Comp. 71 (2002): order r + 1 on trapezoids of one shape needs
    # all of Q_r on the reference square. Of a quadratic field only the lost term is left.
    counts = (4, 8, 16)
    make = FLAT_MESHES["trapezoids"]
    found = [
        errors(make("quad8", n), "quad8", "hooke", "quadratic", setting=setting) for n in counts
    ]
    displacement = orders(counts, [e.displacement for e in found])
    strain = orders(counts, [e.strain for e in found])
    assert 2 - TOLERANCE <= displacement[-1] < 2.5, (displacement, found)
    assert 1 - TOLERANCE <= strain[-1] < 1.5, (strain, found)
    assert displacement[-1] < displacement[-2] + TOLERANCE  # it does not recover
    regular = FLAT_MESHES["regular"]("quad8", 4)
    straight = errors(regular, "quad8", "hooke", "quadratic", setting=setting)
    assert straight.displacement < ROUND_OFF  # on parallelograms the field is in the space


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("cell", "setting"), ELEMENTS)
def test_affine_fields_are_met_exactly_on_curved_cells(cell, setting, law):
    for quadrature in ("full", "over"):
        mesh = FLAT_MESHES["smooth"](cell, 4)
        found = errors(mesh, cell, law, "affine", quadrature, setting)
        assert found.displacement < (ROUND_OFF if law == "hooke" else SETTLED), (quadrature, found)


@pytest.mark.parametrize(
    ("cell", "setting"), [pair for pair in ELEMENTS if pair[0] in ("triangle6", "quad9", "line3")]
)
def test_quadratic_fields_are_met_exactly_on_straight_cells(cell, setting):
    # A stress of third degree times a gradient needs more than the full rule: `over` for StVK.
    for law, quadrature, bound in (("hooke", "full", ROUND_OFF), ("stvk", "over", SETTLED)):
        mesh = FLAT_MESHES["jittered"](cell, 3)
        found = errors(mesh, cell, law, "quadratic", quadrature, setting)
        assert found.displacement < bound, (law, found)


@pytest.mark.parametrize("cell", [*SURFACES, *LINES])
def test_the_distorted_meshes_fill_the_square_and_are_distorted(cell):
    plain = FLAT_MESHES["regular"](cell, 4)
    for kind in kinds_of(cell)[1:]:
        mesh = FLAT_MESHES[kind](cell, 4)
        assert Integrals(mesh, cell).w.sum() == pytest.approx(1.0, rel=1e-13), kind
        assert np.abs(mesh.points - plain.points).max() > 0.02, kind  # of cells of 0.25
        assert not mesh.points[:, 1 + (cell in SURFACES) :].any()


@pytest.mark.parametrize("cell", [*SURFACES, *LINES])
def test_the_oracle_itself_holds_what_it_should(cell):
    points, weights = cubature(family(cell), 4)
    size = {"triangle": 0.5, "quad": 4, "line": 2}[family(cell)]
    assert weights.sum() == pytest.approx(size, rel=1e-14)
    values, gradients = shapes(cell, points)
    assert np.abs(values.sum(axis=1) - 1).max() < 1e-13
    h = 1e-6  # central differences: h^2 and round-off / h
    for axis in range(3):
        up, down = (shapes(cell, points + s * h * np.eye(3)[axis])[0] for s in (1, -1))
        assert np.abs((up - down) / (2 * h) - gradients[:, :, axis]).max() < 1e-8
