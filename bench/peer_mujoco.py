"""MuJoCo's flex, for bench/peers.py."""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from peer_work import GRAVITY, POISSON, SOFT, STIFFNESS_DAMPING, YOUNG, Facts, Work

LAW = "St-Venant–Kirchhoff in squared edge lengths"
WAYS = {
    "discrete": Facts(
        LAW,
        'backward Euler of 10 ms, linearised once (`integrator="discrete"`), else its defaults',
        "other hyperelastic laws, meshes of other elements than tetrahedra, cells removed in a run",
    ),
    "explicit": Facts(LAW, 'symplectic Euler (`integrator="Euler"`), double precision'),
    "dropped": Facts(LAW, "`discrete`, contacts as soft as its defaults"),
    "dropped, stiff contacts": Facts(
        LAW, '`discrete`, `solref="0.002 1" solimp="0.99 0.999 1e-4"`'
    ),
}
STIFF = 'solref="0.002 1" solimp="0.99 0.999 1e-4" priority="1"'
RADIUS = 1e-4  # m, of the cube's surface
INTEGRATORS = {"discrete": "discrete", "explicit": "Euler"}


def version() -> str:
    """Of the package."""
    import mujoco

    return str(mujoco.__version__)


def numbers(values: Any) -> str:
    """As attributes of MJCF hold them."""
    return quoteattr(" ".join(f"{value:.17g}" for value in values.ravel()))


def model(work: Work, way: str) -> str:
    """The bar in MJCF: a body for each free node."""
    mass = float(work.masses.sum())
    return f"""<mujoco>
<option timestep="{work.dt!r}" integrator="{INTEGRATORS[way]}" gravity="0 0 {-GRAVITY!r}"/>
<worldbody><flexcomp name="bar" type="direct" dim="3" radius="0.001" mass="{mass!r}"
 point={numbers(work.points)} element={numbers(work.tetrahedra)}>
<elasticity young="{YOUNG!r}" poisson="{POISSON!r}" damping="0"/>
<contact selfcollide="none" contype="0" conaffinity="0"/>
<pin id={numbers(work.held)}/>
</flexcomp></worldbody></mujoco>"""


def cube_model(work: Work, way: str) -> str:
    """The cube in MJCF, above a plane unless it only falls."""
    plane = f'<geom type="plane" size="1 1 1" {STIFF if "stiff" in way else ""}/>'
    mass = float(work.masses.sum())
    return f"""<mujoco>
<option timestep="{work.dt!r}" integrator="discrete" gravity="0 0 {-GRAVITY!r}"/>
<worldbody>{"" if way == "falling" else plane}
<flexcomp name="cube" type="direct" dim="3" radius="{RADIUS!r}" mass="{mass!r}"
 point={numbers(work.points)} element={numbers(work.tetrahedra)}>
<elasticity young="{SOFT!r}" poisson="{POISSON!r}" damping="{STIFFNESS_DAMPING!r}"/>
<contact selfcollide="none"/>
</flexcomp></worldbody></mujoco>"""


class Flex:
    """A model of one flex or several, and its state."""

    def __init__(self, work: Work, text: str, masses: Any = None, drag: float = 0.0) -> None:
        """`text` is its MJCF.

        Args:
            work: whose nodes it has.
            text: its MJCF.
            masses: of all nodes [kg]; None: those of the work.
            drag: force over momentum of each node [1/s].
        """
        import mujoco

        self._mujoco, self._work = mujoco, work
        self._model = mujoco.MjModel.from_xml_string(text)
        self._data = mujoco.MjData(self._model)
        bodies = self._model.flex_vertbodyid  # 0, the world, of nodes that are held
        free = bodies > 0
        # It gives every node the same mass; here each has that of the cells around it.
        of_nodes = (work.masses if masses is None else masses)[free]
        self._model.body_mass[bodies[free]] = of_nodes
        if drag > 0.0:
            dofs = self._model.body_dofadr[bodies[free]]
            for axis in range(3):
                self._model.dof_damping[dofs + axis] = drag * of_nodes
        mujoco.mj_setConst(self._model, self._data)
        mujoco.mj_resetData(self._model, self._data)
        mujoco.mj_forward(self._model, self._data)
        self._told = self._warnings()

    def step(self) -> None:
        """One of dt."""
        self._mujoco.mj_step(self._model, self._data)

    def _places(self) -> Any:
        """Of the nodes [m], where they are after the step."""
        for place in (self._mujoco.mj_kinematics, self._mujoco.mj_comPos, self._mujoco.mj_flex):
            place(self._model, self._data)
        return self._data.flexvert_xpos

    def unsolved(self) -> int | None:
        """Steps with a warning on the inertia, which is what it says of an unfinished solve."""
        return self._warnings() - self._told

    def _warnings(self) -> int:
        kind = self._mujoco.mjtWarning.mjWARN_INERTIA
        return int(self._data.warning[int(kind)].number)


class Bar(Flex):
    """The bar."""

    def seen(self) -> list[float]:
        """Displacement of the free end [m]."""
        return self._work.tip(self._places())


class Cube(Flex):
    """The cube."""

    def seen(self) -> list[float]:
        """Depth of the lowest node beyond the radius [m], and what the plane carries [N]."""
        force, up = np.zeros(6), 0.0
        for number in range(self._data.ncon):
            self._mujoco.mj_contactForce(self._model, self._data, number, force)
            up += float(force[0])  # along the contact's normal
        return [max(0.0, RADIUS - float(self._places()[:, 2].min())), up]


def make(work: Work, way: str) -> Bar | Cube:
    """The bar, or the cube."""
    if way in INTEGRATORS:
        return Bar(work, model(work, way))
    return Cube(work, cube_model(work, way))
