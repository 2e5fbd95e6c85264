"""How a fit is led: where it stops, and where it begins once trackers let go."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit import fit as fitting
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import anneal, noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Problem


class OneSignal:
    """An objective of one signal whose residual is `function` of the parameter x; tracked, it draws x to `held`."""

    def __init__(self, function: Callable[[float], np.ndarray | None], held: float = 0.0):
        self.function, self.held, self.noise = function, held, {"y": 1.0}
        self.stiffness: dict[str, float] = {}

    def __call__(self, values: dict[str, float], piece: int) -> np.ndarray | None:
        x = values["x"]
        return np.full(4, x - self.held) if self.stiffness else self.function(x)

    def measure(self, parts: list[np.ndarray]) -> dict[str, float]:
        return {"y": float(np.sqrt(np.mean(parts[0] ** 2)))}

    def weights(self, level: Mapping[str, float]) -> list[np.ndarray]:
        return [np.full(4, 1 / level["y"])]

    def track(self, bandwidth: float, parameters: Mapping[str, float]) -> None:
        self.stiffness = {"c": bandwidth} if bandwidth else {}


def problem(objective: OneSignal) -> Problem:
    return Problem([Free("x", 1.0, 1.0, step=1e-3)], objective, 1)


def test_a_stage_that_led_nowhere_is_not_repeated() -> None:
    """At a corner every step is uphill, though the derivative promises much: neither converged nor ever to be."""
    rough = OneSignal(lambda x: 5.0 + 100.0 * np.abs(x) * np.ones(4))
    trial = problem(rough)
    found, level = anneal(rough, trial, np.array([0.0]))
    assert found.values[0] == 0.0 and not found.converged and level == {"y": 5.0}
    one_stage = 1 + 1 + 8  # where it is; a derivative, which is good for the end, too; steps that are tried
    assert trial.simulations == one_stage


def test_a_stage_that_only_leads_takes_no_derivative_to_be_sure_of_its_end() -> None:
    objective = OneSignal(lambda x: np.full(4, x), held=3.0)
    objective.track(8.0, {})
    trial = problem(objective)
    found, _ = anneal(objective, trial, np.array([1.0]))
    assert found.values[0] == pytest.approx(3.0, abs=1e-3)
    where, derivative, step = 1, 1, 1
    assert trial.simulations == where + derivative + step


def test_a_fit_goes_on_below_the_noise_while_it_wins() -> None:
    """A residual that is smaller than its noise all along says nothing of where the fit ends: steps of one unit."""
    crawling = OneSignal(lambda x: 0.9 * np.exp(-x) * np.ones(400))
    crawling.weights = lambda level: [np.full(400, 1 / level["y"])]
    trial = problem(crawling)
    found, level = anneal(crawling, trial, np.array([0.0]), iterations=1)
    assert level == {"y": 1.0} and not found.converged
    assert found.values[0] > 2.5  # where the next step wins less than one of the cost: 324 exp(-2x)
    assert found.iterations == 1


def test_a_start_that_cannot_run_gives_way_to_the_last_one_that_was_tracked(monkeypatch: pytest.MonkeyPatch) -> None:
    objective = OneSignal(lambda x: None if x > 5.0 else np.full(4, 3.0 * (x - 2.0)), held=1.9)
    monkeypatch.setattr(fitting, "_extrapolated", lambda *_: np.array([6.0]))
    found, _ = fitting._led(objective, problem(objective), np.array([1.0]), (8.0, 4.0, 0.0), {}, 10, 4)
    assert found.values[0] == pytest.approx(2.0, abs=1e-3)


def test_what_a_fit_leaves_is_what_its_model_leaves_when_it_is_run(consistent_case: Path) -> None:
    """Residuals are those that the fit has seen, in SI again; missing samples stay missing."""
    case = load(consistent_case)
    case.fit[0].columns["i"][7] = np.nan
    machine = Machine(case, Amendment(read(Library(), case.model)))
    free, fixed = fitting.believed(case, machine)
    found = fitting.fit(machine, case.fit, noise_of(case), free, fixed)
    again = fitting.residuals_of(machine, case.fit, found.point)
    for name, columns in again.items():
        for column, expected in columns.items():
            np.testing.assert_allclose(found.residuals[name][column], expected, rtol=1e-9, atol=1e-12)
    assert np.isnan(found.residuals["r1.csv"]["i"][7])
    for _ in range(3):
        found = found if found.settled else fitting.carried(found, machine)
    assert found.settled
    assert abs(fitting.carried(found, machine).deviance() - found.deviance()) < 1.0
    begun = fitting.fit(machine, case.fit, noise_of(case), free, fixed, stages=1, iterations=0)
    assert not begun.settled


def test_a_residual_whose_square_is_no_number_is_a_failed_simulation() -> None:
    """Steps into where the machine runs away, to values that are finite, are taken back as failed ones are."""
    runaway = OneSignal(lambda x: np.full(4, 1e200 if x > 1.5 else 3.0 * (x - 2.0)))
    trial = problem(runaway)
    assert trial.evaluate(np.array([2.0])) is None
    found, level = anneal(runaway, trial, np.array([0.0]))
    assert 0.5 < found.values[0] <= 1.5 and np.isfinite(found.cost) and level["y"] < 6.0
