"""Numbers in a report's sentences and tables."""

from __future__ import annotations

import pytest

from lacuna.discovery.explanation.wording import HALF_WIDTH, in_a_sentence, rounded, with_error


@pytest.mark.parametrize(
    ("value", "std", "whole", "alone"),
    [
        (3.704, 0.38 / HALF_WIDTH, "3.70 \u00b1 0.38", "3.70"),
        (7.764e-6, 0.96e-6 / HALF_WIDTH, "(7.76 \u00b1 0.96)e-6", "7.76e-6"),
        (-5.93e-5, 0.62e-5 / HALF_WIDTH, "(-5.93 \u00b1 0.62)e-5", "-5.93e-5"),
        (2.5, None, "2.5 (not determined)", "2.5 (not determined)"),
        (0.25, 0.0, "0.25", "0.25"),
    ],
)
def test_a_value_with_its_interval_and_alone(value: float, std: float | None, whole: str, alone: str) -> None:
    assert with_error(value, std) == whole
    assert rounded(value, std) == alone


def test_a_title_with_a_colon_is_told_in_brackets_inside_a_sentence() -> None:
    assert (
        in_a_sentence("Dry friction: constant level, sticks at rest") == "dry friction (constant level, sticks at rest)"
    )
    assert in_a_sentence("Backlash") == "backlash"
