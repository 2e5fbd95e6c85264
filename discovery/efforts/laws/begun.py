"""Where the fit of a screened law begins."""

from __future__ import annotations

from dataclasses import replace

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.law.empirical_law import unfitted
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.naming.candidate_fit import SMALL_STEP, nearest
from lacuna.discovery.naming.race import ROUNDS
from lacuna.discovery.naming.screen import Candidate


def begun_at(
    case: Case, amendment: Amendment, base: Fit, proposal: Proposal, led: dict[str, float]
) -> Candidate | None:  # fmt: skip
    """A screened law where its fit begins: with parameters as they were `led` or as the base has them, or with little
    of it, whichever misses by least: a law that is a little off puts free swings out of step. With little of it the
    data says next to nothing of its shapes: these stay until its amounts are found."""
    candidate = unfitted(case, amendment, base, proposal.law, proposal.start, led)
    if candidate is None:
        return None
    here = candidate.start | base.point
    amounts = [candidate.attachment.full_name(c) for c, _, _ in proposal.law.numbered()]
    little = here | {n: SMALL_STEP * here[n] for n in amounts}
    start = nearest(case, base, candidate, candidate.start, here, little)
    if start is little and proposal.law.shapes():
        free = [*base.estimate.free, *(f for f in candidate.free if f.name in amounts)]
        shapes = {f.name: start[f.name] for f in candidate.free if f.name not in amounts}
        stages, iterations, _ = ROUNDS[0]
        fixed = base.fixed | candidate.fixed | shapes
        found = fit(candidate.machine, case.fit, base.noise, free, fixed,
                    start=start, stages=stages, iterations=iterations)  # fmt: skip
        start = start if found is None else start | found.point
    return replace(candidate, start=start)
