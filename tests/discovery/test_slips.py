"""A slip of sign or unit is one only where a recording comes nearer to its model by being put right."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.steps import opened


@pytest.mark.parametrize(("rate", "sense", "slips"), [(0.8e-4, 1.0, []), (1.2e-4, -1.0, ["scale", "scale"])])
def test_what_settles_the_other_way_is_no_reversed_sign(
    tmp_path: Path, rate: float, sense: float, slips: list[str]
) -> None:
    """A culture washed out faster than it grows, where the model has it grow; and one read with its sign turned."""
    (tmp_path / "Culture.mo").write_text(
        'model Culture\n  parameter Real mu(unit="1/s") = 1.2e-4;\n  input Real D(unit="1/s");\n'
        '  Real X(unit="kg/m3", start=4, fixed=true);\nequation\n  der(X) = (mu - D)*X;\nend Culture;\n'
    )
    (tmp_path / "case.toml").write_text(
        'model = "Culture.mo"\n[signals.D]\nrole = "input"\nvariable = "D"\nunit = "1/s"\ninterpolation = "hold"\n'
        '[signals.X]\nrole = "output"\nvariable = "X"\nunit = "kg/m3"\nnoise_std = 0.002\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    time, random = 5.0 * np.arange(400), np.random.default_rng(3)
    for name in ("r1", "r2"):
        dilution = np.where(time < 1000.0, 1.0e-4, 0.95e-4)
        grown = 5.0 * np.concatenate([[0.0], np.cumsum(rate - dilution[:-1])])
        culture = sense * 4.0 * np.exp(grown) + random.normal(0.0, 0.002, 400)
        table = np.column_stack([time, dilution, culture])
        np.savetxt(tmp_path / f"{name}.csv", table, "%.8g", ",", header="time,D,X", comments="")
    case = load(tmp_path)
    assert [p.kind for p in opened(case, case.library())[0].problems if p.fatal] == slips


@pytest.mark.parametrize(("start", "kinds"), [("", ["scale", "scale"]), ('[initial]\nx = "unknown"\n', [])])
def test_what_swings_from_a_start_that_nobody_knows_has_any_sign(tmp_path: Path, start: str, kinds: list[str]) -> None:
    """A mass let go on the other side of rest than its model believes, with an input that hardly moves it."""
    (tmp_path / "Mass.mo").write_text(
        'model Mass\n  parameter Real k(unit="1/s2") = 4;\n  input Real a(unit="m/s2");\n'
        '  Real x(unit="m", start=0.1, fixed=true);\n  Real v(unit="m/s", start=0, fixed=true);\n'
        "equation\n  der(x) = v;\n  der(v) = a - k*x;\nend Mass;\n"
    )
    (tmp_path / "case.toml").write_text(
        f'model = "Mass.mo"\n{start}[signals.a]\nrole = "input"\nvariable = "a"\nunit = "m/s2"\n'
        '[signals.x]\nrole = "output"\nvariable = "x"\nunit = "m"\nnoise_std = 0.001\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    time, random = 0.02 * np.arange(500), np.random.default_rng(5)
    for name in ("r1", "r2"):
        swing = -0.1 * np.cos(2 * time) + random.normal(0.0, 0.001, 500)
        table = np.column_stack([time, 1e-3 * np.sin(time), swing])
        np.savetxt(tmp_path / f"{name}.csv", table, "%.8g", ",", header="time,a,x", comments="")
    case = load(tmp_path)
    assert [p.kind for p in opened(case, case.library())[0].problems if p.fatal] == kinds
