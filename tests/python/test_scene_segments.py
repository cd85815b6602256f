"""A bar of several cell types, each with its law, from a scene file."""

import numpy as np
import pytest

from tissu import BarMesh, Body, ImplicitEuler, Scene, StVK
from tissu.compile import check_scene
from tissu.errors import SceneError

TEXT = """
bodies:
  bar:
    mesh:
      type: bar
      size: [0.4, 0.1, 0.1]
      cells: [8, 2, 2]
      segments: "wedge6:stvk, pyramid5:stvk, hex8:stvk, tet4:hooke"
    law:
      1 wedge stvk: {type: stvk, young: 1e5, poisson: 0.3}
      2 pyramid stvk: {type: stvk, young: 1e5, poisson: 0.3}
      3 hexahedron stvk: {type: stvk, young: 1e5, poisson: 0.3}
      4 tetra hooke: {type: hooke, young: 1e5, poisson: 0.3}
    density: 1000
fixed:
  - {body: bar, on: {type: box, max: [0, null, null]}}
gravity: [0, 0, -9.81]
step: {type: implicit_euler, dt: 0.01}
"""


def test_a_mixed_bar_runs_from_a_file():
    scene = Scene.from_yaml_text(TEXT)
    simulation = scene.compile()
    mesh = simulation.meshes["bar"]
    assert mesh.volume() == pytest.approx(0.004, rel=1e-12)
    assert list(mesh.regions) == [
        "1 wedge stvk",
        "2 pyramid stvk",
        "3 hexahedron stvk",
        "4 tetra hooke",
    ]
    for _ in range(10):
        assert simulation.step().converged
    sag = simulation.displacements("bar")[:, 2]
    along = mesh.points[:, 0]
    means = [sag[np.isclose(along, x)].mean() for x in (0.0, 0.1, 0.2, 0.3, 0.4)]
    assert means[0] == 0
    assert (np.diff(means) < 0).all()  # each segment hangs lower than the one before
    assert Scene.from_yaml_text(scene.to_yaml()).bodies["bar"] == scene.bodies["bar"]


def test_a_segment_that_is_none():
    body = Body(
        mesh=BarMesh(size=(1, 1, 1), cells=(2, 1, 1), segments="wedge6, cube:stvk"),
        law=StVK(young=1e3, poisson=0.3),
        density=1e3,
    )
    found = check_scene(Scene(bodies={"b": body}, step=ImplicitEuler(0.01))).problems
    assert len(found) == 1
    assert "bodies.b.mesh" in found[0]
    assert "cell type 'cube'" in found[0]


def test_segments_stand_alone():
    with pytest.raises(SceneError, match="segments and cell; segments alone are accepted"):
        BarMesh(size=(1, 1, 1), cells=(2, 1, 1), segments="wedge6, hex8", cell="wedge")
