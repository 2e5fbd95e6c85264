"""Terms of laws: quantities that lag, on a closed form; laws that have a name."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lsim

from lacuna.discovery.efforts.places.sites import Site as Place
from lacuna.discovery.law.law import Law, Site, attach
from lacuna.discovery.law.terms.courses import lagged, swinging
from lacuna.discovery.law.terms.forms import FORMS
from lacuna.discovery.law.terms.law_terms import Group, Shape, Variable

POWER = (Shape("p", "1", 2.0, 0.1, 8.0),)
RELAXING = Group(("((x1/x1_ref) - lag((x1/x1_ref), {t}))",), (Shape("t", "s", 0.5, 0.1, 5.0),))


def law(gives: str, of: str, *groups: Group) -> Law:
    variable = Variable("x1", "body.x", of, "state", 2.0)
    return Law(Site(Place("equation", "a = b"), "body", gives, (variable,)), groups)


def test_a_ramp_behind_a_lag_is_that_ramp_late() -> None:
    time = np.sort(np.random.default_rng(3).uniform(0, 4, 200))
    tau = 0.3
    since = time - time[0]
    exact = since - tau * (1 - np.exp(-since / tau))
    np.testing.assert_allclose(lagged(time, since, tau), exact, atol=1e-12)


def test_a_lag_of_any_signal_does_not_depend_on_how_finely_it_is_sampled() -> None:
    coarse = np.linspace(0, 2, 41)
    fine = np.linspace(0, 2, 401)
    signal = np.random.default_rng(4).normal(size=41)
    whole = lagged(fine, np.interp(fine, coarse, signal), 0.2)
    np.testing.assert_allclose(lagged(coarse, signal, 0.2), whole[::10], atol=1e-12)


@pytest.mark.parametrize("z", [0.0, 0.1, 0.9])
def test_what_swings_behind_a_signal_is_its_transfer_function(z: float) -> None:
    w, time = 40.0, np.linspace(0, 2, 401)
    signal = np.random.default_rng(4).normal(size=401)
    filtered = lsim(([-2 * z, -w, 0.0] if z else [-w, 0.0], [1.0, 2 * z * w, w**2]), signal - signal[0], time)[
        1
    ]  # at rest before
    np.testing.assert_allclose(swinging(time, signal, w, z), filtered, atol=1e-9)


@pytest.mark.parametrize(
    ("gives", "of", "group", "exponent", "form"),
    [
        ("W", "K", Group(("abs(x1/x1_ref)^4",)), 0, "radiation"),
        ("W", "K", Group(("abs(x1/x1_ref)^{p}",), POWER), 4.2, "radiation"),
        ("W", "K", Group(("abs(x1/x1_ref)^{p}",), POWER), 1.3, "convection.natural"),
        ("W", "K", Group(("abs(x1/x1_ref)^{p}",), POWER), 2.0, ""),
        ("N", "m/s", Group(("sign(x1)*abs(x1/x1_ref)^{p}",), POWER), 2.0, "drag.quadratic"),
        ("N.m", "K", Group(("sign(x1)*abs(x1/x1_ref)^{p}",), POWER), 2.0, ""),
        ("m3/s", "Pa", Group(("sign(x1)*abs(x1/x1_ref)^{p}",), POWER), 0.5, "leakage.turbulent"),
        ("A", "V", Group(("exp({q}*(x1/x1_ref))",), (Shape("q", "1", 2.0, 0.1, 8.0),)), 0, "diode"),
        ("W", "K", RELAXING, 0, "relaxation"),
        ("N.m", "rad/s", Group(("swing((x1/x1_ref), {q}, 0.1)", "(x1/x1_ref)"), POWER), 1.0, "compliance"),
    ],
)  # fmt: skip
def test_a_law_of_known_form_bears_its_name_in_its_domain_alone(
    gives: str, of: str, group: Group, exponent: float, form: str
) -> None:
    alone, beside = law(gives, of, group), law(gives, of, Group(("1",)), group)
    shapes = {"q": 1.0, "t": 0.5} | ({"p": exponent} if exponent else {})
    assert alone.form({f"{n}_1": v for n, v in shapes.items()}) == form
    assert beside.form({f"{n}_2": v for n, v in shapes.items()}) == form


def test_what_lags_becomes_a_state_of_the_law_once() -> None:
    twice = Group(("((x1/x1_ref) - lag((x1/x1_ref), {t}))", "lag((x1/x1_ref), {t})"), RELAXING.shapes)
    source = attach(law("W", "K", twice)).definition
    assert source.count("Real lagged_1") == 1
    assert "lagged_2" not in source
    assert "t_1*der(lagged_1) = (x1/x1_ref) - lagged_1;" in source
    assert "lagged_1 = (x1/x1_ref);" in source.partition("initial equation")[2].partition("\nequation")[0]


def test_what_swings_becomes_two_states_of_the_law() -> None:
    source = attach(law("N.m", "rad/s", Group(("swing((x1/x1_ref), 40, 0.1)",)))).definition
    assert "swing_1 = stretch_swing_1 + 2*0.1*(behind_swing_1 - (x1/x1_ref));" in source
    assert "der(stretch_swing_1) = 40*(behind_swing_1 - (x1/x1_ref));" in source
    assert "der(behind_swing_1) = -40*swing_1;" in source
    assert "effort = noEvent(c_1*swing_1);" in source


def test_a_law_pays_for_having_been_picked_and_a_known_form_pays_least() -> None:
    """A two-part code: ln of how many laws there are of each kind; a constant is a known one."""
    variables = tuple(Variable(f"x{k}", f"body.T{k}", "K", "state", 300.0) for k in (1, 2))
    place = Site(Place("equation", "a = b"), "body", "W", variables, (60, 40))

    def pick(*texts: str) -> float:
        return Law(place, tuple(Group((text,)) for text in texts)).pick()

    known = 2 * sum(f.gives in (("W",), ("",)) and not f.commanded for f in FORMS)
    assert pick("1") == pick("abs(x1/x1_ref)^4") == pytest.approx(np.log(3 * (1 + known)))
    assert pick("abs(x1/x1_ref)^5") == pytest.approx(np.log(3 * 60))
    assert pick("(x1/x1_ref)*(x2/x2_ref)") == pytest.approx(np.log(3 * 40))
    assert pick("abs(x1/x1_ref)^5", "(x1/x1_ref)*(x2/x2_ref)") == pytest.approx(np.log(3 * 60) + np.log(3 * 40))


@pytest.mark.parametrize(("gives", "of", "turns", "alike"), [
    ("N", "m/s", False, ("friction.coulomb", "body.x")), ("N", "m/s", True, ("", "")), ("W", "K", False, ("", "")),
])  # fmt: skip
def test_a_level_is_not_told_from_dry_friction_of_what_never_turns(
    gives: str, of: str, turns: bool, alike: tuple[str, str]
) -> None:
    speed = Variable("x1", "body.x", of, "state", 2.0, sticks=True, turns=turns)
    place = Site(Place("equation", "a = b"), "body", gives, (speed,))
    assert attach(Law(place, (Group(("1",)),))).alike == alike
    assert attach(Law(place, (Group((speed.scaled,)),))).alike == ("", "")


BOTH_WAYS = (Shape("q", "1", 0.1, 0.01, 0.99),)
LOST = Group(("(abs((x1/x1_ref) + {q}) - abs((x1/x1_ref) - {q}))",), BOTH_WAYS)
BEYOND = Group(("((x1/x1_ref) - 0.5*abs((x1/x1_ref) + {q}) + 0.5*abs((x1/x1_ref) - {q}))",), BOTH_WAYS)


@pytest.mark.parametrize(
    ("gives", "kind", "group", "form"),
    [
        ("V", "input", LOST, "drive.deadband"), ("V", "input", BEYOND, "drive.saturation"),
        ("V", "state", LOST, ""), ("A", "input", LOST, ""),
    ],
)  # fmt: skip
def test_a_command_that_is_lost_in_part_is_a_drive_s(gives: str, kind: str, group: Group, form: str) -> None:
    variable = Variable("x1", "u", "V", kind, 2.0)
    assert Law(Site(Place("input", "u"), "u", gives, (variable,)), (group,)).form({"q_1": 0.1}) == form
