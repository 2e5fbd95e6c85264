"""Broken histories through `lacuna forecast` and `lacuna fleet`: an error, or a warning and no number."""

from __future__ import annotations

from collections.abc import Callable
import json
from pathlib import Path
import subprocess
import sys
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from lacuna.cli.main import app

USE = np.arange(100.0, 3000, 100)


def linear(n: np.ndarray) -> np.ndarray:
    return 0.02 + 0.32 * n / 5000


def part(use: np.ndarray = USE, truth: Callable[[np.ndarray], np.ndarray] = linear, seed: int = 1) -> dict[str, Any]:
    """Columns of a sound history of actuator A."""
    severity = truth(use) + 0.003 * np.random.default_rng(seed).standard_normal(len(use))
    return {
        "actuator": ["A"] * len(use), "cycles": use, "severity": severity, "low": severity - 0.006,
        "high": severity + 0.006,
    }  # fmt: skip


def mixed(*parts: dict[str, Any]) -> dict[str, Any]:
    """The tests of several actuators under one name, in order of use."""
    whole = {name: np.concatenate([one[name] for one in parts]) for name in parts[0]}
    order = np.argsort(whole["cycles"])
    return {name: column[order] for name, column in whole.items()}


def written(folder: Path, columns: dict[str, Any], ending: str) -> Path:
    table = pa.table(columns)
    if ending == "parquet":
        pq.write_table(table, folder / "history.parquet")
    else:
        rows = [",".join("" if v is None else str(v) for v in row.values()) for row in table.to_pylist()]
        (folder / "history.csv").write_text("\n".join([",".join(columns), *rows]) + "\n", encoding="utf-8")
    return folder


def asked(command: str, folder: Path) -> Any:
    return CliRunner().invoke(app, [command, str(folder), "--out", str(folder / "out")])


def swapped(values: np.ndarray, k: int, value: float) -> np.ndarray:
    return np.concatenate([values[:k], [value], values[k + 1 :]])


REFUSED = {
    "time falls": (part() | {"cycles": swapped(USE, 5, 50.0)}, "do not increase"),
    "a test twice": (part() | {"cycles": swapped(USE, 5, USE[4])}, "do not increase"),
    "use is NaN": (part() | {"cycles": swapped(USE, 5, np.nan)}, "cycles"),
    "use is infinite": (part() | {"cycles": swapped(USE, 5, np.inf)}, "finite number"),
    "beyond the map": (mixed(part(), part(USE[-1:] + 1, lambda n: 0.7 + 0 * n)), "outside the map, 0 to 0.5"),
    "below the map": (part(truth=lambda n: -linear(n)), "outside the map, 0 to 0.5"),
    "per cent": (part(truth=lambda n: 100 * linear(n)), "fractions, not percent"),
    "NaN as an end of an interval": (part() | {"low": swapped(linear(USE), 3, np.nan)}, "interval"),
    "an interval beside its severity": (part() | {"high": linear(USE) - 0.1}, "outside its own interval"),
    "no rows": ({name: column[:0] for name, column in part().items()}, "no rows"),
    "words for numbers": (part() | {"severity": ["high"] * len(USE)}, "high"),
    "dates for cycles": (part() | {"cycles": USE.astype("datetime64[s]")}, "cycles"),
    "another event": (part() | {"event": ["mended"] * len(USE)}, "'replaced'"),
    "no name": (part() | {"actuator": [None] * len(USE)}, "actuator is empty"),
    "hours that fall": (part() | {"hours": USE[::-1]}, "hours do not increase with cycles"),
}


@pytest.mark.parametrize("command", ["forecast", "fleet"])
@pytest.mark.parametrize("ending", ["csv", "parquet"])
@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_history_is_refused_and_nothing_is_written(
    tmp_path: Path, name: str, ending: str, command: str
) -> None:
    columns, message = REFUSED[name]
    done = asked(command, written(tmp_path, columns, ending))
    assert done.exit_code == 1, done.output
    said = " ".join(done.output.split())
    assert said.startswith("error: ") and message in said, said
    assert not list(tmp_path.rglob("forecast.json")) and not list(tmp_path.rglob("fleet.*"))


