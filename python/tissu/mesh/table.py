"""The printed form of a quality report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from tissu.counted import counted
from tissu.mesh.mesh import first_five

if TYPE_CHECKING:
    from tissu.mesh.quality import QualityReport


def table(report: QualityReport) -> str:
    """One line for each fact; faults only where there are some."""
    rows = [*_extent(report), *_surface(report), *_shapes(report), *_faults(report)]
    rows += [
        ("region", f"{name}: {counted(count, 'cell')}") for name, count in report.regions.items()
    ]
    rows += [("note", note) for note in report.notes]
    return "\n".join([report.name, *(f"  {label:<14} {text}" for label, text in rows)])


def _extent(report: QualityReport) -> Iterator[tuple[str, str]]:
    low, high = report.bounds
    yield "nodes", f"{report.node_count}"
    yield "cells", ", ".join(f"{n} {kind}" for kind, n in report.cells.items()) or "none"
    yield "size", " x ".join(f"{length:.4g}" for length in high - low) + " m"
    yield "from", "(" + ", ".join(f"{x:.4g}" for x in low) + ")"
    yield "to", "(" + ", ".join(f"{x:.4g}" for x in high) + ")"
    if np.isfinite(report.volume):
        yield "volume" if report.solid else "encloses", f"{abs(report.volume):.5g} m3"
    yield "parts", f"{report.parts}"


def _surface(report: QualityReport) -> Iterator[tuple[str, str]]:
    state = (
        "closed"
        if report.closed
        else f"open: {counted(report.open_edges, 'edge')} with one triangle"
    )
    yield "surface", f"{counted(report.triangles, 'triangle')}, {report.area:.5g} m2, {state}"


def _shapes(report: QualityReport) -> Iterator[tuple[str, str]]:
    if not len(report.shapes):
        return
    worst = ", ".join(f"{cell} ({report.shapes[cell]:.3g})" for cell in report.worst)
    unit = "m3" if report.solid else "m2"
    shape = f"min {report.min_quality:.3f}, median {report.median_quality:.3f}"
    yield "shape", f"{shape} (1 ideal, 0 flat)"
    yield "worst cells", worst
    yield "cell size", f"{report.sizes.min():.4g} to {report.sizes.max():.4g} {unit}"
    if report.sizes.mean() > 0.0:
        yield "smallest", f"{100.0 * report.sizes.min() / report.sizes.mean():.3g} % of the mean"


def _faults(report: QualityReport) -> Iterator[tuple[str, str]]:
    numbered = (
        ("INVERTED", report.inverted, "cell", "inside out"),
        ("NO VOLUME", report.zero_volume, "cell", "flat"),
        ("UNUSED", report.unused_nodes, "node", "that no cell uses"),
    )
    for label, numbers, noun, what in numbered:
        if len(numbers):
            yield label, f"{counted(len(numbers), noun)} {what} ({first_five(numbers)})"
    if report.overfull_faces:
        yield "OVERLAP", f"{counted(report.overfull_faces, 'face')} shared by more than two cells"
    if report.nonconforming_faces:
        cells = f"(cells {first_five(report.nonconforming_cells)})"
        faces = counted(report.nonconforming_faces, "face")
        verb = "does" if report.nonconforming_faces == 1 else "do"
        yield "NO MATCH", f"{faces} that {verb} not match {cells}"
    if report.clashing_edges:
        text = (
            f"{counted(report.clashing_edges, 'edge')} whose triangles are wound against each other"
        )
        yield "WINDING", text
    if report.volume < 0.0 and not report.solid:
        yield "WINDING", "faces are wound inwards"
    if report.unhandled:
        yield "NOT HANDLED", f"cells of type {', '.join(report.unhandled)} cannot be simulated yet"
