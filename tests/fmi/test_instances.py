"""Instances driven by hand: states kept and restored, derivatives, parameters tuned, the modes of co-simulation, and
what is refused."""

from __future__ import annotations

import ctypes
from pathlib import Path
import subprocess
import zipfile

from fmpy import fmi2
import numpy as np
import pytest

import lacuna
from tests.fmi.fmus import MODELS, OWN, Fmus

SANITIZED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g")


def begin(fmu, stop: float | None = None) -> None:
    if hasattr(fmu, "setupExperiment"):
        fmu.setupExperiment(startTime=0.0, stopTime=stop)
        fmu.enterInitializationMode()
    else:
        fmu.enterInitializationMode(startTime=0.0, stopTime=stop)
    fmu.exitInitializationMode()


def real(fmu, *names: str) -> list[float]:
    references = [fmu.vr[name] for name in names]
    if not hasattr(fmu, "getFloat64"):
        return list(fmu.getReal(references))
    sizes = {v.name: int(np.prod(v.shape or ())) for v in fmu.description.modelVariables}
    return list(fmu.getFloat64(references, sum(sizes[name] for name in names)))


def states(fmu, version: str):
    return (fmu.getFMUState, fmu.setFMUState) if version == "3.0" else (fmu.getFMUstate, fmu.setFMUstate)


@pytest.mark.parametrize(
    ("name", "version"), [("Clockwork", "3.0"), ("Clockwork", "2.0"), ("FlightControlEma", "3.0"), ("Pendulum", "3.0"),
     ("Mesh", "3.0")]
)  # fmt: skip
def test_a_state_that_is_restored_goes_on_to_the_same_bits(fmus: Fmus, name: str, version: str) -> None:
    step = {"Clockwork": 0.07, "FlightControlEma": 3.1e-4, "Pendulum": 0.05, "Mesh": 0.03}[name]
    with fmus.instance(name, "cs", version) as fmu:
        begin(fmu)
        keep, restore = states(fmu, version)
        watched = [v.name for v in fmu.description.modelVariables if v.variability == "continuous"][:60]
        for k in range(10):
            fmu.doStep(k * step, step)
        kept = keep()
        first = []
        for _ in range(2):
            for k in range(10, 20):
                fmu.doStep(k * step, step)
            first.append(real(fmu, *watched))
            restore(kept)
        assert first[0] == first[1]


def test_a_state_travels_to_another_instance_as_bytes(fmus: Fmus) -> None:
    with fmus.instance("Clockwork", "cs") as one, fmus.instance("Clockwork", "cs") as other:
        begin(one), begin(other)
        for k in range(7):
            one.doStep(k * 0.1, 0.1)
        other.setFMUState(other.deserializeFMUState(one.serializeFMUState(one.getFMUState())))
        for k in range(7, 12):
            one.doStep(k * 0.1, 0.1), other.doStep(k * 0.1, 0.1)
        assert real(one, "phi", "w", "seen") == real(other, "phi", "w", "seen")


def test_bytes_of_a_state_that_were_damaged_are_refused(fmus: Fmus) -> None:
    with fmus.instance("Clockwork", "cs") as fmu:
        begin(fmu)
        whole = fmu.serializeFMUState(fmu.getFMUState())
        for at in range(0, len(whole), 7):
            spoilt = bytearray(whole)
            spoilt[at] ^= 4
            with pytest.raises(Exception, match=r"Status|status"):
                fmu.deserializeFMUState(bytes(spoilt))
        fmu.setFMUState(fmu.deserializeFMUState(whole))


def test_directional_derivatives_are_those_of_differences(fmus: Fmus) -> None:
    with fmus.instance("Clockwork", "me") as fmu:
        begin(fmu)
        fmu.updateDiscreteStates()
        fmu.enterContinuousTimeMode()
        unknowns = [fmu.vr["der(w)"], fmu.vr["power"], fmu.vr["der(phi)"]]
        fmu.setFloat64([fmu.vr["u"]], [0.7])

        def values(w: float, u: float) -> np.ndarray:
            set_states(fmu, [0.3, w])
            fmu.setFloat64([fmu.vr["u"]], [u])
            return np.array(fmu.getFloat64(unknowns))

        step = 1e-6
        for known, moved in (("w", (step, 0)), ("u", (0, step))):
            values(1.2, 0.7)
            exact = fmu.getDirectionalDerivative(unknowns, [fmu.vr[known]], [1.0])
            difference = (values(1.2 + moved[0], 0.7 + moved[1]) - values(1.2 - moved[0], 0.7 - moved[1])) / (2 * step)
            assert exact == pytest.approx(difference, rel=1e-7, abs=1e-9)


