"""How far points give way in a step: against the dense inverse, for every way, world and thread."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

TARGET = (0.04, 0.04, 0.05)
POINTS = (([62], [1.0]), ([56, 57, 61], [0.5, 0.3, 0.2]))
"""The middle of the top, and a point between three nodes of it."""


def scene(law: Any = None, **changes: Any) -> ts.Scene:
    """A block of tissue on a floor, pulled down by its weight."""
    block = ts.Body(
        mesh=ts.BarMesh(size=(0.08, 0.08, 0.04), cells=(4, 4, 2)),
        law=law or ts.NeoHooke(young="5 kPa", poisson=0.3),
        density=1050,
        viscosity=ts.Rayleigh(mass=5, stiffness="10 ms"),
    )
    made = ts.Scene(
        bodies={"block": block},
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
    )
    return made.replace(**changes)


def axes(seed: int = 3) -> np.ndarray:
    """Three directions for each point, at right angles, not those of space."""
    random = np.random.default_rng(seed)
    return np.array([np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in POINTS])


def found(simulation: ts.Simulation, compliance: ts.Compliance, at: Any = POINTS) -> np.ndarray:
    """W of the points."""
    nodes, weights = zip(*at, strict=True)
    return compliance.of(["block"] * len(at), nodes, weights, axes()[: len(at)])


def dense(simulation: ts.Simulation, at: Any = POINTS, *, static: bool = False) -> np.ndarray:
    """W by a dense solve of the matrices of SciPy."""
    h = simulation.dt
    A = simulation.stiffness()
    if not static:
        A = simulation.mass_matrix() + h * simulation.damping() + h**2 * A
    free = simulation.free_axes().ravel()
    H = np.zeros((3 * len(at), len(free)))
    for i, ((nodes, weights), D) in enumerate(zip(at, axes(), strict=False)):
        for node, weight in zip(nodes, weights, strict=True):
            H[3 * i : 3 * i + 3, 3 * node : 3 * node + 3] += weight * D
    A, H = A.toarray()[np.ix_(free, free)], H[:, free]
    return np.asarray((1.0 if static else h**2) * H @ np.linalg.solve(A, H.T))


def relative(W: np.ndarray, exact: np.ndarray) -> float:
    """Largest error of a direction's own compliance, and of any other in its measure."""
    size = np.sqrt(np.outer(np.diag(exact), np.diag(exact)))
    return float((np.abs(W - exact) / size).max())


def test_a_factor_of_the_matrix_itself_is_exact() -> None:
    """W against the dense inverse to 1e-10; symmetric to the bit, positive definite."""
    simulation = scene().compile()
    for _ in range(5):
        simulation.step()
    compliance = simulation.compliance()
    W = found(simulation, compliance)
    assert compliance.factors == 1 and compliance.error == 0.0 and compliance.definite
    assert relative(W, dense(simulation)) < 1e-10
    assert W.tobytes() == np.ascontiguousarray(W.T).tobytes()
    assert np.linalg.eigvalsh(W).min() > 0.0


@pytest.mark.parametrize("tolerance", [1e-2, 1e-5, 1e-9])
def test_a_kept_factor_knows_its_error(tolerance: float) -> None:
    """While the block falls and rings: W is never above the exact one, and within the bound."""
    simulation = scene().compile()
    compliance = simulation.compliance(tolerance=tolerance)
    kept = 0
    for _ in range(16):
        simulation.step()
        W, exact = found(simulation, compliance), dense(simulation)
        short = exact - W  # R^T A^-1 R, which is positive semi-definite
        assert np.linalg.eigvalsh(short).min() > -1e-10 * np.trace(exact)
        assert (np.diag(short) <= (compliance.error + 1e-10) * np.diag(exact)).all()
        assert compliance.error <= tolerance
        kept += compliance.error > 0.0
    assert kept > 0 or tolerance < 1e-4
    assert compliance.factors < 16


def test_the_same_bits_on_one_and_two_threads() -> None:
    """Of a factor that is made, kept and corrected."""
    bits = []
    for threads in (1, 2):
        simulation = scene(threads=threads).compile()
        compliance = simulation.compliance(tolerance=1e-4)
        steps = []
        for _ in range(12):
            simulation.step()
            steps.append(found(simulation, compliance).tobytes())
        bits.append(steps)
    assert bits[0] == bits[1]


def test_the_conjugate_gradient_is_within_its_tolerance() -> None:
    """Nothing is factored."""
    simulation = scene().compile()
    compliance = simulation.compliance(by="cg", tolerance=1e-4)
    for _ in range(5):
        simulation.step()
        W, exact = found(simulation, compliance), dense(simulation)
        assert 0.0 < compliance.error <= 1e-4
        assert relative(W, exact) <= 1e-4
    assert compliance.factors == 0 and compliance.corrections > 0


