"""Which variable organises an effort: the one whose value tells it best, or orders of an angle.

The measure is the share of the effort's variance: between bins of a variable (correlation ratio, K. Pearson 1905), or
in the strongest orders of an angle, multiples of which repeat in each turn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

BINS = 25  # of a variable: each holds dozens of samples of the shortest recording
ORDERS = 48  # of an angle, that are looked at
STRONGEST = 3  # orders that together may organise an effort
TURNS = 2.0  # that an angle has to make before its orders can be told from its value
FAINT = 0.05  # share below which nothing organises an effort
SIMPLER = 0.9  # of the share of a speed, from which its sign is said to organise the effort


@dataclass
class Organiser:
    """A variable and the share (0 to 1) of the effort's variance that it tells; the effort over it.

    `centres` and `means` (bins,) are the effort's course over the variable; of an angle's orders, they are the orders
    and the amplitudes.
    """

    variable: str
    unit: str
    share: float
    centres: np.ndarray
    means: np.ndarray
    kind: str = "value"  # of the variable: value | sign | orders

    @property
    def sentence(self) -> str:
        name = self.variable if self.kind == "value" else f"the {self.kind} of {self.variable}"
        if self.share < FAINT:
            return "no variable organises it"
        return f"it follows {name} best ({self.share:.0%} of its variance)"


def organiser(effort: np.ndarray, variables: Mapping[str, tuple[str, np.ndarray]], angles: set[str]) -> Organiser:
    """The best organiser of an effort (n,) among variables, name -> (unit, values (n,)); `angles` may have orders."""
    found = [_by_value(effort, name, unit, values) for name, (unit, values) in variables.items()]
    turning = [n for n in angles if np.ptp(variables[n][1]) > TURNS * 2 * np.pi]
    found += [_by_orders(effort, name, variables[name][1]) for name in turning]
    best = max(found, key=lambda o: o.share)
    unit, values = variables[best.variable]
    if unit in ("rad/s", "m/s"):
        sign = replace(_by_value(effort, best.variable, "1", np.sign(values)), kind="sign")
        return sign if sign.share > SIMPLER * best.share else best
    return best


def _by_value(effort: np.ndarray, name: str, unit: str, values: np.ndarray) -> Organiser:
    """The effort in bins of equal counts; a variable of few values has a bin for each."""
    edges = np.unique(np.quantile(values, np.linspace(0, 1, BINS + 1)))
    edges = np.unique(values) if len(np.unique(values)) <= BINS else edges[:-1]
    index = np.searchsorted(edges, values, side="right") - 1
    counts = np.maximum(np.bincount(index, minlength=len(edges)), 1)
    means = np.bincount(index, effort, len(edges)) / counts
    centres = np.bincount(index, values, len(edges)) / counts
    between = float(np.sum(counts * (means - effort.mean()) ** 2))
    total = float(np.sum((effort - effort.mean()) ** 2))
    return Organiser(name, unit, between / total if total > 0 else 0.0, centres, means)


def _by_orders(effort: np.ndarray, name: str, angle: np.ndarray) -> Organiser:
    """The effort's amplitude at each whole number of periods a turn."""
    orders = np.arange(1, ORDERS + 1)
    varying = effort - effort.mean()
    amplitudes = np.array([2 * abs(np.mean(varying * np.exp(-1j * k * angle))) for k in orders])
    shares = amplitudes**2 / 2 / max(float(np.var(effort)), 1e-300)
    share = min(float(np.sort(shares)[-STRONGEST:].sum()), 1.0)
    return Organiser(name, "1", share, orders.astype(float), amplitudes, kind="orders")
