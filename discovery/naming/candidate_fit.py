"""The fit of a hypothesis: the base's parameters and the effect's together, from a screened start."""

from __future__ import annotations

from lacuna.discovery.case.cases import Case
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.fit.objective import Objective
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.naming.comparison import Progress
from lacuna.discovery.naming.screen import Candidate

SMALL_STEP = 0.1  # of a start that is predicted to first order, which may still hold where the whole of it does not


def fit_candidate(
    case: Case, base: Fit, stages: int, iterations: int, progress: Progress, candidate: Candidate
) -> Fit | None:  # fmt: skip
    """Fit the base's parameters and the effect's together, from the screened start; what has settled stays."""
    if candidate.fit is not None and candidate.fit.settled:
        return candidate.fit
    progress(f"fitting {candidate.attachment.label}")
    free: list[Free] = [*base.estimate.free, *candidate.free]
    start = candidate.fit.point if candidate.fit is not None else _start(case, base, candidate)
    fixed = base.fixed | candidate.fixed
    return fit(
        candidate.machine, case.fit, base.noise, free, fixed, start=start, stages=stages, iterations=iterations,
        known=(candidate.fit or base).sensitivities(),
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
