"""Types of the names that the package loads when they are asked for; see __init__.py."""

from tissu.errors import Diverged as Diverged
from tissu.errors import MeshError as MeshError
from tissu.errors import ParameterError as ParameterError
from tissu.errors import SceneError as SceneError
from tissu.errors import TissuError as TissuError
from tissu.mesh import CellBlock as CellBlock
from tissu.mesh import Mesh as Mesh
from tissu.mesh import QualityReport as QualityReport
from tissu.mesh import Surface as Surface
from tissu.mesh import bar_mesh as bar_mesh
from tissu.mesh import into_tetrahedra as into_tetrahedra
from tissu.mesh import read_mesh as read_mesh
from tissu.mesh import write_mesh as write_mesh
from tissu.scene import BarMesh as BarMesh
from tissu.scene import Body as Body
from tissu.scene import Box as Box
from tissu.scene import Cholesky as Cholesky
from tissu.scene import ConjugateGradient as ConjugateGradient
from tissu.scene import Fixed as Fixed
from tissu.scene import Hooke as Hooke
from tissu.scene import ImplicitEuler as ImplicitEuler
from tissu.scene import MeshFile as MeshFile
from tissu.scene import Newton as Newton
from tissu.scene import NodalLoad as NodalLoad
from tissu.scene import Nodes as Nodes
from tissu.scene import Output as Output
from tissu.scene import Plane as Plane
from tissu.scene import Prescribed as Prescribed
from tissu.scene import Pressure as Pressure
from tissu.scene import Rayleigh as Rayleigh
from tissu.scene import Region as Region
from tissu.scene import Rotation as Rotation
from tissu.scene import Scene as Scene
from tissu.scene import Sphere as Sphere
from tissu.scene import StVK as StVK
from tissu.scene import Static as Static
from tissu.scene import SurfaceNodes as SurfaceNodes
from tissu.scene import Traction as Traction
from tissu.simulation import Plan as Plan
from tissu.simulation import Profile as Profile
from tissu.simulation import Simulation as Simulation
from tissu.simulation import StepReport as StepReport
from tissu.picture import draw as draw
from tissu.picture import draw_overlay as draw_overlay

__version__: str
