"""Is a residual noise? And does a richer model pay on recordings it has not seen?"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.case.noise import Noise, is_coarse
from lacuna.discovery.case.values import is_start
from lacuna.discovery.fit.fit import Fit, nrmse

BLOCKS = (1, 8, 40, 200)  # samples over which a residual is averaged
SIGMAS = 5.0  # of a mean square: dozens of tests of a case together then fail by chance in less than 1 of 10 000
ROUNDING = 2.5  # allowance for rounding errors of a slow signal, which are alike from sample to sample
GROWTH = 1.3  # of the power of block means from one block length to the next that colour may still explain
HALF_STEP = 3**0.5  # of resolution, in units of the standard deviation of rounding
LEFT = 1.2  # RMS in units of the noise, up to which a model stands for all of the misfit
INSTRUMENTS = 1.28  # the same, of what may be left unexplained: hypot(1, 0.8), drift and offset of 0.8 of the noise
ROUGH_SLACK = 0.3  # RMS misfit, in units of the noise, that the end of a fit on rough ground may leave
FAR = 10.0  # level of a signal, in units of its noise, from which the best hypothesis is taken to have lost its way
SPREAD = 0.005  # relative spread of an RMS over 20 000 samples of noise: a smaller gain is none
CLEARLY = 0.8  # times the NRMSE of the signals in their geometric mean, from which a model is better
LEAST_TAKEN = 0.2  # of the error above noise on unseen recordings, that findings must take away
TOLERANCE = 0.04  # of the noise level, within which it counts as known
COLOURED = 5.0  # RMS, in units of the noise as estimated, that coloured noise may have
TAILS = 2.0  # RMS over what the median says it is, from which a residual is no noise: a misfit at some moments


def common_correlation(fits: Iterable[Fit]) -> dict[str, float]:
    """Samples that carry the information of one, by which fits are compared: those of the best of them. What colours
    the residual of a poorer one is what it lacks, and discounts just the signals that tell so."""
    return min(fits, key=Fit.deviance).correlation()


@dataclass(frozen=True)
class Whiteness:
    """Mean square of block means over what white noise of the known level gives, and its limit, worst block length."""

    column: str
    block: int
    ratio: float
    limit: float

    @property
    def passed(self) -> bool:
        return self.ratio <= self.limit


def whiteness(fit: Fit, slack: float = 0.0) -> dict[str, Whiteness]:
    """For each signal the block length at which its residual is least like noise (chi-square of block means).

    `slack` is the RMS misfit, in units of the noise, that is let pass whatever its shape.
    """
    return {c: max((_blocks(fit, c, b, slack) for b in BLOCKS), key=lambda w: w.ratio / w.limit) for c in fit.noise}


def _blocks(fit: Fit, column: str, block: int, slack: float = 0.0) -> Whiteness:
    total, count = 0.0, 0
    for name, residual in fit.residuals.items():
        weight = fit.weights[name][column]
        values = np.nan_to_num(residual[column]) * weight**2 / fit.noise[column].std
        usable = len(values) // block * block
        sums = values[:usable].reshape(-1, block).sum(axis=1)
        power = (weight[:usable] ** 2).reshape(-1, block).sum(axis=1)
        alive = power > 0.5
        total += float(np.sum(sums[alive] ** 2 / power[alive]))
        count += int(alive.sum())
    count = max(count, 1)
    noise = fit.noise[column]
    level = 1.0 + TOLERANCE if noise.given else 1.3
    colour = ROUNDING if noise.quantum and noise.std < 0.5 * noise.quantum and block > 1 else 1.0
    limit = colour * level**2 * (1.0 + SIGMAS * np.sqrt(2.0 / count)) + block * slack**2
    return Whiteness(column, block, total / count, limit)


def excess(fit: Fit) -> float:
    """Square sum of the residuals in units of noise, less that of noise."""
    total = 0.0
    for name, residuals in fit.residuals.items():
        for column, noise in fit.noise.items():
            weight = fit.weights[name][column]
            total += float(np.sum((np.nan_to_num(residuals[column]) * weight / noise.std) ** 2) - np.sum(weight**2))
    return total


def is_noise(fit: Fit) -> bool:
    """Whether nothing is left in any signal but noise."""
    return all(w.passed for w in whiteness(fit).values())


def like_noise(fit: Fit) -> bool:
    """Whether what is left may be coloured noise: of the given level, its memory short, without outbursts.

    The power of block means of coloured noise grows with the block and then stays; that of a misfit goes on growing.
    """
    if not may_be_coloured(fit):
        return False
    for column in fit.noise:
        sizes = {b: _blocks(fit, column, b) for b in BLOCKS}
        chance = {b: sizes[b].limit / sizes[1].limit for b in BLOCKS}
        if sizes[200].ratio > GROWTH * chance[200] * max(sizes[40].ratio, 1.0):
            return False
        if sizes[40].ratio > 2 * GROWTH * chance[40] * max(sizes[8].ratio, 1.0):
            return False
    return True


def may_be_coloured(fit: Fit) -> bool:
    """Whether what is left is of the given level, or of one that noise as estimated may have, without outbursts."""
    for column, noise in fit.noise.items():
        whole = _blocks(fit, column, 1)
        if whole.ratio > (whole.limit if noise.given else COLOURED**2) or _bursts(fit, column):
            return False
    return True


def may_be_instruments(fit: Fit) -> bool:
    """Whether what is left is no more than instruments may be off by beside noise of a given level, or than noise as
    estimated may have, without outbursts."""
    most = {c: INSTRUMENTS if n.given else COLOURED for c, n in fit.noise.items()}
    return all(fit.level[c] < most[c] and not _bursts(fit, c) for c in fit.noise)


def _bursts(fit: Fit, column: str) -> bool:
    """Whether the RMS of a residual is that of a few moments: at edges of a current, say, that come too late."""
    rows = [np.abs(r[column]) for r in fit.residuals.values()]
    sizes = np.concatenate(rows)
    sizes = sizes[np.isfinite(sizes)]
    return float(np.sqrt(np.mean(sizes**2))) > TAILS * 1.4826 * max(float(np.median(sizes)), fit.noise[column].std / 2)


def settled(fit: Fit, rough: bool = False) -> bool:
    """Whether nothing is left to look for: noise, or noise of the level that is given with a colour of its own.

    On `rough` ground a fit ends in one of many dips: a small drift is no sign of anything there.
    """
    if all(w.passed for w in whiteness(fit, ROUGH_SLACK if rough else 0.0).values()):
        return True
    return all(n.given for n in fit.noise.values()) and like_noise(fit)


def holds(unseen: Mapping[str, float], floor: Mapping[str, float], noise: Mapping[str, Noise]) -> bool:
    """Whether NRMSE on recordings that nothing was fitted to are those of noise: parameters can stand for other physics
    in the recordings that they are fitted to, but not in others."""
    return all(unseen[c] < _at_most(n) * floor[c] for c, n in noise.items())


def _at_most(noise: Noise) -> float:
    """RMS that noise may have, in units of its level; where nothing moves, rounding may err by half a step for long."""
    if not noise.given:
        return COLOURED
    return HALF_STEP if is_coarse(noise) else LEFT


def repeats(unseen: Mapping[str, float], attained: Mapping[str, float], fit: Fit, samples: int) -> bool:
    """Whether NRMSE on `samples` unseen ones are those that a fit attains on what it was fitted to, where the
    noise's level, as estimated, is in `attained`: up to what mean squares of so few independent samples scatter by."""
    counts, correlation = fit.counts(), fit.correlation()

    def most(column: str, noise: Noise) -> float:
        if noise.given:
            return _at_most(noise)
        return max(LEFT, _scatter(counts[column], samples, correlation[column]))

    return all(unseen[c] < most(c, n) * attained[c] for c, n in fit.noise.items())


