"""The fuzzers as tests: some hundred cases of each, or as long as TISSU_FUZZ_SECONDS says.

TISSU_FUZZ_SEED chooses where the seeds begin. A failure shows its seed; that case alone:
python tests/fuzz/run.py scenes SEED 1
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

COUNTS = {"scenes": 300, "meshes": 300, "options": 120}
SEED = int(os.environ.get("TISSU_FUZZ_SEED", "1"))
SECONDS = os.environ.get("TISSU_FUZZ_SECONDS")
RUN = Path(__file__).with_name("run.py")


@pytest.mark.parametrize("name", COUNTS)
def test_no_input_ends_in_a_traceback_a_crash_or_a_wait(name):
    count = [str(COUNTS[name])] if SECONDS is None else [str(10**9), str(float(SECONDS) / 3)]
    command = [sys.executable, "-X", "faulthandler", str(RUN), name, str(SEED), *count]
    ended = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    last = ended.stdout.strip().splitlines()[-1:]
    print(*last)
    assert ended.returncode == 0, f"{name}, {last}:\n{ended.stderr[-4000:]}"
    # Both kinds of cases must come up, or the fuzzer looks at nothing.
    assert len(last[0].split(",")) >= 2, last
