"""A scene with every part that a trocar may have, for what looks at all parts."""

import tissu as ts


def every_trocar_part():
    """Trocars far apart, one with each device."""
    coupling = ts.Coupling((1, 1, "0.2 N m/rad", "300 N/m"), damping=(0, 0, 0, "0.05 N s/m"))
    hand = ts.Hand(times=[0, 1], points=[(0, 0, 0.1), (0, 0, 0.12)], tremor="0.1 mm", lets_go=2)
    known = {"damping": (1, 1, 1, 2), "friction": (1, 1, 1, 1)}
    devices = [
        ts.SimulatedDevice(
            hand=hand,
            changes=ts.ToolChanges(times=[1, 2], tags=[None, 0x51A0]),
            delay="1 ms",
            seed=4,
            efficiency=(0.95, 0.95, 0.98, "70 %"),
            mechanism=ts.TrocarMechanism(mass="150 g", roller_force="6 N", encoder="motor"),
        ),
        ts.UdpDevice("192.168.1.20", 7001, **known),
        ts.SerialDevice("/dev/ttyACM0", baud=2_000_000),
        ts.SharedMemoryDevice("/trocar"),
        ts.PluginDevice("device.so", address="0"),
    ]
    trocars = {
        f"trocar {number}": ts.Trocar(
            port=ts.Port((number, 0, 0.1), (0, 0.2, -1), right=(1, 0, 0)),
            device=device,
            tools={0x51A0: f"probe {number}"},
            coupling=coupling,
            gravity=(0, 0, "-9.81 m/s^2"),
            compensation=ts.TrocarCompensation(mass="100 g"),
            limits=ts.TrocarLimits(force="4 N", tilt="40 deg"),
        )
        for number, device in enumerate(devices)
    }
    return ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1)),
                law=ts.StVK(young=1e3, poisson=0.3),
                density=1e3,
            )
        },
        obstacles={
            f"probe {number}": ts.SphereObstacle((number, 0, 2), 0.01)
            for number in range(len(devices))
        },
        contacts=[ts.Contact(("bar", f"probe {number}")) for number in range(len(devices))],
        trocars=trocars,
        step=ts.ImplicitEuler(0.01),
    )
