"""MuJoCo's flex, for bench/peers.py."""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import quoteattr

from peer_work import GRAVITY, POISSON, YOUNG, Facts, Work

LAW = "St-Venant–Kirchhoff in squared edge lengths"
WAYS = {
    "discrete": Facts(
        LAW,
        'backward Euler of 10 ms, linearised once (`integrator="discrete"`), else its defaults',
        "other hyperelastic laws, meshes of other elements than tetrahedra, cutting",
    ),
    "explicit": Facts(LAW, 'symplectic Euler (`integrator="Euler"`), double precision'),
}
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


class Bar:
    """A model of the bar and its state."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is one of WAYS."""
        import mujoco

        self._mujoco, self._work = mujoco, work
        self._model = mujoco.MjModel.from_xml_string(model(work, way))
        self._data = mujoco.MjData(self._model)
        bodies = self._model.flex_vertbodyid  # 0, the world, of nodes that are held
        free = bodies > 0
        # It gives every node the same mass; here each has that of the cells around it.
        self._model.body_mass[bodies[free]] = work.masses[free]
        mujoco.mj_setConst(self._model, self._data)
        mujoco.mj_resetData(self._model, self._data)
        mujoco.mj_forward(self._model, self._data)
        self._told = self._warnings()

    def step(self) -> None:
        """One of dt."""
        self._mujoco.mj_step(self._model, self._data)

    def tip(self) -> list[float]:
        """Of the free end [m], where it is after the step."""
        for place in (self._mujoco.mj_kinematics, self._mujoco.mj_comPos, self._mujoco.mj_flex):
            place(self._model, self._data)
        return self._work.tip(self._data.flexvert_xpos)

    def unsolved(self) -> int | None:
        """Steps with a warning on the inertia, which is what it says of an unfinished solve."""
        return self._warnings() - self._told

    def _warnings(self) -> int:
        kind = self._mujoco.mjtWarning.mjWARN_INERTIA
        return int(self._data.warning[int(kind)].number)


make = Bar
