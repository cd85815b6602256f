"""Runs the cases of one fuzzer: run.py scenes|meshes|options SEED COUNT [SECONDS].

Each seed is printed before its case, so that a crash or a wait shows which it was; a case that
fails is run again by itself with its seed and a count of 1. The last line counts what came of them.
"""

from __future__ import annotations

import collections
import importlib
import resource
import signal
import sys
import tempfile
import time
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
MEMORY = 16 * 2**30  # bytes of addresses
PATIENCE = 120  # s for a case, where the slowest takes one
FUZZERS = ("scenes", "meshes", "options")


def main() -> int:
    """Runs them; 1 when a case raised what no user should see."""
    name, seed, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    seconds = float(sys.argv[4]) if len(sys.argv) > 4 else float("inf")
    attempt = importlib.import_module(name).attempt
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    warnings.simplefilter("ignore")
    came: collections.Counter[str] = collections.Counter()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="tissu-fuzz-") as folder:
        for number in range(seed, seed + count):
            if time.monotonic() - begin > seconds:
                break
            print(f"seed {number}", flush=True)
            signal.alarm(PATIENCE)
            came[attempt(number, Path(folder))] += 1
            signal.alarm(0)
    print(f"{name}: " + ", ".join(f"{n} {what}" for what, n in sorted(came.items())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
