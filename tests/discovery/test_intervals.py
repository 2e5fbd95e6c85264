"""Standard errors against the scatter of estimates from data that are made many times."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.noise import Noise, last_digit, sample_weights
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit.fit import fit
from lacuna.discovery.fit.intervals import covariance, from_bound, narrowed
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.secants import input_shift
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Estimate, Problem, solve

from .conftest import BELIEVED, write_case

CYCLE = 9.3 * (1.0 + np.sin(2 * np.pi * np.arange(20) / 20))
PERIODIC = np.tile(CYCLE, 30)  # the same angles, and their rounding, again and again
UNSTEADY = PERIODIC * (1.0 + 0.3 * np.sin(0.01 * np.arange(600)))


def fitted(measured: np.ndarray, shape: np.ndarray, noise: Noise) -> SimpleNamespace:
    """The fit of the angle's factor, `slope`, to a recorded angle."""
    weights = sample_weights(measured, noise)
    free = [Free("slope", 1.0, 0.1), Free("unseen", 0.0, 1.0)]
    problem = Problem(free, lambda values, _: (measured - values["slope"] * shape) * weights / noise.std, 1)
    estimate = solve(problem)
    residual = {"angle": measured - estimate["slope"] * shape}
    return SimpleNamespace(
        estimate=estimate, noise={"angle": noise}, level={"angle": 1.0}, weights={"r": {"angle": weights}},
        residuals={"r": residual}, correlation=lambda: {"angle": 1.0},
        machine=SimpleNamespace(case=SimpleNamespace(fit=[SimpleNamespace(name="r", columns={"angle": measured})])),
    )  # fmt: skip


@pytest.mark.parametrize("pushed", [0.0, 0.8, 5.0])  # by how many sigmas the data lies beyond the bound
def test_at_a_bound_one_sigma_is_where_the_cost_has_risen_by_one(pushed: float) -> None:
    """The cost of the best line with a slope that far inside is one more, whatever pushes the slope to its bound."""
    x = np.linspace(0.0, 1.0, 400)
    sigma = 1.0 / np.sqrt(np.sum((x - x.mean()) ** 2))
    y = 3.0 + pushed * sigma * x

    def best(slope: Free) -> Estimate:
        problem = Problem([Free("level", 0.0, 1.0), slope], lambda v, _: y - v["level"] - v["slope"] * x, 1)
        return solve(problem, tolerance=1e-12)

    here = best(Free("slope", -0.1, 0.3, upper=0.0))
    assert here.at_bound("slope")
    inside = from_bound(SimpleNamespace(estimate=here, inflation=lambda: 1.0), 1)
    there = best(Free("slope", -inside, 0.3, lower=-inside, upper=-inside))
    assert there.cost - here.cost == pytest.approx(1.0, rel=1e-3)
    held = replace(here, jacobian=[np.vstack([b, np.ones((7, b.shape[1]))]) for b in here.jacobian])
    assert from_bound(SimpleNamespace(estimate=held, inflation=lambda: 1.0), 1) == inside  # as a held shaft adds rows


def test_the_last_digit_of_a_column_is_that_of_its_recordings_together() -> None:
    fine, coarse = np.round(np.sin(np.arange(500.0)), 5), np.tile([0.0, 0.04, -0.04], 100)
    assert last_digit([coarse, fine]) == pytest.approx(1e-5)
    assert last_digit([coarse]) == 0.0  # a command of few levels is given exactly
    assert last_digit([fine * np.pi]) == 0.0 and last_digit([np.round(np.sin(np.arange(500.0)), 8)]) == 0.0


def test_digits_of_an_input_that_are_not_written_widen_the_intervals(tmp_path: Path) -> None:
    """The scatter of estimates over the digits that a voltage may have had is what the intervals allow for."""
    case = load(write_case(tmp_path, "Benches.DcServo", BELIEVED))
    exact = [r.columns["u"] for r in case.fit]
    for recording, u in zip(case.fit, exact, strict=True):
        recording.columns["u"] = np.round(u, 2)
    found, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    said = input_shift(found)
    moved, random = [], np.random.default_rng(7)
    for _ in range(12):
        for recording, u in zip(case.fit, exact, strict=True):
            recording.columns["u"] = np.round(u + random.uniform(-0.005, 0.005, len(u)), 2)
        machine = Machine(case, found.machine.amendment)
        again = fit(machine, case.fit, found.noise, found.estimate.free, found.fixed, start=found.point)
        moved.append(again.estimate.values)
    scatter = np.std(moved, axis=0)
    assert np.all(said > 0.5 * scatter) and np.all(said < 2.0 * scatter)


@pytest.mark.parametrize(("shape", "repeats"), [(UNSTEADY, False), (PERIODIC, True)], ids=["unsteady", "periodic"])
def test_rounding_that_repeats_widens_an_interval(shape: np.ndarray, repeats: bool) -> None:
    """An encoder's levels lie anywhere: so do the estimates, and their scatter is the standard error."""
    noise = Noise(1.0 / np.sqrt(12), 1.0, True)
    fits = [fitted(np.round(shape + place) - place, shape, noise) for place in np.random.default_rng(0).random(400)]
    scatter = float(np.sqrt(np.mean([(f.estimate["slope"] - 1.0) ** 2 for f in fits])))
    errors = np.array([np.sqrt(np.diag(covariance(f))) for f in fits])
    said = errors[:, 0]
    as_noise = np.array([f.estimate.normal[0, 0] ** -0.5 * f.estimate.free[0].scale for f in fits])
    assert 0.8 < np.median(said) / scatter < 1.5  # the larger of what rounding gives and of what white noise would
    assert np.all(errors[:, 1] == 0.0)  # unseen
    assert bool(np.median(as_noise) < 0.5 * scatter) is repeats


def test_what_the_data_does_not_tell_within_its_bounds_widens_nothing() -> None:
    """A stop beyond the motion moves the outputs by rounding: a pseudo-inverse in the parameters' own scales left it
    with an error of 1e-11, and one in units of what they do lent its rounding to the others."""
    noise = Noise(1.0, 0.1, False)
    found = fitted(UNSTEADY + np.random.default_rng(0).normal(0.0, 1.0, 600), UNSTEADY, noise)
    alone = np.sqrt(covariance(found)[0, 0])
    slope = found.estimate.jacobian[0][:, 0]
    block = np.column_stack([slope, 1e-13 * (slope + 0.01 * np.random.default_rng(1).normal(0.0, 1.0, 600))])
    free = [found.estimate.free[0], Free("far", -5.0, 1.0, lower=-1e3, upper=0.0)]
    found.estimate = replace(found.estimate, free=free, jacobian=[block], normal=block.T @ block)
    assert list(narrowed(found)) == [True, False]
    assert np.sqrt(covariance(found)[0, 0]) == pytest.approx(alone)
    free[1] = replace(free[1], lower=-np.inf)
    assert list(narrowed(found)) == [True, True]  # of nothing known, this is more
