"""Naming: hypotheses as amended models, fitted by output error, ranked by evidence.

Every hypothesis is screened to first order; the promising ones are fitted for a few steps, the better half goes on
(successive halving), the last few are polished. They are compared by the deviance of the data with a price for each
parameter (Schwarz 1978), samples discounted for the colour of the best residual.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial

from runtime import SimulationError

from .amend import Amendment, Attachment
from .cases import Case
from .comparison import TIE, Progress, Ranked, best_correlation, confidences, cross_validated, score
from .evidence import nearly_noise
from .fit import Fit, falling_bandwidths, fit
from .least_squares import WORKERS, Free
from .machine import try_machine
from .objective import Objective
from .places import Shaft
from .race import best_starts, first_round, relatives, still_in
from .screen import Candidate, Screen, prepare, telling_recordings
from .time_limit import TimeUp, check
from .tracking import trackable

ROUNDS = ((2, 2, 100), (2, 3, 10), (3, 3, 4), (10, 4, 2))  # (stages, iterations, fits): successive halving
SMALL_STEP = 0.1  # of a start that is predicted to first order, which may still hold where the whole of it does not
HALF = 0.5  # of the best gain, that a hypothesis must have to be fitted further: a simpler law, or one to be led
SEVERAL_STARTS = 1  # rounds after which only the best start of each hypothesis goes on
LED = 2  # hypotheses that are fitted again, led by trackers, where none has left noise
CONTENDING = 0.1  # share of the best gain, within which rivals are begun again from where the best hypothesis ended,
AS_GOOD = 3.0  # while to first order they leave at most so many times what it does there itself


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
    bandwidths: tuple[float, ...] = (0.0,), progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Screen, fit and rank hypotheses on top of `base`, the fit of the amendment so far."""
    candidates, failures = screen_all(case, amendment, attachments, base, progress)
    naming = compete(case, candidates, base, bandwidths=bandwidths, progress=progress)
    return replace(naming, failures=[*failures, *naming.failures])


