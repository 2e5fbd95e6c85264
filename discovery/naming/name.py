"""Naming: hypotheses as amended models, fitted by output error, ranked by evidence.

Every hypothesis is screened to first order; the promising ones are fitted for a few steps, the better half goes on
(successive halving), the last few are polished. They are compared by the deviance of the data with a price for each
parameter (Schwarz 1978), samples discounted for the colour of the best residual.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment, Attachment
from lacuna.discovery.fit.evidence import nearly_noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.machine import try_machine
from lacuna.discovery.fit.solver.least_squares import WORKERS
from lacuna.discovery.fit.time_limit import TimeUp, check
from lacuna.discovery.naming.candidate_fit import fit_candidate
from lacuna.discovery.naming.comparison import (
    TIE,
    Progress,
    Ranked,
    best_correlation,
    confidences,
    cross_validated,
    score,
)
from lacuna.discovery.naming.race import HALF, ROUNDS, best_starts, first_round, leading, relatives, still_in
from lacuna.discovery.naming.restarts import begin_again
from lacuna.discovery.naming.screen import Candidate, Screen, prepare, telling_recordings
from lacuna.runtime import SimulationError

SEVERAL_STARTS = 1  # rounds after which only the best start of each hypothesis goes on


@dataclass
class Naming:
    """What one round of naming found, best first; what was screened out with the share it could have explained; and
    what could not be tried, with the reason."""

    ranked: list[Ranked]
    screened: list[tuple[str, float]]
    failures: list[tuple[str, str]] = field(default_factory=list)
    correlation: dict[str, float] = field(default_factory=dict)

    @property
    def best(self) -> Ranked | None:
        return self.ranked[0] if self.ranked else None

    @property
    def simplest(self) -> Ranked | None:
        """The best; or, of the laws that it contains, the best that the data does not tell from it."""
        best = self.best
        if best is None:
            return None
        contained = [r for r in self.ranked if best.attachment.contains(r.attachment) and r.score < best.score + TIE]
        return contained[0] if contained else best

    def of(self, identity: tuple[str, str]) -> Ranked | None:
        """The best hypothesis of this physics at this place."""
        return next((r for r in self.ranked if r.identity == identity), None)

    def rivals(self, ranked: Ranked) -> list[Ranked]:
        """Hypotheses of other physics or another place that the data does not tell from this one."""
        return [r for r in self.ranked if r.identity != ranked.identity and r.score - ranked.score < TIE]


def screen_all(
    case: Case, amendment: Amendment, attachments: list[Attachment], base: Fit, progress: Progress
) -> tuple[list[Candidate], list[tuple[str, str]]]:
    """Candidates (one for each start), most promising first; and the hypotheses that do not fit this model."""
    screen = Screen(base, telling_recordings(base))
    failures: list[tuple[str, str]] = []

    def one(attachment: Attachment) -> list[Candidate]:
        check()
        amended = replace(amendment, attachments=[*amendment.attachments, attachment])
        machine, why = try_machine(case, amended, base.machine)
        if machine is None:
            failures.append((attachment.label, why))
            return []
        try:
            found = prepare(screen, attachment, machine)
        except SimulationError as error:
            failures.append((attachment.label, str(error)))
            return []
        progress(f"screened {attachment.label}: " + (f"{found[0].predicted:.1%}" if found else "no use"))
        return found

    with ThreadPoolExecutor(WORKERS) as pool:
        candidates = [c for found in pool.map(one, attachments) for c in found]
    return sorted(candidates, key=lambda c: -c.predicted), failures


def rank(
    case: Case, amendment: Amendment, attachments: list[Attachment], base: Fit, *,
    final: bool = True, progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Screen, fit and rank hypotheses on top of `base`, the fit of the amendment so far; `final`: see `compete`."""
    candidates, failures = screen_all(case, amendment, attachments, base, progress)
    naming = compete(case, candidates, base, final=final, progress=progress)
    return replace(naming, failures=[*failures, *naming.failures])


