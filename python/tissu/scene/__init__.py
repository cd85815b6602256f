"""The parts of a scene, as frozen and validated data.

Made from the list in tissu/codegen/names.py by `make codegen`; never edited.
"""

from tissu.scene.scene import (
    Output,
)
from tissu.scene.body import (
    Body,
    MeshFile,
)
from tissu.scene.section import (
    Round,
    Rectangle,
    Tube,
    GeneralSection,
)
from tissu.scene.start import (
    Start,
)
from tissu.scene.bar import (
    BarMesh,
)
from tissu.scene.tissue import (
    Tissue,
)
from tissu.scene.generated.laws import (
    Hooke,
    StVK,
    NeoHooke,
    StableNeoHooke,
    MooneyRivlin,
    Yeoh,
    ArrudaBoyce,
)
from tissu.scene.law import (
    Fibres,
    UserLaw,
)
from tissu.scene.viscosity import (
    Rayleigh,
    KelvinVoigt,
    Centroid,
    Prony,
    PronyBranch,
)
from tissu.scene.model import (
    FEM,
    Corotational,
    MassSpring,
    MassLink,
    MassTensor,
    Condensed,
    MeanDilatation,
    Frames,
    Shell,
)
from tissu.scene.selection import (
    Box,
    Sphere,
    Plane,
    Nodes,
    SurfaceNodes,
    Region,
)
from tissu.scene.support import (
    Fixed,
    Prescribed,
    Rotation,
)
from tissu.scene.load import (
    NodalLoad,
    Moment,
    Traction,
    Pressure,
)
from tissu.scene.motion import (
    Motion,
)
from tissu.scene.obstacle import (
    PlaneObstacle,
    SphereObstacle,
    CapsuleObstacle,
    BoxObstacle,
    MeshObstacle,
)
from tissu.scene.convex_obstacle import (
    CylinderObstacle,
    ConeObstacle,
    EllipsoidObstacle,
    ConvexObstacle,
)
from tissu.scene.contact import (
    Contact,
    SelfContact,
    ContactSettings,
)
from tissu.scene.trocar.trocar import (
    Trocar,
    Coupling,
)
from tissu.scene.trocar.port import (
    Port,
)
from tissu.scene.trocar.device import (
    SimulatedDevice,
    UdpDevice,
    SerialDevice,
    SharedMemoryDevice,
    PluginDevice,
)
from tissu.scene.trocar.hand import (
    Hand,
)
from tissu.scene.trocar.changes import (
    ToolChanges,
)
from tissu.scene.trocar.limits import (
    TrocarLimits,
)
from tissu.scene.trocar.compensation import (
    TrocarCompensation,
)
from tissu.scene.trocar.mechanism import (
    TrocarMechanism,
)
from tissu.scene.editing import (
    Editing,
    Repair,
)
from tissu.scene.instrument import (
    Ablator,
    Knife,
    ToolPath,
)
from tissu.scene.tear import (
    Tear,
)
from tissu.scene.step import (
    ExplicitEuler,
    SymplecticEuler,
    RK2,
    RK4,
    ImplicitEuler,
    ImplicitMidpoint,
    BDF2,
    Newmark,
    EnergyMomentum,
    BDF2FixedPoint,
    Static,
    Newton,
)
from tissu.scene.solver import (
    Auto,
    ConjugateGradient,
    Cholesky,
)

__all__ = [
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
]
