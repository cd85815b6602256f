"""How points of connective tissue follow frames and nodes of bodies, and how they lose them."""

from tissu.ties.links import Left, Links
from tissu.ties.riding import Carriers, carried
from tissu.ties.weights import Weights

__all__ = ["Carriers", "Left", "Links", "Weights", "carried"]
