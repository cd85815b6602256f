"""Scenes with contact that several tests take."""

import tissu as ts

SOFT = ts.StVK(young=4e3, poisson=0.4)


def cube(origin=(0, 0, 0), *, cell="hexahedron", cells=(2, 2, 2), size=(0.1, 0.1, 0.1), **fields):
    """A body of 10 cm along every axis, in cells of 5 cm."""
    mesh = ts.BarMesh(size=size, cells=cells, cell=cell, origin=origin)
    return ts.Body(**({"mesh": mesh, "law": SOFT, "density": 1000.0} | fields))


def sheet(z=0.25, **fields):
    """A sheet of quads, 2 mm thick, at a height [m]."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0), cells=(4, 4, 0), cell="quad", origin=(0, 0, z))
    return ts.Body(mesh=mesh, law=SOFT, density=1000.0, thickness=0.002, **fields)


def scene(**fields):
    """Two cubes, a sheet and a table; the fields of the scene beside them."""
    given = {
        "bodies": {"liver": cube(), "gut": cube((0, 0, 0.11)), "skin": sheet()},
        "obstacles": {"table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))},
        "step": ts.ImplicitEuler("10 ms"),
    }
    return ts.Scene(**(given | fields))


def every_contact_part():
    """A scene with each class of an obstacle and a contact, and each of their fields."""
    turn = ts.Rotation(axis=(0, 0, 1), center=(0.1, 0, 0), angles=("0 deg", "90 deg"))
    path = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, "-6 cm")), rotation=turn)
    obstacles = {
        "table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1)),
        "ball": ts.SphereObstacle((0, 0, "40 cm"), "2 cm"),
        "probe": ts.CapsuleObstacle(((0, 0, 0.5), (0, 0, 0.6)), radius="3 mm", motion=path),
        "brick": ts.BoxObstacle((1, 1, 1), (2, 2, 2)),
        "bone": ts.MeshObstacle(ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1), origin=(3, 3, 3))),
        "rod": ts.CylinderObstacle(((0, 0, 0.7), (0, 0, 0.8)), "3 mm"),
        "needle": ts.ConeObstacle((0, 0, 0.9), (0, 0, 0.88), "1 mm"),
        "stone": ts.EllipsoidObstacle((0, 0, 1.0), ("1 cm", "1 cm", "2 cm")),
        "wedge": ts.ConvexObstacle(points=[(5, 5, 5), (6, 5, 5), (5, 6, 5), (5, 5, 6)]),
        "hull": ts.ConvexObstacle(
            mesh=ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1), origin=(7, 7, 7))
        ),
    }
    contacts = [
        ts.Contact(("liver", "probe"), friction=0.2, gap="0.5 mm"),
        ts.Contact(["liver", ["table", "ball"]], on=ts.Box(max=(None, None, 0.01))),
        ts.SelfContact("skin", friction=0.1, gap=1e-4),
        ts.Contact("all"),
    ]
    settings = ts.ContactSettings(
        method="augmented",
        broad_phase="grid",
        iterations=5,
        travel=False,
        overlap="refuse",
        surface_of={"gut": ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), origin=(0, 0, 0.11))},
    )
    return scene(obstacles=obstacles, contacts=contacts, contact=settings)