def set_states(fmu, x: list[float]) -> None:
    from ctypes import c_double

    fmu.setContinuousStates((c_double * len(x))(*x), len(x))


def test_a_parameter_is_tuned_between_steps(fmus: Fmus) -> None:
    """With four times the decay from one second on."""
    with fmus.instance("Dahlquist", "cs") as fmu:
        begin(fmu)
        fmu.doStep(0.0, 1.0)
        fmu.setFloat64([fmu.vr["k"]], [4.0])
        fmu.doStep(1.0, 0.5)
        assert real(fmu, "x")[0] == pytest.approx(np.exp(-1 - 4 * 0.5), rel=1e-5)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_no_step_goes_past_the_stop_time_that_was_given(
    fmus: Fmus, capfd: pytest.CaptureFixture[str], version: str
) -> None:
    with fmus.instance("Dahlquist", "cs", version) as fmu:
        begin(fmu, stop=0.3)
        for k in range(3):
            fmu.doStep(0.1 * k, 0.1)
        with pytest.raises(Exception, match="failed"):
            fmu.doStep(0.3, 0.1)
    captured = capfd.readouterr()
    assert "the stop time that was given is 0.3" in captured.out + captured.err


def test_dependent_parameters_follow_and_sample_clocks_are_set_anew(fmus: Fmus) -> None:
    with fmus.instance("Clockwork", "cs") as fmu:
        begin(fmu)
        fmu.doStep(0.0, 0.25)
        fmu.setFloat64([fmu.vr["J"], fmu.vr["T"]], [0.8, 0.5])
        fmu.doStep(0.25, 0.05)
        assert real(fmu, "twice") == [1.6]
        phi = []
        for k in range(8):  # 0.5 and 1.0 are samples, nothing between is
            fmu.doStep(0.3 + 0.1 * k, 0.1)
            phi.append(real(fmu, "seen")[0])
        assert phi[1] == phi[5] and phi[0] != phi[1] and phi[5] != phi[7]


def test_event_mode_stops_a_step_at_each_event(fmus: Fmus) -> None:
    with fmus.instance("BouncingBall", "cs", eventModeUsed=True, earlyReturnAllowed=True) as fmu:
        begin(fmu)
        fmu.updateDiscreteStates()
        fmu.enterStepMode()
        reached = 0.0
        while reached < 0.1:  # the relation v < 0 switches when the ball begins to fall
            event, _, early, reached = fmu.doStep(reached, 1.0)
            if reached < 0.1:
                fmu.enterEventMode()
                fmu.updateDiscreteStates()
                fmu.enterStepMode()
        assert event and early and reached == pytest.approx(np.sqrt(2 / 9.81), rel=1e-6)
        before = real(fmu, "v")[0]
        fmu.enterEventMode()
        fmu.updateDiscreteStates()
        assert real(fmu, "v")[0] == pytest.approx(-0.7 * before)


@pytest.mark.parametrize("version", ["3.0", "2.0"])
def test_an_event_just_after_a_rounded_communication_point_happens_at_its_own_time(fmus: Fmus, version: str) -> None:
    """Ten steps of 0.1 end an ulp before 1."""
    with fmus.instance("Seconds", "cs", version) as fmu:
        begin(fmu)
        reached = 0.0
        for _ in range(55):
            fmu.doStep(reached, 0.1)
            reached += 0.1
        assert real(fmu, "next") == [6.0]


def test_a_guard_may_rest_on_its_threshold_while_an_importers_time_goes_on(fmus: Fmus) -> None:
    """Another tool's solver finds a guard at its own accuracy, to and fro: 300 events that move nothing are as good as
    any while time goes on, and chattering where it stands."""

    def rest_at_the_stop(fmu, step: float) -> None:
        begin(fmu)
        fmu.updateDiscreteStates()
        for k in range(300):
            fmu.enterContinuousTimeMode()
            fmu.setTime(0.1 + k * step)
            states = (ctypes.c_double * 2)(1 + (-1) ** k * 1e-12, 0.0)
            fmu.setContinuousStates(states, 2)
            fmu.enterEventMode()
            fmu.updateDiscreteStates()

    with fmus.instance("Clockwork", "me") as fmu:
        rest_at_the_stop(fmu, 1e-4)
    with fmus.instance("Clockwork", "me") as fmu, pytest.raises(Exception, match="failed"):
        rest_at_the_stop(fmu, 0.0)


