"""Rough ground: when it is seen to be rough, and what is said of values there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Problem, solve
from lacuna.discovery.fit.solver.time_limit import TimeUp
from lacuna.discovery.naming import dips, screen

FREE = [Free("x", 1.0, 1.0, step=1e-3)]
BELIEVED = [Free("y", 0.0, 1.0, sigma=1.0)]
NOISE = np.random.default_rng(0).normal(size=400)


def fitted(
    function: Callable[[float], np.ndarray], free: list[Free], monkeypatch: pytest.MonkeyPatch
) -> SimpleNamespace:
    """The least-squares fit of the parameter x whose weighted residual is `function`."""
    objective = SimpleNamespace(weights=lambda level: None, weighted=lambda values, weights: function(values["x"]))
    monkeypatch.setattr(screen, "Objective", lambda *_: objective)
    start = np.array([f.centre for f in free])
    estimate = solve(Problem(free, lambda values, _: function(values["x"]), 1), start)
    machine = SimpleNamespace(case=SimpleNamespace(fit=[SimpleNamespace(name="r")]))
    return SimpleNamespace(
        estimate=estimate, machine=machine, noise={}, level={}, point=estimate.point, fixed={}, residuals={"r": {}}
    )


@pytest.mark.parametrize(
    ("function", "smooth"),
    [
        (lambda x: 10.0 * (x - 2.0) + NOISE, True),
        (lambda x: 10.0 * (x**2 - 4.0) + NOISE, True),
        (lambda x: 10.0 * (x - 2.0) + NOISE + np.sin(1e5 * x), False),  # dips of the width of 1e-2 sigma
        (lambda x: 10.0 * np.round(x - 2.0, 1) + NOISE, False),
    ],
)
@pytest.mark.parametrize("unseen", [[], BELIEVED], ids=["", "and a parameter that the data does not see"])
def test_ground_is_smooth_where_the_cost_rises_as_derivatives_say(
    function: Callable[[float], np.ndarray], smooth: bool, unseen: list[Free], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert dips.is_smooth(fitted(function, FREE + unseen, monkeypatch)) is smooth


def ends(values: list[float], deviances: list[float]) -> Iterator[SimpleNamespace]:
    for value, deviance in zip(values, deviances, strict=True):
        estimate = SimpleNamespace(free=FREE, values=np.array([value]), converged=True)
        machine = SimpleNamespace(case=SimpleNamespace(fit=[]))
        yield SimpleNamespace(
            estimate=estimate, machine=machine, noise={}, fixed={}, point={"x": value}, deviance=lambda d=deviance: d,
            sensitivities=dict,
        )  # fmt: skip


@pytest.fixture
def five_ends(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A fit that ended at 1, and where it ends when it is begun again: four ends near the best, one far above."""
    first, *others = ends([1.0, 1.3, 1.1, 0.9, 5.0, 1.2], [10.0, 9.0, 6.0, 8.0, 90.0, 7.0])
    sequence = iter(others)
    monkeypatch.setattr(dips, "fit", lambda *_, **__: next(sequence))
    monkeypatch.setattr(dips, "Fit", SimpleNamespace(deviance=lambda f: f.deviance()))
    return first


def test_the_best_end_is_taken_and_the_others_say_how_far_off_it_may_be(five_ends: SimpleNamespace) -> None:
    best, spread = dips.explored(five_ends, lambda text: None)
    assert best.estimate.values[0] == 1.1
    assert spread["x"] == pytest.approx(np.sqrt(np.mean(np.square([0.1, 0.2, 0.2, 0.1]))))


@pytest.mark.parametrize("up", [False, True], ids=["", "the time is up"])
def test_the_best_end_is_carried_on_where_its_derivatives_were_led_along(
    five_ends: SimpleNamespace, up: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    further = SimpleNamespace(estimate=SimpleNamespace(values=np.array([1.05])))

    def carried(fit: SimpleNamespace, machine: SimpleNamespace) -> SimpleNamespace:
        if up:
            raise TimeUp("the search was stopped")
        return further

    monkeypatch.setattr(dips, "carried", carried)
    led = dips.fit

    def fit(*arguments: object, **options: object) -> SimpleNamespace:
        found = led(*arguments, **options)
        found.estimate.converged = False
        return found

    monkeypatch.setattr(dips, "fit", fit)
    best, _ = dips.explored(five_ends, lambda text: None)
    assert best.estimate.values[0] == (1.1 if up else 1.05)


def test_when_time_is_up_what_was_tried_counts(five_ends: SimpleNamespace) -> None:
    calls = iter(range(2))

    def progress(text: str) -> None:
        if next(calls, None) is None:
            raise TimeUp("the search was stopped")

    best, spread = dips.explored(five_ends, progress)
    assert best.estimate.values[0] == 1.1 and spread["x"] > 0
