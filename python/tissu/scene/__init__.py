"""Scenes: what is simulated, as frozen and validated parts."""

from tissu.scene.bar import BarMesh
from tissu.scene.body import Body, MeshFile
from tissu.scene.energy_momentum import EnergyMomentum
from tissu.scene.law import (
    ArrudaBoyce,
    Fibres,
    Hooke,
    MooneyRivlin,
    NeoHooke,
    StableNeoHooke,
    StVK,
    UserLaw,
    Yeoh,
)
from tissu.scene.load import Moment, NodalLoad, Pressure, Traction
from tissu.scene.model import (
    FEM,
    Condensed,
    Corotational,
    Frames,
    MassLink,
    MassSpring,
    MassTensor,
    MeanDilatation,
    Shell,
)
from tissu.scene.scene import Output, Scene
from tissu.scene.selection import Box, Nodes, Plane, Region, Sphere, SurfaceNodes
from tissu.scene.solver import Auto, Cholesky, ConjugateGradient
from tissu.scene.start import Start
from tissu.scene.step import (
    BDF2,
    RK2,
    RK4,
    BDF2FixedPoint,
    ExplicitEuler,
    ImplicitEuler,
    ImplicitMidpoint,
    Newmark,
    Newton,
    Static,
    SymplecticEuler,
)
from tissu.scene.support import Fixed, Prescribed, Rotation
from tissu.scene.tissue import Tissue
from tissu.scene.viscosity import Centroid, KelvinVoigt, Prony, PronyBranch, Rayleigh

__all__ = [
    "BDF2",
    "FEM",
    "RK2",
    "RK4",
    "ArrudaBoyce",
    "Auto",
    "BDF2FixedPoint",
    "BarMesh",
    "Body",
    "Box",
    "Centroid",
    "Cholesky",
    "Condensed",
    "ConjugateGradient",
    "Corotational",
    "EnergyMomentum",
    "ExplicitEuler",
    "Fibres",
    "Fixed",
    "Frames",
    "Hooke",
    "ImplicitEuler",
    "ImplicitMidpoint",
    "KelvinVoigt",
    "MassLink",
    "MassSpring",
    "MassTensor",
    "MeanDilatation",
    "MeshFile",
    "Moment",
    "MooneyRivlin",
    "NeoHooke",
    "Newmark",
    "Newton",
    "NodalLoad",
    "Nodes",
    "Output",
    "Plane",
    "Prescribed",
    "Pressure",
    "Prony",
    "PronyBranch",
    "Rayleigh",
    "Region",
    "Rotation",
    "Scene",
    "Shell",
    "Sphere",
    "StVK",
    "StableNeoHooke",
    "Start",
    "Static",
    "SurfaceNodes",
    "SymplecticEuler",
    "Tissue",
    "Traction",
    "UserLaw",
    "Yeoh",
]
