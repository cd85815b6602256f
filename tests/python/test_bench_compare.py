"""bench/compare.py: what changed is told, noise is not, and wrong input is one sentence."""

import itertools
import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import compare
import ranks
import reports


def noisy(
    seed: int, rows: int, repetitions: int, noise: float, factors: dict[int, float] | None = None
) -> dict[str, list[float]]:
    """Times of rows by number: 1 us, noise that makes nothing faster, now and then a large hit."""
    random = np.random.default_rng(seed)
    factors = factors or {}
    times = {}
    for row in range(rows):
        hit = 1.0 + 5.0 * (random.random(repetitions) < 0.03)
        drawn = 1e3 * (1.0 + noise * random.gamma(2.0, 0.5, repetitions)) * hit
        times[f"kernel/{row}"] = [float(t) for t in factors.get(row, 1.0) * drawn]
    return times


def report(times: dict[str, list[float]]) -> dict[str, Any]:
    """As Google Benchmark writes it, with an aggregate that must not count."""
    rows: list[dict[str, Any]] = []
    for name, values in times.items():
        rows += [
            {"name": name, "run_name": name, "run_type": "iteration", "real_time": 1.0,
             "cpu_time": t, "time_unit": "ns"}
            for t in values
        ]  # fmt: skip
        rows.append({"name": f"{name}_mean", "run_name": name, "run_type": "aggregate",
                     "cpu_time": 1e9, "real_time": 1e9, "time_unit": "ns"})  # fmt: skip
    return {"context": {}, "benchmarks": rows}


def written(path: Path, times: dict[str, list[float]]) -> str:
    """A report in a file."""
    path.write_text(json.dumps(report(times)), encoding="utf-8")
    return str(path)


def status(folder: Path, old: Any, new: Any, *more: str) -> int:
    """Of the comparison of two files."""
    files = [written(folder / "old.json", old), written(folder / "new.json", new)]
    return int(compare.main([*files, *more]))


# ---- the tests of ranks are exact


def brute_rank_sum(old: list[float], new: list[float]) -> float:
    """Every way to give out the labels."""
    values = np.array([*old, *new])
    ranks = np.array([(values < v).sum() + 0.5 * ((values == v).sum() + 1) for v in values])
    sums = [ranks[list(c)].sum() for c in itertools.combinations(range(len(values)), len(old))]
    mean = np.mean(sums)
    return float(np.mean(np.abs(sums - mean) >= abs(ranks[: len(old)].sum() - mean) - 1e-9))


def brute_signed_rank(differences: list[float]) -> float:
    """Every way to give out the signs."""
    size = np.abs(differences)
    ranks = np.array([(size < v).sum() + 0.5 * ((size == v).sum() + 1) for v in size])
    signs = itertools.product((0, 1), repeat=len(size))
    sums = [float(np.dot(s, ranks)) for s in signs]
    found = ranks[np.array(differences) > 0].sum()
    return float(np.mean(np.abs(sums - np.mean(sums)) >= abs(found - np.mean(sums)) - 1e-9))


@pytest.mark.parametrize("seed", range(5))
def test_ranks_of_two_files_as_by_counting_all_orders(seed: int) -> None:
    random = np.random.default_rng(seed)
    old = [float(x) for x in random.integers(0, 9, 5)]  # with ties
    new = [float(x) for x in random.integers(2, 12, 6)]
    assert ranks.rank_sum_chance(old, new) == pytest.approx(brute_rank_sum(old, new))


@pytest.mark.parametrize("seed", range(5))
def test_ranks_of_pairs_as_by_counting_all_signs(seed: int) -> None:
    random = np.random.default_rng(seed)
    differences = [float(x) for x in random.integers(1, 6, 9) * random.choice((-1, 1), 9)]
    assert ranks.signed_rank_chance(differences) == pytest.approx(brute_signed_rank(differences))


def test_apart_in_all_repetitions_is_the_least_chance() -> None:
    assert ranks.rank_sum_chance([1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]) == pytest.approx(
        2 / math.comb(8, 4)
    )
    assert ranks.signed_rank_chance([0.1, 0.2, 0.3, 0.4]) == pytest.approx(2 / 16)
    assert ranks.signed_rank_chance([0.0, 0.0]) == 1.0


