"""A law found without listening to one sensor, and what is wrong with that sensor.

An error of a sensor and a law beside it bend each other: alone, the law stands for both as well as it can, and so does
the error. The other sensors know nothing of that error. So where an error of any course in one reading, beside an
effort at a place, tells more than two efforts do, the law is sought in what the others say, and is then held against
the sensor that was not heard.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, CaseError, Signal
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.efforts.find import TRIED, Found, add_laws, places_of, simplest
from lacuna.discovery.efforts.instruments import NATS
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.fit.evidence import pays, within_instruments
from lacuna.discovery.fit.fit import Fit, linearised
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.law.together.several import finding
from lacuna.discovery.naming.comparison import MIN_GAIN
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding, Naming, compete, screen_all
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


def to_be_left_out(found: Found, told: float, progress: Progress) -> Signal | None:
    """Of the sensors whose errors explain most by themselves, the one of which an error beside an effort at a place has
    the most log evidence, if that is more than what was `told`; None where there is none, or no other sensor."""
    locator = found.locator
    sensors = [s for s in found.sites if s.place is None and s.gain > NATS]
    if locator is None or len(locator.case.outputs) < 2:
        return None
    best = None
    for site in sensors[:TRIED]:
        progress(f"locating beside {site.location}")
        try:
            there = locator.beside(locator, site)
            efforts = simplest(there.ranked())
        except (NotNumeric, SimulationError, np.linalg.LinAlgError):
            continue
        log = there.null + efforts[0].gain if efforts else -np.inf
        if log > told + NATS:
            best, told = site, log
    return None if best is None else next(s for s in locator.case.outputs if f"sensor:{s.column}" == best.location)


def beside_error(unbegun: Search, sensor: Signal, library: Library, progress: Progress) -> Search | None:
    """A search that has found a law by the other sensors, and an error of this one; None where either is not needed, or
    they do not pay."""
    progress(f"looking for a law without {sensor.column}")
    try:
        law = _law_without(unbegun, sensor, library, progress)
        with_law = law and _with(unbegun, law)
    except (CaseError, Diagnostic, SimulationError):
        return None
    naming = with_law and _errors_of(unbegun, sensor, with_law, progress)
    if not naming or naming.simplest is None or naming.simplest.score > -MIN_GAIN:
        return None
    ranked, base = naming.simplest, unbegun.fit
    between, after = (try_judge(f.machine, f.point) for f in (with_law, ranked.fit))
    if between is None or after is None:
        return None
    own = finding(replace(law, machine=ranked.fit.machine, fit=ranked.fit), base, unbegun.judgement, between)
    trial = replace(unbegun, findings=[own, Finding(ranked, naming, between, after)], namings=[])
    trial.take([law.attachment, ranked.attachment], ranked.fit, after)
    trial.drop_needless(progress)
    told = pays(left_out(unbegun.case, base), left_out(unbegun.case, trial.fit), unbegun.floor)
    return trial if told and len(trial.findings) > 1 else None


def _law_without(unbegun: Search, sensor: Signal, library: Library, progress: Progress) -> Candidate | None:
    """The best law by the other sensors; None where it leaves more of them than instruments are off by."""
    case = without_sensor(unbegun.case, sensor)
    base, lead = fit_believed(case, unbegun.fit.machine.amended(unbegun.amendment, case))
    if not lead.direct or base.machine.case is not case:
        return None
    found = places_of(case, unbegun.amendment, base, library, progress)
    add_laws(found, case, unbegun.amendment, base, progress)
    law = found.laws[0] if found.laws else None
    return law if law is not None and within_instruments(law.fit) else None


def without_sensor(case: Case, sensor: Signal) -> Case:
    """The case as if this sensor were not there: states that it was to give the start of start anywhere."""

    def unknown(starts: dict[str, float | str]) -> dict[str, float | str]:
        named = (sensor.column, sensor.variable)
        return {n: "unknown" if v == "recorded" and n in named else v for n, v in starts.items()}

    signals = {c: s for c, s in case.signals.items() if c != sensor.column}
    own = {name: replace(o, initial=unknown(o.initial)) for name, o in case.own.items()}
    noise = {c: n for c, n in case.noise.items() if c != sensor.column}
    return replace(case, signals=signals, initial=unknown(case.initial), own=own, noise=noise)


def _with(unbegun: Search, law: Candidate) -> Fit | None:
    """The law in the model that all sensors are held against, as a fit that does not move."""
    base = unbegun.fit
    amendment = replace(unbegun.amendment, attachments=[*unbegun.amendment.attachments, law.attachment])
    machine = base.machine.amended(amendment)
    free, fixed = [*base.estimate.free, *law.free], base.fixed | law.fixed
    return linearised(machine, unbegun.case.fit, base.noise, free, fixed, base.point | law.fit.point)


def _errors_of(unbegun: Search, sensor: Signal, base: Fit, progress: Progress) -> Naming:
    """What may be wrong with the sensor, beside the law that `base` has."""
    case, amendment = unbegun.case, base.machine.amendment
    every = enumerate_attachments(case, amendment.structure, unbegun.effects, amendment)
    own = [a for a in every if a.variable == sensor.variable]
    candidates, _ = screen_all(case, amendment, own, base, progress)
    return compete(case, candidates, base, progress=progress)
