"""Mesh files with bytes changed, lines doubled, numbers replaced, ends cut off."""

from __future__ import annotations

import functools
import random
import re
from pathlib import Path

import tissu as ts

ENDINGS = (".vtu", ".vtk", ".msh", ".mesh", ".inp", ".off", ".obj", ".stl", ".ply", ".su2", ".bdf")
NUMBERS = (b"-1", b"0", b"1e400", b"nan", b"99999999999", b"2147483648", b"1e-320", b"x", b"")


@functools.cache
def whole(ending: str, folder: Path) -> bytes:
    """A mesh of this format."""
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 1, 1))
    surface = ending in (".off", ".obj", ".stl", ".ply")
    file = folder / f"whole{ending}"
    if ending == ".off":
        points, triangles = mesh.points, mesh.surface().triangles
        rows = [f"OFF\n{len(points)} {len(triangles)} 0"]
        rows += [" ".join(map(str, point)) for point in points.tolist()]
        rows += ["3 " + " ".join(map(str, nodes)) for nodes in triangles.tolist()]
        file.write_text("\n".join(rows))
    else:
        made = mesh.surface_mesh() if surface else mesh
        ts.write_mesh(made, file)
    return file.read_bytes()


def mutated(data: bytes, dice: random.Random) -> bytes:
    """The bytes with one to four things changed."""
    for _ in range(dice.choice((1, 1, 1, 2, 4))):
        kind, place = dice.random(), dice.randrange(max(len(data), 1))
        if kind < 0.3:
            data = data[:place] + bytes([dice.randrange(256)]) + data[place + 1 :]
        elif kind < 0.4:
            data = data[:place]
        elif kind < 0.5:
            data = data[:place] + data[place + dice.randint(1, 40) :]
        elif kind < 0.65:
            lines = data.split(b"\n")
            line = dice.randrange(len(lines))
            lines[line : line + 1] = [lines[line]] * dice.choice((0, 2, 2, 50))
            data = b"\n".join(lines)
        else:
            numbers = list(re.finditer(rb"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", data))
            if numbers:
                match = dice.choice(numbers)
                data = data[: match.start()] + dice.choice(NUMBERS) + data[match.end() :]
    return data


def attempt(seed: int, folder: Path) -> str:
    """One file: read, looked at, or refused in a sentence; what came of it."""
    dice = random.Random(seed)
    ending = dice.choice(ENDINGS)
    file = folder / f"mesh{dice.choice((ending, ending, ending, dice.choice(ENDINGS)))}"
    file.write_bytes(mutated(whole(ending, folder), dice))
    try:
        mesh = ts.read_mesh(file)
        str(mesh.quality())
        return "read"
    except ts.TissuError as error:
        text = str(error)
        assert text.strip() and len(text) < 3000, text[:3000]
        assert "\n" not in text.strip(), text
        return "refused"
