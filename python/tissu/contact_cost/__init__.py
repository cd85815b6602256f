"""What a step with contact costs, and how well it holds: the scenes of `tissu bench contact`."""

from tissu.contact_cost.measure import Row, measure
from tissu.contact_cost.responses import RESPONSES, by_response, measured_responses
from tissu.contact_cost.scenes import CASES, Case

__all__ = ["CASES", "RESPONSES", "Case", "Row", "by_response", "measure", "measured_responses"]
