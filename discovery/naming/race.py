"""The race of hypotheses: which of them are fitted, in which order, and which are given up on the way.

Promise to first order decides who starts; laws that contain one another start one after the other, the simplest first.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.fit.evidence import is_noise, nearly_noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.naming.screen import Candidate

ROUNDS = ((2, 2, 100), (2, 3, 10), (3, 3, 4), (10, 4, 2))  # (stages, iterations, fits): successive halving
FIRST_ROUND = 8  # hypotheses at least that are fitted: a budget of time
LEADING = 2  # hypotheses that are fitted before the others
ENOUGH = 0.9  # of the promise of a law, that one which it contains must have to be tried in its stead,
LEAVES = 1.5  # while it leaves at most so many times the misfit
HALF = 0.5  # of the promise or the gain of the best hypothesis, that another form of it must have to be tried
STARTS = 3  # from which a hypothesis is fitted in the first round,
WHOLE_STARTS = 8  # where they are whole numbers: none leads to another; those with HALF of the promise of the best
LITTLE = 0.1  # share of the misfit, that a hypothesis has to explain before others are dropped for it
NEAR = 0.1  # share of the best gain, within which a hypothesis stays in the race, or is begun again
NEAR_NOISE = 0.01  # the same, where the best one leaves noise
FAINT = 0.03  # share of the best gain, that a hypothesis must have after the first round to stay
GAINING = 0.1  # share of what parts it from the best, that one further away must have won in a round to stay


def run_round(pool: list[Candidate], fitted: Callable[[Candidate], Fit | None]) -> list[Candidate]:
    """Each hypothesis fitted further, the better one of its fits kept; those that have one."""
    for candidate, found in zip(pool, in_threads(fitted, pool), strict=True):
        better = candidate.fit is None or (found is not None and found.deviance() < candidate.fit.deviance())
        candidate.fit = found if better else candidate.fit
    return [c for c in pool if c.fit is not None]


def first_round(candidates: list[Candidate]) -> list[Candidate]:
    """The most promising hypotheses, and the best of each physics that explains at least a quarter of the best.

    Each is tried from several starts: where events make the response rough, promise to first order can mislead. A law
    that promises hardly more than one that it contains waits for that one to win.
    """
    chosen: dict[str, int] = {}
    seen: set[str] = set()
    every = best_starts(candidates)
    for candidate in every:
        simpler = [c for c in every if candidate.attachment.contains(c.attachment)]
        if any(_promises_enough(c.predicted, candidate.predicted) for c in simpler):
            continue
        identifier = candidate.attachment.effect.identifier
        late = identifier not in seen and candidate.predicted > 0.25 * candidates[0].predicted
        if len(chosen) < FIRST_ROUND or late:
            chosen[candidate.attachment.label] = _starts(candidate, candidates)
            seen.add(identifier)
    pool = []
    for candidate in candidates:
        if chosen.get(candidate.attachment.label, 0) > 0:
            chosen[candidate.attachment.label] -= 1
            pool.append(candidate)
    return pool


def at_first(attachments: list[Attachment]) -> tuple[list[Attachment], list[Attachment]]:
    """(hypotheses that are looked at first, those that wait): richer forms of dry friction wait for the plain one."""
    waiting = [any(a.contains(b) and b.effect.friction for b in attachments) for a in attachments]
    pairs = list(zip(attachments, waiting, strict=True))
    return [a for a, waits in pairs if not waits], [a for a, waits in pairs if waits]


def stands_out(candidates: list[Candidate]) -> bool:
    """Whether no other physics promises half as much as the best, which may then win before what waits is looked at: to
    fit what does not win costs as much as to look at a dozen."""
    if not candidates:
        return False
    own = candidates[0].attachment.effect.identifier
    others = [c.predicted for c in candidates if c.attachment.effect.identifier != own]
    return max(others, default=0.0) < HALF * candidates[0].predicted


def akin(attachment: Attachment, best: Attachment) -> bool:
    """Whether one of two laws at a place contains the other."""
    return attachment.contains(best) or best.contains(attachment)


def leading(pool: list[Candidate]) -> tuple[list[Candidate], list[Candidate]]:
    """(all starts of the first few hypotheses of a pool, the rest)."""
    first = list(dict.fromkeys(c.attachment.label for c in pool))[:LEADING]
    return [c for c in pool if c.attachment.label in first], [c for c in pool if c.attachment.label not in first]


def _promises_enough(simpler: float, richer: float) -> bool:
    """Whether a law may wait for one that it contains, by the shares of the misfit that both promise to explain."""
    return simpler > ENOUGH * richer and 1.0 - simpler < LEAVES * (1.0 - richer)


def _starts(best: Candidate, candidates: list[Candidate]) -> int:
    """How many starts of the best one's hypothesis are tried."""
    if not best.attachment.effect.whole:
        return STARTS
    same = [c for c in candidates if c.attachment.label == best.attachment.label]
    promising = sum(c.predicted > HALF * best.predicted for c in same)
    return min(max(promising, STARTS), WHOLE_STARTS)


