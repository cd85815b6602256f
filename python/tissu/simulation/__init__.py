"""A compiled scene: its state, and the loop that moves it."""

from tissu.simulation.compliance import Compliance
from tissu.simulation.cutting import Mark
from tissu.simulation.fields import IntegrationPoints
from tissu.simulation.grab import Grab
from tissu.simulation.instruments import Tool
from tissu.simulation.live_load import LiveLoad
from tissu.simulation.plan import Plan
from tissu.simulation.profile import Profile, ProfileRow, Solves, WorstStep
from tissu.simulation.report import StepReport
from tissu.simulation.simulation import Simulation
from tissu.simulation.touched import Contacts, Crossing, Overlap, Wrench

__all__ = [
    "Compliance",
    "Contacts",
    "Crossing",
    "Grab",
    "IntegrationPoints",
    "LiveLoad",
    "Mark",
    "Overlap",
    "Plan",
    "Profile",
    "ProfileRow",
    "Simulation",
    "Solves",
    "StepReport",
    "Tool",
    "WorstStep",
    "Wrench",
]
