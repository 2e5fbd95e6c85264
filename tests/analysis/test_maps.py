"""Maps end to end on the hand-written simulation: tables, figures, resuming, refusing to leave half a map."""

from __future__ import annotations

import csv
import json
import re

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import Record
from tests.analysis.plants import ReferencePlant, paper_settings

COARSE = ("step = 0.01", "step = 0.1")
COLUMNS = (
    "zeta,rms_a,rms_b,rms_c,rms_mean,peak_a_hz,peak_a_bin,peak_b_hz,peak_b_bin,peak_c_hz,peak_c_bin,speed_mean,"
    "steps,state_events"
)


@pytest.fixture
def coarse(tmp_path):
    return paper_settings(tmp_path, COARSE)


def test_files_of_a_map(tmp_path, coarse):
    calls = []
    built = build_map(ReferencePlant(), coarse, tmp_path / "map", progress=lambda *call: calls.append(call))
    names = {path.name for path in (tmp_path / "map").iterdir()}
    stems = {"fig4_phase_rms", "fig5_mean_rms", "fig6_speed", "fig7_currents", "spectra"}
    figures = {f"{stem}.{kind}" for stem in stems for kind in ("svg", "png", "csv")}
    assert names == figures | {"map.csv", "summary.json", "settings.toml", "report.html", "rows"}
    assert calls[0] == (0, 6) and calls[-1] == (6, 6)
    assert built.seconds["analyse_cpu"] > 0

    text = (tmp_path / "map" / "map.csv").read_text()
    assert text.splitlines()[0] == COLUMNS
    rows = list(csv.DictReader(text.splitlines()))
    assert [float(row["zeta"]) for row in rows] == [0, 0.1, 0.2, 0.3, 0.4, 0.5]
    assert [float(row["rms_mean"]) for row in rows] == pytest.approx(
        [0.2959, 0.3119, 0.3662, 0.4538, 0.5673, 0.6933], abs=1e-3
    )
    assert [row["peak_b_bin"] for row in rows] == ["44", "44", "44", "44", "43", "43"]


def test_spectra_that_end_below_what_is_shown_are_drawn_as_far_as_they_go(tmp_path):
    """A recording at 500 Hz has no line beyond 250 Hz: figures of it ended in an IndexError."""

    class Slow(ReferencePlant):
        def run(self, severity: float, **parameters: float) -> Record:
            fast = super().run(severity, **parameters)
            return Record(fast.currents[:, ::200], fast.speed[::200], fast.angle[::200], fast.counters)

    rate = ("sampling_rate = 100000.0", "sampling_rate = 500.0")
    build_map(Slow(), paper_settings(tmp_path, ("step = 0.01", "step = 0.25"), rate), tmp_path / "map")
    assert (tmp_path / "map" / "spectra.svg").is_file()


def test_summary_sets_published_beside_reproduced(tmp_path, coarse):
    build_map(ReferencePlant(), coarse, tmp_path / "map", figures=False)
    summary = json.loads((tmp_path / "map" / "summary.json").read_text())
    assert [band["name"] for band in summary["bands"]] == ["green", "orange", "red", "violet"]
    assert summary["bands"][0]["rise"] == pytest.approx(0.0160, abs=5e-4)
    assert summary["bands"][0]["published_rise"] == 0.016
    assert summary["hz1"] == pytest.approx(44 * 1e5 / 2**17)
    assert summary["hz2"] == pytest.approx(43 * 1e5 / 2**17)
    assert summary["switch_severity"] == 0.4
    assert summary["ordering"] == "A < C < B"
    assert summary["speed_falls"] is True
    assert summary["counters"]["state_events"] == 6 * 403
    first = summary["comparison"][0]
    assert (first["unit"], first["published"]) == ("mA", 16.0)


def test_report_stands_alone(tmp_path, coarse):
    build_map(ReferencePlant(), coarse, tmp_path / "map")
    report = (tmp_path / "map" / "report.html").read_text()
    assert re.findall(r"(?:src|href)=[\"'](?!data:|#)[^\"']*", report) == []
    assert report.count("<figure>") == report.count("<svg") == 5
    assert "a consistent set" in report and "16.0 mA" in report
    assert "J*a = tau &lt; 0 &amp; b" in report
    assert "$" not in re.sub(r"base64,[^\"]*", "", report)


