"""The script that writes docs/measured/scaling.md: targets met and missed, exponents, threads."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))

import scaling
import scaling_rows
import targets

STEP = ("force share", "matrix share", "preconditioner share", "solve share", "solve of bandwidth")


def entry(name: str, ns: float, **counters: float) -> dict[str, Any]:
    """One repetition, as the benchmark library writes it."""
    return {"name": f"{name}/min_time:0.050/real_time", "cpu_time": ns, "real_time": ns,
            "time_unit": "ns", "elements": 1000.0, "bytes/element": 300.0,
            **counters}  # fmt: skip


def step(name: str, ms: float, **counters: float) -> dict[str, Any]:
    """One of whole steps, ten in an iteration."""
    numbers = {**dict.fromkeys(STEP, 0.25), "CG iterations": 20.0, "nodes": 500.0, "steps": 10.0}
    resident = {"resident bytes/element": 800.0}
    return entry(name, 1e7 * ms, **{**numbers, **resident, **counters})


def report(power: float = 1.0, second: float = 0.5) -> list[dict[str, Any]]:
    """Everything that the page reads: steps grow with a power, two threads take a share of one."""
    rows = [entry("kernel/tetra/stvk/force", 1e4, **{"of peak": 0.4, "of bandwidth": 0.1})]
    rows += [entry("baseline/textbook/tetra/stvk/force", 5e4), entry("rotation/polar", 1e4)]
    for kind, unit in (("multiply-add", "GFLOP/s"), ("triad from memory", "GB/s")):
        rows += [entry(f"limit/{kind}/8", 1.0, **{unit: 20.0})]
        rows += [entry(f"limit/{kind}, 2 threads/8", 1.0, **{unit: 30.0})]
    for threads, share in ((1, 1.0), (2, second)):
        for size in targets.SIZES:
            more = {"elements": float(size)}
            ns = 20.0 * size * share
            rows += [entry(f"scale/{p}/{size}/{threads}", ns, **more) for p in targets.PARTS]
            for place, solver in enumerate(targets.SOLVERS):
                ms = share * (1 + place) * (size / 1e4) ** power
                rows.append(step(f"scale/step, {solver}/{size}/{threads}", ms, **more))
        for size in (1000, 1_000_000):
            numbers = {"of bandwidth": 0.8, "bytes": 1e6, "GB/s": 50.0}
            rows.append(entry(f"solve/product/double/{size}/{threads}", 1e5, **numbers))
        for solver, ms in (("block_jacobi", 4.0), ("incomplete_cholesky", 5.0)):
            for body in ("mixed body", "corotational 50k"):
                rows.append(step(f"target/{body}, {solver}/{threads}", ms * share))
        rows.append(entry(f"corotational step, 20 CG/{threads}", 2e7 * share))
    context = {"num_cpus": 2, "caches": [], "instruction set": "avx2", "compiler": "GCC",
               "date": "2026-01-01", "load_avg": [1.5]}  # fmt: skip
    return [{"context": context, "benchmarks": rows, "others": 0.5, "seconds": 10.0}]


def test_every_target_is_met_by_good_numbers() -> None:
    rows = scaling_rows.rows_of(report())
    found = [target(rows) for target in targets.TARGETS]
    assert all(target.met for target in found)
    assert found[0].measured == "5.0 times (10.0 against 50.0 ns an element)"
    assert found[3].measured.startswith("250 steps/s on one thread, 500 steps/s on two")
    assert "Missed" not in scaling.target_table(rows)


def test_a_cost_that_grows_too_fast_is_missed_with_its_exponent() -> None:
    rows = scaling_rows.rows_of(report(power=1.3))
    text = scaling.target_table(rows)
    assert "n^1.30 with block_jacobi, the fastest at a million | **no** |" in text
    assert "Missed, and what bounds it:" in text
    # 100 times the elements: 100^0.15 times too much
    assert "The cost is 2.0 times what the target allows at 1,000,000 elements" in text


def test_a_second_thread_that_gives_too_little_is_missed_by_its_share() -> None:
    found = targets.threads(scaling_rows.rows_of(report(second=0.8)))
    assert not found.met
    assert found.measured.startswith("1.25 to 1.25 times; 0 of 15")
    assert "26 % short" in found.why  # 1.25 of 1.7
    assert "triad from memory 1.50" in found.why


def test_memory_counts_what_the_process_grew_by() -> None:
    made = report()
    for row in made[0]["benchmarks"]:
        if "resident bytes/element" in row:
            row["resident bytes/element"] = 1100.0
    found = targets.memory(scaling_rows.rows_of(made))
    assert not found.met
    assert found.why.startswith("10 % too much")


def test_one_thread_counts_by_the_processor_and_two_by_the_clock() -> None:
    """The fastest repetition of each."""
    times = [{"cpu_time": 1.0, "real_time": 9.0}, {"cpu_time": 2.0, "real_time": 3.0}]
    entries = [
        {**entry(f"scale/force/1000/{threads}", 0.0), **time}
        for threads in (1, 2)
        for time in times
    ]
    rows = scaling_rows.rows_of([{"benchmarks": entries}])
    assert rows["scale/force/1000/1"].ns == 1.0
    assert rows["scale/force/1000/2"].ns == 3.0


def test_the_page_says_that_the_machine_was_loaded() -> None:
    text = scaling.page(report())
    assert "others used 0.5 of the machine's processors" in text
    assert "a loaded machine" in text
    assert " nan " not in text


def test_names_lose_what_the_library_appends() -> None:
    name = "limit/triad from L3, 2 threads/262144/real_time"
    assert scaling_rows.name_of({"name": name}) == "limit/triad from L3, 2 threads/262144"
    assert scaling_rows.threads_of(name) == 2
    assert scaling_rows.threads_of("scale/force/1000/1") == 1


def test_without_two_threads_the_page_says_so_and_has_the_rest() -> None:
    made = report()
    rows = [e for e in made[0]["benchmarks"] if not re.search("/2/min|, 2 threads", e["name"])]
    made[0]["benchmarks"] = rows
    text = scaling.page(made)
    assert "Two threads were not measured." in text
    assert "from 10,000 elements on | not measured |  |" in text
    assert "| multiply-add, GFLOP/s | 20 |  |  |" in text


def test_every_row_is_measured_in_one_pass_of_the_patterns_that_are_meant() -> None:
    rows = ["limit/triad from L2/8", "limit/multiply-add, 2 threads/real_time", "rotation/polar"]
    rows += [f"scale/{part}/{size}/{threads}/min_time:0.050"
             for part in ("force", "step, block_jacobi") for size in targets.SIZES
             for threads in (1, 2)]  # fmt: skip
    for threads in (1, 2):
        patterns = scaling_rows.filters(1, threads)[:-1]  # the limits come twice
        for row in rows:
            wanted = threads >= scaling_rows.threads_of(row.split("/min_time")[0])
            assert sum(bool(re.search(p, row)) for p in patterns) == int(wanted), row
