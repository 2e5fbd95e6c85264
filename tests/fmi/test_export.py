"""FMUs as another tool sees them: valid by its check, equal to our trajectories when its solver integrates them, and
when it only asks for steps."""

from __future__ import annotations

from pathlib import Path
import zipfile

from fmpy import read_model_description
from fmpy.validation import validate_fmu
import numpy as np
import pytest

import lacuna
from tests.fmi.fmus import ALL, OTHERS, OWN, Fmus
from tests.fmi.trajectories import KINDS, differences, reference, run, signals_of

BOUND = 1e-5  # of each signal's largest value
HYBRID = {"T1": 0.4, "T2": 0.03, "FlightControlEma": 0.03, "Clockwork": 2.0, "VanDerPol": 20.0, "Pendulum": 1.0,
          "Mesh": 1.0}  # fmt: skip


@pytest.mark.parametrize(("name", "version"), [*((n, "3.0") for n in (*OWN, *OTHERS)), *((n, "2.0") for n in OWN)])
def test_fmpy_finds_nothing_to_object_to(fmus: Fmus, name: str, version: str) -> None:
    assert validate_fmu(str(fmus.path(name, version))) == []


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("name", "version"), [*((n, "3.0") for n in HYBRID), ("T1", "2.0"), ("T2", "2.0"), ("Pendulum", "2.0")]
)
def test_states_are_ours_on_both_sides_of_events(fmus: Fmus, name: str, version: str, kind: str) -> None:
    stop, model = HYBRID[name], lacuna.load(ALL[name])
    signals = signals_of(model)
    found = run(fmus.path(name, version), kind, stop, signals, record_events=True)
    assert found["time"][-1] == pytest.approx(stop)
    beyond = differences(found, reference(model, stop, signals), signals)
    assert not {signal: d for signal, d in beyond.items() if d > BOUND}


@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_ball_bounces_as_its_closed_form_says(fmus: Fmus, kind: str, version: str) -> None:
    found = run(fmus.path("BouncingBall", version), kind, 3.0, ["h", "v"])
    t, g, e = found["time"], 9.81, 0.7
    fall = np.sqrt(2 / g)
    height, start, speed = 1 - g * t**2 / 2, fall, e * g * fall
    while speed >= 0.1:
        height = np.where(t > start, speed * (t - start) - g * (t - start) ** 2 / 2, height)
        start, speed = start + 2 * speed / g, e * speed
    height = np.where(t > start, 0, height)
    assert np.max(np.abs(found["h"] - height)) <= BOUND
    assert found["v"][-1] == 0


@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("kind", KINDS)
def test_decay(fmus: Fmus, kind: str, version: str) -> None:
    found = run(fmus.path("Dahlquist", version), kind, 10.0, ["x"], start_values={"k": 0.5, "x": 3.0})
    assert np.max(np.abs(found["x"] - 3 * np.exp(-0.5 * found["time"]))) <= BOUND


@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("interval", [0.5, 0.7])  # 9 s is one of the importer's points, or lies within a step
def test_a_stair_without_states_ends_itself(fmus: Fmus, kind: str, version: str, interval: float) -> None:
    found = run(fmus.path("Stair", version), kind, 12.0, ["counter"], output_interval=interval)
    assert found["time"][-1] <= 9.0 + interval
    inside = np.abs(found["time"] - np.round(found["time"])) > 0.1
    assert np.array_equal(found["counter"][inside], 1 + np.floor(found["time"][inside]))
    assert found["counter"][-1] == (9 if kind == "me" else 10)  # FMPy has no row after an event that ends the run


@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("kind", KINDS)
def test_inputs_of_all_types_pass_through(fmus: Fmus, kind: str, version: str) -> None:
    table = np.array(
        [(0, 0.0, 1, False), (1, 2.0, 1, False), (1, 3.0, -2, True), (2, 3.0, -2, True)],
        dtype=[("time", float), ("u", float), ("n", np.int32), ("b", bool)],
    )
    found = run(
        fmus.path("Feedthrough", version), kind, 2.0, ["y", "doubled", "m", "c"], input=table, output_interval=0.25
    )
    late = found["time"] > 1.3
    assert set(found["m"][late]) == {-2} and set(found["c"][late]) == {1}
    assert found["y"][late] == pytest.approx(3.0) and found["doubled"][late] == pytest.approx(6.0)
    early = found["time"] < 0.9
    assert set(found["m"][early]) == {1} and set(found["c"][early]) == {0}


def test_the_source_is_inside_and_equal_models_give_equal_bytes(fmus: Fmus, tmp_path: Path) -> None:
    first, again = fmus.path("Dahlquist"), tmp_path / "again.fmu"
    lacuna.export_fmu(OWN["Dahlquist"], again)
    assert first.read_bytes() == again.read_bytes()
    names = set(zipfile.ZipFile(first).namelist())
    assert {"sources/generated.c", "sources/simulate.c", "sources/fmi3.c", "sources/buildDescription.xml"} <= names


