"""The table of a history: read as written, or refused with its row."""

from __future__ import annotations

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.fleet import histories_of
from lacuna.analysis.prognosis.history import read_histories

GOOD = """actuator,cycles,severity,low,high,event
B,10,0.05,0.04,0.06,
A,5,0.02,0.01,0.03,
A,15,0.03,0.02,0.05,
A,25,,,,
A,35,0.01,0.00,0.02,replaced
"""


def written(tmp_path, text):
    (tmp_path / "history.csv").write_text(text)
    return tmp_path


def test_actuators_lives_and_gaps(tmp_path):
    a, b = read_histories(written(tmp_path, GOOD))
    assert (a.actuator, b.actuator, a.unit) == ("A", "B", "cycles")
    assert a.use.tolist() == [5, 15, 25, 35]
    assert np.isnan(a.severity[2]) and a.severity[1] == 0.03
    assert a.lives == [slice(0, 3), slice(3, 4)]


def test_parquet_says_the_same(tmp_path):
    text = written(tmp_path, GOOD)
    table = pa.csv.read_csv(text / "history.csv")
    (tmp_path / "p").mkdir()
    pq.write_table(table, tmp_path / "p" / "history.parquet")
    for one, other in zip(read_histories(text), read_histories(tmp_path / "p"), strict=True):
        assert one.actuator == other.actuator
        assert np.array_equal(one.severity, other.severity, equal_nan=True) and np.array_equal(one.use, other.use)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no rows"),
        ("actuator,severity\nA,0.1\n", "column cycles"),
        ("cycles,severity\n1,0.1\n", "column actuator"),
        ("actuator,cycles,cycles\nA,1,1\n", "occurs twice"),
        ("actuator,cycles,severity,low,high\n,1,0.1,0.1,0.1\n", ":2: actuator is empty"),
        ("actuator,cycles,severity,low,high\nA,x,0.1,0.1,0.1\n", ":2: cycles is 'x', not a finite number"),
        ("actuator,cycles,severity,low,high\nA,inf,0.1,0.1,0.1\n", ":2: cycles is 'inf', not a finite number"),
        ("actuator,cycles,severity,low,high\nA,-1,0.1,0.1,0.1\n", ":2: cycles is -1, below zero"),
        ("actuator,cycles,severity,low,high\nA,1e308,0.1,0.1,0.1\n", r":2: cycles is 1e\+308, beyond 1e\+150"),
        ("actuator,cycles,severity,low,high\nA,5,.1,.1,.1\nA,4,.1,.1,.1\n", ":3: cycles do not increase: 4 after 5"),
        ("actuator,cycles,severity,low,high\nA,5,.1,.1,.1\nA,5,.1,.1,.1\n", ":3: cycles do not increase"),
        ("actuator,cycles,severity,low,high\nA,5,0.1,,\n", ":2: severity without low and high"),
        ("actuator,cycles,severity,low,high\nA,5,0.1,0.2,0.3\n", ":2: severity 0.1 lies outside its own interval"),
        ("actuator,cycles,severity,low,high,event\nA,5,.1,.1,.1,mended\n", ":2: event is 'mended'"),
        ("actuator,cycles,hours,severity,low,high\nA,5,,.1,.1,.1\nA,,9,.1,.1,.1\n", "cycles and hours are mixed"),
        ("actuator,cycles,recording\nA,5,r.csv\n", ":2: r.csv has to be assessed"),
        (
            "actuator,cycles,hours,severity,low,high\nA,5,3,.1,.1,.1\nA,6,4,.1,.1,.1\nA,7,2,.1,.1,.1\n",
            ":4: hours do not",
        ),
        ("actuator,cycles,severity,low,high\nA,5,.1,.1,.1,7\n", ":2: more cells"),
    ],
)
def test_what_is_no_history_is_refused_with_its_row(tmp_path, text, message):
    with pytest.raises(AnalysisError, match="history.csv.*" + message.replace("?", r"\?")):
        read_histories(written(tmp_path, text))


@pytest.mark.parametrize(("slip", "meant"), [("evnt", "event"), ("Event", "event"), ("Recording", "recording")])
def test_a_column_that_is_called_nearly_as_one_that_is_missing_is_refused(tmp_path, slip, meant):
    """The parts that were replaced were lost with a word in a head."""
    path = tmp_path / "history.csv"
    path.write_text(f"actuator,cycles,severity,low,high,{slip},operator\nA,1,0.1,0,0.2,replaced,me\n")
    with pytest.raises(AnalysisError, match=f"column {slip} is not known; did you mean {meant}?"):
        read_histories(path)
    with pytest.raises(AnalysisError, match=f"column {slip} is not known; did you mean {meant}?"):
        histories_of(pyarrow.csv.read_csv(path), str(path))
    path.write_text(path.read_text().replace(slip, "noted on the day"))

    assert len(read_histories(path)) == 1


def test_a_missing_recording_is_named(tmp_path):
    written(tmp_path, "actuator,cycles,recording\nA,5,r.csv\n")
    with pytest.raises(AnalysisError, match=r"recording r.csv is missing"):
        read_histories(tmp_path, assess=lambda path: [])


def test_a_refused_recording_is_a_missing_test_with_a_warning(tmp_path):
    written(tmp_path, "actuator,cycles,recording\nA,5,r.csv\nA,6,r.csv\n")
    (tmp_path / "r.csv").write_text("")

    def refuse(path):
        raise AnalysisError("another actuator")

    (h,) = read_histories(tmp_path, refuse)
    assert np.isnan(h.severity).all() and len(h.warnings) == 3 and "another actuator" in h.warnings[0]


def table(use, hours=None):
    head = "actuator,cycles,severity,low,high" + (",hours" if hours is not None else "")
    rows = [f"A,{n},0.1,0.09,0.11" + (f",{hours[k]}" if hours is not None else "") for k, n in enumerate(use)]
    return "\n".join([head, *rows]) + "\n"


def test_hours_written_among_cycles_are_a_doubt(tmp_path):
    use = [*range(100, 1100, 100), *(1000 + 9 * k for k in range(1, 10))]
    (h,) = read_histories(written(tmp_path, table(use)))
    assert "hours and cycles mixed" in h.doubts[0]


def test_hours_and_cycles_that_do_not_go_together_are_a_doubt(tmp_path):
    use = list(range(100, 1100, 100))
    hours = [2 * n for n in use[:6]] + [1200 + 20 * n for n in use[:4]]
    (h,) = read_histories(written(tmp_path, table(use, hours)))
    assert "are units mixed" in h.doubts[0]
    (fine,) = read_histories(written(tmp_path, table(use, [2 * n for n in use])), unit="hours")
    assert fine.unit == "hours" and not fine.doubts


@pytest.mark.parametrize("severity", ["", "nan"])
def test_an_interval_without_its_severity_is_refused(tmp_path, severity):
    """The test was left out without a word."""
    with pytest.raises(AnalysisError, match=r"history.csv:4: low and high without their severity"):
        read_histories(written(tmp_path, GOOD.replace("A,15,0.03,", f"A,15,{severity},")))


def test_a_last_test_without_a_severity_is_told(tmp_path):
    head = "actuator,cycles,severity,low,high\nA,5,0.1,0.05,0.15\n"
    (seen,) = read_histories(written(tmp_path, head + "A,9,0.1,0.05,0.15\n"))
    (open_end,) = read_histories(written(tmp_path, head + "A,9,,,\n"))
    assert seen.warnings == ()
    assert "history.csv:3: the last test of A has no severity" in open_end.warnings[0]
    assert "at 9 cycles" in open_end.warnings[0]
