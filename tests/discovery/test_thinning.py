"""Long recordings: outputs are compared at fewer samples, inputs drive as they were recorded."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case import thinning
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.case.noise import estimate
from lacuna.discovery.case.thinning import said_of, thinned
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.steps import fitted

TANK = """model Tank "Filled by a flow that changes at every sample"
  parameter Real A(unit="m2", min=0) = 0.01;
  parameter Real k(unit="m2/s", min=0) = 3e-4;
  input Real q(unit="m3/s");
  Real h(unit="m", start=0.2, fixed=true);
  Real out(unit="m3/s");
equation
  A*der(h) = q - out;
  out = k*h;
end Tank;
"""


@pytest.fixture
def case(tmp_path: Path) -> Case:
    """Two recordings in closed form; the outflow is read at every seventh sample alone."""
    random, rate = np.random.default_rng(2), 3.2e-4 / 0.01
    for name in ("r1", "r2"):
        time, q = 0.5 * np.arange(2000), random.uniform(0, 2e-4, 2000)
        keep, h = np.exp(-rate * 0.5), np.full(2000, 0.2)
        for n in range(1999):
            h[n + 1] = q[n] / 3.2e-4 + (h[n] - q[n] / 3.2e-4) * keep
        out = np.where(np.arange(2000) % 7 == 3, 3.2e-4 * h + random.normal(0, 1e-7, 2000), np.nan)
        table = np.column_stack([time, q, h + random.normal(0, 1e-3, 2000), out])
        lines = [",".join("" if np.isnan(v) else f"{v:.9g}" for v in row) for row in table]
        (tmp_path / f"{name}.csv").write_text("time,q,h,out\n" + "\n".join(lines) + "\n")
    signals = "".join(
        f'[signals.{n}]\nrole = "{role}"\nvariable = "{n}"\nunit = "{unit}"\ninterpolation = "{kind}"\n'
        for n, role, unit, kind in (("q", "input", "m3/s", "hold"), ("h", "output", "m", "linear"),
                                    ("out", "output", "m3/s", "linear"))
    )  # fmt: skip
    (tmp_path / "Tank.mo").write_text(TANK)
    (tmp_path / "case.toml").write_text(
        f'model = "Tank.mo"\n{signals}[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    return load(tmp_path)


def test_a_thinned_recording_says_what_the_whole_one_says(case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = fitted(case, lambda text: None)
    assert thinned(case, noise_of(case)) is case and not said_of(case)
    monkeypatch.setattr(thinning, "MOST", 500)
    short = fitted(case, lambda text: None)
    recording = short.case.fit[0]
    assert len(recording.time) < 600 and np.isfinite(recording.columns["out"]).sum() >= 36
    assert len(recording.drive("q")[0]) == 2000
    assert noise_of(short.case)["h"] == estimate([case.fit[0].columns["h"]], None)
    assert [p.kind for p in short.problems] == ["thinned", "thinned"]
    errors = short.errors()
    for name in ("A", "k"):
        assert abs(short.base.point[name] - whole.base.point[name]) < 4 * errors[name]
    assert short.base.point["k"] == pytest.approx(3.2e-4, rel=0.01)