def test_a_table_is_exact_where_the_stiffness_does_not_change() -> None:
    """Hooke's law: one table for all steps."""
    simulation = scene(ts.Hooke(young="5 kPa", poisson=0.3)).compile()
    compliance = simulation.compliance(by="condensed")
    for _ in range(3):
        simulation.step()
        assert relative(found(simulation, compliance), dense(simulation)) < 1e-10
    assert compliance.factors == 1


def test_a_warped_table_turns_with_the_body() -> None:
    """A corotational block turned by hand: W turns with it, to round-off."""
    corotational = ts.Hooke(young="5 kPa", poisson=0.3)
    base = scene(corotational, fixed=[], gravity=(0, 0, 0))
    body = base.bodies["block"].replace(model=ts.Corotational())
    simulation = base.replace(bodies={"block": body}).compile()
    warped = simulation.compliance(by="warped")
    exact = simulation.compliance()
    assert relative(found(simulation, warped), found(simulation, exact)) < 1e-9
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    simulation.positions["block"][:] = simulation.positions["block"] @ turn.T
    assert relative(found(simulation, warped), found(simulation, exact)) < 1e-6
    assert np.isnan(warped.error)


def test_at_rest_it_is_the_static_one() -> None:
    """H K^-1 H^T of a static method."""
    simulation = scene(step=ts.Static()).compile()
    simulation.step()
    compliance = simulation.compliance()
    assert relative(found(simulation, compliance), dense(simulation, static=True)) < 1e-9
    assert relative(found(simulation, compliance), dense(simulation, static=True)) < 1e-9


def test_what_is_grabbed_gives_way_less() -> None:
    """The spring of a grab is a part of the step's matrix, and of a kept factor's."""
    simulation = scene(grabbing=True).compile()
    compliance = simulation.compliance(tolerance=1e-3)
    simulation.step()
    free = found(simulation, compliance)
    grab = simulation.grab("block", 62, TARGET, stiffness=500.0)
    simulation.step()
    held = found(simulation, compliance)
    assert relative(held, dense(simulation)) <= 1e-3
    assert held[0, 0] < 0.5 * free[0, 0]
    grab.release()
    simulation.step()
    assert relative(found(simulation, compliance), dense(simulation)) <= 1e-3


def test_held_directions_give_way_by_zero() -> None:
    """A node of the floor."""
    simulation = scene().compile()
    simulation.step()
    W = found(simulation, simulation.compliance(), (([0], [1.0]), POINTS[0]))
    assert not W[:3].any() and not W[:, :3].any()
    assert (np.diag(W)[3:] > 0.0).all()


def test_a_world_that_was_edited_is_found_again() -> None:
    """Cells are taken out between two steps: the factor of the world before is not used."""
    simulation = scene(editing=True).compile()
    compliance = simulation.compliance()
    simulation.step()
    found(simulation, compliance)
    simulation.remove_cells(body="block", cells=[0, 1, 2])
    simulation.step()
    assert relative(found(simulation, compliance), dense(simulation)) < 1e-2
    assert compliance.factors == 2