def test_equal_input_gives_equal_bytes(tmp_path, coarse):
    for name, jobs in (("one", 1), ("three", 3)):
        build_map(ReferencePlant(), coarse, tmp_path / name, jobs=jobs)
    for file in ("map.csv", "fig4_phase_rms.svg", "spectra.png"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "three" / file).read_bytes(), file


def test_an_unchanged_map_is_not_drawn_again(tmp_path, coarse):
    build_map(ReferencePlant(), coarse, tmp_path / "map")
    before = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "map").glob("*.*")}
    build_map(ReferencePlant(), coarse, tmp_path / "map")
    assert {path.name: path.stat().st_mtime_ns for path in (tmp_path / "map").glob("*.*")} == before
    (tmp_path / "map" / "report.html").unlink()
    build_map(ReferencePlant(), coarse, tmp_path / "map")
    assert (tmp_path / "map" / "report.html").exists()


def test_an_interrupted_map_goes_on_where_it_stopped(tmp_path, coarse):
    interrupted = ReferencePlant(fails_at=0.3, error=KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt):
        build_map(interrupted, coarse, tmp_path / "map", jobs=1, figures=False)
    assert interrupted.runs[:3] == [0.0, 0.1, 0.2]
    assert [path.name for path in (tmp_path / "map").iterdir()] == ["rows"]

    again = ReferencePlant()
    build_map(again, coarse, tmp_path / "map", jobs=1, figures=False)
    assert sorted(again.runs + interrupted.runs) == coarse.fault.severities
    build_map(ReferencePlant(), coarse, tmp_path / "undisturbed", figures=False)
    assert (tmp_path / "map" / "map.csv").read_bytes() == (tmp_path / "undisturbed" / "map.csv").read_bytes()


def _spoil(rows, change):
    """Files of rows as a power cut leaves them, as another hand orders them, and with other numbers in them."""
    if change == "empty":
        for path in rows:
            path.write_bytes(b"")
    elif change == "exchanged":
        contents = [path.read_bytes() for path in rows]
        for path, content in zip(rows, contents[1:] + contents[:1], strict=True):
            path.write_bytes(content)
    else:
        for path in rows:
            with np.load(path) as data:
                kept = dict(data)
            kept["fields"] = str(kept["fields"]).replace('"rms_mean": ', '"rms_mean": 9')
            np.savez(path, **kept)


@pytest.mark.parametrize("change", ["model", "settings", "damage", "empty", "exchanged", "changed", "fresh"])
def test_nothing_stale_is_ever_read(tmp_path, coarse, change):
    build_map(ReferencePlant(), coarse, tmp_path / "map", figures=False)
    plant = ReferencePlant(hash="2" if change == "model" else "1")
    if change == "settings":
        coarse = paper_settings(tmp_path, COARSE, ("threshold = 0.10", "threshold = 0.11"))
    if change == "damage":
        for path in (tmp_path / "map" / "rows").iterdir():
            path.write_bytes(path.read_bytes()[:-100])
    if change in ("empty", "exchanged", "changed"):
        _spoil(sorted((tmp_path / "map" / "rows").iterdir()), change)
    build_map(plant, coarse, tmp_path / "map", figures=False, resume=change != "fresh")
    assert len(plant.runs) == 6
    assert len(list((tmp_path / "map" / "rows").iterdir())) == 6


def test_a_failed_map_leaves_the_previous_one(tmp_path, coarse):
    build_map(ReferencePlant(), coarse, tmp_path / "map", figures=False)
    before = {path.name: path.read_bytes() for path in (tmp_path / "map").glob("*.*")}
    failing = ReferencePlant("2", fails_at=0.2, error=AnalysisError("step collapse"))
    with pytest.raises(AnalysisError, match="step collapse"):
        build_map(failing, coarse, tmp_path / "map", figures=False)
    assert {path.name: path.read_bytes() for path in (tmp_path / "map").glob("*.*")} == before


def test_features_that_do_not_exist_are_empty_fields(tmp_path):
    settings = paper_settings(tmp_path, COARSE, ("above = 5.0", "above = 4000.0"), ("after = 0.3", "after = 0.99"))
    built = build_map(ReferencePlant(), settings, tmp_path / "map")
    row = (tmp_path / "map" / "map.csv").read_text().splitlines()[1].split(",")
    assert row[5:12] == [""] * 7
    assert built.summary["hz1"] is None and built.summary["speed_falls"] is False
