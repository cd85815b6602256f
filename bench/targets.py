"""The targets for speed and memory: what was measured, by how much it misses, and what bounds it.

Every sentence is made from the rows of tissu-bench (scaling_rows.py).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from scaling_rows import Row, Rows

SOLVERS = (
    "block_jacobi",
    "block_jacobi single",
    "incomplete_cholesky",
    "incomplete_cholesky single",
    "multigrid",
    "multigrid single",
)
PARTS = ("force", "tangent product", "assembly", "matrix product")
SIZES = (1_000, 10_000, 100_000, 1_000_000)
MILLION = SIZES[-1]

TEXTBOOK = 3.0  # times
SPEED_UP = 1.7
BANDWIDTH = 0.7
MIXED = 100.0  # steps a second
COROTATIONAL = 10.0
EXPONENT = 1.15
BYTES = 1000.0


@dataclass(frozen=True)
class Target:
    """One line of the table, and why where it is missed."""

    wanted: str
    measured: str
    met: bool | None  # None: not measured
    why: str = ""


def on_threads(rows: Rows, name: str) -> dict[int, Row]:
    """The row of one thread, and that of two where it was measured."""
    return {n: rows[f"{name}/{n}"] for n in (1, 2) if n == 1 or f"{name}/{n}" in rows}


def on(threads: int) -> str:
    """In words."""
    return "on one thread" if threads == 1 else "on two"


def step_row(rows: Rows, solver: str, size: int, threads: int = 1) -> Row:
    """Whole steps of the cube."""
    return rows[f"scale/step, {solver}/{size}/{threads}"]


def best_solver(rows: Rows, size: int, threads: int = 1) -> str:
    """The one of least time for a step."""
    return min(SOLVERS, key=lambda s: step_row(rows, s, size, threads).step_ms)


def exponent(small: Row, large: Row, value: Callable[[Row], float]) -> float:
    """P of value ~ elements^p."""
    ratio = large["elements"] / small["elements"]
    return math.log(value(large) / value(small)) / math.log(ratio)


def missed(value: float, wanted: float) -> str:
    """By how much, for what is to be at least that."""
    return f"{100 * (1 - value / wanted):.0f} % short"


def textbook(rows: Rows) -> Target:
    """The force against plain loops."""
    ours = rows["kernel/tetra/stvk/force"]
    other = rows["baseline/textbook/tetra/stvk/force"]
    ratio = other.per_element / ours.per_element
    measured = (
        f"{ratio:.1f} times ({ours.per_element:.1f} against {other.per_element:.1f} ns an element)"
    )
    why = (
        f"{missed(ratio, TEXTBOOK)}; the force reaches {100 * ours['of peak']:.0f} % of the "
        f"multiply-add limit and {100 * ours['of bandwidth']:.0f} % of the triad's bandwidth; "
        "[kernels.md](kernels.md) takes it apart."
    )
    return Target(
        f"StVK force on tetrahedra at least {TEXTBOOK:.0f} times as fast as the textbook's loop",
        measured,
        ratio >= TEXTBOOK,
        why,
    )


def speed_up(rows: Rows, what: str, size: int) -> float:
    """Of two threads over one."""
    one, two = (rows[f"scale/{what}/{size}/{threads}"] for threads in (1, 2))
    return one.ns / two.ns


def speed_ups(rows: Rows) -> dict[tuple[str, int], float]:
    """Of every part, and of a step with the best solver of its size, from 10,000 elements on."""
    found = {}
    for size in SIZES[1:]:
        named = {part: part for part in PARTS} | {"step": f"step, {best_solver(rows, size)}"}
        for name, what in named.items():
            if f"scale/{what}/{size}/2" in rows:
                found[name, size] = speed_up(rows, what, size)
    return found


def limit_ratios(rows: Rows) -> dict[str, float]:
    """What two threads of the machine do more than one, with nothing else to do."""
    ratios = {}
    for name, one in rows.items():
        if not name.startswith("limit/") or ", 2 threads" in name:
            continue
        kind = name.split("/")[1]
        two = next(row for n, row in rows.items() if n.split("/")[1] == f"{kind}, 2 threads")
        unit = "GFLOP/s" if "GFLOP/s" in one.counters else "GB/s"
        ratios[kind] = two[unit] / one[unit]
    return ratios


def threads(rows: Rows) -> Target:
    """Two threads against one."""
    wanted = f"two threads at least {SPEED_UP} times as fast as one from 10,000 elements on"
    found = speed_ups(rows)
    if not found:
        return Target(wanted, "not measured", None)
    good = sum(ratio >= SPEED_UP for ratio in found.values())
    (part, size), least = min(found.items(), key=lambda item: item[1])
    measured = (
        f"{min(found.values()):.2f} to {max(found.values()):.2f} times; "
        f"{good} of {len(found)} parts and sizes reach it"
    )
    limits = ", ".join(f"{kind} {ratio:.2f}" for kind, ratio in limit_ratios(rows).items())
    why = (
        f"{missed(least, SPEED_UP)} at the least, {part} at {size:,} elements. What the machine "
        f"itself gains from a second thread, with nothing else to do: {limits}; what reads memory "
        "cannot gain more than the triad from there, and a second core that others use is not free."
    )
    return Target(wanted, measured, least >= SPEED_UP, why)


def product(rows: Rows) -> Target:
    """The product of a matrix that no cache holds."""
    found = on_threads(rows, f"solve/product/double/{MILLION}")
    shares = {threads: row["of bandwidth"] for threads, row in found.items()}
    measured = ", ".join(f"{100 * share:.0f} % {on(threads)}" for threads, share in shares.items())
    times = ", ".join(f"{row.ns / 1e6:.1f} ms {on(threads)}" for threads, row in found.items())
    why = (
        f"{missed(min(shares.values()), BANDWIDTH)}: {found[1]['bytes'] / 1e6:.0f} MB are read in "
        f"{times}; in L2 the same loop moves "
        f"{rows['solve/product/double/1000/1']['GB/s']:.0f} GB/s, so it waits for memory."
    )
    return Target(
        f"sparse product at {100 * BANDWIDTH:.0f} % of the triad's bandwidth out of cache",
        measured,
        min(shares.values()) >= BANDWIDTH,
        why,
    )


def shares(row: Row) -> str:
    """Where the time of a step goes."""
    parts = ("force", "matrix", "preconditioner", "solve")
    return ", ".join(f"{part} {100 * row[f'{part} share']:.0f} %" for part in parts)


def best_rate(rows: Rows, body: str) -> tuple[str, Row, str]:
    """Steps a second of the fastest solver, in words; the faster of its rows; on what."""
    everything = {
        solver: on_threads(rows, f"target/{body}, {solver}")
        for solver in SOLVERS
        if f"target/{body}, {solver}/1" in rows
    }
    best = max(everything, key=lambda s: max(row.rate for row in everything[s].values()))
    found = everything[best]
    text = ", ".join(f"{row.rate:.0f} steps/s {on(threads)}" for threads, row in found.items())
    threads = max(found, key=lambda n: found[n].rate)
    text = f"{text} ({found[1]['CG iterations']:.0f} iterations a step), {best}"
    return text, found[threads], on(threads)


def bandwidth(row: Row) -> str:
    """What the solve reaches, where it is known what it moves."""
    if "solve of bandwidth" not in row.counters:
        return ""
    return f", the solve at {100 * row['solve of bandwidth']:.0f} % of the triad's bandwidth"


def mixed(rows: Rows) -> Target:
    """A body of four element types."""
    text, one, how = best_rate(rows, "mixed body")
    why = f"{missed(one.rate, MIXED)} {how}; of a step {shares(one)}{bandwidth(one)}."
    return Target(
        f"mixed body of {one['nodes']:.0f} nodes and {one['elements']:.0f} elements, StVK, "
        f"implicit Euler (CG 1e-6) above {MIXED:.0f} steps a second",
        text,
        one.rate > MIXED,
        why,
    )


def corotational(rows: Rows) -> Target:
    """Fifty thousand tetrahedra with the iterations of the published figure."""
    found = on_threads(rows, "corotational step, 20 CG")
    published = {threads: 1e9 / row.ns for threads, row in found.items()}
    return Target(
        f"50,688 corotational tetrahedra above {COROTATIONAL:.0f} steps a second, 20 iterations "
        "of the conjugate gradient as published",
        ", ".join(f"{rate:.0f} steps/s {on(threads)}" for threads, rate in published.items()),
        published[1] > COROTATIONAL,
        f"{missed(published[1], COROTATIONAL)} on one thread.",
    )


def corotational_solved(rows: Rows) -> Target:
    """The same beam, every step solved."""
    text, one, how = best_rate(rows, "corotational 50k")
    why = f"{missed(one.rate, COROTATIONAL)} {how}; of a step {shares(one)}{bandwidth(one)}."
    return Target(
        f"the same above {COROTATIONAL:.0f} steps a second, solved to 1e-6",
        text,
        one.rate > COROTATIONAL,
        why,
    )


def growth(rows: Rows) -> Target:
    """Time of a step from ten thousand elements to a million."""
    solver = best_solver(rows, MILLION)
    small, large = (step_row(rows, solver, size) for size in (SIZES[1], MILLION))
    found = exponent(small, large, lambda row: row.step_ms)
    iterations = exponent(small, large, lambda row: row["CG iterations"])
    solve = exponent(
        small, large, lambda row: row.step_ms * row["solve share"] / row["CG iterations"]
    )
    rest = exponent(small, large, lambda row: row.step_ms * (1 - row["solve share"]))
    why = (
        f"The cost is {(large['elements'] / small['elements']) ** (found - EXPONENT):.1f} times "
        f"what the target allows at {large['elements']:,.0f} elements. Iterations grow from "
        f"{small['CG iterations']:.0f} to {large['CG iterations']:.0f} a step, "
        f"n^{iterations:.2f}; an iteration costs n^{solve:.2f}, as the matrix leaves the caches; "
        f"the rest of a step n^{rest:.2f}."
    )
    return Target(
        f"cost of a step no faster than n^{EXPONENT} from 10,000 to 1,000,000 elements",
        f"n^{found:.2f} with {solver}, the fastest at a million",
        found <= EXPONENT,
        why,
    )


def memory(rows: Rows) -> Target:
    """What an implicit step holds."""
    solver = best_solver(rows, MILLION)
    row = step_row(rows, solver, MILLION)
    matrix = rows[f"scale/matrix product/{MILLION}/1"]["bytes/element"]
    model = rows[f"scale/force/{MILLION}/1"]["bytes/element"]
    resident = row["resident bytes/element"]
    least = min(step_row(rows, s, MILLION)["resident bytes/element"] for s in SOLVERS)
    return Target(
        f"less than {BYTES / 1000:.0f} kB a tetrahedron for an implicit step",
        f"{row['bytes/element']:.0f} bytes in model, matrix and solver ({solver}); "
        f"the whole process grew by {resident:.0f}",
        max(row["bytes/element"], resident) < BYTES,
        f"{100 * (max(row['bytes/element'], resident) / BYTES - 1):.0f} % too much: model "
        f"{model:.0f}, matrix {matrix:.0f}, solver {row['bytes/element'] - model - matrix:.0f}, "
        f"the rest is states and world; the least of the solvers takes {least:.0f}.",
    )


TARGETS: tuple[Callable[[Rows], Target], ...] = (
    textbook,
    threads,
    product,
    mixed,
    corotational,
    corotational_solved,
    growth,
    memory,
)
