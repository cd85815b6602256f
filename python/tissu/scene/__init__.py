"""Scenes: what is simulated, as frozen and validated parts."""

from tissu.scene.bar import BarMesh
from tissu.scene.body import Body, MeshFile
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
from tissu.scene.load import NodalLoad, Pressure, Traction
from tissu.scene.model import FEM, Condensed, Corotational, MassLink, MassSpring, MassTensor
from tissu.scene.scene import Output, Scene
from tissu.scene.selection import Box, Nodes, Plane, Region, Sphere, SurfaceNodes
from tissu.scene.solver import Auto, Cholesky, ConjugateGradient
from tissu.scene.step import ImplicitEuler, Newton, Static
from tissu.scene.support import Fixed, Prescribed, Rotation
from tissu.scene.viscosity import Centroid, KelvinVoigt, Prony, PronyBranch, Rayleigh

__all__ = [
    "FEM",
    "ArrudaBoyce",
    "Auto",
    "BarMesh",
    "Body",
    "Box",
    "Centroid",
    "Cholesky",
    "Condensed",
    "ConjugateGradient",
    "Corotational",
    "Fibres",
    "Fixed",
    "Hooke",
    "ImplicitEuler",
    "KelvinVoigt",
    "MassLink",
    "MassSpring",
    "MassTensor",
    "MeshFile",
    "MooneyRivlin",
    "NeoHooke",
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
    "Sphere",
    "StVK",
    "StableNeoHooke",
    "Static",
    "SurfaceNodes",
    "Traction",
    "UserLaw",
    "Yeoh",
]
