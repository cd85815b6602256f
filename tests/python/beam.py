"""A short bar that is let go under its own weight, for tests that run a scene many times."""

import tissu as ts


def beam(young, **changes):
    """The scene, with other fields where they are given."""
    fields = {
        "name": "beam",
        "bodies": {
            "bar": ts.Body(
                mesh=ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(4, 1, 1), cell="hexahedron"),
                law=ts.StVK(young=young, poisson=0.3),
                density=1000,
            )
        },
        "gravity": (0, 0, -9.81),
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "step": ts.ImplicitEuler("10 ms"),
        "duration": 0.1,
    }
    return ts.Scene(**{**fields, **changes})
