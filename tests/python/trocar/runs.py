"""Runs of a trocar for tests: settings, counts of a path, the C++ tick and the NumPy law."""

import numpy as np

from tissu import _haptic
from tissu.trocar import kinematics
from tissu.trocar.law import Law
from tissu.trocar.model import LocalModel
from tissu.trocar.sample import Offered, Sample
from tissu.trocar.settings import fields_of, settings_from
from tissu.trocar.states import Status
from tissu.trocar.ticking import in_core

COUNTS = np.array([np.radians(0.01), np.radians(0.01), np.radians(0.05), 1e-4])
HOMED_IN = 1 | 2 | 4
"""Flags: homed, enabled, a tool in."""
PERIOD = 1e-3


def settings(**changes):
    """Of the tick: its defaults, with forces that are solved for to round-off."""
    tight = {"sweeps": 400, "tolerance": 1e-15, "run": True, "tag": 1}
    return fields_of(settings_from({**tight, **changes}))


def replayed(q, flags=None, tags=None, status=None):
    """A device that gives joints (n, 4), rounded to counts."""
    n = len(q)
    counts = np.zeros((n, 5), np.int32)
    counts[:, :4] = np.floor(np.asarray(q) / COUNTS + 1e-9)
    return _haptic.replayed(
        {
            "read": np.zeros(n, np.uint8) if status is None else status,
            "written": np.zeros(n, np.uint8),
            "counts": counts,
            "time_ns": np.arange(n, dtype=np.int64) * 1_000_000,
            "sequence": np.arange(n, dtype=np.uint32),
            "flags": np.full(n, HOMED_IN, np.uint16) if flags is None else flags,
            "tag": np.ones(n, np.uint64) if tags is None else tags,
        }
    )


def publish(run, model):
    """Hands a model to the C++ run; its stamp."""
    made = in_core(model, 1)
    run.publish(made)
    return made.stamp


def both(q, models, given, **columns):
    """Commands, reports, states and tanks of both at each tick of a path; the law at its end.

    models: number of a tick -> the model that is published before it.
    """
    device = replayed(q, **columns)
    run, law = _haptic.Run(device, settings_from(given), room=len(q) + 1), Law(given)
    offered, commands = None, []
    for k in range(len(q)):
        if k in models:
            stamp = publish(run, models[k])
            offered = Offered(models[k], stamp, (k - 1) * 1_000_000 if k else 0)
        run.step()
        records = run.records()
        status = Status(int(records["read"][0]))
        sample = Sample(
            tuple(int(c) for c in records["counts"][0]),
            int(records["time_ns"][0]),
            int(records["flags"][0]),
            int(records["tag"][0]),
        )
        command = law.tick(
            sample if status is Status.ok else None, offered, now_ns=k * 1_000_000, read=status
        )
        commands.append(
            (records["command"][0, :4], command, run.report(), law.state.name, law.tank.energy)
        )
    return commands, law


def walls(random, q, contacts, stiffness=(30.0, 300.0)):
    """A model of some contacts near the tip at q, with a random compliance."""
    normals = random.normal(size=(contacts, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    tangents = np.cross(normals, random.normal(size=(contacts, 3)))
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    points = random.uniform(-3e-3, 3e-3, (contacts, 3))
    x = np.array([kinematics.position(q, point) for point in points]).reshape(-1, 3)
    depth = random.uniform(-1e-3, 2e-3, contacts)
    B = random.normal(size=(3 * contacts, 3 * contacts))
    soft = 1.0 / random.uniform(*stiffness, contacts)
    scale = np.repeat(np.sqrt(soft), 3)
    W = (B @ B.T / (3 * contacts) + np.eye(3 * contacts)) * 0.5 * np.outer(scale, scale)
    return LocalModel(
        joints=q,
        points=points,
        anchors=x + depth[:, None] * normals,
        normals=normals,
        tangents=tangents,
        friction=random.uniform(0.0, 0.6, contacts),
        forces=np.zeros((contacts, 3)),
        compliance=W,
    )
