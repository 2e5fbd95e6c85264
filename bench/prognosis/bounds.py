"""What no forecast can pass: forecasts that are told more than any history says, by the same filter.

*Told the law*: the part's own law and shape, the true process noise, the true lives. *Told the population*: all laws
and shapes that parts are drawn from, with their noise and lives, but not which of them a part has.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from bench.prognosis.fleet import Part
from bench.prognosis.scores import Scores
from bench.prognosis.study import walked
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.law import Law
from lacuna.analysis.prognosis.filter.settings import DEFAULT

WANDER, SCATTER, SHOCKS = 0.1, 0.02, 0.08  # of truth.py
# Lives of 20 to 120 tests, evenly in the logarithm: their median, and a spread of the same size.
TOLD = replace(
    DEFAULT, lives=(10.0, 200.0), life=49.0, life_spread=0.6, first=(0.1, 0.1), noises=((1.0, 1.0, 1.0, 0.0),),
    change=0.0,
)  # fmt: skip


def told_the_law(parts: Sequence[Part]) -> Scores:
    """Of parts whose law is one of truth.KNOWN."""
    banks = [Bank([Law.of("own", p.truth.growth, wander=WANDER, diffusion=SCATTER)], TOLD) for p in parts]
    return _joined([walked([p], bank, None).scores for p, bank in zip(parts, banks, strict=True)])


def told_the_population(parts: Sequence[Part]) -> Scores:
    bank = Bank(_population(), TOLD)
    return _joined([walked(parts[k : k + 50], bank, None).scores for k in range(0, len(parts), 50)])


def _joined(scores: Sequence[Scores]) -> Scores:
    return Scores(*(np.concatenate([getattr(s, n) for s in scores]) for n in ("truth", "said", "quantiles", "crps")))


def _population() -> list[Law]:
    """The laws of truth.py at values over the ranges that it draws from."""
    growths: dict[str, list[Callable]] = {
        "steady wear": [np.ones_like],
        "in proportion": [lambda x: x],
        "power law": [lambda x, m=m: x**m for m in (1.3, 1.5, 1.7, 1.9, 2.1)],
        "play": [lambda x, c=c: 1 + c * x for c in (1.5, 3, 6, 11)],
        "settling": [lambda x, top=top: np.maximum(1 - x / top, 0.02) for top in (1.3, 1.6, 2.2)],
        "heated winding": [
            lambda x, r=r: np.exp(11600 / 373.15 - 11600 / (373.15 + r * x)) for r in (12, 20, 30)
        ],
        "slow start": [lambda x: np.maximum((0.02 + x) * (1.6 - x), 0.02)],
        "knee": [
            lambda x, k=k, f=f: np.where(x < k, 1.0, f) for k in (0.25, 0.33, 0.42, 0.5) for f in (1.7, 2.5)
        ],
        "seasons": [np.ones_like],
        "shocks": [np.ones_like],
    }  # fmt: skip
    noise = {"shocks": {"diffusion": SHOCKS}, "seasons": {"wander": 0.3}}
    return [
        Law.of(name, growth, shape=(("number", k),), **({"wander": WANDER, "diffusion": SCATTER} | noise.get(name, {})))
        for name, shapes in growths.items()
        for k, growth in enumerate(shapes)
    ]