def _scatter(fitted: float, unseen: float, correlation: float) -> float:
    """The most that the RMS of noise of one process differs by between samples that carry the information of one in
    `correlation` of them."""
    return float(np.sqrt(1.0 + SIGMAS * np.sqrt(2.0 * correlation * (1.0 / fitted + 1.0 / unseen))))


def nearly_noise(fit: Fit) -> bool:
    """Whether no signal leaves much more than its noise: what may still be there is too little to be told apart."""
    return max(fit.level.values()) < LEFT


def within_instruments(fit: Fit) -> bool:
    """Whether what is left, in which nothing was found, may be what instruments are off by beside their noise."""
    return max(fit.level.values()) < INSTRUMENTS


def astray(fit: Fit) -> bool:
    """Whether far more than noise is left in a signal."""
    return max(fit.level.values()) > FAR


def out_of_phase(fit: Fit) -> bool:
    """Whether far more than noise is left in a signal, or more of one than is explained: what a fit in a dip leaves
    that is a period off."""
    case = fit.machine.case
    missed = nrmse(case, case.fit, fit.residuals)
    return astray(fit) or any(level > LEFT and 2 * missed[c] ** 2 > 1 for c, level in fit.level.items())


def outside_belief(fit: Fit, sigmas: float = 3.0) -> dict[str, float]:
    """Parameters that ended beyond `sigmas` believed sigmas, with how many."""
    result = {}
    for f, value in zip(fit.estimate.free, fit.estimate.values, strict=True):
        if f.sigma and not is_start(f.name) and abs(value - f.centre) > sigmas * f.sigma:
            result[f.name] = float((value - f.centre) / f.sigma)
    return result


def pays(before: Mapping[str, float], after: Mapping[str, float], floor: Mapping[str, float]) -> bool:
    """Whether a model is better on recordings that it has not seen: NRMSE of the case, above what noise could give.

    Or, where that is ruled by one signal which stays as it is, NRMSE of the signals in their geometric mean.
    """
    noise = float(np.sqrt(np.mean([floor[c] ** 2 for c in floor])))
    gap = before[""] - noise
    if before[""] - after[""] > max(0.02 * gap, SPREAD * before[""]):
        return True
    ratios = [max(after[c], floor[c]) / max(before[c], floor[c]) for c in floor]
    return after[""] < before[""] and float(np.exp(np.mean(np.log(ratios)))) < CLEARLY
