"""Unknown efforts: linearisation, smoother, regression on closed forms; places; a law, from case to verdict."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.explain import explain, judge_written, write_amended
from lacuna.discovery.explanation import diagnosis
from lacuna.discovery.fit.intervals import undetermined
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.runtime import Model, RecordedInput, simulate

from .recorded import concealed, record

DATA = np.random.default_rng(5)


CASCADE = """model Cascade "Two tanks, one above the other"
  parameter Real A(unit="m2", min=0) = 0.01;
  parameter Real B(unit="m2", min=0) = 0.02;
  parameter Real k(unit="m2/s", min=0) = 3e-4;
  input Real q(unit="m3/s");
  Real upper(unit="m", start=0.3, fixed=true);
  Real lower(unit="m", start=0.2, fixed=true);
equation
  A*der(upper) = q - {upper};
  B*der(lower) = {upper} - {lower};
end Cascade;
"""
BELIEVED = CASCADE.format(upper="k*upper", lower="k*lower")
TORRICELLI = CASCADE.format(upper="k*upper", lower="1.9e-4*sqrt(lower)")
CASE = """model = "Cascade.mo"
[uncertainty]
A = 0.02
B = 0.05
k = 0.1
[signals.q]
role = "input"
unit = "m3/s"
[signals.lower]
role = "output"
unit = "m"
noise_std = 0.001
[signals.upper]
role = "output"
unit = "m"
noise_std = 0.001
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def cascade(folder: Path, machine: str, lower: str = "lower") -> Path:
    """A case of the two tanks whose truth is another class of the same variables; the sensor below shows `lower`."""
    case, tanks = concealed(folder, "Cascade", machine, BELIEVED, CASE)
    random, time = np.random.default_rng(3), np.arange(300) * 2.0
    for n in (1, 2, 3):
        q = np.repeat(random.uniform(2e-5, 1.8e-4, 10), 30)
        errors = {v: 0.001 * random.normal(size=300) for v in ("upper", "lower")}
        record(case / f"r{n}.csv", tanks, time, {"q": q}, {"upper": "upper", "lower": lower}, errors)
    return case


def test_the_linear_response_is_the_closed_form(tmp_path: Path) -> None:
    """A constant effort in the upper balance: (1 - exp(-k t / A)) / k in its level; k answers as d/dk of the level."""
    case = load(cascade(tmp_path, BELIEVED))
    amendment = Amendment(read_structure(case.library(), case.base))
    door = opened(case, amendment, case.library(), ["k"])
    recording = case.fit[0]
    along = door.linear.along({"A": 0.01, "B": 0.02, "k": 3e-4}, recording)
    upper = next(k for k, s in enumerate(door.sites) if "upper) = q" in s.label)
    answer = along.response(np.array([upper]), np.ones((300, 1)))[:, 1, 0]
    np.testing.assert_allclose(answer, (1 - np.exp(-recording.time * 3e-4 / 0.01)) / 3e-4, atol=1e-6 / 3e-4)
    step = 1e-6
    higher, lower = (
        door.machine.simulate({"A": 0.01, "B": 0.02, "k": 3e-4 + s}, recording)["upper"] for s in (step, -step)
    )
    by_k = along.response(np.array([len(door.sites)]), np.ones((300, 1)))[:, 1, 0]
    np.testing.assert_allclose(by_k, (higher - lower) / (2 * step), atol=2e-3 * np.abs(by_k).max())


def test_places_of_a_model_without_connectors(tmp_path: Path) -> None:
    case = load(cascade(tmp_path, TORRICELLI))
    amendment = Amendment(read_structure(case.library(), case.base))
    base, _ = fit_believed(case, Machine(case, amendment))
    locator = Locator(case, opened(case, amendment, case.library(), ["A", "B", "k"]), base)
    balances = {("upper", "m3/s"), ("lower", "m3/s")}
    assert {(p.location, p.unit) for p in locator.places} == {*balances, ("k", "m2/s")}
    ranked = locator.ranked()
    assert ranked[0].location == "lower" and ranked[0].gain > ranked[1].gain + 100
    assert {s.location for s in ranked} == {"upper", "lower", "k", "sensor:upper", "sensor:lower"}


def test_places_of_a_bench_and_what_is_closed() -> None:
    found = read(Library(), "Benches.DcServo")
    kinds = {s.kind for s in found.places}
    assert kinds == {"node", "edge", "branch", "equation"}
    assert any("shaft.flange_b" in s.ends for s in found.places if s.kind == "node")


def test_an_equation_that_only_names_a_rate_is_no_place(tmp_path: Path) -> None:
    """What is missing in a motion is missing in its balance; a rate that is an input is a balance."""
    file = tmp_path / "Free.mo"
    file.write_text(
        'model Free\n  input Real q(unit="m3/s");\n  Real x;\n  Real v;\n  Real h;\nequation\n  der(x) = v;\n'
        "  2*der(v) = -x;\n  der(h) = q;\nend Free;\n"
    )
    found = read(Library([str(file)]), "Free")
    assert [s.label for s in found.places] == ["2*der(v) = -x", "der(h) = q"]
    assert [label for label, _ in found.closed] == ["der(x) = v"]


def test_a_direction_that_nothing_holds_is_undetermined() -> None:
    rows = np.column_stack([np.ones(50), np.arange(50.0), 1e-9 * np.arange(50.0)])
    assert undetermined(rows.T @ rows).tolist() == [False, True, True]


@pytest.fixture(scope="module")
def torricelli(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, Path]:
    folder = tmp_path_factory.mktemp("torricelli")
    result = explain(load(cascade(folder, TORRICELLI)))
    path = write_amended(result, folder)
    judge_written(result, path)
    return json.loads(diagnosis.write(result, folder, path).read_text()), path


def test_a_law_outside_the_catalogue_is_found_where_it_is(torricelli: tuple[dict, Path]) -> None:
    told, _ = torricelli
    assert told["verdict"] == "missing_physics"
    (finding,) = told["findings"]
    assert (finding["effect"], finding["location"]) == ("unknown", "lower")
    assert told["explained"] > 0.99 and finding["confidence"] <= 0.999
    assert told["nrmse"]["validate"]["after"] < 1.1 * np.sqrt(
        np.mean([s["noise_floor"] ** 2 for s in told["per_signal"].values()])
    )
    for name, true in (("A", 0.01), ("k", 3e-4)):
        fitted = told["parameters"][name]
        assert abs(fitted["value"] - true) < 4 * fitted["std"]
    assert {p["location"] for p in told["places"]} >= {"upper", "lower", "sensor:upper"}


def test_the_amended_model_has_the_law_in_its_balance(torricelli: tuple[dict, Path]) -> None:
    _, path = torricelli
    model = Model(compile_model(str(path)).path)
    run = simulate(model, solver="dopri5", inputs={"q": RecordedInput([0.0, 1.0], [1e-4, 1e-4])}, stop=4000.0,
                   outputs=["upper", "lower"])  # fmt: skip
    assert run["lower"][-1] == pytest.approx((1e-4 / 1.9e-4) ** 2, rel=0.02)  # where the outflow equals the inflow


def test_nothing_is_found_where_nothing_is_missing(tmp_path: Path) -> None:
    result = explain(load(cascade(tmp_path, BELIEVED)))
    assert result.verdict == "consistent" and not result.findings
