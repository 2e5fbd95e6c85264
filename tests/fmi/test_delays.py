"""delay() in co-simulation: its past lives in the instance, and travels with its state."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy
from fmpy.validation import validate_fmu
import numpy as np
import pytest

import lacuna
from tests.fmi.fmus import MODELS, Fmus
from tests.fmi.test_instances import begin, real, states
from tests.fmi.trajectories import differences, reference, run

LATE = str(MODELS / "Late.mo")
VERSIONS = ("3.0", "2.0")


@pytest.fixture
def late(fmus: Fmus) -> Any:
    @contextmanager
    def opened(version: str) -> Iterator[Any]:
        with fmus.instance(LATE, "cs", version, exported={"type": "cs"}) as fmu:
            yield fmu

    return opened


@pytest.mark.parametrize("version", VERSIONS)
def test_a_delay_is_as_ours_and_as_the_method_of_steps_has_it(fmus: Fmus, version: str) -> None:
    path, model = fmus.path(LATE, version, type="cs"), lacuna.load(LATE)
    assert validate_fmu(str(path)) == []
    found = run(path, "cs", 3.0, ["x", "z"])
    beyond = differences(found, reference(model, 3.0, ["x", "z"]), ["x", "z"])
    assert not {signal: d for signal, d in beyond.items() if d > 1e-5}
    t = found["time"]
    second = 1 - 2 * t + 2 * (t - 0.3) ** 2  # x' = -2 (1 - 2 (t - 0.3)) from 0.3 to 0.6, after x' = -2
    early = np.where(t <= 0.3, 1 - 2 * t, second)[t <= 0.6]
    assert found["x"][t <= 0.6] == pytest.approx(early, abs=1e-7)
    late = np.where(t > 0.75, 1 - np.exp(-2 * np.maximum(t - 0.75, 0)), 0)
    assert found["z"] == pytest.approx(late, abs=1e-6)


@pytest.mark.parametrize("version", VERSIONS)
def test_its_past_goes_back_with_the_state_and_to_another_instance(late: Any, version: str) -> None:
    with late(version) as one, late(version) as other:
        begin(one), begin(other)
        keep, restore = states(one, version)
        for k in range(7):
            one.doStep(0.1 * k, 0.1)
        kept = keep()
        tail = []
        for _ in range(2):
            for k in range(7, 20):
                one.doStep(0.1 * k, 0.1)
            tail.append(real(one, "x", "z"))
            restore(kept)
        assert tail[0] == tail[1]
        write, read = (
            (one.serializeFMUState, other.deserializeFMUState) if version == "3.0" else
            (one.serializeFMUstate, other.deSerializeFMUstate)
        )  # fmt: skip
        states(other, version)[1](read(write(kept)))
        for k in range(7, 20):
            other.doStep(0.1 * k, 0.1)
        assert real(other, "x", "z") == tail[0]


def test_bytes_that_are_no_state_are_refused(late: Any, capfd: pytest.CaptureFixture[str]) -> None:
    with late("3.0") as fmu:
        begin(fmu)
        fmu.doStep(0.0, 0.5)
        whole = bytes(fmu.serializeFMUState(fmu.getFMUState()))
        for wrong in (whole[:-8], whole + b"\0" * 8, b"\xff\xff\xff\x7f" + whole[4:], b"\xff" * len(whole), b""):
            with pytest.raises(Exception, match="failed"):
                fmu.deserializeFMUState(wrong)
        assert "are no state of this FMU" in "".join(capfd.readouterr())


def test_a_delay_keeps_its_time_in_a_run(late: Any, capfd: pytest.CaptureFixture[str]) -> None:
    with late("3.0") as fmu:
        fmu.setFloat64([fmu.vr["T"]], [0.5])
        begin(fmu)
        fmu.doStep(0.0, 0.5)
        assert real(fmu, "x")[0] == pytest.approx(0.0, abs=1e-9)  # x = 1 - 2 t up to 0.5 s
        fmu.setFloat64([fmu.vr["T"]], [0.2])
        with pytest.raises(Exception, match="failed"):
            fmu.doStep(0.5, 0.5)
        assert "cannot be tuned in a run: 0.5 s, not 0.2 s" in "".join(capfd.readouterr())


def test_model_exchange_is_refused_with_the_reason(tmp_path: Path) -> None:
    for kind in ("me", "both"):
        with pytest.raises(Exception, match="for co-simulation only") as refused:
            lacuna.export_fmu(LATE, tmp_path / "x.fmu", type=kind)
        assert lacuna.is_user_error(refused.value) and not list(tmp_path.iterdir())
    done = lacuna.export_fmu(LATE, tmp_path / "x.fmu", type="cs")
    assert fmpy.read_model_description(str(done.path)).coSimulation.providesDirectionalDerivative is False
