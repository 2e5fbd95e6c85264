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
from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.signals import Signal
from lacuna.discovery.efforts.find import Found, add_laws, places_of, simplest
from lacuna.discovery.efforts.instruments import NATS, theirs
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.law_at import TRIED
from lacuna.discovery.efforts.located import Site
from lacuna.discovery.fit.evidence import pays
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.law.empirical_law import unmoved
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.together.several import errors_of_sensors, finding
from lacuna.discovery.naming.comparison import MIN_GAIN
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


def to_be_left_out(
    found: Found, told: float, progress: Progress, among: Callable[[Site], bool] = lambda site: True
) -> Signal | None:
    """Of the sensors whose errors explain most by themselves, the one of which an error beside an effort at one of some
    places has the most log evidence, if that is more than what was `told`; None where there is none, or no other
    sensor."""
    locator = found.locator
    sensors = [s for s in found.sites if s.place is None and s.gain > NATS]
    if locator is None or len(locator.case.outputs) < 2:
        return None
    best = None
    for site in sensors[:TRIED]:
        progress(f"locating beside {site.location}")
        try:
            there = locator.beside(locator, site)
            efforts = [s for s in simplest(there.ranked()) if among(s)]
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
    except (CaseError, Diagnostic, SimulationError):
        return None
    base = unbegun.fit
    beside = law and unmoved(unbegun.case, unbegun.amendment, base, _as_found(law, base))
    if not beside:
        return None
    amendment, with_law = beside
    naming = errors_of_sensors(unbegun, amendment, with_law, progress, only=sensor.variable)
    ranked = naming.simplest
    if ranked is None or ranked.score > -MIN_GAIN:
        return None
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
    return law if law is not None and theirs(law.fit) else None


def _as_found(law: Candidate, base: Fit) -> Proposal:
    """A law that starts where it was fitted to the other sensors, starts that only `base` has as they are there."""
    values = law.attachment.own_values(law.fit.point)
    return Proposal(law.attachment.law, values, point=base.point | law.fit.point)


def without_sensor(case: Case, sensor: Signal) -> Case:
    """The case as if this sensor were not there: states that it was to give the start of start anywhere."""

    def unknown(starts: dict[str, float | str]) -> dict[str, float | str]:
        named = (sensor.column, sensor.variable)
        return {n: "unknown" if v == "recorded" and n in named else v for n, v in starts.items()}

    signals = {c: s for c, s in case.signals.items() if c != sensor.column}
    own = {name: replace(o, initial=unknown(o.initial)) for name, o in case.own.items()}
    noise = {c: n for c, n in case.noise.items() if c != sensor.column}
    return replace(case, signals=signals, initial=unknown(case.initial), own=own, noise=noise)