def test_what_is_refused() -> None:
    """Each in one sentence."""
    simulation = scene().compile()
    with pytest.raises(ts.ParameterError, match="found the way 'guess'; accepted: factor, cg"):
        simulation.compliance(by="guess")  # type: ignore[arg-type]
    with pytest.raises(ts.ParameterError, match="found a tolerance of 0; one above 0"):
        simulation.compliance(tolerance=0.0)
    with pytest.raises(ts.ParameterError, match="stiffness that changes with the shape"):
        found(simulation, simulation.compliance(by="condensed"))
    compliance = simulation.compliance()
    with pytest.raises(ts.ParameterError, match="found node 999 of 'block'"):
        found(simulation, compliance, (([999], [1.0]),))
    with pytest.raises(ts.ParameterError, match="as many of each are accepted"):
        compliance.of(["block"], [[0]], [], np.eye(3)[None])
    fine = ts.BarMesh(size=(0.08, 0.08, 0.04), cells=(20, 20, 10))
    body = scene().bodies["block"].replace(mesh=fine)
    large = scene(bodies={"block": body}).compile()
    with pytest.raises(ts.ParameterError, match="at most 1000 are accepted"):
        large.compliance(by="warped")


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "tolerance inf": ({"tolerance": np.inf}, "found inf, which is not finite; a number"),
    "tolerance nan": ({"tolerance": np.nan}, "found nan, which is not finite; a number"),
    "tolerance a text": ({"tolerance": "small"}, "found 'small', which does not begin with a n"),
    "tolerance a list": ({"tolerance": [0.1]}, r"found \[0.1\]; a number is accepted"),
    "a body as text": ({"bodies": "block"}, r"a list of names is accepted, such as \['block'\]"),
    "a number as body": ({"bodies": [3]}, r"found the bodies \[3\]; a list of names"),
    "no body": ({"bodies": [], "by": "warped"}, "found an empty list of bodies; at least one"),
    "another body": ({"bodies": ["b"]}, "found body 'b'; accepted: block"),
}
POINT: dict[str, Any] = {
    "bodies": ["block"],
    "nodes": [[0]],
    "weights": [[1.0]],
    "axes": [np.eye(3)],
}
WRONG_POINT: dict[str, tuple[dict[str, Any], str]] = {
    "a body as text": ({"bodies": "b"}, "found the bodies 'b'; a list of names is accepted"),
    "no list of nodes": ({"nodes": 3}, "0 nodes, 1 weights and 1 axes; as many of each"),
    "a node as text": ({"nodes": [["a"]]}, "found nodes of type"),
    "half a node": ({"nodes": [[0.5]]}, "a list of whole numbers is accepted"),
    "two weights": ({"weights": [[1.0, 2.0]]}, "for 1 node; a finite one for each node"),
    "a weight nan": ({"weights": [[np.nan]]}, "for 1 node; a finite one for each node"),
    "axes of length 2": (
        {"axes": [2.0 * np.eye(3)]},
        "an axis of length 2; directions of length 1",
    ),
    "axes of length 0": ({"axes": [np.zeros((3, 3))]}, "an axis of length 0; directions of length"),
    "axes in one matrix": ({"axes": np.eye(3)}, r"axes of shape \(3, 3\); \(m, 3, 3\)"),
    "axes of a plane": ({"axes": np.eye(2)}, r"axes of shape \(2, 2\); \(m, 3, 3\) is accepted"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_not_a_tolerance_or_a_list_of_bodies(case: str) -> None:
    """Each in one sentence; a text is not taken for its letters."""
    given, said = WRONG[case]
    with pytest.raises(ts.ParameterError, match=said):
        scene().compile().compliance(**given)


@pytest.mark.parametrize("case", WRONG_POINT)
def test_what_is_not_a_point(case: str) -> None:
    """The same of bodies, nodes, weights and axes."""
    given, said = WRONG_POINT[case]
    with pytest.raises(ts.ParameterError, match=said):
        scene().compile().compliance().of(**{**POINT, **given})


def test_a_tolerance_may_be_a_share() -> None:
    """As every number of a scene."""
    assert scene().compile().compliance(tolerance="1 %").error == 0.0


def test_the_gradient_serves_a_static_scene() -> None:
    """Without inertia its error is estimated by a further solve, and no factor is made."""
    simulation = scene(step=ts.Static()).compile()
    simulation.step()
    exact = found(simulation, simulation.compliance()).copy()
    compliance = simulation.compliance(by="cg")
    assert relative(found(simulation, compliance), exact) < 1e-2
    assert compliance.error < 1e-2
    assert compliance.factors == 0


@pytest.mark.parametrize("way", ["factor", "cg"])
def test_the_drift_is_where_the_next_step_takes_the_points(way: str) -> None:
    """A bar of Hooke's law that swings: x_(n+1) = x_n + drift, but for its weight within a step.

    Backward Euler is linear in it, so that the two agree to the tolerance of the compliance; a
    steady force f gives way by the same at any time, and is in both steps of the velocity's change.
    """
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.02, 0.02), cells=(8, 2, 2)),
        law=ts.Hooke(young="50 kPa", poisson=0.3),
        density=1000,
        viscosity=ts.Rayleigh(mass=2, stiffness="5 ms"),
    )
    simulation = ts.Scene(
        bodies={"bar": bar},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    tip = int(simulation.positions["bar"][:, 0].argmax())
    compliance = simulation.compliance(by=way, tolerance=1e-6)

    def drift() -> np.ndarray:
        compliance.of(["bar"], [[tip]], [[1.0]], np.eye(3)[None])
        return compliance.drift

    np.testing.assert_array_equal(drift(), 0.0)  # at rest
    places, expected = [], []
    for _ in range(30):
        simulation.step()
        places.append(simulation.positions["bar"][tip].copy())
        expected.append(drift())
    ways = np.diff(places, axis=0)
    largest = float(np.abs(ways).max())
    np.testing.assert_allclose(expected[1:-1], ways[1:], atol=1e-3 * largest)
    assert largest > 1e-3


def test_the_drift_of_a_table_is_zero() -> None:
    """A table of surface nodes has no motion of the others."""
    simulation = ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.BarMesh(size=(0.2, 0.02, 0.02), cells=(4, 1, 1)),
                law=ts.Hooke(young="50 kPa", poisson=0.3),
                density=1000,
            )
        },
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    for _ in range(3):
        simulation.step()
    compliance = simulation.compliance(by="condensed")
    compliance.of(["bar"], [[19]], [[1.0]], np.eye(3)[None])
    np.testing.assert_array_equal(compliance.drift, np.zeros(3))
