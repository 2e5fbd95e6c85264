"""Histories of parts whose law is written here in closed form."""

from __future__ import annotations

import numpy as np

from lacuna.analysis.prognosis.filter.law import Law
from lacuna.analysis.prognosis.forecast import Limits
from lacuna.analysis.prognosis.history import History

LIMITS = Limits(("orange", "red", "violet"), (0.11, 0.27, 0.34), 0.0, 0.5)

LAWS = [
    Law.of("linear", lambda x: 1 + 0 * x),
    Law.of("exponential", lambda x: x),
    Law.of("crack", lambda x: x**2, shape=(("m", 2.0),)),
    Law.of("friction", lambda x: np.maximum(1 - x / 1.2, 0), shape=(("level", 1.2),)),
]


def linear(n, life=5000.0):
    return 0.02 + 0.32 * n / life


def exponential(n, life=5000.0):
    return 0.02 * np.exp(np.log(17) * n / life)


def history(truth, use, *, sd=0.004, seed=0, outliers=(), replaced=(), actuator="A", unit="cycles") -> History:
    """Tests of `truth(use)` with Gaussian errors and their 95 % intervals, cut at the map's edges."""
    random, use = np.random.default_rng(seed), np.asarray(use, dtype=float)
    severity = truth(use) + sd * random.standard_normal(len(use))
    for k, value in dict(outliers).items():
        severity[k] = value
    severity = np.clip(severity, 0, 0.5)
    low, high = np.clip(severity - 1.96 * sd, 0, 0.5), np.clip(severity + 1.96 * sd, 0, 0.5)
    return History(actuator, unit, use, severity, low, high, np.isin(np.arange(len(use)), replaced))
