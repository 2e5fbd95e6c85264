"""What no recording of these can tell: a constant effort from an offset of the input that acts at its place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.confidence import tie
from lacuna.discovery.explanation.input_error import offset_instead

from .recorded import TANK, record, truth


def drained(folder: Path, lost: str) -> Path:
    """A tank whose inflow is recorded, and which loses more than is believed."""
    (folder / "Tank.mo").write_text(TANK.format(outflow="k*h"))
    believed = truth(folder / "machine", "Tank", TANK.format(outflow=f"(k*h + {lost})"))
    time, random = np.arange(0.0, 1200.0, 3.0), np.random.default_rng(4)
    for name in ("r1", "r2", "r3"):
        inflow = 8e-5 + 2.5e-5 * np.repeat(random.uniform(-1, 1, 8), 50)
        errors = {"h": random.normal(0, 5e-4, len(time))}
        record(folder / f"{name}.csv", believed, time, {"q": inflow}, {"h": "h"}, errors)
    (folder / "case.toml").write_text(
        'model = "Tank.mo"\n[uncertainty]\nA = 0.01\nk = 0.05\n'
        '[signals.q]\nrole = "input"\nvariable = "q"\nunit = "m3/s"\n'
        '[signals.h]\nrole = "output"\nvariable = "h"\nunit = "m"\nnoise_std = 5e-4\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    return folder


def test_a_constant_loss_is_not_told_from_an_offset_of_the_inflow(tmp_path: Path) -> None:
    found = explain(load(drained(tmp_path, "2e-5")))
    assert found.verdict == "undetermined"
    signal, offset = offset_instead(found)
    assert signal.column == "q" and offset == pytest.approx(2e-5, rel=0.05)
    assert {t["effect"] for t in tie(found.findings[0])} >= {"sensor.offset"}
    assert "offset" in found.reason and "q" in found.experiment


def test_a_loss_that_is_none_at_rest_is_told(tmp_path: Path) -> None:
    found = explain(load(drained(tmp_path, "6e-5*sqrt(h)")))
    assert found.verdict == "missing_physics" and offset_instead(found) is None
