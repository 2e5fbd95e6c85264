"""A case may speak of the start of what is no state where the model chooses: the position of a mass behind a spring."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.searched import believed_structure
from lacuna.discovery.steps import opened

MASS = """model Held "On a spring that prefers its own deflection"
  input Real F(unit="N");
  Real e(unit="m", stateSelect=StateSelect.prefer) "Of the spring";
  Real s(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real q(unit="m/s");
equation
  e = s - 0.2;
  der(e) = q;
  der(s) = v;
  2*der(v) = F - 8*e - q;
end Held;
"""
CASE = """model = "Held.mo"
[signals.F]
role = "input"
variable = "F"
unit = "N"
[signals.s]
role = "output"
variable = "s"
unit = "m"
noise_std = 0.001
[initial]
{name} = "unknown"
[recordings]
fit = ["r1.csv"]
validate = ["r2.csv"]
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "Held.mo").write_text(MASS)
    for shift in (1, 2):
        rows = "\n".join(f"{k / 20},{k % 7 / 10},{0.1 + k % 5 / 1000 + shift / 100}" for k in range(200))
        (tmp_path / f"r{shift}.csv").write_text(f"time,F,s\n{rows}\n")
    return tmp_path


@pytest.mark.parametrize(("name", "states"), [("s", ("s",)), ("e", ()), ("v", ())])
def test_what_a_case_gives_the_start_of_is_a_state(folder: Path, name: str, states: tuple[str, ...]) -> None:
    (folder / "case.toml").write_text(CASE.format(name=name))
    case = load(folder)
    assert believed_structure(case, case.library()).states == states
    _, machine = opened(case, Library([str(folder)]))
    assert machine is None or name in machine.model.states


def test_what_can_be_no_state_is_refused_as_before(folder: Path) -> None:
    (folder / "case.toml").write_text(CASE.format(name="q"))
    case = load(folder)
    assert believed_structure(case, case.library()).states == ()
