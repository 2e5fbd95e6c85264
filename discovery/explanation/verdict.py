"""The verdict: from the findings and what the fitted model leaves."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.find import INDIFFERENT
from lacuna.discovery.efforts.instruments import NATS, gained, log_evidence, only_instruments
from lacuna.discovery.efforts.located import Site
from lacuna.discovery.explanation.contenders import is_anywhere
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.input_error import moved_as_one, offset_instead
from lacuna.discovery.explanation.wording import at
from lacuna.discovery.fit.evidence import (
    CLEARLY,
    LEAST_TAKEN,
    astray,
    common_correlation,
    like_noise,
    nearly_noise,
    pays,
    repeats,
    settled,
    whiteness,
    within_instruments,
)
from lacuna.discovery.fit.fit import Fit, nrmse
from lacuna.discovery.fit.solver.free import pulls
from lacuna.discovery.fit.zeros import zeros_of
from lacuna.discovery.law.law import law_at
from lacuna.discovery.naming.comparison import TIE, Ranked, price, score
from lacuna.discovery.naming.foretold import foretold
from lacuna.discovery.naming.judge import Judgement
from lacuna.discovery.naming.screen import Candidate


def decide(result: Explanation) -> None:
    """The verdict, from the findings and the whiteness of what is left."""
    if result.instead and not _equations_may_be_wrong(result) and _holds(result):
        result.verdict = "missing_physics"
        return
    small = _accuses_sensors(result) and nearly_noise(result.base)  # an error that is smaller than its noise is none
    if result.findings and (small or _is_colour(result) or _is_refuted(result)):
        _believe_again(result)
    if result.findings:
        _conclude_from_findings(result)
        return
    worst = _worst(result)
    if worst or not _holds(result):
        result.verdict = "undetermined"
        where = f"the residual of {worst}" if worst else "what is left of the recordings that were not fitted to"
        result.reason = result.reason or f"{where} is not noise, and no effect of the catalogue explains it"
        result.experiment = "record the same motion with the quantities that are not recorded now"
    else:
        result.verdict = "consistent"


def _worst(result: Explanation) -> str:
    """The output whose residual is least like noise; "" where all are, or are no more than noise."""
    left = [w for w in whiteness(result.final).values() if not w.passed]
    return max(left, key=lambda w: w.ratio / w.limit).column if left and not _quiet(result) else ""


def _is_refuted(result: Explanation) -> bool:
    """Whether what was found does not hold on unseen recordings, of which the fitted believed model leaves noise."""
    if pays(*_unseen(result), result.floor):
        return False
    without = copy(result)
    _believe_again(without)
    return not _worst(without) and _holds(without)


def _is_colour(result: Explanation) -> bool:
    """Whether errors of instruments with a memory, noise of an unknown level or what is beside a known one, say as much
    as what was found in them."""
    case, base = result.case, (replace(result.amendment, attachments=[]), result.base)
    if not result.lead.direct or not (within_instruments(result.base) or only_instruments(case, *base)):
        return False
    enough = NATS + sum(f.ranked.candidate.pick for f in result.findings)
    if _disbelief(result.base) - _disbelief(result.final) >= enough:  # to first order it might return at no price
        return False
    return gained(case, base, (result.amendment, result.final)) < enough


def _disbelief(fit: Fit) -> float:
    """Nats by which a fit's parameters speak against it, that are not where they are believed to be."""
    return 0.5 * float(np.sum(pulls(fit.estimate.free, fit.estimate.values) ** 2))


def _holds(result: Explanation) -> bool:
    """Whether the fitted model tells unseen recordings as well as its noise lets it, or its uncertain parameters."""
    attained, samples = _attained(result), sum(len(r.time) for r in result.case.validate)
    if repeats(result.after.validate, attained, result.final, samples):
        return True
    spread = foretold(result.final, result.case.validate)
    within = {c: float(np.hypot(attained[c], spread[c])) for c in attained}
    return repeats(result.after.validate, within, result.final, samples)


