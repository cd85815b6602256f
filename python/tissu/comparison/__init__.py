"""The same scene with each of several models: error, time, memory, largest stable step."""

from tissu.comparison.run import compare
from tissu.comparison.table import Comparison, Row

__all__ = ["Comparison", "Row", "compare"]
