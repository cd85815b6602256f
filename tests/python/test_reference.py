"""Independent reference values: the static bar, node by node on the same meshes, and its limit."""

import re
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

FOLDER = Path(__file__).parents[1] / "reference"
CELL = {"hex8": "hexahedron", "tet4": "tetra", "tet4_5": "tetra"}
LAWS = {"hooke": ts.Hooke, "stvk": ts.StVK}
PRINTED = 1e-7  # m: twice what the seven printed digits of the reference leave open
ROUND_OFF = 1e-9  # m: Newton's tolerance on half a metre


def static_bar(mesh, law, poisson, quadrature="full"):
    body = ts.Body(
        mesh=mesh,
        law=LAWS[law](young=1e8, poisson=poisson),
        density=1000.0,
        quadrature=quadrature,
    )
    scene = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Box((None, None, None), (1e-9, None, None)))],
        gravity=(0.0, -9.81, 0.0),
        step=ts.Static(solver=ts.Cholesky(), newton=ts.Newton(iterations=20, tolerance=1e-10)),
    )
    simulation = scene.compile()
    report = simulation.step()
    assert report.converged, report
    return simulation.displacements("bar")


def same_mesh_cases():
    cases = []
    for path in sorted(FOLDER.glob("A_mesh_*.npz")):
        found = re.fullmatch(r"A_mesh_[\dx]+_(hex8|tet4_5|tet4)_nu(\d\d)(_exact.*)?", path.stem)
        exact = found[3] is not None
        for law in [name for name in LAWS if f"u_{name}" in np.load(path)]:
            case = (path, found[1], int(found[2]) / 10, exact, law)
            cases.append(pytest.param(*case, id=f"{path.stem}-{law}"))
    return cases


@pytest.mark.parametrize(("path", "kind", "poisson", "exact", "law"), same_mesh_cases())
def test_displacements_on_the_same_mesh(path, kind, poisson, exact, law):
    data = np.load(path)
    cells = data["elements"].astype(np.int32)
    mesh = ts.Mesh(points=data["nodes"], cells=(ts.CellBlock(CELL[kind], cells),))
    found = static_bar(mesh, law, poisson, "over" if exact else "full")
    assert np.abs(found - data[f"u_{law}"]).max() < (ROUND_OFF if exact else PRINTED)


def test_refinement_converges_to_the_reference_of_the_bar():
    # Trilinear hexahedra: displacements of second order. The reference carries 7e-7 m.
    errors = []
    for n in (2, 4, 8):
        mesh = ts.bar_mesh(
            size=(8, 1, 1), cells=(6 * n, n, n), cell="hexahedron", origin=(0, -0.5, -0.5)
        )
        tip = np.linalg.norm(mesh.points - [8, 0, 0], axis=1).argmin()
        errors.append(static_bar(mesh, "stvk", 0.0)[tip, 1] + 0.607597371697848)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.array(errors) > 0)  # too stiff, from above
    assert orders[1] > 1.9, (errors, orders)
    # Extrapolated with the order 2 of the element: what is left is of the next order, h^2 smaller.
    extrapolated = errors[2] + (errors[2] - errors[1]) / 3.0
    assert abs(extrapolated) < errors[2] / 10.0, (errors, extrapolated)


def test_the_reference_is_there():
    assert len(same_mesh_cases()) == 16  # 8 files with two laws each
