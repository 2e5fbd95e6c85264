"""Unknown efforts: linearisation, smoother, regression on closed forms; places; a law, from case to verdict."""

from __future__ import annotations

from dataclasses import replace
import json
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import block_diag

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.chains import Colour, Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.smoother import Whitener, courses
from lacuna.discovery.efforts.latent.thinned import thinned
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


def piece(n: int, missing: int = 0, scale: float = 1.0) -> Piece:
    """A random stable linear model of two states, two outputs and two columns; `missing` readings are left out."""
    random = np.random.default_rng(11 + n)
    along = Along(
        np.cumsum(random.uniform(0.5, 1.5, n)),
        0.8 * np.eye(2) + 0.1 * random.normal(size=(n - 1, 2, 2)),
        random.normal(size=(n - 1, 2, 2)),
        scale * random.normal(size=(n, 2, 2)),
        scale * random.normal(size=(n, 2, 2)),
        *(np.zeros((n, 2, 2)), np.zeros((2, 2), dtype=bool)),
        {},
    )
    data = scale * random.normal(size=(n, 2, 3))
    for k in random.choice(n, missing, replace=False):
        data[k, k % 2] = np.nan
    return Piece(along, data, scale * np.array([0.3, 0.7]), np.array([0.2, 0.0]))


def dense(p: Piece, latent: Latent) -> tuple[np.ndarray, np.ndarray]:
    """(covariance of the readings seen, that of the effort with them) by the definition, without any recursion."""
    apart = np.abs(np.subtract.outer(p.along.time, p.along.time))
    effort = latent.size[0] ** 2 * np.exp(-apart / latent.time[0])
    start, free = np.zeros((len(apart), 2, 2)), np.eye(2)
    for k in range(len(apart)):
        start[k] = p.along.read[k] @ free
        free = p.along.step[k] @ free if k < len(apart) - 1 else free
    seen = np.isfinite(p.data).all(axis=2)
    every, s = [answers(p, c)[seen] for c in latent.column[0]], start[seen]
    g = every[0]
    noise = np.broadcast_to(p.noise, seen.shape)[seen]
    cover = sum(g @ effort @ g.T for g in every) + s @ np.diag(p.start**2) @ s.T + np.diag(noise**2)
    when, output = np.nonzero(seen)
    apart = np.abs(np.subtract.outer(p.along.time[when], p.along.time[when]))
    own = latent.colour
    for sensor, size, time in zip(own.sensor, own.size[0], own.time[0], strict=True) if own else ():
        both = np.outer(output == sensor, output == sensor)
        cover += both * size**2 * np.exp(-apart / time)
    for j, column in enumerate(own.column if own and own.column is not None else ()):
        if column >= 0:
            other = answers(p, column)[seen]
            between = np.abs(np.subtract.outer(p.along.time, p.along.time))
            cover += own.size[0, j] ** 2 * other @ np.exp(-between / own.time[0, j]) @ other.T
    return cover, effort @ g.T


def answers(p: Piece, column: int) -> np.ndarray:
    """(n, y, n): readings to an effort in a column that is one at a single sample."""
    n = len(p.along.time)
    answer, state = np.zeros((n, 2, n)), np.zeros((2, n))
    for k in range(n):
        unit = np.eye(n)[k]
        answer[k] = p.along.read[k] @ state + np.outer(p.along.feed[k][:, column], unit)
        if k < n - 1:
            state = p.along.step[k] @ state + np.outer(p.along.drive[k][:, column], unit)
    return answer


LATENT = Latent(np.array([[1]]), np.array([-1]), np.array([0.8]), np.array([3.0]))
COLOUR = Colour(np.array([1, 0, 1]), np.array([[0.5, 0.2, 1.1]]), np.array([[2.0, 0.7, 40.0]]))
BOTH = replace(LATENT, column=np.array([[1, 0]]), colour=COLOUR)
TWO = replace(LATENT, colour=COLOUR.beside(Latent(np.array([[0]]), np.array([-1]), np.array([0.6]), np.array([5.0]))))


