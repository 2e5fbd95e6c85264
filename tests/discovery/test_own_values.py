"""What holds in one recording only, of a recording that only judges: no other one can tell it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain

TANK = """package Site
  constant Real unit_area(unit="m2") = 1;
  model Outlet
    parameter Real k(unit="m2/s") = 1e-3;
    input Real h(unit="m");
    output Real q(unit="m3/s");
  equation
    q = k*h;
  end Outlet;
  model Tank
    parameter Real k(unit="m2/s") = 1e-3 "By the setting of a hand valve";
    input Real q(unit="m3/s");
    Outlet outlet(k=k, h=h);
    Real h(unit="m", start=1, fixed=true);
  equation
    0.5*unit_area*der(h) = q - outlet.q;
  end Tank;
end Site;
"""


def _case(folder: Path, valves: dict[str, float], loss: float = 0.0) -> Path:
    """Recordings with these openings of the valve, where 1e-3 is believed within a tenth; `loss` is a leak, m2.5/s."""
    folder.mkdir()
    (folder / "Site.mo").write_text(TANK)
    random = np.random.default_rng(3)
    toml = [
        'model = "Site.mo:Site.Tank"', "[uncertainty]", "k = 0.1", "[signals.q]", 'role = "input"', 'variable = "q"',
        'unit = "m3/s"', 'interpolation = "hold"', "[signals.h]", 'role = "output"', 'variable = "h"', 'unit = "m"',
        "noise_std = 0.002", "[recordings]", 'fit = ["r1.csv", "r2.csv"]', 'validate = ["r3.csv"]',
    ]  # fmt: skip
    for name, k in valves.items():
        toml += [f'[recording."{name}.csv"]', "parameters = {k = 1e-3}", "uncertainty = {k = 0.1}"]
        h, rows = 1.0, []
        for n, q in enumerate(np.repeat(random.uniform(0.2e-3, 2e-3, 8), 75)):
            rows.append(f"{4.0 * n},{q:.8g},{h + random.normal(0, 0.002):.8g}")
            for _ in range(40):
                h += 0.1 / 0.5 * (q - k * h - loss * np.sqrt(abs(h)))
        (folder / f"{name}.csv").write_text("\n".join(["time,q,h", *rows]))
    (folder / "case.toml").write_text("\n".join(toml))
    return folder


def test_a_setting_of_the_recording_that_judges_is_fitted_within_its_belief(tmp_path: Path) -> None:
    """It was held at what is believed, and the believed model was then undetermined."""
    found = explain(load(_case(tmp_path / "case", {"r1": 1.05e-3, "r2": 0.93e-3, "r3": 1.12e-3})))
    assert found.verdict == "consistent", found.reason
    assert found.after.validate["h"] == pytest.approx(found.floor["h"], rel=0.1)


def test_what_no_setting_explains_is_still_seen_there(tmp_path: Path) -> None:
    """And a law is found in the equation of a part whose class stands in the same package."""
    valves = {"r1": 1.05e-3, "r2": 0.93e-3, "r3": 1.12e-3}
    found = explain(load(_case(tmp_path / "case", valves, loss=0.4e-3)))
    assert found.verdict == "missing_physics", found.reason
    assert found.after.validate["h"] == pytest.approx(found.floor["h"], rel=0.2)
