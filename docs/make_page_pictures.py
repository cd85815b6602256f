"""Runs pages and keeps the pictures that they draw: python docs/make_page_pictures.py."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from make_gallery import kept

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT.parent / "tests" / "python"))

from page_blocks import run_page  # noqa: E402

DRAWN = {
    "first-scene": ("learn/first-scene.md", "results/liver/liver.png"),
    "own-organ": ("learn/own-organ.md", "liver.png"),
    "touch-and-cut": ("learn/touch-and-cut.md", "cut.png"),
    "organ-cut": ("learn/touch-and-cut.md", "organ.png"),
    "operation": ("learn/touch-and-cut.md", "results/operation/operation.png"),
}
"""Name of the picture -> the page, and what its blocks draw."""


def main() -> None:
    """Runs every page in a folder of its own."""
    here = Path.cwd()
    for name, (page, drawn) in DRAWN.items():
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            run_page(ROOT / page)
            kept(Path(drawn), ROOT / "pictures" / f"{name}.webp")
            os.chdir(here)


if __name__ == "__main__":
    main()
