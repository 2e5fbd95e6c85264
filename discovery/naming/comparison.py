"""Comparing fitted hypotheses: evidence with a price for complexity, and what they say of recordings left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.trace import left
from lacuna.discovery.fit.evidence import common_correlation, nearly_noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.zeros import beside_zeros, largest_zero
from lacuna.discovery.naming.left_out import left_out_residuals
from lacuna.discovery.naming.screen import Candidate

MIN_GAIN = 20.0  # drop of the deviance, prices paid, below which nothing is believed missing
CLOSE = 0.3  # share of the best gain within which hypotheses are cross-validated against each other
DECIDED = 20.0  # difference of two scores that decides, where the better one leaves noise
CONTENDERS = 4  # hypotheses that are told apart by recordings left out
TIE = 8.0  # difference of two scores below which the data does not tell them apart
TEMPER = 4.0  # of scores to twice the logarithm of odds: misfit makes likelihoods surer than they should be
COLOUR = 30.0  # samples at most that count as one

Progress = Callable[[str], None]


@dataclass
class Ranked:
    """A fitted hypothesis. `score` is its deviance and price less the base's: negative is better than nothing."""

    candidate: Candidate
    fit: Fit
    score: float
    confidence: float = 0.0

    @property
    def attachment(self) -> Attachment:
        return self.candidate.attachment

    @property
    def identity(self) -> tuple[str, str]:
        return self.attachment.effect.identifier, self.attachment.location

    def effect_values(self) -> dict[str, float]:
        """Value of each of the effect's parameters, by its own name."""
        point = self.fit.point
        names = [p.name for p in self.attachment.effect.parameters]
        values = {n: point[self.attachment.full_name(n)] for n in names if self.attachment.full_name(n) in point}
        return values | dict(self.attachment.values)


def cross_validated(base: Fit, ranked: list[Ranked], correlation: dict[str, float], progress: Progress) -> list[Ranked]:
    """Contenders that are close to the best are ranked by recordings of the fit set that each is not fitted to.

    What a contender loses there against the best one is its score; those that tie there keep their order. Where the
    best one leaves noise nothing is left to fit too well, and the evidence itself decides.
    """
    best = ranked[0].score
    reach = DECIDED if nearly_noise(ranked[0].fit) else CLOSE * abs(best)
    close = [r for r in ranked if r.score - best < reach][:CONTENDERS]
    if len({r.identity for r in close}) < 2 or ranked[0].score > -MIN_GAIN:
        return ranked
    losses = [left_out_deviance(_for_rivals(r.candidate, r.fit), base, correlation) for r in close]
    losses = [min(loss, *_of_richer(contender, close, losses)) for contender, loss in zip(close, losses, strict=True)]
    least = min(losses)
    for contender, loss in zip(close, losses, strict=True):
        progress(f"left out: {contender.attachment.label}: {loss - least:.1f}")
        gap = loss - least
        contender.score = best + gap if gap > TIE else best + min(contender.score - best, TIE)
    return sorted(ranked, key=lambda r: r.score)


def _of_richer(contender: Ranked, close: list[Ranked], losses: list[float]) -> list[float]:
    """Losses of contenders that contain this one's law and do not pay for what they add to it, infinity at the end.

    Such a one predicts nothing that this one could not: what it wins on a recording left out is luck of the refit.
    """
    own = contender.attachment
    richer = [
        loss
        for other, loss in zip(close, losses, strict=True)
        if other.attachment.contains(own) and other.score >= contender.score
    ]
    return [*richer, float("inf")]


def left_out_deviance(found: Fit, base: Fit, correlation: dict[str, float]) -> float:
    """Deviance of what a fit says of parts of the recordings that are left out (`left_out`), weighted as `base`."""
    total = 0.0
    told = left_out_residuals(found)
    for column, noise in base.noise.items():
        for name, residuals in told.items():
            weight = base.weights[name][column]
            power = float(np.sum(weight**2))
            square = float(np.sum((weight * np.nan_to_num(residuals[column])) ** 2)) / power
            total += power / correlation[column] * np.log(max(1.0, square / noise.std**2))
    return total


def best_correlation(candidates: list[Candidate]) -> dict[str, float]:
    """Samples that count as one in the best fit; few enough that a misfit which drifts over a recording still tells."""
    found = common_correlation(c.fit for c in candidates)
    return {column: min(samples, COLOUR) for column, samples in found.items()}


def price(parameters: int, base: Fit, correlation: dict[str, float]) -> float:
    """ln n for each parameter of an effect, n independent samples."""
    informative = sum(count / correlation[c] for c, count in base.counts().items())
    return parameters * float(np.log(max(informative, 2.0)))


