"""Checkpoints: one file from which a simulation goes on with the same bits."""

from tissu.checkpoint.checkpoint import Checkpoint, Resumed, read_checkpoint
from tissu.checkpoint.physics import physics_of
from tissu.checkpoint.whole import prepare_place

__all__ = ["Checkpoint", "Resumed", "physics_of", "prepare_place", "read_checkpoint"]
