"""Kills a process that writes checkpoints, again and again, and looks at what it leaves.

python checkpoint_killed.py FOLDER KILLS WANTED prints one JSON object: how often the file was not
whole or not one of the two states that it may be, how often the kill left a file half done beside
it, how often the state was the one before and the one being written, and what lies in the folder
at last. Where fewer than WANTED kills came while a file was written, as on a machine with other
work, it goes on, up to ten times KILLS.
"""

import hashlib
import json
import os
import random
import signal
import sys
import time
from pathlib import Path

import tissu as ts
from tissu.checkpoint.checkpoint import read_checkpoint

SCENE = ts.Scene(
    bodies={
        "bar": ts.Body(
            mesh=ts.BarMesh(size=(1, 0.5, 0.5), cells=(16, 12, 12)),
            law=ts.StVK(young=1e4, poisson=0.3),
            density=1e3,
        )
    },
    gravity=(0, 0, -9.81),
    step=ts.ImplicitEuler(0.01),
)


def digest(positions):
    return hashlib.sha256(positions.tobytes()).hexdigest()


def write_for_ever(simulation, path, log):
    """Each state is told before it is written and after; the state changes as by a step."""
    number = int(simulation.time)
    while True:
        number += 1
        simulation._core.time = float(number)
        simulation.positions["bar"][:] += 1e-3
        now = digest(simulation.positions["bar"])
        os.write(log, f"begin {number} {now}\n".encode())
        simulation.save_checkpoint(path)
        os.write(log, f"done {number} {now}\n".encode())


def kill_once(simulation, path, log_path, moment):
    """The two states that may be in the file after a kill: the latest done, and the one begun."""
    log = os.open(log_path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND)
    child = os.fork()
    if child == 0:
        try:
            write_for_ever(simulation, path, log)
        finally:
            os._exit(1)
    os.close(log)
    while b"done" not in log_path.read_bytes():
        time.sleep(1e-3)
    time.sleep(moment)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    lines = [line.split() for line in log_path.read_text().splitlines()]
    done = [line for line in lines if line[0] == "done"][-1]
    return [(float(number), now) for _, number, now in (done, lines[-1])]


def main(folder, kills, wanted):
    random.seed(5)
    path, log_path = folder / "run.checkpoint", folder / "log"
    simulation = SCENE.compile()
    wrong, halves, most, before, new = [], 0, 0, 0, 0
    for number in range(10 * kills):
        if number >= kills and min(halves, before) >= wanted:
            break
        allowed = kill_once(simulation, path, log_path, random.uniform(0.0, 0.03))
        beside = len(list(folder.glob(".*")))
        halves, most = halves + (beside > 0), max(most, beside)
        try:
            found = read_checkpoint(path).snapshot
            state = (found["time"], digest(found["positions"]))
            if allowed[0] != allowed[1]:
                before, new = before + (state == allowed[0]), new + (state == allowed[1])
            if state not in allowed:
                wrong.append(f"{state} is none of {allowed}")
        except ts.CheckpointError as error:
            wrong.append(str(error))
    simulation.save_checkpoint(path)
    left = sorted(p.name for p in folder.iterdir())
    told = {"wrong": wrong, "halves": halves, "most": most, "before": before, "new": new}
    print(json.dumps({**told, "left": left}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