def _attained(result: Explanation) -> dict[str, float]:
    """NRMSE on unseen recordings that a model has which errs there as it does on those that it was fitted to."""
    return {c: floor * result.final.level[c] for c, floor in result.floor.items()}


def _conclude_from_findings(result: Explanation) -> None:
    """Physics is missing, unless something speaks against what was found, or for something else as much."""
    if _accuses_sensors(result) and _equations_may_be_wrong(result):
        _withdraw(result, result.findings[0].ranked)
        return
    if doubt := _doubt(result):
        result.verdict, (result.reason, result.experiment) = "undetermined", doubt
        return
    result.verdict = "missing_physics"
    turning = dict.fromkeys(v for f in result.findings if (v := f.ranked.attachment.alike[1]))
    result.experiment = f"record a motion in which {' and '.join(turning)} turns" if turning else ""


def _doubt(result: Explanation) -> tuple[str, str] | None:
    """(why the findings are none, what to record): they do not hold, nearly all of what is missing is left, they are
    tied with another place, or what is recorded of the inputs would do the same. None where nothing of this is."""
    first = result.findings[0]
    label, others = first.ranked.attachment.label, first.naming.ranked[1:]
    if not pays(*_unseen(result), result.floor):
        reason = "explains the recordings that it was fitted to, but does not hold on those that only judge"
        return f"{label} {reason}", experiment_for(first.ranked, others)
    if (taken := _taken(result)) < LEAST_TAKEN:
        reason = (
            f"{label} fits best, but takes only {max(taken, 0):.0%} of the error on unseen recordings that is above "
            "noise away: what is missing is something else"
        )
        return reason, experiment_for(first.ranked, others)
    if all(is_anywhere(result, f) for f in result.findings):
        rivals = first.elsewhere
        names = ", ".join(dict.fromkeys(r.attachment.label for r in rivals[:3]))
        return f"{label} and {names} explain the data equally well", experiment_for(first.ranked, rivals)
    if error := offset_instead(result):
        signal, offset = error
        result.findings[0] = replace(first, instrument=signal.column)
        reason = (
            f"{_told(first.ranked)} does what an offset of {offset:.3g} {signal.model_unit} in the recorded "
            f"{signal.column} would do: physics or an instrument"
        )
        return reason, f"record {signal.column} by a second instrument, or where it is known to be zero"
    if pair := moved_as_one(result):
        own, other = pair
        result.findings[0] = replace(first, moved=other.column)
        proportion = f"which was always in one proportion to {own.column}"
        reason = f"{_told(first.ranked)} may as well be one of {other.column}, {proportion}"
        return reason, f"record a motion in which {own.column} and {other.column} go apart"
    return None


def _told(ranked: Ranked | Candidate) -> str:
    law = law_at(ranked.attachment, ranked.fit.point)
    return f"a term {law} {at(ranked.attachment.location)}" if law else ranked.attachment.label


def _taken(result: Explanation) -> float:
    """Share of the unseen error above noise that the findings take away, in units of the noise of each signal, which
    is known no better than CLEARLY tells: one whose noise is large hides nothing of the others."""
    before, after = _unseen(result)
    above = sum((before[c] - min(f, CLEARLY * before[c])) / f for c, f in result.floor.items())
    return sum((before[c] - after[c]) / f for c, f in result.floor.items()) / above


def _unseen(result: Explanation) -> tuple[dict[str, float], dict[str, float]]:
    """NRMSE on unseen recordings before and after, less the zeros of the sensors that the fits tell beside themselves:
    a small one would hide what a finding takes away."""
    case = result.case

    def error(fit: Fit, judgement: Judgement) -> dict[str, float]:
        zeros, told = zeros_of(fit), judgement.residuals
        left = {r.name: {c: e - zeros[c] for c, e in told[r.name].items()} for r in case.validate}
        return nrmse(case, case.validate, left)

    return error(result.base, result.before), error(result.final, result.after)


def _efforts(result: Explanation) -> list[Site]:
    """Places of the equations, but those of readings: of an error there that of the sensor is another name."""
    sites = result.opened.sites if result.opened else []
    return [s for s in sites if s.place is not None and not s.place.reading]


