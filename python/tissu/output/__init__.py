"""Results on disk: a series of VTU files with its PVD index, and a summary."""

from tissu.output.contact_tally import ContactTally
from tissu.output.folder import folder_of_run, prepare_folder
from tissu.output.series import Series
from tissu.output.summary import StepTally, summarise, write_summary

__all__ = [
    "ContactTally",
    "Series",
    "StepTally",
    "folder_of_run",
    "prepare_folder",
    "summarise",
    "write_summary",
]
