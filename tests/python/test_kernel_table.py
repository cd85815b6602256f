"""The script that prints docs/measured/kernels.md: fastest repetitions, ratios, bounds."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SCRIPT = Path(__file__).parents[2] / "bench" / "kernels.py"


@pytest.fixture(scope="module")
def kernels() -> ModuleType:
    """bench/kernels.py as a module."""
    spec = importlib.util.spec_from_file_location("bench_kernels", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["bench_kernels"] = module
    spec.loader.exec_module(module)
    return module


def entry(name: str, ns: float, **counters: float) -> dict[str, Any]:
    """One repetition of ten elements, as the benchmark library writes it."""
    return {"name": f"{name}/min_time:0.050", "cpu_time": ns, "elements": 10.0, **counters}


def test_fastest_repetition_counts_and_aggregates_do_not(kernels: ModuleType) -> None:
    """A mean is not a row, and the slower repetition is forgotten."""
    mean = {**entry("kernel/tetra/stvk/force", 1.0), "run_type": "aggregate"}
    report = {"benchmarks": [entry("kernel/tetra/stvk/force", t) for t in (80.0, 50.0)] + [mean]}
    rows = kernels.rows_of(report)
    assert list(rows) == ["kernel/tetra/stvk/force"]
    assert rows["kernel/tetra/stvk/force"].ns_per_element == pytest.approx(5.0)


def test_baselines_are_shown_as_multiples_of_ours(kernels: ModuleType) -> None:
    """5 ns against 20 and 100 ns an element."""
    names = {"kernel": 50.0, "baseline/textbook": 200.0, "baseline/expanded": 1000.0}
    entries = [entry(f"{who}/tetra/stvk/force", ns) for who, ns in names.items()]
    text = kernels.baseline_table(kernels.rows_of({"benchmarks": entries}))
    assert "| tetra, force | 5 | 20 | 4.0 | 100 | 20.0 |" in text


def test_a_definite_matrix_is_shown_beside_the_exact_one(kernels: ModuleType) -> None:
    """5 ns and 10 ns an element; a row without its twin is left out."""
    times = {
        "fem/tetra/stvk/exact": 50.0,
        "fem/tetra/stvk/definite": 100.0,
        "fem/line/x/exact": 1.0,
    }
    entries = [entry(f"definite/{name}", ns) for name, ns in times.items()]
    text = kernels.definite_table(kernels.rows_of({"benchmarks": entries}))
    assert "| fem, tetra, stvk | 5 | 10 | 2.0 |" in text
    assert "line" not in text


def test_the_part_whose_absence_saves_most_bounds_the_kernel(kernels: ModuleType) -> None:
    """Of 10 ns the scatter takes 6."""
    parts = {
        "arithmetic": 3.0,
        "constants": 1.0,
        "constants, gather": 2.0,
        "constants, gather, arithmetic": 4.0,
        "constants, gather, scatter": 8.0,
        "constants, gather, arithmetic, scatter": 10.0,
    }
    entries = [entry(f"ablation/{part}", 10.0 * ns) for part, ns in parts.items()]
    text = kernels.ablation_table(kernels.rows_of({"benchmarks": entries}))
    assert "the arithmetic 20 %, the scatter 60 %, the gather 10 %, the constants 10 %" in text
    assert text.endswith("The largest is the scatter.")


def test_a_kernel_is_named_by_the_limit_that_it_is_nearest_to(kernels: ModuleType) -> None:
    """Of 10 ns four nodes gathered in 0.5 ns and scattered in 1 ns each take 6; a product's 8."""
    parts = {"constants": 1.0, "constants, gather": 3.0, "constants, gather, scatter": 7.0}
    entries = [entry(f"ablation/{part}", 10.0 * ns) for part, ns in parts.items()]
    shares = {"of peak": 0.3, "of bandwidth": 0.7, "nodes/element": 4.0}
    entries += [entry(f"kernel/tetra/stvk/{job}", 100.0, **shares) for job in ("force", "product")]
    entries.append(entry("kernel/tetra/stvk/assembly", 100.0, **shares, **{"of writing": 0.75}))
    rows = kernels.rows_of({"benchmarks": entries})
    moved = kernels.moved_of(rows)
    assert moved == pytest.approx((0.5, 1.0))
    found = [kernels.bound_of(rows[f"kernel/tetra/stvk/{j}"], j, moved) for j in kernels.JOBS]
    assert found == ["constants 70 %", "gather, scatter 80 %", "writing 75 %"]