def test_reset_begins_anew(fmus: Fmus) -> None:
    with fmus.instance("Clockwork", "cs") as fmu:
        begin(fmu)
        fmu.setFloat64([fmu.vr["kick"]], [2.0])
        fmu.doStep(0.0, 1.0)
        moved = real(fmu, "w")
        fmu.reset()
        begin(fmu)
        fmu.doStep(0.0, 1.0)
        assert real(fmu, "kick") == [0.3] and real(fmu, "w") != moved


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [("e", 1.5, "outside its bounds"), ("der(h)", 0.0, "may be set"), ("h", np.nan, "finite")],
)
def test_a_value_that_cannot_be_is_refused_with_the_reason(
    fmus: Fmus, capfd: pytest.CaptureFixture[str], name: str, value: float, said: str
) -> None:
    with fmus.instance("BouncingBall", "me") as fmu, pytest.raises(Exception, match="failed"):
        fmu.setFloat64([fmu.vr[name]], [value])
    captured = capfd.readouterr()
    assert said in captured.out + captured.err


def test_a_reason_reaches_an_importer_that_has_reused_the_struct_of_its_functions(fmus: Fmus) -> None:
    said: list[bytes] = []
    functions = fmi2.fmi2CallbackFunctions()
    functions.logger = logger = fmi2.fmi2CallbackLoggerTYPE(lambda *words: said.append(words[-1]))
    with fmus.instance("BouncingBall", "me", "2.0", callbacks=functions) as fmu:
        ctypes.memset(ctypes.byref(functions), 0, ctypes.sizeof(functions))
        with pytest.raises(Exception, match="failed"):
            fmu.setReal([fmu.vr["e"]], [1.5])
    assert logger and len(said) == 1


def test_a_violated_assert_of_level_warning_is_logged_once(
    fmus: Fmus, capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    written = tmp_path / "Warned.mo"
    written.write_text(
        "model Warned\n  Real z(start=0, fixed=true);\nequation\n  der(z) = 1;\n"
        '  assert(z < 0.5, "late", AssertionLevel.warning);\nend Warned;\n'
    )
    with fmus.instance(str(written), "cs") as fmu:
        begin(fmu)
        for k in range(10):
            fmu.doStep(0.1 * k, 0.1)
    captured = capfd.readouterr()
    assert (captured.out + captured.err).count("Warned.mo:5: assertion violated at time 0.") == 1


def test_what_cannot_be_exported_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Exception, match="IDA belongs to SUNDIALS") as refused:
        lacuna.export_fmu(OWN["Dahlquist"], tmp_path / "x.fmu", solver="ida")
    assert lacuna.is_user_error(refused.value)
    with pytest.raises(Exception, match=r"ends with \.fmu"):
        lacuna.export_fmu(OWN["Dahlquist"], tmp_path / "x.zip")
    with pytest.raises(Exception, match=r"2\.0 and 3\.0"):
        lacuna.export_fmu(OWN["Dahlquist"], tmp_path / "x.fmu", version="1.0")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["BouncingBall", "Clockwork", "FlightControlEma", "Pendulum", "Mesh", "Late"])
def test_a_thousand_lives_under_the_address_sanitizer(fmus: Fmus, tmp_path: Path, name: str) -> None:
    done = _driven(fmus, tmp_path, name, "lives.c", "1000", *(["cs"] if name == "Late" else []))
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "1000 lives\n"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["Clockwork", "Mesh", "Late"])
def test_bytes_that_were_changed_lead_nowhere_out_of_memory(fmus: Fmus, tmp_path: Path, name: str) -> None:
    done = _driven(fmus, tmp_path, name, "states.c", "1000", "7")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.endswith("of 1000 taken\n") and not done.stdout.startswith("0 ")


def _driven(fmus: Fmus, folder: Path, name: str, driver: str, *words: str) -> subprocess.CompletedProcess[str]:
    """An FMU's sources under a driver in C, with the sanitizers."""
    path = fmus.path(str(MODELS / "Late.mo"), type="cs") if name == "Late" else fmus.path(name)
    zipfile.ZipFile(path).extractall(folder)
    sources = sorted(p.name for p in (folder / "sources").glob("*.c"))
    options = ["-std=c11", "-O1", "-D_DEFAULT_SOURCE", "-D_POSIX_C_SOURCE=200809L", "-DRT_OWN_METHODS",
               "-ffp-contract=off", *SANITIZED]  # fmt: skip
    command = ["cc", *options, "-I.", "-o", "../driven", *sources, str(Path(__file__).parent / driver), "-lm"]
    built = subprocess.run(command, cwd=folder / "sources", capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    token = zipfile.ZipFile(path).read("modelDescription.xml").decode().split('instantiationToken="')[1].split('"')[0]
    return subprocess.run([folder / "driven", token, *words], capture_output=True, text=True, check=False)
