"""A wrong name is answered with the nearest right one, and with some that there are where none is near."""

from __future__ import annotations

import pytest

from lacuna.suggest import suggestion

NAMES = ["R", "L", "winding.R", "winding.hall.theta_e", "stops.phi_max", "stops.phi_min", "J"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("phi_mx", "; did you mean stops.phi_max or stops.phi_min?"),
        ("theta", "; did you mean winding.hall.theta_e?"),
        ("motor.R", "; did you mean R or winding.R"),
        ("Winding.hall.thetae", "; did you mean winding.hall.theta_e"),
    ],
)
def test_the_nearest_comes_first(name: str, expected: str) -> None:
    assert suggestion(name, NAMES).startswith(expected)


def test_where_nothing_is_near_some_are_listed() -> None:
    assert suggestion("zzz", NAMES) == "; there are R, L, winding.R, winding.hall.theta_e, stops.phi_max and 2 more"
    assert suggestion("zzz", ["J"]) == "; there is J"
    assert suggestion("zzz", []) == "; there is none"
