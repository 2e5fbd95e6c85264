"""A free swing of many periods: what is believed is soon out of step, and so is a law that is a little off."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.law.law import law_at

from .recorded import record, truth

HAMMER = """model Hammer "Swings"
  parameter Real J(unit="kg.m2", min=0) = {J};
  parameter Real G(unit="N.m", min=0) = {G};
  parameter Real d(unit="N.m.s/rad", min=0) = 0.15;
  Real th(unit="rad", start={th}, fixed=true);
  Real w(unit="rad/s", start={w}, fixed=true);
equation
  der(th) = w;
  J*der(w) = -G*sin(th) - d*w{more};
end Hammer;
"""


def test_a_drag_of_a_free_swing_is_found_with_its_power(tmp_path: Path) -> None:
    random = np.random.default_rng(6)
    (tmp_path / "Hammer.mo").write_text(HAMMER.format(J=12.25, G=138.1, th=1, w=0, more=""))
    for name, th, w, rows in (("r1", 2.44, 0.1, 1200), ("r2", -1.13, -0.4, 800), ("r3", 1.8, 0.0, 800)):
        text = HAMMER.format(J=12.4, G=137.0, th=th, w=w, more=" - 0.06*w*abs(w)^0.6")
        time, errors = 0.05 * np.arange(rows), {n: random.normal(0, s, rows) for n, s in (("th", 0.01), ("w", 0.03))}
        record(
            tmp_path / f"{name}.csv", truth(tmp_path / name, "Hammer", text), time, {}, {"th": "th", "w": "w"}, errors
        )
    (tmp_path / "case.toml").write_text(
        'model = "Hammer.mo"\n[uncertainty]\nJ = 0.01\nG = 0.006\nd = 0.3\n[initial]\nth = "unknown"\nw = "unknown"\n'
        '[signals.th]\nrole = "output"\nvariable = "th"\nunit = "rad"\nnoise_std = 0.01\n'
        '[signals.w]\nrole = "output"\nvariable = "w"\nunit = "rad/s"\nnoise_std = 0.03\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    found = explain(load(tmp_path))
    assert found.verdict == "missing_physics"
    (finding,) = found.findings
    assert finding.ranked.attachment.location == "w"
    law = law_at(finding.ranked.attachment, found.final.point)
    speed, lost = np.linspace(0.5, 4.0, 8), 0.06 * np.linspace(0.5, 4.0, 8) ** 1.6
    said = -eval(law.replace("^", "**"), {"sign": np.sign, "abs": np.abs, "w": speed})
    damping = found.final.point["d"] * speed - 0.15 * speed
    assert said + damping == pytest.approx(lost, rel=0.1, abs=0.02), law