def compete(
    case: Case, candidates: list[Candidate], base: Fit, *, final: bool = True, progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Fit and rank candidates (most promising first) on top of `base`.

    A `final` ranking is cross-validated; not one of fits that are held, which is decided when they are released. Where
    the time is up, those that have been fitted are ranked if the best leaves noise; else TimeUp is raised.
    """
    screened = [(c.attachment.label, c.predicted) for c in best_starts(candidates)]
    fitted: dict[str, Candidate] = {}
    failures: list[tuple[str, str]] = []
    try:
        failures = _race(case, candidates, base, fitted, progress)
        if not fitted:
            return Naming([], screened, failures)
        ranked, correlation = _ranked(fitted, base)
        if final:
            ranked = cross_validated(base, ranked, correlation, progress)
    except TimeUp:
        if not any(nearly_noise(c.fit) for c in fitted.values()):
            raise
        ranked, correlation = _ranked(fitted, base)
    confidences(ranked)
    return Naming(ranked, screened, failures, correlation)


def _ranked(fitted: dict[str, Candidate], base: Fit) -> tuple[list[Ranked], dict[str, float]]:
    """What was fitted, best first, and the samples of each signal that count as one."""
    correlation = best_correlation(list(fitted.values()))
    ranked = [Ranked(c, c.fit, score(c, base, correlation)) for c in fitted.values()]
    return sorted(ranked, key=lambda r: r.score), correlation


def _race(
    case: Case, candidates: list[Candidate], base: Fit, fitted: dict[str, Candidate], progress: Progress
) -> list[tuple[str, str]]:  # fmt: skip
    """Fit what may win, into `fitted`; what could not be simulated, with the reason.

    The most promising go first: where one of them leaves noise, others can but tie with it, and those that promise much
    less do not.
    """
    first = first_round(candidates)
    leaders, others = leading(first)
    _halve(case, base, leaders, fitted, progress)
    if fitted and nearly_noise(_ranked(fitted, base)[0][0].fit):
        others = [c for c in others if c.predicted > HALF * first[0].predicted]
    _halve(case, base, others, fitted, progress)
    related: list[Candidate] = []
    if fitted:
        related = relatives(candidates, fitted, _ranked(fitted, base)[0][0].candidate)
        _halve(case, base, related, fitted, progress)
        begin_again(case, base, list(fitted.values()), progress)
    failed = dict.fromkeys(
        c.attachment.label for c in [*leaders, *others, *related] if c.attachment.label not in fitted
    )
    return [(label, "no simulation succeeded from its start values") for label in failed]


def _halve(
    case: Case, base: Fit, pool: list[Candidate], fitted: dict[str, Candidate], progress: Progress
) -> None:  # fmt: skip
    """Fit a pool by successive halving; the best start of each hypothesis ends in `fitted`."""
    before: dict[int, float] = {}
    for k, (stages, iterations, keep) in enumerate(ROUNDS):
        pool = (pool if k <= SEVERAL_STARTS else best_starts(pool))[:keep]
        with ThreadPoolExecutor(WORKERS) as workers:
            fits = workers.map(partial(fit_candidate, case, base, stages, iterations, progress), pool)
            for candidate, found in zip(pool, fits, strict=True):
                better = candidate.fit is None or (found is not None and found.deviance() < candidate.fit.deviance())
                candidate.fit = found if better else candidate.fit
        pool = [c for c in pool if c.fit is not None]
        if not pool:
            return
        correlation = best_correlation([*fitted.values(), *pool])
        scores = {id(c): score(c, base, correlation) for c in pool}
        pool.sort(key=lambda c: scores[id(c)])
        for c in best_starts(pool):
            progress(f"fitted {c.attachment.label}: {scores[id(c)]:.1f}, best so far {pool[0].attachment.label}")
        fitted |= {c.attachment.label: c for c in best_starts(pool)}
        leader = min(fitted.values(), key=lambda c: score(c, base, correlation))
        pool = still_in(pool, scores, before, leader.fit, score(leader, base, correlation), base, correlation)
        before = scores
