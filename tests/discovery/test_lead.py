"""Where a fit is held while hypotheses are compared: stiffly enough to be linear, and where something shows."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit import lead as leading
from lacuna.discovery.fit.fit import FALLING, believed, falling_bandwidths, fit, linearised
from lacuna.discovery.fit.lead import BELIEVABLE, HELD, SHARES, Lead
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.secants import solver_shift
from lacuna.discovery.fit.tracking import trackable
from lacuna.discovery.naming.name import screen_all
from lacuna.discovery.steps import STIFFLY

from .conftest import BELIEVED, attachment, conceal


@pytest.fixture(scope="module")
def cogging_case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    cogging = "CoggingTorque(amplitude=0.012, periods=8, phase=0.3)"
    return conceal(tmp_path_factory.mktemp("cogging"), BELIEVED | {"R": 3.45}, cogging=cogging)


def tracked(folder: Path) -> tuple[Case, Machine]:
    """A case, and its believed machine with a tracker on its shaft."""
    case = load(folder)
    structure = read(Library(), case.model)
    shafts = trackable(case, Machine(case, Amendment(structure)).model, structure)[:1]
    return case, Machine(case, Amendment(structure, trackers=shafts))


@pytest.mark.parametrize(("shares", "held", "seen"), [(STIFFLY, 1, True), (FALLING, HELD, False)])
def test_the_periods_of_a_strong_cogging_show_where_the_shaft_is_held_stiffly(
    cogging_case: Path, shares: tuple[float, ...], held: int, seen: bool
) -> None:
    """Its wells, amplitude times periods, are 0.096 N.m/rad deep; a tracker of J w^2 has to be stiffer than they."""
    case, machine = tracked(cogging_case)
    lead = Lead(falling_bandwidths(case, machine, shares), held=held)
    assert (BELIEVED["J"] * lead.bandwidths[held] ** 2 > 0.096) == seen
    free, fixed = believed(case, machine)
    base = lead.hold(fit(machine, case.fit, noise_of(case), free, fixed, stages=1, iterations=0))
    cogging = attachment(case, "CoggingTorque")
    best = screen_all(case, machine.amendment, [cogging], base, lambda text: None)[0][0]
    right = best.fixed[cogging.full_name("periods")] == 8 and best.predicted > 0.3
    assert right == seen


def test_parameters_stay_near_belief_while_a_shaft_is_held(cogging_case: Path) -> None:
    """A machine that says nothing follows its held shaft best: what is missing would end in absurd parameters."""
    case, machine = tracked(cogging_case)
    free, fixed = believed(case, machine)
    own = next(f for f in free if f.name == "R")
    base = linearised(machine, case.fit, noise_of(case), free, fixed, {})
    far = base.point | {"R": own.centre + 12 * own.sigma}
    elsewhere = linearised(machine, case.fit, noise_of(case), free, fixed, far)
    for fitted, reach in ((base, BELIEVABLE), (elsewhere, 12.0)):  # a fit that has left belief may stay where it is
        free_held = Lead(falling_bandwidths(case, machine)).hold(fitted).estimate.free
        held = next(f for f in free_held if f.name == "R")
        assert held.upper == pytest.approx(own.centre + reach * own.sigma)
        assert held.lower == pytest.approx(max(own.centre - reach * own.sigma, own.lower))


@pytest.mark.parametrize(
    ("levels", "chosen"),
    [
        ((1.0, 1.0, 9.0, 9.0), 0.08),  # what is missing shows with the third share only
        ((1.0, 1.6, 9.0), 0.04),  # it shows before the motion has run away
        ((1.0,) * len(SHARES), 1.0),
    ],
)
def test_a_fit_that_grows_is_held_where_something_is_seen_to_be_missing(
    consistent_case: Path, monkeypatch: pytest.MonkeyPatch, levels: tuple[float, ...], chosen: float
) -> None:
    case = load(consistent_case)
    estimate = SimpleNamespace(free=[])
    left = iter(levels)

    def machine_of(case: Case) -> SimpleNamespace:
        return SimpleNamespace(case=case, amendment=None, amended=lambda amendment, case: machine_of(case))

    def fit_of(machine, *rest, **options) -> SimpleNamespace:
        return SimpleNamespace(machine=machine, level={"i": next(left)}, point={})

    monkeypatch.setattr(leading, "fit", fit_of)
    whole = SimpleNamespace(machine=machine_of(case), estimate=estimate, point={}, noise={}, fixed={})
    held = Lead(grows=True).hold(whole)
    assert len(held.machine.case.fit[0].time) == int(chosen * len(case.fit[0].time))


def test_a_fit_of_a_held_shaft_has_errors(cogging_case: Path) -> None:
    """Its Jacobian is of the recorded outputs: the motion that the shaft is held to is no recording of its own."""
    case, machine = tracked(cogging_case)
    free, fixed = believed(case, machine)
    base = fit(machine, case.fit, noise_of(case), free, fixed, stages=1, iterations=0)
    held = leading._tracked(base, falling_bandwidths(case, machine)[0])
    assert np.all(np.isfinite(solver_shift(held)))
