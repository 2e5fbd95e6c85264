"""A command that switches between two samples of its recording is no physics."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.steps import fitted

HEATER = """model Heater "Plate, heated, measured"
  parameter Real C(unit="J/K", min=0) = 50;
  parameter Real G(unit="W/K", min=0) = 2;
  parameter Real Ta(unit="K") = 293;
  input Real P(unit="W");
  Real T(unit="K", start=293, fixed=true);
equation
  C*der(T) = P - G*(T - Ta);
end Heater;
"""


@pytest.fixture(scope="module", params=[0.0, 0.55])
def heater(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, float]:
    """Recordings of a plate in closed form, every 5 s; its heater switches `share` of an interval before a sample."""
    folder, share, random = tmp_path_factory.mktemp("heater"), request.param, np.random.default_rng(5)
    (folder / "Heater.mo").write_text(HEATER)
    for name in ("r1", "r2", "r3"):
        time = 5.0 * np.arange(400)
        power, at = random.uniform(20.0, 400.0, 10), 5.0 * (40 * np.arange(10) - share)
        truth, edges = np.full(400, 293.0), [*at[1:], np.inf]
        here, now = 293.0, 0.0
        for p, end in zip(power, edges, strict=True):
            inside = (time >= now) & (time < end)
            rest = 293.0 + p / 2.0
            truth[inside] = rest + (here - rest) * np.exp(-(time[inside] - now) / 25.0)
            here, now = rest + (here - rest) * np.exp(-(min(end, time[-1]) - now) / 25.0), end
        seen = power[np.clip(np.searchsorted(at, time, side="right") - 1, 0, 9)]
        table = np.column_stack([time, seen, truth + random.normal(0.0, 0.3, 400)])
        np.savetxt(folder / f"{name}.csv", table, "%.8g", ",", header="time,P,T", comments="")
    (folder / "case.toml").write_text(
        'model = "Heater.mo"\n[signals.P]\nrole = "input"\nvariable = "P"\nunit = "W"\ninterpolation = "hold"\n'
        '[signals.T]\nrole = "output"\nvariable = "T"\nunit = "K"\nnoise_std = 0.3\n[uncertainty]\nTa = 0\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    return folder, share


def test_switches_are_placed_where_the_outputs_tell_them(heater: tuple[Path, float]) -> None:
    folder, share = heater
    found = fitted(load(folder), lambda text: None)
    assert is_noise(found.base)
    assert all(bool(r.drives) == bool(share) for r in (*found.case.fit, *found.case.validate))
    assert any(p.kind == "switches" for p in found.problems) == bool(share)
    for r in found.case.fit if share else ():
        early = (r.time - r.drives["P"][0]) / 5.0
        assert np.count_nonzero(early) <= 9
        large = np.abs(np.diff(r.columns["P"]))[39::40] > 60.0  # W: a tenth of a kelvin for each, a third is noise
        assert early[40::40][large] == pytest.approx(share, abs=0.1)
