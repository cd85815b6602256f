"""One program of bench/peers.py in a process of its own: `python peer_worker.py PROGRAM`.

Reads a request a line and answers each with a line, both JSON:

    {"do": "make", "work": FILE, "way": WAY}  ->  {"version": …, "seconds": …}
    {"do": "turn", "steps": N}  ->  {"ms": […], "seen": [[…], …], "unsolved": N or null}

Milliseconds are the process's CPU time. What goes wrong is an answer too: {"missing": …} where the
program is not installed, {"failed": …} otherwise.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

sys.path.insert(0, str(Path(__file__).resolve().parent))
if TYPE_CHECKING:
    from peer_work import Running


def answers_only() -> TextIO:
    """What was stdout; all that programs print goes to stderr from now on."""
    kept = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return kept


def turn(running: Running, steps: int) -> dict[str, Any]:
    """Some steps, each timed."""
    ms, seen = [], []
    for _ in range(steps):
        begin = time.process_time()
        running.step()
        ms.append(1e3 * (time.process_time() - begin))
        seen.append(running.seen())
    return {"ms": ms, "seen": seen, "unsolved": running.unsolved()}


def main() -> int:
    """Until its input ends."""
    out = answers_only()
    running: Running | None = None
    for line in sys.stdin:
        asked = json.loads(line)
        try:
            program = importlib.import_module(f"peer_{sys.argv[1]}")
            work = importlib.import_module("peer_work").Work
            if asked["do"] == "make":
                begin = time.perf_counter()
                running = program.make(work.read(asked["work"]), asked["way"])
                seconds = time.perf_counter() - begin
                answer = {"version": program.version(), "seconds": seconds}
            else:
                assert running is not None
                answer = turn(running, asked["steps"])
        except ImportError as error:
            answer = {"missing": str(error)}
        except Exception as error:  # whatever a program throws is a row of the table
            lines = str(error).splitlines()
            answer = {"failed": f"{type(error).__name__}: {lines[0] if lines else ''}"}
        print(json.dumps(answer), file=out, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