def test_many_values_are_judged_as_few_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """Counted and normal chances of the same values agree to a percent or so."""
    random = np.random.default_rng(3)
    old, new = ([float(x) for x in random.normal(mean, 1.0, 25)] for mean in (0.0, 0.6))
    differences = [b - a for a, b in zip(old, new, strict=True)]
    counted = ranks.rank_sum_chance(old, new), ranks.signed_rank_chance(differences)
    monkeypatch.setattr(ranks, "MOST_COUNTED", 0)
    normal = ranks.rank_sum_chance(old, new), ranks.signed_rank_chance(differences)
    assert counted == pytest.approx(normal, abs=0.01)


# ---- verdicts


@pytest.mark.parametrize("noise", [0.01, 0.1, 0.5])
@pytest.mark.parametrize("seed", range(4))
def test_noise_gives_no_verdict(
    tmp_path: Path,
    noise: float,
    seed: int,
    capsys: pytest.CaptureFixture[str],
) -> None:
    old, new = (noisy(100 * seed + k, 200, 10, noise) for k in (1, 2))
    assert status(tmp_path, old, new) == 0
    assert "200 rows: 0 slower, 0 faster, 200 not told apart" in capsys.readouterr().out


def test_slower_and_faster_rows_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = noisy(2, 60, 10, 0.05, {3: 1.3, 7: 1.2, 11: 0.7})
    assert status(tmp_path, noisy(1, 60, 10, 0.05), new) == 1
    text = capsys.readouterr().out
    assert text.index("slower:") < text.index("kernel/3:") < text.index("kernel/7:")
    assert text.index("faster:") < text.index("kernel/11:")
    assert "60 rows: 2 slower, 1 faster, 57 not told apart" in text


def test_faster_alone_is_no_failure(tmp_path: Path) -> None:
    old, new = noisy(1, 20, 10, 0.05), noisy(2, 20, 10, 0.05, {4: 0.5})
    assert status(tmp_path, old, new) == 0


def test_a_change_below_the_least_does_not_count(tmp_path: Path) -> None:
    old, new = noisy(1, 20, 10, 0.002), noisy(2, 20, 10, 0.002, {4: 1.03})
    assert status(tmp_path, old, new) == 0
    assert status(tmp_path, old, new, "--least", "0.01") == 1


def test_a_change_within_the_spread_of_files_does_not_count() -> None:
    """Two hundred repetitions separate 10 % in noise of 30 %; that may be their two processes."""
    random = np.random.default_rng(5)
    old = {"kernel": [float(x) for x in np.exp(0.3 * random.standard_normal(200))]}
    new = {"kernel": [float(x) for x in 1.15 * np.exp(0.3 * random.standard_normal(200))]}
    rows = compare.compared(old, new, compare.unpaired)
    assert rows[0].chance < 0.01
    assert not compare.verdict(rows, least=0.05, alarms=0.05, spread_counts=True).slower
    assert compare.verdict(rows, least=0.05, alarms=0.05, spread_counts=False).slower


def test_the_machines_limits_are_told_and_not_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    old, new = ({"limit/triad": v, "kernel/x": [5.0] * 8} for v in ([1.0] * 8, [2.0] * 8))
    assert status(tmp_path, old, new) == 0
    assert "the machine itself changed" in capsys.readouterr().out


