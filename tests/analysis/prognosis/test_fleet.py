"""A fleet: as the single forecasts, sorted by risk, and killed and resumed with equal bytes."""

from __future__ import annotations

import re

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis import fleet as module
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.fleet import FleetWork, histories_of, run_fleet
from lacuna.analysis.prognosis.forecast import Options, forecasts
from lacuna.analysis.prognosis.pages.overview import overview
from tests.analysis.prognosis.histories import LAWS, LIMITS, exponential, history, linear


def table(count: int = 12) -> pa.Table:
    rows = []
    for k in range(count):
        truth = (linear, exponential, lambda n: 0.03 + 0 * n)[k % 3]
        h = history(truth, np.arange(0, 1500.0 + 200 * k, 100), seed=k, actuator=f"<A{k}>")
        columns = zip(h.use, h.severity, h.low, h.high, strict=True)
        rows += [
            dict(zip(("actuator", "cycles", "severity", "low", "high"), (h.actuator, *r), strict=True)) for r in columns
        ]
    return pa.Table.from_pylist(rows)


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch):
    monkeypatch.setattr(module, "CHUNK", 3)


def here(work, pieces, todo, scheduler):
    for k in todo:
        yield k, module.rows_of(pieces[k], work)


def work() -> FleetWork:
    return FleetWork(Bank(LAWS), {"": LIMITS}, Options(listed=40))


def test_on_dask_as_one_by_one_and_sorted_by_risk(tmp_path):
    histories = histories_of(table(), "table")
    found = run_fleet(histories, work(), tmp_path).to_pylist()
    single = {f.history.actuator: f for f in forecasts(histories, Bank(LAWS), LIMITS, learn=False)}
    assert len(found) == 12
    order = [("forecast", "too_early", "steady").index(r["verdict"]) for r in found]
    assert order == sorted(order)
    left = [np.inf if (last := r["advised_last_test"]) is None else last - r["at"] for r in found[: order.count(0)]]
    assert left == sorted(left) and left[0] < left[-1]
    for r in found:
        f = single[r["actuator"]]
        assert r["verdict"] == f.verdict
        if r["median"] is not None:
            assert r["median"] == pytest.approx(f.quantiles[-1, 2], rel=1e-6)


def test_killed_and_resumed_gives_equal_bytes(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_results", here)
    histories = histories_of(table(), "table")
    run_fleet(histories, work(), tmp_path / "whole")

    def killed(*arguments):
        for n, item in enumerate(here(*arguments)):
            if n == 2:
                raise KeyboardInterrupt
            yield item

    monkeypatch.setattr(module, "_results", killed)
    with pytest.raises(KeyboardInterrupt):
        run_fleet(histories, work(), tmp_path / "cut")
    assert len(list((tmp_path / "cut" / "parts").glob("*.parquet"))) == 2
    done = []
    monkeypatch.setattr(module, "_results", lambda w, p, todo, s: (done.extend(todo), here(w, p, todo, s))[1])
    run_fleet(histories, work(), tmp_path / "cut")
    assert len(done) == 2
    assert (tmp_path / "cut" / "fleet.parquet").read_bytes() == (tmp_path / "whole" / "fleet.parquet").read_bytes()


def test_the_page_stands_alone_and_escapes_names(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_results", here)
    found = run_fleet(histories_of(table(), "table"), work(), tmp_path)
    page = overview(found, {"": LIMITS})
    assert "<A0>" not in page and "&lt;A" in page
    assert not re.search(r"""src=|href="(?!data:text/csv)|<script(?!>// Figures)|url\(|@import""", page)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cycles": [1.0, 1.0]}, "t:2: cycles do not increase"),
        ({"severity": [0.1, 0.9]}, "t:2: severity lies outside"),
        ({"cycles": [1.0, -2.0]}, "t:2: cycles must be"),
        ({"actuator": ["A", ""]}, "t:2: actuator is empty"),
        ({"event": ["", "mended"]}, "t:2: event"),
    ],
)
def test_broken_tables_are_refused_with_the_row(changes, message):
    good = {"actuator": ["A", "A"], "cycles": [1.0, 2.0], "severity": [0.1, 0.1], "low": [0.0, 0.0], "high": [0.2, 0.2]}
    with pytest.raises(AnalysisError, match=message):
        histories_of(pa.table(good | changes), "t")
    with pytest.raises(AnalysisError, match="missing"):
        histories_of(pa.table({"actuator": ["A"]}), "t")


def test_parquet_round_trip(tmp_path):
    pq.write_table(table(4), tmp_path / "t.parquet")
    again = histories_of(pq.read_table(tmp_path / "t.parquet"), "t")
    assert [h.actuator for h in again] == [f"<A{k}>" for k in range(4)]


def test_what_lies_beyond_the_axis_of_the_overview_is_an_arrow_and_not_at_its_end():
    def row(name, left):
        spread = {"low95": 0.6, "low80": 0.8, "median": 1.0, "high80": 1.2, "high95": 1.5, "advised_last_test": 0.5}
        numbers = {key: left * share for key, share in spread.items()}
        text = {"actuator": name, "fault": "", "verdict": "forecast", "unit": "cycles", "law": "linear", "warnings": ""}
        return text | numbers | {"at": 0.0, "severity": 0.1, "risk_next": 0.0}

    def arrows(lives):
        drawn = overview(pa.Table.from_pylist([row(f"A{k}", life) for k, life in enumerate(lives)]), {"": LIMITS})
        return len(re.findall(r'<path d="M[^"]*z"', drawn))

    assert arrows([100.0, 2000.0]) == 0
    assert arrows([100.0] * 11 + [1e4]) == 2  # its median and its last advised test
