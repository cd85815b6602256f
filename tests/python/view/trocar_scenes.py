"""A block of tissue under a port for tests of the view, and what is asked of a view of it."""

import tissu as ts

PORT = (0.04, 0.04, 0.15)
TIMES, POINTS = (0, "0.1 s", "0.4 s"), ((0, 0, 0.1), (0, 0, 0.1), (0, 0, 0.118))


def tissue(**changes):
    """A hand goes straight down into a block, from 10 to 118 mm of depth, and stays."""
    block = ts.Body(
        mesh=ts.BarMesh(size=(0.08, 0.08, 0.04), cells=(4, 4, 2)),
        law=ts.NeoHooke(young="5 kPa", poisson=0.3),
        density=1050,
        viscosity=ts.Rayleigh(mass=5, stiffness="10 ms"),
    )
    trocar = ts.Trocar(
        port=ts.Port(PORT, (0, 0, -1)),
        device=ts.SimulatedDevice(hand=ts.Hand(times=TIMES, points=POINTS)),
        tools={0x51A0: "probe", 0x51A1: "thin"},
    )
    fields = {
        "bodies": {"block": block},
        "fixed": [ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        "obstacles": {
            "probe": ts.SphereObstacle((0.04, 0.04, 0.06), radius=0.005),
            "thin": ts.SphereObstacle((0.02, 0.02, 0.08), radius=0.003),
        },
        "contacts": [
            ts.Contact(("block", "probe"), friction=0.2),
            ts.Contact(("block", "thin"), friction=0.2),
        ],
        "trocars": {"right": trocar},
        "step": ts.ImplicitEuler("10 ms"),
    }
    return ts.Scene(name="palpated", **{**fields, **changes})


def device(**changes):
    """The trocar of `tissue` with another simulated device."""
    scene = tissue()
    part = scene.trocars["right"].device.replace(**changes)
    return tissue(trocars={"right": scene.trocars["right"].replace(device=part)})


def stepped(trocars, steps):
    """The only trocar, after steps of its simulation."""
    (one,) = trocars.each
    for _ in range(steps):
        trocars.step(one.simulation)
    return one