def test_many_rows_with_few_repetitions_are_said_to_be_blunt(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status(tmp_path, noisy(1, 100, 5, 0.1), noisy(2, 100, 5, 0.1))
    assert "may be missed" in capsys.readouterr().out


def test_the_clock_counts_where_a_row_was_measured_by_it() -> None:
    entry = {"cpu_time": 2.0, "real_time": 3.0, "time_unit": "us"}
    rows = [{"name": name, **entry} for name in ("force/1", "force/2/real_time")]
    times = reports.times_of({"benchmarks": rows}, "x")
    assert times == {"force/1": [2000.0], "force/2/real_time": [3000.0]}


# ---- two binaries

BINARY = """#!{python}
import json, pathlib, sys
seen = pathlib.Path(__file__).with_suffix(".count")
order = pathlib.Path(__file__).with_name("order")
turn = len(order.read_text()) if order.exists() else 0
with order.open("a") as out:
    out.write("{letter}")
load = 1.0 + 3.0 * ((turn // 2) % 3)  # of other work: the same for both of a pair
assert "--benchmark_filter=step" in sys.argv
rows = [{{"name": n, "run_name": n, "run_type": "iteration", "real_time": 1.0, "time_unit": "ms",
         "cpu_time": f * load * (1.0 + 0.001 * turn)}} for n, f in {rows}]
print(json.dumps({{"context": {{}}, "benchmarks": rows}}))
"""


def binary(folder: Path, letter: str, rows: list[tuple[str, float]]) -> Path:
    """A program that reports rows, slowed by what else the machine does."""
    path = folder / f"binary_{letter}"
    path.write_text(
        BINARY.format(python=sys.executable, letter=letter, rows=rows), encoding="utf-8"
    )
    path.chmod(0o755)
    return path


def test_pairs_see_a_change_that_load_hides(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Load varies fourfold between pairs; 10 % is told, and runs alternate."""
    old = binary(tmp_path, "A", [("step", 1.0), ("same", 1.0)])
    new = binary(tmp_path, "B", [("step", 1.1), ("same", 1.0)])
    kept = [str(tmp_path / name) for name in ("old.json", "new.json")]
    run = ["--run", str(old), str(new), "--filter", "step", "--pairs", "10"]
    assert compare.main([*kept, *run]) == 1
    text = capsys.readouterr().out
    assert "step: " in text
    assert "same: " not in text
    assert (tmp_path / "order").read_text() == "ABBA" * 5
    assert compare.main(kept) == 0  # the same numbers without their pairs


def test_the_same_binary_twice_gives_no_verdict(tmp_path: Path) -> None:
    path = binary(tmp_path, "A", [("step", 1.0)])
    assert compare.main(["--run", str(path), str(path), "--filter", "step"]) == 0


# ---- wrong input


def complaint(capsys: pytest.CaptureFixture[str], *words: str | Path) -> str:
    """The sentence that a wrong call gives."""
    assert compare.main([str(word) for word in words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.strip().splitlines()) == 1
    assert err.startswith("compare: ")
    return str(err)


def test_wrong_input_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good = written(tmp_path / "good.json", noisy(1, 3, 6, 0.1))
    other = written(tmp_path / "other.json", {"another": [1.0] * 6})
    seldom = written(tmp_path / "seldom.json", noisy(1, 3, 2, 0.1))
    text, listed, odd = (tmp_path / name for name in ("text", "list.json", "odd.json"))
    text.write_text("Running ./tissu-bench\n", encoding="utf-8")
    listed.write_text("[1, 2]", encoding="utf-8")
    odd.write_text('{"benchmarks": [{"name": "x"}]}', encoding="utf-8")
    missing = tmp_path / "missing.json"
    assert "cannot be read" in complaint(capsys, good, missing)
    assert "is not JSON" in complaint(capsys, text, good)
    assert 'no list "benchmarks"' in complaint(capsys, good, listed)
    assert "cannot be read" in complaint(capsys, odd, good)
    assert "no row in common" in complaint(capsys, good, other)
    assert "benchmark_repetitions" in complaint(capsys, good, seldom)
    assert "give OLD.json" in complaint(capsys, good)
    assert "give OLD.json" in complaint(capsys)
    run = ("--run", missing, missing)
    assert "cannot be run" in complaint(capsys, *run)
    assert "--pairs" in complaint(capsys, *run, "--pairs", "2")


def test_a_binary_that_fails_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "binary"
    path.write_text("#!/bin/sh\necho first >&2; echo no such row >&2; exit 3\n", encoding="utf-8")
    path.chmod(0o755)
    assert "ended with status 3: no such row" in complaint(capsys, "--run", path, path)
    path.write_text("#!/bin/sh\necho no match >&2\n", encoding="utf-8")
    assert "has no row that matches" in complaint(capsys, "--run", path, path)