def is_better(one: Fit, other: Fit) -> bool:
    """By deviance and price of all that is free in each."""
    correlation = common_correlation((one, other))
    paid = [fit.deviance(correlation) + price(len(fit.estimate.free), one, correlation) for fit in (one, other)]
    return paid[0] < paid[1]


def score(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> float:
    """Deviance, less the base's, with the price of its parameters and of having been picked among many."""
    paid = candidate.fit.deviance(correlation) + price(len(candidate.free), base, correlation) + 2 * candidate.pick
    return paid - base.deviance(correlation)


def rival_score(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> float:
    """The score among rivals: beside errors of the sensors' zeros, which a law must not have stood for; errors of
    sensors themselves are weighed as they are."""
    own, before = (_for_rivals(candidate, f) for f in (candidate.fit, base))
    return score(replace(candidate, fit=own), before, correlation)


def ranked_beside_zeros(ranked: list[Ranked], base: Fit, correlation: dict[str, float]) -> list[Ranked]:
    """Best first: what is no error of a sensor, among itself as `rival_score` has it, the first of it with the best
    score that one of them has."""
    physical = [r for r in ranked if not r.attachment.variable]
    if physical:
        scores = [rival_score(r.candidate, base, correlation) for r in physical]
        shift = min(r.score for r in physical) - min(scores)
        for r, own in zip(physical, scores, strict=True):
            r.score = own + shift
    return sorted(ranked, key=lambda r: r.score)


def beyond_zeros(ranked: list[Ranked], base: Fit, correlation: dict[str, float]) -> list[Ranked]:
    """Those that say more than that zeros are off and drift, by the noise of a sample at most: instruments are, and
    nothing is missing then."""
    kept = [r for r in ranked if not _is_zero(r.candidate, base, correlation)]
    for r in ranked:
        if all(r is not other for other in kept):
            left(said(r.candidate), "comparison", "no more than a zero or a drift, as instruments have", cost=r.score)
    return kept


def needed(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> bool:
    """Whether a finding is believed beside the others, of which `base` is the fit: beside zeros of sensors, and of an
    error of a sensor not where its noise hides it."""
    small = bool(candidate.attachment.variable) and nearly_noise(base)
    return not small and rival_score(candidate, base, correlation) < -MIN_GAIN


def _is_zero(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> bool:
    """Whether an error of a sensor says no more than that zeros are off and drift."""
    if not candidate.attachment.variable or max(map(largest_zero, (base, candidate.fit))) > 1.0:
        return False
    beside = replace(candidate, fit=beside_zeros(candidate.fit))
    return score(beside, beside_zeros(base), correlation) > -MIN_GAIN


def _for_rivals(candidate: Candidate, found: Fit) -> Fit:
    return found if candidate.attachment.variable else beside_zeros(found)


def told_by_data(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> float:
    """The score as the recordings alone have it: what parameters can say, though they leave what is believed of them,
    is an answer without new physics."""
    pull, before = (fit.estimate.cost - fit.estimate.data_cost for fit in (candidate.fit, base))
    return score(candidate, base, correlation) - (pull - before)


def note_losers(ranked: list[Ranked]) -> None:
    """Trace those that are not the best."""
    for r in ranked[1:]:
        why = f"{r.score - ranked[0].score:.1f} behind {said(ranked[0].candidate)}"
        left(said(r.candidate), "comparison", why, cost=r.score)


def note_laws(laws: list[Candidate | None], best: Candidate | None, base: Fit) -> None:
    """Trace the laws that are not the best of those that were fitted side by side."""
    others = [law for law in laws if law is not None and law is not best]
    for law in (law for law in others if law.fit is None or best is None):
        left(said(law), "race", "no run from where it starts")
    fitted = [law for law in others if law.fit is not None]
    if best is not None and fitted:
        correlation = best_correlation([best, *fitted])
        note_losers([Ranked(law, law.fit, score(law, base, correlation)) for law in (best, *fitted)])


def said(candidate: Candidate) -> str:
    """A hypothesis in a line, a law with its numbers, where it was fitted to or where it starts."""
    return candidate.attachment.said(candidate.fit.point if candidate.fit is not None else candidate.start)


def confidences(ranked: list[Ranked]) -> None:
    """Posterior probability of each hypothesis among those tried (equal beliefs before), tempered to admit misfit."""
    scores = np.array([r.score for r in ranked])
    weights = np.exp(-np.minimum((scores - scores.min()) / TEMPER, 700.0))
    for r, weight in zip(ranked, weights / weights.sum(), strict=True):
        r.confidence = float(weight)
