"""Which instrument of a scene is of which kind."""

from __future__ import annotations

from tissu.scene.instrument import Ablator, Instrument, Knife


def knife_of(instrument: Instrument) -> Knife | None:
    """The instrument, where it is a knife."""
    return instrument if isinstance(instrument, Knife) else None


def tough_knife_of(instrument: Instrument) -> Knife | None:
    """The instrument, where it is a knife with a toughness."""
    knife = knife_of(instrument)
    return None if knife is None or knife.toughness is None else knife


def ablator_of(instrument: Instrument) -> Ablator | None:
    """The instrument, where it is an ablator."""
    return instrument if isinstance(instrument, Ablator) else None
