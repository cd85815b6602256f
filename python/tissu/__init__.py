"""tissu: real-time soft tissue for surgery.

A scene goes in, a deforming organ comes out:

    import tissu as ts

    scene = ts.Scene.from_yaml("organ.yaml")
    simulation = scene.compile()
    for report in simulation.run():
        print(report)

Everything is in SI units and float64; arrays are (n, 3); nodes of cells are in VTK's order.

Made from the list in tissu/codegen/names.py by `make codegen`; never edited.
"""

from __future__ import annotations

import importlib
from typing import Any

_HOMES = {
    "tissu.errors": (
        "TissuError",
        "MeshError",
        "ParameterError",
        "LawError",
        "SceneError",
        "BusyError",
        "CheckpointError",
        "Diverged",
    ),
    "tissu.front": (
        "Scene",
    ),
    "tissu.mesh": (
        "Mesh",
        "CellBlock",
        "Surface",
        "QualityReport",
        "read_mesh",
        "write_mesh",
        "bar_mesh",
        "into_quadratic",
        "into_tetrahedra",
        "mixed_bar_mesh",
        "refined",
    ),
    "tissu.user_law": (
        "law",
        "read_law",
    ),
    "tissu.field_names": (
        "FIELD_NAMES",
    ),
    "tissu.simulation": (
        "Compliance",
        "Contacts",
        "Crossing",
        "IntegrationPoints",
        "Mark",
        "Overlap",
        "Plan",
        "Profile",
        "Simulation",
        "StepReport",
        "Tool",
        "Wrench",
    ),
    "tissu.cutting": (
        "Capsule",
        "CutReport",
        "Disc",
        "Material",
        "MaterialSurface",
        "Piece",
        "Quality",
        "Repairs",
        "Sweep",
        "Triangles",
    ),
    "tissu.comparison": (
        "Comparison",
        "compare",
    ),
    "tissu.advice": (
        "Advice",
        "advise",
    ),
    "tissu.picture": (
        "draw",
        "draw_overlay",
    ),
    "tissu.output": (
        "Series",
    ),
    "tissu.live_view": (
        "View",
        "view",
    ),
    "tissu.scene": (
        "Output",
        "Body",
        "MeshFile",
        "Round",
        "Rectangle",
        "Tube",
        "GeneralSection",
        "Start",
        "BarMesh",
        "Tissue",
        "Hooke",
        "StVK",
        "NeoHooke",
        "StableNeoHooke",
        "MooneyRivlin",
        "Yeoh",
        "ArrudaBoyce",
        "Fibres",
        "UserLaw",
        "Rayleigh",
        "KelvinVoigt",
        "Centroid",
        "Prony",
        "PronyBranch",
        "FEM",
        "Corotational",
        "MassSpring",
        "MassLink",
        "MassTensor",
        "Condensed",
        "MeanDilatation",
        "Frames",
        "Shell",
        "Box",
        "Sphere",
        "Plane",
        "Nodes",
        "SurfaceNodes",
        "Region",
        "Fixed",
        "Prescribed",
        "Rotation",
        "NodalLoad",
        "Moment",
        "Traction",
        "Pressure",
        "Motion",
        "PlaneObstacle",
        "SphereObstacle",
        "CapsuleObstacle",
        "BoxObstacle",
        "MeshObstacle",
        "CylinderObstacle",
        "ConeObstacle",
        "EllipsoidObstacle",
        "ConvexObstacle",
        "Contact",
        "SelfContact",
        "ContactSettings",
        "Trocar",
        "Coupling",
        "Port",
        "SimulatedDevice",
        "UdpDevice",
        "SerialDevice",
        "SharedMemoryDevice",
        "PluginDevice",
        "Hand",
        "ToolChanges",
        "TrocarLimits",
        "TrocarCompensation",
        "TrocarMechanism",
        "Editing",
        "Repair",
        "Ablator",
        "Knife",
        "ToolPath",
        "Tear",
        "ExplicitEuler",
        "SymplecticEuler",
        "RK2",
        "RK4",
        "ImplicitEuler",
        "ImplicitMidpoint",
        "BDF2",
        "Newmark",
        "EnergyMomentum",
        "BDF2FixedPoint",
        "Static",
        "Newton",
        "Auto",
        "ConjugateGradient",
        "Cholesky",
    ),
}
_MODULES = ("examples", "formula", "sampling")
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = sorted([*_HOME_OF, *_MODULES, "__version__"])


def __getattr__(name: str) -> Any:
    """Load a name from its room when it is first asked for, so that the import stays short."""
    if name == "__version__":
        from tissu import _core

        return _core.build_info()["version"]
    if name == "_core":
        return _load_core()
    if name in _MODULES:
        return importlib.import_module(f"tissu.{name}")
    home = _HOME_OF.get(name)
    if home is None:
        raise AttributeError(f"module 'tissu' has no attribute '{name}'")
    value = getattr(importlib.import_module(home), name)
    globals()[name] = value
    return value


def _load_core() -> Any:
    """The compiled core.

    Raises:
        ImportError: a library that it needs is missing, or it was made for another Python.
    """
    try:
        return importlib.import_module("tissu._core")
    except ModuleNotFoundError:
        raise ImportError(
            "the compiled core of tissu is missing for this Python; install tissu with it: "
            "python -m pip install tissu"
        ) from None
    except ImportError as error:
        raise ImportError(
            f"the compiled core of tissu cannot be loaded: {error}; install the library that it "
            "names (Debian: sudo apt install libcholmod3 for libcholmod), or build tissu again"
        ) from error


def __dir__() -> list[str]:
    return __all__
