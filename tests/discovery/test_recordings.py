"""Broken recordings are recognised, with column and time; sound ones are not suspected.

The table below is tried on a motor simulated here; what needs other machines (currents that add up to zero, a closed
loop) on practice cases, where they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from lacuna.codegen.library.classes import Library
from lacuna.discovery import semantic_check
from lacuna.discovery.case.cases import Case, Recording, load
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.recordings_check import Problem, check_case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.steps import opened

Spoil = Callable[[Recording], None]


def changed(column: str, change: Callable[[np.ndarray], np.ndarray]) -> Spoil:
    """A recording with `column` replaced by what `change` makes of its samples."""

    def spoil(r: Recording) -> None:
        r.columns[column] = change(r.columns[column].copy())

    return spoil


def between(first: int, end: int, value: float | None = None) -> Callable[[np.ndarray], np.ndarray]:
    """Samples from `first` to `end` all equal: to `value`, else to the first of them."""

    def hold(v: np.ndarray) -> np.ndarray:
        v[first:end] = v[first] if value is None else value
        return v

    return hold


def clip(v: np.ndarray) -> np.ndarray:
    return np.minimum(v, 0.5 * v.max())


def later(samples: int) -> Callable[[np.ndarray], np.ndarray]:
    """What is recorded arrives later by this number of samples (earlier where negative); mirrored at the ends."""

    def move(v: np.ndarray) -> np.ndarray:
        n = abs(samples)
        return np.concatenate([v[n - 1 :: -1], v[:-n]] if samples > 0 else [v[n:], v[: -n - 1 : -1]])

    return move


def backwards(r: Recording) -> None:
    r.time[700] = r.time[690]


def repeated(r: Recording) -> None:
    r.time[700] = r.time[699]


def no_time(r: Recording) -> None:
    r.time[700] = np.nan


def short(r: Recording, length: int = 49) -> None:
    r.time = r.time[:length]
    r.columns = {name: v[:length] for name, v in r.columns.items()}


def empty(r: Recording) -> None:
    short(r, 0)


def spike(v: np.ndarray) -> np.ndarray:
    v[700] += 5 * np.ptp(v)
    return v


WITHOUT_A_MODEL = [  # what is done to r2.csv, the kind, the column, the time (s) at which it is seen
    (backwards, "time_order", "time", 0.69),
    (repeated, "time_order", "time", 0.699),
    (no_time, "time_missing", "time", 0.699),
    (short, "too_short", "time", 0.0),
    (empty, "too_short", "time", None),
    (changed("i", between(0, 1500, np.nan)), "missing_samples", "i", 0.0),
    (changed("i", between(600, 800)), "frozen", "i", 0.6),
    (changed("i", between(600, 800, 0.0)), "frozen", "i", 0.6),
    (changed("theta", between(600, 1500)), "frozen", "theta", 0.6),
    (changed("i", clip), "clipped", "i", None),
    (changed("i", lambda v: 0 * v), "constant", "i", 0.0),
]  # fmt: skip

AGAINST_THE_MODEL = [  # what is done to r2.csv, words of the text, the column
    (changed("i", np.negative), "its sign is reversed", "i"),
    (changed("theta", np.negative), "its sign is reversed", "theta"),
    (changed("u", np.negative), "its sign is reversed", "u"),
    (changed("i", lambda v: 1000 * v), "1000 times too large", "i"),
    (changed("theta", lambda v: v / 1000), "1000 times too small", "theta"),
    (changed("theta", np.degrees), "degrees where radians", "theta"),
    (changed("theta", np.radians), "radians where degrees", "theta"),
    (changed("i", later(80)), "shifted in time by +0.08", "i"),
    (changed("theta", later(-60)), "shifted in time by -0.0", "theta"),
    (changed("u", later(60)), "every output answers before it", "u"),
]  # fmt: skip


def problems_of(case: Case) -> list[Problem]:
    return opened(case, Library())[0].problems


def diagnosed(case: Case, column: str) -> None:
    """A broken file must never lead to a confident diagnosis."""
    result = explain(case)
    assert result.verdict == "undetermined" and not result.findings
    assert f"column `{column}`" in result.reason


@pytest.mark.parametrize("count", [50, 99, 101, 150, *range(700, 740, 6)])
def test_sound_recordings_of_any_length_are_not_suspected(consistent_case: Path, count: int) -> None:
    case = load(consistent_case)
    for recording in case.fit:
        recording.time = recording.time[:count]
        recording.columns = {n: v[:count] for n, v in recording.columns.items()}
    assert [str(p) for p in problems_of(case)] == []


def test_a_slow_sensor_is_no_shifted_signal(consistent_case: Path) -> None:
    """A lag of 66 samples moves a signal by nearly as many, but smooths it, too."""
    case = load(consistent_case)
    pole = np.exp(-1.0 / 66)
    for recording in case.fit + case.validate:
        recording.columns["theta"] = lfilter([1.0 - pole], [1.0, -pole], recording.columns["theta"])
    assert [str(p) for p in problems_of(case)] == []


@pytest.mark.parametrize(("others", "suspected"), [((-18, 0.96), False), ((0, 0.0), True), ((-3, 0.96), True)])
def test_a_machine_faster_than_believed_shifts_no_column(
    consistent_case: Path, monkeypatch: pytest.MonkeyPatch, others: tuple[int, float], suspected: bool
) -> None:
    """It advances every signal that it moves, though one hardly shows it and another most."""
    case = load(consistent_case)
    case.signals["w"] = replace(case.signals["theta"], column="w", variable="w", unit="rad/s", model_unit="rad/s")
    for recording in case.fit + case.validate:
        recording.columns["w"] = np.gradient(recording.columns["theta"], recording.interval)
    machine = Machine(case, Amendment(read(Library(), case.model)))
    lags = {"i": (-10, 0.03), "w": others, "theta": (-18, 0.99)}
    order = iter([s.column for s in case.outputs])
    monkeypatch.setattr(semantic_check, "_lag", lambda *signals: lags[next(order)])
    monkeypatch.setattr(semantic_check, "_agrees", lambda *signals: True)
    found = semantic_check._shifts(machine, case.fit[0], machine.simulate(case.parameters, case.fit[0]))
    assert [p.column for p in found] == (["theta"] if suspected else [])


@pytest.mark.parametrize(("spoil", "kind", "column", "time"), WITHOUT_A_MODEL)
def test_broken_recordings_are_seen_without_a_model(
    consistent_case: Path, spoil: Spoil, kind: str, column: str, time: float | None
) -> None:
    case = load(consistent_case)
    assert check_case(case) == []
    spoil(case.fit[1])
    first = check_case(case)[0]
    assert (first.kind, first.column, first.recording, first.fatal) == (kind, column, "r2.csv", True)
    assert time is None or first.time == pytest.approx(time, abs=2e-3)
    diagnosed(case, column)


@pytest.mark.parametrize(("spoil", "text", "column"), AGAINST_THE_MODEL)
def test_slips_are_seen_against_the_model(consistent_case: Path, spoil: Spoil, text: str, column: str) -> None:
    case = load(consistent_case)
    assert problems_of(case) == []
    spoil(case.fit[1])
    problems = problems_of(case)
    assert problems and all(p.recording == "r2.csv" and p.fatal for p in problems)
    assert text.removeprefix("its") in problems[0].text and problems[0].column == column
    diagnosed(case, column)


@pytest.mark.parametrize(("column", "words"), [("i", "may be fitted"), ("theta", "may be fitted"), ("u", "no input")])
def test_what_never_changes_is_of_no_use(consistent_case: Path, column: str, words: str) -> None:
    case = load(consistent_case)
    for recording in case.fit:
        recording.columns[column][:] = 0.5
    problems = [p for p in check_case(case) if p.kind in ("constant", "undriven")]
    assert [p.column for p in problems] == [column] and words in problems[0].text
    diagnosed(case, column)


def test_a_signal_at_rest_is_not_frozen(consistent_case: Path) -> None:
    """An encoder without noise stands while the shaft does: the first 0.1 s, and after the supply is cut."""
    case = load(consistent_case)
    for recording in case.fit + case.validate:
        theta = np.round(recording.columns["theta"] / 0.01) * 0.01
        theta[:100], theta[1300:] = theta[100], theta[1300]
        recording.columns["theta"] = theta
    assert check_case(case) == []


def test_a_shaft_that_rests_before_it_turns_on_is_not_suspected(consistent_case: Path) -> None:
    """Its angle lies at its lowest end for 0.1 s, and passes many steps of the encoder a sample after it."""
    case, step = load(consistent_case), 2 * np.pi / 4096
    signal = replace(case.signals["theta"], noise_std=step / np.sqrt(12))
    for recording in case.fit + case.validate:
        angle = np.concatenate([np.zeros(100), np.cumsum(np.linspace(0.01, 0.4, len(recording.time) - 100))])
        recording.columns["theta"] = np.round(np.floor(angle / step) * step, 6)
    assert check_case(replace(case, signals=case.signals | {"theta": signal})) == []


@pytest.mark.parametrize(
    ("change", "kind"), [(between(500, 503, np.nan), "missing_samples"), (spike, "outlier")], ids=["missing", "outlier"]
)  # fmt: skip
@pytest.mark.parametrize("column", ["i", "theta"])
def test_single_bad_samples_are_said_and_left_at_that(
    consistent_case: Path, column: str, change: Callable[[np.ndarray], np.ndarray], kind: str
) -> None:
    case = load(consistent_case)
    changed(column, change)(case.fit[1])
    assert [(p.kind, p.column, p.fatal) for p in problems_of(case)] == [(kind, column, False)]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('unit = "A"', "", r"signals\.i\] has no unit"),
        ('unit = "A"', 'unit = "amp"', "amp"),
        ('unit = "A"', 'unit = "V"', "unit V does not fit i, which is in A"),
        ("time,u,i,theta", "time,u,current,theta", "r2.csv: column `i` is missing"),
        ("time,u,i,theta", "t,u,i,theta", "r2.csv: column `time` is missing"),
    ],
)
def test_columns_and_units_have_to_be_there(
    consistent_case: Path, tmp_path: Path, old: str, new: str, words: str
) -> None:
    for file in ("r1.csv", "r2.csv", "r3.csv", "case.toml"):
        text = (consistent_case / file).read_text()
        (tmp_path / file).write_text(text.replace(old, new, 1) if file in ("r2.csv", "case.toml") else text)
    with pytest.raises(CaseError, match=words):
        opened(load(tmp_path), Library())


PRACTICE = [f"p{k:02d}" for k in range(1, 11)]


@pytest.fixture
def practice(shared: Path) -> Callable[[str], Case]:
    """Reads a practice case by its name; skips where there is none."""

    def read(name: str) -> Case:
        folder = shared / "recordings" / "practice" / name
        if not folder.is_dir():
            pytest.skip(f"needs the practice recordings; not at {folder}")
        return load(folder)

    return read


@pytest.mark.parametrize("name", PRACTICE)
def test_practice_recordings_are_not_suspected(practice: Callable[[str], Case], name: str) -> None:
    assert problems_of(practice(name)) == []


@pytest.mark.parametrize(
    ("name", "spoil", "kind", "column"),
    [
        ("p01", changed("theta", between(3000, 6001)), "constant", "theta"),
        ("p04", changed("theta", np.negative), "scale", "theta"),
        ("p06", changed("i", clip), "clipped", "i"),
        ("p06", changed("thm", later(80)), "shift", "thm"),
        ("p08", changed("ths", np.degrees), "scale", "ths"),
        ("p08", changed("u", between(600, 800)), "frozen", "u"),
        ("p09", changed("ia", np.negative), "scale", "ia"),
        ("p09", changed("ic", lambda v: 1000 * v), "scale", "ic"),
        ("p10", changed("ib", np.negative), "scale", "ib"),
        ("p10", changed("ia", lambda v: 0 * v), "constant", "ia"),
    ],
)  # fmt: skip
def test_practice_recordings_are_seen_when_broken(
    practice: Callable[[str], Case], name: str, spoil: Spoil, kind: str, column: str
) -> None:
    case = practice(name)
    spoil(case.fit[1])
    found = [p for p in problems_of(case) if p.fatal]
    assert (kind, column, case.fit[1].name) in [(p.kind, p.column, p.recording) for p in found]
