"""Ten examples of the Modelica Standard Library as FMUs: electrical, mechanical, thermal and logical, with diodes,
clutches, play, hysteresis and time tables."""

from __future__ import annotations

from pathlib import Path

from fmpy.validation import validate_fmu
import pytest

import lacuna
from tests.fmi.fmus import LIBRARY, Fmus
from tests.fmi.trajectories import KINDS, differences, reference, run, signals_of

BOUND = 1e-5  # of each signal's largest value
STIFF = {"SwitchWithArc"}
# Each in one version where time is short, every other in the same; all in both by `make check`.
OFTEN = [(name, ("3.0", "2.0")[k % 2]) for k, name in enumerate(LIBRARY)]
SELDOM = [pytest.param(name, ("2.0", "3.0")[k % 2], marks=pytest.mark.slow) for k, name in enumerate(LIBRARY)]


@pytest.mark.parametrize(("name", "version"), [*OFTEN, *SELDOM])
def test_an_example_is_valid_and_runs_as_ours_does(fmus: Fmus, msl: Path, name: str, version: str) -> None:
    path = fmus.path(name, version, libraries=[msl])
    assert validate_fmu(str(path)) == []
    model = lacuna.load(LIBRARY[name], libraries=[msl], units="warn")
    signals, stop = signals_of(model), model.stop_time
    ours = reference(model, stop, signals, "rodas4" if name in STIFF else "dopri5")
    for kind in KINDS:
        found = run(path, kind, stop, signals, record_events=True)
        assert found["time"][-1] == pytest.approx(stop)
        beyond = {signal: d for signal, d in differences(found, ours, signals).items() if d > BOUND}
        assert not beyond, kind
