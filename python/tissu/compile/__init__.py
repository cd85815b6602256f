"""Compiling: a scene becomes a constant world, or the complete list of what is wrong with it."""

from tissu.compile.check import Check, check_scene, problems_of
from tissu.compile.world import compile_scene

__all__ = ["Check", "check_scene", "compile_scene", "problems_of"]