@pytest.mark.parametrize(
    "latent",
    [LATENT, replace(LATENT, colour=COLOUR), TWO, BOTH],
    ids=["white", "coloured", "beside another effort", "at two places, coloured"],
)
def test_the_smoother_equals_one_dense_solve(latent: Latent) -> None:
    pieces = [piece(30, missing=7), piece(21)]
    parts = [dense(p, latent) for p in pieces]
    rows = np.concatenate([p.data[np.isfinite(p.data).all(axis=2)] for p in pieces])
    noise = np.concatenate(
        [np.broadcast_to(p.noise, p.data.shape[:2])[np.isfinite(p.data).all(axis=2)] for p in pieces]
    )
    cover, residual, answers = block_diag(*(c for c, _ in parts)), rows[:, 0], -rows[:, 1:]
    whole = cover + answers @ answers.T
    log = -0.5 * (residual @ np.linalg.solve(whole, residual) + np.linalg.slogdet(whole)[1] - 2 * np.log(noise).sum())
    found = evidence(pieces, latent)
    assert found.log[0] == pytest.approx(log, rel=1e-9)
    mean = answers.T @ np.linalg.solve(whole, residual)
    np.testing.assert_allclose(found.mean[0], mean, rtol=1e-9)
    at = 0
    for (effort, error), (c, crossed) in zip(courses(pieces, latent, mean), parts, strict=True):
        left = (residual - answers @ mean)[at : at + len(c)]
        np.testing.assert_allclose(effort, crossed @ np.linalg.solve(c, left), rtol=1e-8, atol=1e-10)
        variance = latent.size[0] ** 2 - np.sum(crossed * np.linalg.solve(c, crossed.T).T, axis=1)
        np.testing.assert_allclose(error**2, variance, rtol=1e-7)
        at += len(c)


def test_hypotheses_of_several_widths_side_by_side_are_each_by_itself() -> None:
    none = Latent(np.array([[-1]]), np.array([1]), np.array([0.4]), np.array([2.0]))
    alone = [LATENT, BOTH.of([0]), none]
    alone = [replace(x, colour=COLOUR) for x in alone]
    column = np.array([[1, -1], [1, 0], [-1, -1]])
    fields = (np.concatenate([getattr(x, f) for x in alone]) for f in ("sensor", "size", "time"))
    beside = Latent(column, *fields, COLOUR.of([0, 0, 0]))
    pieces = [piece(30, missing=7), piece(21)]
    np.testing.assert_allclose(evidence(pieces, beside).log, [evidence(pieces, x).log[0] for x in alone], rtol=1e-12)


def test_whitened_columns_make_the_dense_gram_matrix() -> None:
    p = piece(25, missing=5)
    cover, _ = dense(p, LATENT)
    rows = p.data[np.isfinite(p.data).all(axis=2)]
    white = Whitener([p], LATENT)([p.data])
    np.testing.assert_allclose(white.T @ white, rows.T @ np.linalg.solve(cover, rows), rtol=1e-9)


def test_other_units_and_readings_at_other_rates_change_nothing() -> None:
    """Outputs in thousandths; and an output that is read at every third sample only, with or without its empty rows."""
    assert evidence([piece(30, 4, 1e3)], LATENT).log == pytest.approx(evidence([piece(30, 4)], LATENT).log, rel=1e-9)
    sparse = piece(30)
    sparse.data[np.arange(30) % 3 != 0, 1] = np.nan
    cover, _ = dense(sparse, LATENT)
    assert len(cover) == 40
    rows = sparse.data[np.isfinite(sparse.data).all(axis=2)]
    white = Whitener([sparse], LATENT)([sparse.data])
    np.testing.assert_allclose(white.T @ white, rows.T @ np.linalg.solve(cover, rows), rtol=1e-9)


def test_a_model_without_states_is_thinned_too() -> None:
    """As a device whose motion is imposed: its readings follow the effort at once."""
    p, none = piece(7), np.zeros((7, 0, 0))
    still = replace(p.along, step=none, drive=np.zeros((7, 0, 2)), read=np.zeros((7, 2, 0)))
    thin = thinned(replace(p, along=still, start=np.zeros(0)), 3)
    np.testing.assert_array_equal(thin.data, p.data[::3])
    assert thin.along.step.shape == (2, 0, 0)


def test_an_effort_of_no_size_is_none() -> None:
    none = Latent(np.array([[-1]]), np.array([-1]), np.array([0.0]), np.array([1.0]))
    p = piece(12)
    p.start[:] = 0.0
    p.data = p.data[:, :, :1]
    assert evidence([p], none).log[0] == pytest.approx(-0.5 * np.sum((p.data[:, :, 0] / p.noise) ** 2), rel=1e-12)


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
