"""A load of a scene that is changed while a simulation runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.errors import ParameterError
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.reading import Number, VectorLike
    from tissu.scene.load import Load, Where
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]

_HEAD = 2  # numbers before those that the load is made of: whether a factor is given, and which


@known_names_only
@one_thread_at_a_time
class LiveLoad:
    """A load as it acts now; an assigned value holds from the next step on.

    It has the attribute that its type has in a scene: `force` [N], `moment` [N m], `traction` or
    `pressure` [Pa]. Made by `Simulation.load`.
    """

    def __init__(
        self, *, simulation: core.Simulation, entry: Entry, load: Load, where: Where, number: int
    ) -> None:
        """Take a load of the scene, where it acts, and its number among the loads."""
        self._core = simulation
        self._entry = entry
        self._load = load
        self._where = where
        self._place = load.core_name(number)

    def __repr__(self) -> str:
        """What it is called, and its value."""
        quantity = self._load.quantity
        return f"LiveLoad({self._place}: {quantity} {self._value()}, factor {self.factor:g})"

    @property
    def force(self) -> Any:
        """Total force of a nodal load (3,) [N]."""
        return self._get("force")

    @force.setter
    def force(self, value: VectorLike) -> None:
        self._set("force", value)

    @property
    def moment(self) -> Any:
        """Total moment (3,) [N m]."""
        return self._get("moment")

    @moment.setter
    def moment(self, value: VectorLike) -> None:
        self._set("moment", value)

    @property
    def traction(self) -> Any:
        """Force per rest area (3,) [Pa]."""
        return self._get("traction")

    @traction.setter
    def traction(self, value: VectorLike) -> None:
        self._set("traction", value)

    @property
    def pressure(self) -> Any:
        """Pressure [Pa], positive inwards."""
        return self._get("pressure")

    @pressure.setter
    def pressure(self, value: Number | str) -> None:
        self._set("pressure", value)

    @property
    def factor(self) -> float:
        """Present factor of the load: the assigned one, else that of its times and factors."""
        numbers = self._core.remembered(self._place)
        if len(numbers) and numbers[0] != 0.0:
            return float(numbers[1])
        if self._load.times is None or self._load.factors is None:
            return 1.0
        return float(np.interp(self._core.time, self._load.times, self._load.factors))

    @factor.setter
    def factor(self, value: Number | str | None) -> None:
        """A factor from now on; None: by the times and factors of the scene again."""
        numbers = self._numbers()
        given = value is not None
        numbers[:_HEAD] = [float(given), units.NUMBER(value) if given else 0.0]
        self._keep(numbers)

    def reset(self) -> None:
        """Restore the value that it has in the scene."""
        self._core.set_remembered(self._place, np.empty(0))

    def _numbers(self) -> Floats:
        numbers = self._core.remembered(self._place)
        if len(numbers):
            return numbers
        return np.concatenate([np.zeros(_HEAD), self._load.made_of(self._where)])

    def _value(self) -> Any:
        """Of the quantity that it has, as an array (3,) or a number."""
        built = getattr(self._load, self._load.quantity)
        numbers = self._core.remembered(self._place)
        if np.ndim(built) == 0:
            return float(numbers[_HEAD]) if len(numbers) else float(built)
        return numbers[_HEAD : _HEAD + 3].copy() if len(numbers) else np.array(built)

    def _get(self, quantity: str) -> Any:
        self._require(quantity)
        return self._value()

    def _set(self, quantity: str, value: Any) -> None:
        self._require(quantity)
        other = self._load.replace(**{quantity: value})
        head = self._numbers()[:_HEAD]
        self._keep(np.concatenate([head, other.made_of(self._where)]))

    def _keep(self, numbers: Floats) -> None:
        """Give the core its numbers, which are one for each node that the load had at first."""
        try:
            self._core.set_remembered(self._place, numbers)
        except ParameterError:
            raise ParameterError(
                f"found the {self._place}, whose nodes a cut has parted; it keeps the value it "
                "had then"
            ) from None

    def _require(self, quantity: str) -> None:
        if quantity != self._load.quantity:
            raise ParameterError(
                f"found {quantity} of the {self._place}; its {self._load.quantity} is accepted"
            )
