"""Work and precision: what each choice in a scene costs, and how near it comes to a reference."""

from tissu.accuracy.case import Case, read_case, read_cases
from tissu.accuracy.front import cheapest, front
from tissu.accuracy.study import Run, Study, study

__all__ = ["Case", "Run", "Study", "cheapest", "front", "read_case", "read_cases", "study"]