# What can only be told from the whole of a history: no forecast, and why.
DOUBTED = {
    "another actuator's tests between": (mixed(part(), part(USE + 50, lambda n: 0.3 + 0 * n)), "another actuator's"),
    "of a healthy one": (mixed(part(), part(USE + 50, lambda n: 0.02 + 0 * n, 4)), "another actuator's"),
    "three of them": (mixed(part(), part(USE[20:23] + 50, lambda n: 0.3 + 0 * n)), "another actuator's"),
    "from a day on": (mixed(part(USE[:15]), part(USE[15:], lambda n: 0.3 + 0 * n)), "another actuator's"),
    "hours from a row on": (part(np.concatenate([USE[:15], USE[14] + USE[:14] / 500])), "hours and cycles mixed"),
    "cycles in the hours": (part() | {"hours": np.concatenate([USE[:15] / 500, USE[15:]])}, "are units mixed"),
    "no severity": (part() | {n: np.full(len(USE), np.nan) for n in ("severity", "low", "high")}, "no tests"),
    "two tests": (part(USE[:2]), "2 tests"),
}  # fmt: skip


@pytest.mark.parametrize("name", DOUBTED)
def test_a_history_that_contradicts_itself_gets_a_warning_and_no_number(tmp_path: Path, name: str) -> None:
    columns, message = DOUBTED[name]
    done = asked("forecast", written(tmp_path, columns, "csv"))
    assert done.exit_code == 0 and message in " ".join(done.output.split()), done.output
    said = json.loads((tmp_path / "out" / "forecast.json").read_text(encoding="utf-8"))["actuators"]["A"]
    assert said["verdict"] == "too_early" and said["advised_last_test"] is None and said["probability"] == []
    assert said["violet"] == {"median": None, "interval80": [None, None], "interval95": [None, None]}
    done = asked("fleet", written(tmp_path, columns, "parquet"))
    assert done.exit_code == 0, done.output
    (row,) = pq.read_table(tmp_path / "out" / "fleet.parquet").to_pylist()
    assert row["verdict"] == "too_early" and row["median"] is row["risk_next"] is row["advised_last_test"] is None


def test_missing_tests_and_numbers_as_words_are_no_fault(tmp_path: Path) -> None:
    columns = part() | {"severity": [str(v) for v in part()["severity"]]}
    for name in ("severity", "low", "high"):
        columns[name] = ["" if k % 3 == 1 else str(v) for k, v in enumerate(part()[name])]
    for ending in ("csv", "parquet"):
        done = asked("forecast", written(tmp_path, columns, ending))
        assert done.exit_code == 0 and "reaches violet in" in " ".join(done.output.split()), done.output
        (tmp_path / f"history.{ending}").unlink()


def test_bytes_that_are_no_table_are_refused(tmp_path: Path) -> None:
    for name, content in (("history.csv", bytes(range(256))), ("history.csv", b""), ("history.parquet", b"PAR1")):
        (tmp_path / name).write_bytes(content)
        for command in ("forecast", "fleet"):
            done = asked(command, tmp_path)
            assert done.exit_code == 1 and done.output.startswith("error: "), (name, command, done.output)
        (tmp_path / name).unlink()


SCRIPT = """import lacuna
import lacuna.analysis.prognosis.fleet as fleet

print("begins", flush=True)
fleet.CHUNK = 1  # two workers for two actuators
print(len(lacuna.fleet("history.parquet")), "rows")
"""


def test_a_script_without_a_guard_is_run_once(tmp_path: Path) -> None:
    """Workers are processes that are spawned; they do not run the caller's script."""
    a, b = part(), part(seed=2) | {"actuator": ["B"] * len(USE)}
    written(tmp_path, {name: [*a[name], *b[name]] for name in a}, "parquet")
    (tmp_path / "own.py").write_text(SCRIPT, encoding="utf-8")
    done = subprocess.run([sys.executable, "own.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "begins\n2 rows\n"