def relatives(candidates: list[Candidate], fitted: dict[str, Candidate], best: Candidate) -> list[Candidate]:
    """Not yet fitted: laws that the best hypothesis contains, laws that contain it, from where it ended, and, where it
    leaves more than noise, those from starts of their own and its other forms."""
    own = best.attachment
    promise = max(c.predicted for c in candidates if c.attachment.label == own.label)
    least = float("inf") if nearly_noise(best.fit) else HALF * promise
    new = [c for c in candidates if c.attachment.location == own.location and c.attachment.label not in fitted]
    richer = [c for c in new if c.attachment.contains(own)]
    alike = [
        c for c in new
        if own.contains(c.attachment)
        or (c.attachment.effect.identifier == own.effect.identifier and c.predicted > least)
    ]  # fmt: skip
    own_starts = [] if nearly_noise(best.fit) else richer
    found = [*(_enriched(c, best) for c in best_starts(richer)), *own_starts, *alike]
    labels = [c.attachment.label for c in found]
    return [c for k, c in enumerate(found) if labels[:k].count(labels[k]) < STARTS]


def outdone(candidates: list[Candidate], fitted: dict[str, Candidate]) -> list[Candidate]:
    """Fitted laws that fit worse than one which they contain at their place: a dip. From where that one ended. None
    where the best of all leaves noise: what a richer law adds to another one is not needed then."""
    if any(is_noise(c.fit) for c in fitted.values()):
        return []
    found = []
    for label, law in fitted.items():
        simpler = [c for c in fitted.values() if law.attachment.contains(c.attachment)]
        best = min(simpler, key=lambda c: c.fit.deviance(), default=law)
        if best.fit.deviance() < law.fit.deviance():
            found += [_enriched(c, best) for c in candidates if c.attachment.label == label][:STARTS]
    return found


def _enriched(candidate: Candidate, best: Candidate) -> Candidate:
    """A law that contains the best one, begun where that one ended: its levels equal, what it adds at nothing."""
    own, effect, full = best.attachment, candidate.attachment.effect, candidate.attachment.full_name
    point = best.fit.point
    start = candidate.start | {n: v for n, v in point.items() if not n.startswith(f"{own.component}.")}
    shared = {p.name: point[own.full_name(p.name)] for p in own.effect.parameters if own.full_name(p.name) in point}
    if len(shared) == 1:
        shared |= dict.fromkeys(effect.levels, next(iter(shared.values())))
    added = {n: v for n, v in effect.neutral.items() if n not in effect.polar}
    start |= {full(n): v for n, v in (added | shared).items() if full(n) in start}
    return replace(candidate, start=start)


def whole_of(candidate: Candidate) -> dict[str, float]:
    """The whole numbers of a hypothesis, by their full names: no fit moves them."""
    names = [candidate.attachment.full_name(n) for n in candidate.attachment.effect.whole]
    return {n: candidate.fixed[n] for n in names if n in candidate.fixed}


def beside_whole(best: Candidate) -> list[Candidate]:
    """A fitted hypothesis with one of its whole numbers one less or more, from where it is: starts have gaps."""
    attachment, whole = best.attachment, whole_of(best)
    lower = {attachment.full_name(p.name): p.lower for p in attachment.effect.parameters}
    steps = [{n: v + step} for n, v in whole.items() for step in (-1.0, 1.0) if v + step >= lower[n]]
    start = {n: v for n, v in best.fit.point.items() if n not in best.fixed}
    return [replace(best, fixed=best.fixed | step, start=start, shift={}, fit=None) for step in steps]


def best_starts(candidates: list[Candidate]) -> list[Candidate]:
    """Of candidates in order, the first of each attachment."""
    first: dict[str, Candidate] = {}
    for candidate in candidates:
        first.setdefault(candidate.attachment.label, candidate)
    return list(first.values())


def still_in(
    pool: list[Candidate], scores: dict[int, float], before: dict[int, float], leader: Fit, best: float, base: Fit,
    correlation: dict[str, float],
) -> list[Candidate]:  # fmt: skip
    """Those of the pool that may still win; `scores` (`before`: of a round ago) by identity, `best` is the leader's."""
    if best > -LITTLE * _misfit(base, correlation):
        return pool
    won = nearly_noise(leader)
    return [c for c in pool if in_the_race(scores[id(c)], before.get(id(c)), best, won)]


def in_the_race(now: float, before: float | None, best: float, won: bool) -> bool:
    """Whether a score may still become the best: near it, or still gaining on it (`before` is that of a round ago).

    Where the best one leaves noise (`won`), others can but tie with it.
    """
    if before is None:
        return now < FAINT * best
    near = NEAR_NOISE if won else NEAR
    return now - best < near * abs(best) or before - now > GAINING * (now - best)


def _misfit(base: Fit, correlation: dict[str, float]) -> float:
    """How far a fit's deviance is above that of noise."""
    return base.deviance(correlation) - sum(count / correlation[c] for c, count in base.counts().items())