def test_angles_count_in_units_as_fmi_counts_them(fmus: Fmus) -> None:
    """FMI has the radian among its base units, Modelica has not: a speed and a frequency differ by it."""
    units = {u.name: u.baseUnit for u in read_model_description(fmus.path("T1")).unitDefinitions}
    assert (units["rad/s"].rad, units["rad/s"].s) == (1, -1)
    assert units["N.m.s/rad"].rad == -1 and units["N.m"].rad == 0


def test_a_foreign_fmu_is_compared_and_a_wrong_one_found(fmus: Fmus) -> None:
    own = OWN["VanDerPol"]
    assert lacuna.compare_with_file(own, fmus.path("VanDerPol"), tolerance=1e-4).beyond == []
    other = lacuna.compare_with_file(own, fmus.path("VanDerPol", parameters={"mu": 1.1}), tolerance=1e-4)
    assert set(other.beyond) == {"x0", "x1"}


def test_an_fmu_with_arrays_is_compared_element_by_element(fmus: Fmus) -> None:
    own, rates = OWN["Mesh"], {"u[2]": 0.5, "u[3]": (np.array([0.0, 1.0]), np.array([1.0, 3.0]))}
    # FMPy holds an input over each of its steps, which a ramp shows: as much with FMI 2.0, where all is scalar.
    given = {"tolerance": 3e-3, "parameters": {"A[1,2]": 2.0, "A[2,1]": -3.0}, "inputs": rates}
    found = lacuna.compare_with_file(own, fmus.path("Mesh"), **given)
    assert {"x[1]", "x[3]", "y[1]", "seen[2,1]", "two[2]"} <= {row[0] for row in found.rows} and found.beyond == []
    wrong = lacuna.compare_with_file(own, fmus.path("Mesh", parameters={"A[2,2]": 1.0}), **given)
    assert set(wrong.beyond) == {"y[2]"}


def test_a_cache_that_is_named_from_here_serves_a_compiler_that_works_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LACUNA_CACHE", "cache")
    assert lacuna.export_fmu(OWN["Dahlquist"], "one.fmu").path.is_file()
    assert (tmp_path / "cache").is_dir()


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("n", 1.5, "parameter n cannot be 1.5: it is of whole numbers"),
        ("b", 0.5, "parameter b cannot be 0.5: it is Boolean"),
        ("n", 1e12, "n would start at 1000000000000, and an Integer of FMI has 32 bits"),
        ("r", 7.0, "r"),
    ],
)
def test_a_start_value_that_no_run_takes_is_refused(tmp_path: Path, name: str, value: float, said: str) -> None:
    model = tmp_path / "N.mo"
    model.write_text(
        "model N parameter Integer n = 3; parameter Boolean b = true; parameter Real r(max = 5) = 1; Real x = n*r;"
        " Boolean y = b; end N;"
    )
    with pytest.raises(Exception, match=said) as refused:
        lacuna.export_fmu(model, tmp_path / "N.fmu", parameters={name: value})
    assert lacuna.is_user_error(refused.value) and not (tmp_path / "N.fmu").exists()


def test_an_fmu_in_other_units_is_compared_in_the_models(tmp_path: Path) -> None:
    """What is 0.5 V in the FMU was compared as 0.5 mV."""
    text = 'model M\n  parameter Real a(unit="{0}") = {1};\n  Real x(start=0, fixed=true, unit="{0}");\n'
    text += "equation\n  der(x)*{{number}} = a;\nend M;\n"
    text = text.replace("{{number}}", "T").replace("equation", '  parameter Real T(unit="s") = 2;\nequation')
    for folder, values in (("theirs", ("V", 1)), ("ours", ("mV", 1000)), ("ampere", ("A", 1))):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "M.mo").write_text(text.format(*values))
    lacuna.export_fmu(tmp_path / "theirs" / "M.mo", tmp_path / "M.fmu")
    found = lacuna.compare_with_file(tmp_path / "ours" / "M.mo", tmp_path / "M.fmu")
    assert found.beyond == [] and "x" in {row[0] for row in found.rows}
    with pytest.raises(Exception, match="a is in V, in the model in A"):
        lacuna.compare_with_file(tmp_path / "ampere" / "M.mo", tmp_path / "M.fmu")
    with pytest.raises(Exception, match="has a, which the comparison sets, in another unit"):
        lacuna.compare_with_file(tmp_path / "ours" / "M.mo", tmp_path / "M.fmu", parameters={"a": 3.0})


def test_integers_and_booleans_of_an_fmu_are_compared(tmp_path: Path) -> None:
    """They were left out without a word: one that counts otherwise agreed."""
    text = (
        "model Counter Integer n(start=0, fixed=true); Boolean odd = mod(n, 2) == 1; equation"
        " when sample(0.05, 0.1) then n = pre(n) + {0}; end when; end Counter;"
    )
    for folder, step in (("ours", 1), ("theirs", 2)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "Counter.mo").write_text(text.format(step))
    for version in ("2.0", "3.0"):
        for folder, beyond in (("ours", []), ("theirs", ["n", "odd"])):
            fmu = tmp_path / folder / "Counter.fmu"
            lacuna.export_fmu(tmp_path / folder / "Counter.mo", fmu, version=version)
            found = lacuna.compare_with_file(tmp_path / "ours" / "Counter.mo", fmu)
            assert sorted(row[0] for row in found.rows) == ["n", "odd"] and found.beyond == beyond
