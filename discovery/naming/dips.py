"""Ground too rough for derivatives: impacts, stick and slip make a sum of squares of many narrow dips.

A fit ends in one of them, and the curvature there says how narrow the dip is, not how well the data determines the
values. So the fit is begun again from beside where it ended: the best of all is taken, and how far apart they end is
an error of its own.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lacuna.discovery.fit.fit import Fit, carried, fit
from lacuna.discovery.fit.solver.free import pulls
from lacuna.discovery.fit.solver.time_limit import TimeUp
from lacuna.discovery.naming.screen import Screen

PROBES = 4  # directions in which the cost is compared with its quadratic form
SIGMAS = 3.0  # how far
SMOOTH = 0.5  # of the predicted rise of the cost, that the actual one may differ by
STARTS = 5  # of fits from beside: their spread is then known to a third of itself
BESIDE = 0.01  # of its value, by which each parameter is moved

Progress = Callable[[str], None]


def is_smooth(found: Fit) -> bool:
    """Whether the cost rises around a fit as its Jacobian says it does, a few standard errors to both sides."""
    estimate = found.estimate
    free = [k for k, f in enumerate(estimate.free) if not estimate.at_bound(f.name)]
    if not estimate.jacobian or not free:
        return True
    screen = Screen(found)
    root = np.linalg.pinv(np.linalg.qr(screen.jacobian[:, free], mode="r"))
    random = np.random.default_rng(1)

    def cost(step: np.ndarray) -> float:
        values = estimate.values.copy()
        for k, z in zip(free, step, strict=True):
            values[k] = estimate.free[k].clip(values[k] + z * estimate.free[k].scale)
        point = found.fixed | {f.name: float(v) for f, v in zip(estimate.free, values, strict=True)}
        data = screen.outputs(found.machine, point)
        return float("inf") if data is None else float(data @ data + np.sum(pulls(estimate.free, values) ** 2))

    here = float(screen.load @ screen.load)
    for _ in range(PROBES):
        direction = random.normal(size=len(free))
        step = root @ (SIGMAS * direction / np.linalg.norm(direction))
        rise = (cost(step) + cost(-step)) / 2 - here  # the slope that is left at the end of a fit cancels
        if abs(rise - SIGMAS**2) > SMOOTH * SIGMAS**2:
            return False
    return True


def explored(found: Fit, progress: Progress) -> tuple[Fit, dict[str, float]]:
    """(the best of several fits begun beside this one, how far apart they end): 1-sigma of each free parameter.

    Fits that end much higher than most say nothing of the ground near the best. Where the time is up, those that
    have been made count.
    """
    random = np.random.default_rng(1)
    fits = [found]
    try:
        for _ in range(STARTS):
            progress("beginning the fit again from beside where it ended")
            start = found.point | {
                f.name: f.clip(v + BESIDE * (abs(v) or f.scale) * random.normal())
                for f, v in zip(found.estimate.free, found.estimate.values, strict=True)
            }
            other = fit(
                found.machine, found.machine.case.fit, found.noise, found.estimate.free, found.fixed, start=start,
                known=found.sensitivities(), renewed=False,
            )  # fmt: skip
            if other is not None:
                fits.append(other)
    except TimeUp:
        pass
    best = min(fits, key=Fit.deviance)
    above = np.array([f.deviance() - best.deviance() for f in fits])
    near = [f for f, a in zip(fits, above, strict=True) if a <= 2 * np.median(above) and f is not best]
    apart = np.array([f.estimate.values - best.estimate.values for f in near]).reshape(-1, len(best.estimate.values))
    spread = np.sqrt(np.mean(apart**2, axis=0)) if len(apart) else np.zeros(apart.shape[1])
    scatter = {f.name: float(s) for f, s in zip(best.estimate.free, spread, strict=True)}
    return found if best is found else _carried_on(best), scatter


def _carried_on(best: Fit) -> Fit:
    """The fit with a Jacobian of where it ends; as it is where the time is up."""
    try:
        return best if best.estimate.converged else carried(best, best.machine) or best
    except TimeUp:
        return best
