"""Where files may be written, and how: every file that tissu writes goes through this room."""

from tissu.files.names import distinct_names, file_name
from tissu.files.place import require_file_place, require_folder_place
from tissu.files.whole import whole_file

__all__ = [
    "distinct_names",
    "file_name",
    "require_file_place",
    "require_folder_place",
    "whole_file",
]