def compete(
    case: Case, candidates: list[Candidate], base: Fit, *, bandwidths: tuple[float, ...] = (0.0,),
    progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Fit and rank candidates (most promising first) on top of `base`.

    Where the time is up, those that have been fitted are ranked if the best leaves noise; else TimeUp is raised.
    """
    screened = [(c.attachment.label, c.predicted) for c in best_starts(candidates)]
    fitted: dict[str, Candidate] = {}
    done = False
    try:
        failures = _race(case, candidates, base, bandwidths, fitted, progress)
        done = True
    except TimeUp:
        if not any(nearly_noise(c.fit) for c in fitted.values()):
            raise
        failures = []
    if not fitted:
        return Naming([], screened, failures)
    correlation = best_correlation(list(fitted.values()))
    ranked = [Ranked(c, c.fit, score(c, base, correlation)) for c in fitted.values()]
    ranked.sort(key=lambda r: r.score)
    if done:
        ranked = cross_validated(case, base, ranked, correlation, progress)
    confidences(ranked)
    return Naming(ranked, screened, failures, correlation)


def _race(
    case: Case, candidates: list[Candidate], base: Fit, bandwidths: tuple[float, ...], fitted: dict[str, Candidate],
    progress: Progress,
) -> list[tuple[str, str]]:  # fmt: skip
    """Fit what may win, into `fitted`; what could not be simulated, with the reason."""
    first = first_round(candidates)
    _halve(case, base, first, bandwidths, fitted, progress)
    related = relatives(candidates, fitted)
    _halve(case, base, related, bandwidths, fitted, progress)
    if fitted:
        _lead(case, base, list(fitted.values()), progress)
        _simplify(case, base, list(fitted.values()))
        _contend(case, base, list(fitted.values()), progress)
    failed = dict.fromkeys(c.attachment.label for c in [*first, *related] if c.attachment.label not in fitted)
    return [(label, "no simulation succeeded from its start values") for label in failed]


def _halve(
    case: Case, base: Fit, pool: list[Candidate], bandwidths: tuple[float, ...], fitted: dict[str, Candidate],
    progress: Progress,
) -> None:  # fmt: skip
    """Fit a pool by successive halving; the best start of each hypothesis ends in `fitted`."""
    before: dict[int, float] = {}
    for k, (stages, iterations, keep) in enumerate(ROUNDS):
        pool = (pool if k <= SEVERAL_STARTS else best_starts(pool))[:keep]
        with ThreadPoolExecutor(WORKERS) as workers:
            fits = workers.map(partial(fit_candidate, case, base, bandwidths, stages, iterations, progress), pool)
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
            progress(f"fitted {c.attachment.label}: {scores[id(c)]:.1f}")
        fitted |= {c.attachment.label: c for c in best_starts(pool)}
        leader = min(fitted.values(), key=lambda c: score(c, base, correlation))
        pool = still_in(pool, scores, before, leader.fit, score(leader, base, correlation), base, correlation)
        before = scores


def fit_candidate(
    case: Case, base: Fit, bandwidths: tuple[float, ...], stages: int, iterations: int, progress: Progress,
    candidate: Candidate,
) -> Fit | None:  # fmt: skip
    """Fit the base's parameters and the effect's together, from the screened start."""
    progress(f"fitting {candidate.attachment.label}")
    free: list[Free] = [*base.estimate.free, *candidate.free]
    if candidate.fit is not None:
        start = candidate.fit.point
        bandwidths = bandwidths[-1:]
    else:
        start = _start(case, base, candidate)
    fixed = base.fixed | candidate.fixed
    return fit(
        candidate.machine, case.fit, base.noise, free, fixed, start=start, bandwidths=bandwidths, stages=stages,
        iterations=iterations, known=base.sensitivities() if candidate.fit is None else None,
    )  # fmt: skip


def _start(case: Case, base: Fit, candidate: Candidate) -> dict[str, float]:
    """The screened start that misses by least: the base's parameters as they are, or as they would go with the effect,
    or only a little of both."""
    objective = Objective(candidate.machine, case.fit, base.noise)
    weights = objective.weights(base.level)

    def missed(start: dict[str, float]) -> float:
        residual = objective.weighted(start | candidate.fixed, weights)
        return float("inf") if residual is None else float(residual @ residual)

    full = base.point | candidate.shift | candidate.start
    return min((base.point | candidate.start, full, _small_step(base, candidate, full)), key=missed)


def _small_step(base: Fit, candidate: Candidate, full: dict[str, float]) -> dict[str, float]:
    """A little of the way from the base without the effect to a start; what has no neutral value stays."""
    attachment = candidate.attachment
    neutral = {attachment.full_name(n): v for n, v in attachment.effect.neutral.items()}
    without = full | {n: v for n, v in neutral.items() if n in full} | base.point
    return {n: without[n] + SMALL_STEP * (v - without[n]) for n, v in full.items()}


def _lead(case: Case, base: Fit, candidates: list[Candidate], progress: Progress) -> None:
    """Fit the best hypotheses again, shafts held near their recorded motion at first, where none of them left noise.

    Stick and slip make the sum of squares rough: a fit that starts far away can end in one of its many dips.
    """
    ordered = sorted(candidates, key=lambda c: c.fit.deviance())
    far = base.deviance() - HALF * (base.deviance() - ordered[0].fit.deviance())
    shafts = trackable(case, base.machine.model, base.machine.amendment.structure)
    if not shafts or base.machine.amendment.trackers or nearly_noise(ordered[0].fit):
        return
    for candidate in [c for c in ordered[:LED] if c.fit.deviance() <= far]:
        progress(f"leading {candidate.attachment.label}")
        found = _fit_led(case, base, candidate, shafts)
        if found is not None and found.deviance() < candidate.fit.deviance():
            candidate.fit = found


def _simplify(case: Case, base: Fit, candidates: list[Candidate]) -> None:
    """Start the laws that the best hypothesis contains from where it ended: a simpler one may do as well."""
    best = min(candidates, key=lambda c: c.fit.deviance())
    for candidate in candidates:
        if best.attachment.contains(candidate.attachment):
            found = _from_richer(case, base, candidate, best)
            if found is not None and found.deviance() < candidate.fit.deviance():
                candidate.fit = found


def _from_richer(case: Case, base: Fit, candidate: Candidate, best: Candidate) -> Fit | None:
    """The fit of a law from the values of one that contains it; given up where a first look shows it far behind."""
    point = best.fit.point
    shared = {f.name: point.get(best.attachment.full_name(f.name.rsplit(".", 1)[-1])) for f in candidate.free}
    start = candidate.fit.point | {f.name: point[f.name] for f in base.estimate.free}
    start |= {name: value for name, value in shared.items() if value is not None}
    correlation = best_correlation([best])
    goal = score(best, base, correlation)
    simpler = replace(candidate, fit=None)
    for stages, iterations, _ in (ROUNDS[0], ROUNDS[-1]):
        free, fixed = [*base.estimate.free, *candidate.free], base.fixed | candidate.fixed
        simpler.fit = fit(
            candidate.machine, case.fit, base.noise, free, fixed, start=start, stages=stages, iterations=iterations
        )
        if simpler.fit is None or score(simpler, base, correlation) > HALF * goal:
            break
        start = simpler.fit.point
    return simpler.fit


def _contend(case: Case, base: Fit, candidates: list[Candidate], progress: Progress) -> None:
    """Begin rivals of the best hypothesis again, the base's parameters where that one left them.

    Without an effect they stand for it as well as they can, and on the way back a fit may end in a dip: which of two
    hypotheses that do equally well is named must not hang on that.
    """
    best = min(candidates, key=lambda c: c.fit.deviance())
    near = best.fit.deviance() + CONTENDING * (base.deviance() - best.fit.deviance())
    close = [c for c in candidates if c.fit.deviance() <= near]
    free, point = base.estimate.free, best.fit.point
    there = fit(base.machine, case.fit, base.noise, free, base.fixed, start=point, stages=1, iterations=0)
    if len(close) < 2 or there is None:
        return
    screen = Screen(there, telling_recordings(there))
    least = AS_GOOD * (1.0 - _prepared(screen, best).predicted)

    def begin_again(candidate: Candidate) -> None:
        again = _prepared(screen, candidate)
        if 1.0 - again.predicted > least:
            return
        for stages, iterations, _ in (ROUNDS[0], ROUNDS[-1]):
            again.fit = fit_candidate(case, there, (0.0,), stages, iterations, progress, again)
            if again.fit is None or again.fit.deviance() > candidate.fit.deviance():
                return
            candidate.fit, candidate.free = again.fit, again.free

    with ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(begin_again, close))


def _prepared(screen: Screen, candidate: Candidate) -> Candidate:
    """The candidate at its most promising start against another fit of the base."""
    found = prepare(screen, candidate.attachment, candidate.machine)
    return found[0] if found else replace(candidate, predicted=0.0)


def _fit_led(case: Case, base: Fit, candidate: Candidate, shafts: list[Shaft]) -> Fit | None:
    amendment = replace(candidate.machine.amendment, trackers=shafts)
    machine, _ = try_machine(case, amendment, base.machine)
    if machine is None:
        return None
    free, fixed = [*base.estimate.free, *candidate.free], base.fixed | candidate.fixed
    start = base.point | candidate.start
    bandwidths = falling_bandwidths(case, machine)
    led = fit(machine, case.fit, base.noise, free, fixed, start=start, bandwidths=bandwidths, stages=4)
    return led and fit(candidate.machine, case.fit, base.noise, free, fixed, start=led.point)
