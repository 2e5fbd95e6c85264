"""Laws that no catalogue holds: sparse sums of terms in the variables at a place, fitted by the error of the outputs.

Every group of terms is screened to first order, as an effort along the fitted trajectory, and those are kept that
explain recordings (or parts of one) they were not fitted to. The best few become components of a model and are fitted
like any effect; groups are added while they pay for their parameters and for having been picked among many.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
import re

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.trace import left, looking
from lacuna.discovery.efforts.laws.variants import stuck, unbent
from lacuna.discovery.efforts.places import sites as places
from lacuna.discovery.fit.evidence import common_correlation, is_noise
from lacuna.discovery.fit.fit import Fit, fit, linearised
from lacuna.discovery.fit.machine import try_machine
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.fit.zeros import beside_zeros
from lacuna.discovery.law.law import Law, attach, component_of
from lacuna.discovery.law.law_screen import Effort, Proposal, screened, sites
from lacuna.discovery.naming.comparison import best_correlation, note_laws, rival_score, score
from lacuna.discovery.naming.race import ROUNDS, run_round, still_in
from lacuna.discovery.naming.screen import Candidate

GROUPS = 3  # that a law may be the sum of
FITTED = 4  # groups that are fitted in each round
SIGNIFICANT = 3.0  # standard errors of a coefficient below which it is left out

Progress = Callable[[str], None]


def find(
    case: Case, amendment: Amendment, base: Fit, progress: Progress = lambda text: None, most: int = GROUPS
) -> Candidate | None:
    """The best law of up to `most` groups of terms on top of `base`, the fit of `amendment`; None where no term pays.

    Its fit is in the candidate.
    """
    looking("an empirical law at a shaft or in a line")
    best: Proposal | None = None
    efforts = [Effort(case, base, site) for site in sites(case, base)]
    while best is None or (len(best.law.groups) < most and not is_noise(best.candidate.fit)):
        here, law = (base, None) if best is None else (best.candidate.fit, best.law)
        proposals = screened(case, here, law, efforts, progress)
        tried = proposals[:FITTED]
        for proposal in tried:
            progress(f"fitting a law at {proposal.law.site.location}")
        candidates = in_threads(lambda p: fitted_law(case, amendment, base, p.law, p.start), tried)
        fitted = [replace(p, candidate=c) for p, c in zip(tried, candidates, strict=True) if c is not None]
        if not fitted:
            break
        correlation = common_correlation(p.candidate.fit for p in fitted)
        chosen = min(fitted, key=lambda p: score(p.candidate, base, correlation))
        before = 0.0 if best is None else score(best.candidate, base, correlation)
        after = score(chosen.candidate, base, correlation)
        progress(f"law at {chosen.law.site.location}: {chosen.law.text()}: {after:.1f}")
        note_laws([c for c in candidates if c is not chosen.candidate], chosen.candidate, base)
        if after > before - 2 * np.log(len(proposals)):  # ln of the squared number of terms that were looked at
            break
        best = chosen
    return None if best is None else simplified(case, amendment, base, best).candidate


def fitted_law(
    case: Case,
    amendment: Amendment,
    base: Fit,
    law: Law,
    start: dict[str, float],
    believed: dict[str, float] | None = None,
) -> Candidate | None:
    """The law as a component of the amended model, fitted together with the believed parameters."""
    candidate = unfitted(case, amendment, base, law, start, believed)
    if candidate is None:
        return None
    candidate.fit = _fit(case, base, *ROUNDS[-1][:2], candidate)
    return None if candidate.fit is None else candidate


def unfitted(
    case: Case, amendment: Amendment, base: Fit, law: Law, start: dict[str, float], believed: dict[str, float] | None
) -> Candidate | None:  # fmt: skip
    """The law as a component of the amended model, where its fit begins; None where there is no such model."""
    attachment = attach(law)
    machine, why = try_machine(case, replace(amendment, attachments=[*amendment.attachments, attachment]), base.machine)
    first = (believed or base.point) | {attachment.full_name(n): v for n, v in start.items()}
    if machine is None:
        left(attachment.said(first), "model", why)
    free, held = free_of(law, attachment, start), held_of(law, attachment, start)
    return None if machine is None else Candidate(attachment, machine, free, held, first, pick=law.pick())


def unmoved(case: Case, amendment: Amendment, base: Fit, proposal: Proposal) -> tuple[Amendment, Fit] | None:
    """(the model with a law where that starts, as a fit that does not move); None where it cannot be simulated."""
    candidate = unfitted(case, amendment, base, proposal.law, proposal.start, proposal.point)
    if candidate is None:
        return None
    free, fixed = [*base.estimate.free, *candidate.free], base.fixed | candidate.fixed
    there = linearised(candidate.machine, case.fit, base.noise, free, fixed, candidate.start)
    return None if there is None else (candidate.machine.amendment, there)


def race(case: Case, base: Fit, pool: list[Candidate], leader: Candidate | None) -> None:
    """Fit laws side by side, in rounds; one that can no longer win, against the others or the `leader`, is left where
    it is, as an effect of the catalogue would be. Those that cannot be simulated are left without a fit."""
    before: dict[int, float] = {}
    for stages, iterations, _ in (*ROUNDS[:2], ROUNDS[-1]):
        pool = run_round(pool, partial(_fit, case, base, stages, iterations))
        if not pool:
            return
        every = [*pool, *([leader] if leader else [])]
        correlation = best_correlation(every)
        scored = partial(score, base=base, correlation=correlation)
        first, scores = min(every, key=scored), {id(c): scored(c) for c in pool}
        pool = still_in(pool, scores, before, first.fit, scored(first), base, correlation)
        before = scores


def _fit(case: Case, base: Fit, stages: int, iterations: int, law: Candidate) -> Fit | None:
    """The law fitted together with the believed parameters, from where it was; what has settled stays."""
    if law.fit is not None and law.fit.settled:
        return law.fit
    start, known = (law.start, None) if law.fit is None else (law.fit.point, law.fit.sensitivities())
    free = [*base.estimate.free, *law.free]
    return fit(law.machine, case.fit, base.noise, free, base.fixed | law.fixed, start=start, stages=stages,
               iterations=iterations, known=known)  # fmt: skip


def free_of(law: Law, attachment: Attachment, start: dict[str, float]) -> list[Free]:
    """Coefficients of any sign, scaled by the largest of all, but those that are held; shapes within their bounds."""
    scale = max(abs(start[c]) for c, _, _ in law.numbered()) or 1.0
    told, held = [attachment.full_name(c) for c, _, _ in law.numbered()], held_of(law, attachment, start)
    free = [
        Free(name, start[c], max(abs(start[c]), 0.1 * scale))
        for name, (c, _, _) in zip(told, law.numbered(), strict=True) if name not in held
    ]  # fmt: skip
    for name, shape in law.shapes().items():
        step = 1e-3 if shape.name == "omega" else 1e-2
        scale = 0.3 * abs(shape.start) or shape.step  # a threshold may start at zero
        free.append(Free(attachment.full_name(name), start[name], scale, shape.lower, shape.upper, step=step))
    return free


def held_of(law: Law, attachment: Attachment, start: dict[str, float]) -> dict[str, float]:
    """Coefficients that no fit moves, by their full names."""
    return {attachment.full_name(c): start[c] for c in law.held()}


def simplified(case: Case, amendment: Amendment, base: Fit, best: Proposal) -> Proposal:
    """The law without coefficients that may be zero, and with whole exponents and orders where the data allows them."""
    simpler, point = _simpler(best), best.candidate.fit.point
    fitted = in_threads(lambda p: fitted_law(case, amendment, base, p.law, p.start, point), simpler)
    shorter = [replace(p, candidate=c) for p, c in zip(simpler, fitted, strict=True) if c is not None]
    correlation = best.candidate.fit.correlation()
    chosen = min([best, *shorter], key=lambda p: rival_score(p.candidate, base, correlation))
    return best if chosen is best else simplified(case, amendment, base, chosen)


def _simpler(proposal: Proposal) -> list[Proposal]:
    """The law with one thing less that is not needed by its own standard error."""
    law, fitted = proposal.law, beside_zeros(proposal.candidate.fit)
    covariance = fitted.estimate.covariance(fitted.inflation())
    errors = {f.name: float(np.sqrt(max(covariance[k, k], 0.0))) for k, f in enumerate(fitted.estimate.free)}
    prefix, values = f"{component_of(law)}.", proposal.candidate.attachment.own_values(fitted.point)
    found = [*stuck(law, values), *unbent(law, values), *_whole(law, values, errors.get(prefix + "c_1", 0.0))]
    for name, shape in law.shapes().items():
        near = [s for s in shape.simple if abs(s - values[name]) < SIGNIFICANT * errors[prefix + name] + 0.02 * s]
        found += [_with_fixed(law, values, name, s) for s in near]
    numbered = law.numbered()
    for k, (c, _, _) in enumerate(numbered):
        if len(numbered) > 1 and abs(values[c]) < SIGNIFICANT * errors.get(prefix + c, 0.0):
            found.append(_without(law, values, k))
    return found


def _whole(law: Law, values: dict[str, float], error: float) -> list[Proposal]:
    """A signal that lags or is late, where it may be the whole of it: how much of it is nothing to be told."""
    place = law.site.place
    signal = isinstance(place, places.Site) and place.kind in ("signal", "input")
    if len(law.numbered()) > 1 or law.held() or not signal:
        return []
    text = law.groups[0].texts[0]
    late = [v for v in law.site.variables if re.match(rf"\({re.escape(v.scaled)} - (lag|delay|onset)\(", text)]
    whole = Law(law.site, (replace(law.groups[0], held=True),))
    return [
        Proposal(whole, values | {"c_1": -v.size}) for v in late
        if v.unit == law.site.unit and abs(values["c_1"] + v.size) < SIGNIFICANT * error
    ]  # fmt: skip


def _with_fixed(law: Law, values: dict[str, float], name: str, value: float) -> Proposal:
    """The law with a number in place of a shape parameter."""
    groups = list(law.groups)
    k = int(name.rsplit("_", 1)[1]) - 1
    shape = name.rsplit("_", 1)[0]
    texts = tuple(text.replace(f"{{{shape}}}", f"{value:.4g}") for text in groups[k].texts)
    texts = tuple(text.replace("(1*", "(") for text in texts)
    groups[k] = replace(groups[k], texts=texts, shapes=tuple(s for s in groups[k].shapes if s.name != shape))
    return Proposal(Law(law.site, tuple(groups)), {n: v for n, v in values.items() if n != name})


def _without(law: Law, values: dict[str, float], k: int) -> Proposal:
    """The law without its term k; groups that lose all terms go too."""
    groups, start, count, kept = [], {}, 0, 0
    for n, group in enumerate(law.groups):
        texts = []
        for text in group.texts:
            count += 1
            if count - 1 != k:
                kept += 1
                texts.append(text)
                start[f"c_{kept}"] = values[f"c_{count}"]
        if texts:
            groups.append(replace(group, texts=tuple(texts)))
            start |= {f"{s.name}_{len(groups)}": values[f"{s.name}_{n + 1}"] for s in group.shapes}
    return Proposal(Law(law.site, tuple(groups)), start)