def _equations_may_be_wrong(result: Explanation) -> bool:
    """Whether a sensor would be accused though places in the equations could not be tried, more than noise is left, or
    a law there, or an effort of any course, explains as much as what was found."""
    efforts = _efforts(result)
    if not efforts:
        return not result.amendment.structure.open
    if astray(result.final) or (result.findings and _rival_law(result)):
        return True
    found = log_evidence(result.case, result.amendment, result.final) - result.opened.null
    sensors = [s.gain for s in result.opened.sites if s.place is None]
    return max(s.gain for s in efforts) > max([*sensors, found]) - INDIFFERENT


def _withdraw(result: Explanation, best: Ranked) -> None:
    """A sensor is not accused where nothing else could be: the believed model stands, and the reason says so."""
    result.verdict = "undetermined"
    result.reason = f"{best.attachment.label} fits best, but " + (
        "leaves far more than noise, and no law was found in the equations"
        if _efforts(result) and astray(result.final)
        else _as_much(result)
        if _efforts(result)
        else "the equations had not been searched yet: it may as well be physics"
        if result.stopped and result.opened is None
        else f"no place in the equations of {result.case.model} was open to this search{_why_closed(result)}: "
        "it may as well be physics"
    )
    result.experiment = "record the same motion with the quantities that are not recorded now"
    _believe_again(result)


def _why_closed(result: Explanation) -> str:
    if result.opened is None:
        return ""
    reasons = [result.opened.reason] if result.opened.reason else [f"{at}: {why}" for at, why in result.opened.closed]
    return f" ({reasons[0]})" if reasons else ""


def _believe_again(result: Explanation) -> None:
    """Put the believed model, as fitted, in the place of what was found."""
    result.findings, result.final, result.after, result.instead = [], result.base, result.before, ()
    result.amendment = replace(result.amendment, attachments=[])


def _accuses_sensors(result: Explanation) -> bool:
    """Whether nothing but sensors is said to be wrong."""
    return all(f.ranked.attachment.variable for f in result.findings)


def _as_much(result: Explanation) -> str:
    """What in the equations explains as much as an error of a sensor."""
    law = _rival_law(result)
    if law is not None:
        return f"{_told(law)} explains as much"
    return f"an effort at {_efforts(result)[0].location} explains as much, for which no law was found"


def _rival_law(result: Explanation) -> Candidate | None:
    """The best law in the equations, where the data does not tell it from what was found. Which law it is does not
    matter: that it was picked among many is no reason against that one of them holds."""
    base, final, places = result.base, result.final, [s.place for s in _efforts(result)]
    laws = [law for law in result.opened.laws if any(p.named(law.attachment.location) for p in places)]
    if not laws:
        return None
    correlation = common_correlation([laws[0].fit, final])
    found = final.deviance(correlation) - base.deviance(correlation)
    found += price(len(final.estimate.free) - len(base.estimate.free), base, correlation)
    picked = sum(2 * f.ranked.candidate.pick for f in result.findings)
    law = min(laws, key=lambda law: score(law, base, correlation) - 2 * law.pick)
    return law if score(law, base, correlation) - 2 * law.pick < found + picked + TIE else None


def _quiet(result: Explanation) -> bool:
    """Whether what is left is no more than noise, though some of it is not white: by its size, which instruments drift
    and are off by; or by its colour, where its level is not given and no effort in the equations explains it better."""
    final, direct = result.final, result.lead.direct
    if within_instruments(final) or settled(final, rough=not direct):
        return True
    if not direct:
        return like_noise(final)
    return only_instruments(result.case, result.amendment, final)


def experiment_for(best: Ranked, rivals: list[Ranked]) -> str:
    """What to record so that tied hypotheses part: the excitation that the catalogue asks for each of them."""
    wanted = dict.fromkeys(
        r.attachment.effect.excitation for r in [best, *rivals[:2]] if r.attachment.effect.excitation
    )
    return "record: " + "; ".join(wanted)
