"""The cheapest setting of a scene that meets an error and a rate."""

from tissu.advice.advice import Advice
from tissu.advice.advise import advise

__all__ = ["Advice", "advise"]
