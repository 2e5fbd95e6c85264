"""Broken recordings are recognised, with column and time; sound ones are not suspected."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from codegen.library import Library
from discovery.amend import Amendment
from discovery.cases import Case, Recording, load
from discovery.explain import explain
from discovery.fit import believed
from discovery.machine import Machine
from discovery.places import read
from discovery.recordings_check import check_case
from discovery.semantic_check import check_against_model


def frozen(r: Recording) -> None:
    r.columns["i"][600:800] = r.columns["i"][600]


def clipped(r: Recording) -> None:
    r.columns["i"] = np.minimum(r.columns["i"], 0.5 * r.columns["i"].max())


def backwards(r: Recording) -> None:
    r.time[700] = r.time[690]


def gap(r: Recording) -> None:
    r.time[900:] += 0.4


def missing(r: Recording) -> None:
    r.columns["u"][300:340] = np.nan


def reversed_sign(r: Recording) -> None:
    r.columns["i"] = -r.columns["i"]


def thousand(r: Recording) -> None:
    r.columns["i"] = 1000 * r.columns["i"]


def degrees(r: Recording) -> None:
    r.columns["theta"] = np.degrees(r.columns["theta"])


def shifted(r: Recording) -> None:
    r.columns["i"] = np.concatenate([np.full(80, r.columns["i"][0]), r.columns["i"][:-80]])


@pytest.mark.parametrize(
    ("spoil", "kind", "column"),
    [(frozen, "frozen", "i"), (clipped, "clipped", "i"), (backwards, "time_order", "time"), (gap, "gap", "time"),
     (missing, "missing_samples", "u")],
)  # fmt: skip
def test_broken_recordings_are_seen_without_a_model(
    consistent_case: Path, spoil: Callable[[Recording], None], kind: str, column: str
) -> None:
    case = load(consistent_case)
    assert check_case(case) == []
    spoil(case.fit[1])
    found = [p for p in check_case(case) if p.kind == kind]
    assert found and found[0].column == column and found[0].recording == "r2.csv" and found[0].fatal


@pytest.mark.parametrize(
    ("spoil", "text"),
    [(reversed_sign, "reversed"), (thousand, "1000"), (degrees, "degrees"), (shifted, "shifted")],
)
def test_slips_are_seen_against_the_model(consistent_case: Path, spoil: Callable[[Recording], None], text: str) -> None:
    case = load(consistent_case)
    machine = _machine(case)
    assert check_against_model(machine, believed(case, machine)) == []
    spoil(case.fit[1])
    problems = check_against_model(machine, believed(case, machine))
    assert problems and all(p.recording == "r2.csv" for p in problems)
    assert text in problems[0].text


def _machine(case: Case) -> Machine:
    return Machine(case, Amendment(read(Library(), case.model)))


def test_no_confident_diagnosis_from_a_broken_file(consistent_case: Path) -> None:
    case = load(consistent_case)
    frozen(case.fit[0])
    result = explain(case)
    assert result.verdict == "undetermined" and not result.findings and "column `i`" in result.reason
