"""A law of each class of the library, with the typical parameters that its formula names."""

from tissu import _core
from tissu.scene.generated.laws import LAWS
from tissu.scene.part import type_name

TYPICAL = {name: typical for name, typical, *_ in _core.laws()}


def typical_laws():
    """Name -> law, in the order of the list."""
    return {type_name(cls): cls(**TYPICAL[type_name(cls)]) for cls in LAWS}
