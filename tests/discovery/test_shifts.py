"""Signals that are shifted in time against the model's, and what only looks so."""

from __future__ import annotations

import numpy as np

from lacuna.discovery import semantic_check


def test_what_swings_further_than_the_model_is_not_what_came_a_period_earlier() -> None:
    """It dies out: a period earlier it was larger, too."""
    time = np.linspace(0, 10, 2000)
    swing = np.exp(-0.2 * time) * np.sin(2 * np.pi * time)
    _, gain = semantic_check._lag(1.22 * swing, swing)
    assert gain < 0.1
    lag, gain = semantic_check._lag(np.concatenate([np.zeros(30), swing[:-30]]), swing)
    assert lag == 30 and gain > 0.9
