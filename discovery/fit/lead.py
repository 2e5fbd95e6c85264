"""How a fit is led where events make the sum of squares rough.

Trackers hold a shaft near its recorded motion and are released step by step. Where no sensor records a motion, the
recordings are fitted from their beginning on, a little more each time, so that the simulated motion never runs away
from what was recorded. Hypotheses are compared on a fit that is held: edges stay where they are, and misfit shows.

Where it is rough because a run slips out of phase, or leaves where it was linear, multiple shooting leads (H. G. Bock,
Recent advances in parameter identification techniques for O.D.E., in: Numerical Treatment of Inverse Problems,
Birkhaeuser 1983): recordings in pieces, whose states at their first samples are free, which are joined step by step.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.gaps import JOINED, MIN_SAMPLES, in_pieces
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.thinning import MOST
from lacuna.discovery.case.values import is_start, state_of
from lacuna.discovery.catalogue.attachment import OWN
from lacuna.discovery.fit.evidence import LEFT, nearly_noise, out_of_phase, outside_belief
from lacuna.discovery.fit.fit import Fit, believed, falling_bandwidths, fit
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import Objective, noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.starts import begun, uncertain_starts
from lacuna.runtime import SimulationError

ROUGH = 20  # events a second, from which fits are led
FAST, HELD = 1, 2  # which of the bandwidths holds the shafts for sensitivities, and while hypotheses are compared
SHARES = (0.02, 0.04, 0.08, 0.16, 0.3, 0.55, 1.0)  # of the recordings' lengths, fitted one after the other
LOST = 2.5  # level of a signal, from which the simulated motion is taken to have run away,
FOLLOWED = 1.5  # unless another signal is below this level: that one's edges are where they were recorded
BELIEVABLE = 8.0  # sigmas from its believed value, within which a parameter is sought while shafts are held
EARLY = 0.16  # share on which the motion is still held fast by its beginning
PIECES = JOINED**3  # at first: of a few hundred periods, a few
POLYNOMIAL = JOINED**2  # growth from the first quarter of a piece to its last, through two integrators: force to place
ROOM = 60 * MOST  # numbers in a Jacobian: as many as thinning leaves room for

Courses = Mapping[str, Mapping[str, np.ndarray]]  # recording, or what of it is between gaps -> state -> (n,)


@dataclass(frozen=True)
class Lead:
    """`bandwidths` (rad/s) of the trackers, falling to 0, or growing shares of the recordings, or neither.

    Hypotheses are compared at the bandwidth of index `held`.
    """

    bandwidths: tuple[float, ...] = ()
    grows: bool = False
    held: int = HELD

    @property
    def direct(self) -> bool:
        """Whether fits need no lead."""
        return not self.bandwidths and not self.grows

    def fit(
        self, machine: Machine, case: Case, noise: Mapping[str, Noise], free: list[Free], fixed: Mapping[str, float],
        start: Mapping[str, float] | None = None,
    ) -> Fit | None:  # fmt: skip
        """The fit to all of the recordings, led from the beginning."""
        if self.grows:
            return _grown(machine, case, noise, free, fixed, start, SHARES)
        return fit(machine, case.fit, noise, free, fixed, start=start, bandwidths=self.bandwidths or (0.0,))

    def hold(self, base: Fit, like: Fit | None = None) -> Fit:
        """The fit that hypotheses are compared on; it may be to the first share of the recordings only.

        `like` is a fit that is held already: the share is then the same.
        """
        if self.bandwidths:
            return _tracked(base, self.bandwidths[self.held])
        most, lost = (1.0, LOST) if like is None else (_share(like.machine.case), float("inf"))
        return self._begun(base, most, lost) if self.grows else base

    def hold_fast(self, base: Fit) -> Fit:
        """The fit with the motion held as much as the lead can: where sensitivities are smooth."""
        if self.bandwidths:
            return _tracked(base, self.bandwidths[FAST])
        return self._begun(base, EARLY, float("inf")) if self.grows else base

    def release(self, machine: Machine, case: Case, base: Fit, free: list[Free], held: Fit) -> Fit | None:
        """The fit to all of `case` by a machine of it, from where a fit that was held has ended."""
        fixed = {n: v for n, v in held.fixed.items() if not n.startswith(OWN)}
        if self.bandwidths:
            ladder = self.bandwidths[self.held + 1 :]
            return fit(machine, case.fit, base.noise, free, fixed, start=held.point, bandwidths=ladder)
        share = _share(held.machine.case)
        return _grown(machine, case, base.noise, free, fixed, held.point, [s for s in SHARES if s > share] or [1.0])

    def _begun(self, base: Fit, most: float, lost: float) -> Fit:
        """The fit to the largest share, up to `most`, on which some signal still follows the recorded one; or to the
        first on which what is missing shows."""
        case, machine = base.machine.case, base.machine
        start = {f.name: base.point[f.name] for f in base.estimate.free if not f.sigma}
        kept = base
        for share in [s for s in SHARES if s <= most]:
            short = cut(case, share)
            here = machine if share == 1.0 else machine.amended(machine.amendment, short)
            found = fit(here, short.fit, base.noise, base.estimate.free, base.fixed, start=start)
            if found is None or (kept is not base and _astray(found, lost) and not nearly_noise(kept)):
                break
            kept, start = found, found.point
        return kept


def _astray(found: Fit, lost: float) -> bool:
    return max(found.level.values()) > lost and min(found.level.values()) > FOLLOWED


def lead_for(case: Case, machine: Machine, values: Mapping[str, float]) -> Lead:
    """How fits of this machine have to be led; it tracks what it can."""
    if machine.events_per_second(values, case.fit[0]) < ROUGH:
        return Lead()
    if any(machine.motions()):
        return Lead(falling_bandwidths(case, machine))
    return Lead(grows=True)


def cut(case: Case, share: float) -> Case:
    """The case with the first share of each recording that may be fitted."""
    return case if share == 1.0 else replace(case, fit=[_first(r, share) for r in case.fit])


def _first(recording: Recording, share: float) -> Recording:
    count = max(int(len(recording.time) * share), 16)
    columns = {n: v[:count] for n, v in recording.columns.items()}
    time, name = recording.time[:count], f"{recording.name}@{share:g}"
    drives = {c: (t[t <= time[-1]], v[t <= time[-1]]) for c, (t, v) in recording.drives.items()}
    return replace(recording, name=name, time=time, columns=columns, drives=drives)


def _share(case: Case) -> float:
    return float(case.fit[0].name.rpartition("@")[2]) if "@" in case.fit[0].name else 1.0


def _grown(
    machine: Machine, case: Case, noise: Mapping[str, Noise], free: list[Free], fixed: Mapping[str, float],
    start: Mapping[str, float] | None, shares: tuple[float, ...] | list[float],
) -> Fit | None:  # fmt: skip
    found = None
    for share in shares:
        found = fit(machine, cut(case, share).fit, noise, free, fixed, start=found.point if found else start)
    return found


def _tracked(base: Fit, bandwidth: float) -> Fit:
    """The fit with trackers of this bandwidth in place."""
    machine = base.machine
    objective = Objective(machine, machine.case.fit, base.noise)
    objective.track(bandwidth, base.point)
    fixed, free = base.fixed | objective.stiffness, [_near_belief(f, base.point[f.name]) for f in base.estimate.free]
    return fit(machine, machine.case.fit, base.noise, free, fixed, start=base.point) or base


def _near_belief(free: Free, value: float) -> Free:
    """A parameter kept to what is believed of it, or to where it is: a shaft that is held follows its recorded motion
    all the better, the less the machine has to say."""
    if not free.sigma:
        return free
    reach = max(BELIEVABLE * free.sigma, abs(value - free.centre))
    return replace(free, lower=max(free.lower, free.centre - reach), upper=min(free.upper, free.centre + reach))


def fit_believed(case: Case, machine: Machine) -> tuple[Fit, Lead]:
    """The believed model's best fit, in pieces too where it may be out of phase, and how fits of it are led."""
    noise = noise_of(case)
    free, fixed = believed(case, machine)
    lead = lead_for(case, machine, fixed | {f.name: f.centre for f in free})
    best = lead.fit(machine, case, noise, free, fixed)
    if lead.direct and (best is None or out_of_phase(best)):
        other = joined(machine, case, noise, free, fixed)
        best = other if other is not None and other.machine is not machine else _better(best, other)
    if best is None:
        said = f"{case.model} cannot be simulated with the recorded inputs of {case.label} at the believed values"
        raise CaseError(f"{said}: look at [parameters] and [initial] of case.toml, and at the units of time and inputs")
    return _nearer_belief(best), lead


def _better(one: Fit | None, other: Fit | None) -> Fit | None:
    if one is None or (other is not None and other.deviance() < one.deviance()):
        return other
    return one


def _nearer_belief(found: Fit) -> Fit:
    """A fit that leaves noise, begun anew from belief and the best of the rest: a dip is no finding."""
    free = found.estimate.free
    if not (outside := outside_belief(found)) or not nearly_noise(found):
        return found
    fitted = partial(fit, found.machine, found.machine.case.fit, found.noise)
    there = found.fixed | {f.name: f.centre for f in free if f.name in outside}
    held = fitted([f for f in free if f.name not in outside], there, start=found.point)
    other = held and fitted(free, found.fixed, start=held.point)
    return _better(found, other)


def joined(
    machine: Machine, case: Case, noise: Mapping[str, Noise], free: list[Free], fixed: Mapping[str, float],
    start: Mapping[str, float] | None = None, courses: Courses | None = None,
) -> Fit | None:  # fmt: skip
    """The fit to all of the recordings by multiple shooting. Pieces begin on `courses` of the states, without them on
    those of a run from the start. None where the first pieces cannot be simulated, or the whole.

    Where errors of the states at first grow faster than a power of time (an unstable plant in a closed loop), no run
    can tell what a longer one does, if it can be simulated at all: the fit is then that of the longest pieces in which
    they do not, its machine bound to a case of those."""
    point = dict(fixed) | {f.name: f.centre if f.start is None else f.start for f in free} | dict(start or {})
    courses = _courses(machine, case, point) if courses is None else courses
    known, shorter, before = {f.name for f in free}, None, 0.0
    for count in _counts(case, len(machine.model.states)):
        short = replace(in_pieces(case, count), noise=dict(noise))
        here = machine.amended(machine.amendment, short)
        starts = {r.name: [f for f in _piece_starts(here, r, courses) if f.name not in known] for r in short.fit}
        if shorter is None:
            starts = {r.name: begun(here, r, starts[r.name], point) for r in short.fit}
        found = fit(here, short.fit, noise, [*free, *chain(*starts.values())], fixed, start=point)
        if found is None:
            return shorter
        growth = _growth(found)
        if shorter is not None and growth > np.log(POLYNOMIAL) and _worse(found, shorter):
            return shorter
        if growth > np.log(JOINED) and growth * _power(before, growth) > np.log(POLYNOMIAL):
            return found  # it has grown more than in proportion to time, and will by more than any machine does
        shorter, before = found, growth
        point |= found.point
    return fit(machine, case.fit, noise, free, fixed, start=point)


def _growth(found: Fit) -> float:
    """Logarithm of what an error of a state at the start of a piece grows by, from its first quarter to its last, in
    the outputs: of the state for which that is most, the median of the pieces. Where all of its range moves no output
    by its noise (an angle that nothing depends on), what grows is rounding."""
    grown: dict[str, list[float]] = {}
    for name, columns in found.sensitivities().items():
        for column, recording in zip(columns, found.residuals, strict=True):
            if not (is_start(name) and np.any(column)):
                continue
            rows = len(next(iter(found.residuals[recording].values())))
            size = np.abs(column).reshape(-1, rows).max(axis=0)
            if size.max() < 1.0:
                continue
            first, last = size[: rows // JOINED].max(), size[-(rows // JOINED) :].max()
            grown.setdefault(state_of(name), []).append(np.log(max(last, 1e-300) / max(first, 1e-300)))
    return max((float(np.median(g)) for g in grown.values()), default=0.0)


def _worse(found: Fit, shorter: Fit) -> bool:
    """Whether a fit leaves more of a signal than that of shorter pieces, by more than noise may."""
    return any(found.level[c] > LEFT * shorter.level[c] for c in found.level)


def _power(before: float, growth: float) -> float:
    """By what power the growth rises from pieces to those of JOINED times their length: 1 of a power of time, JOINED
    of an exponential; as it has risen to here."""
    return 1.0 if before <= 0.0 else float(np.clip(growth / before, 1.0, JOINED))


def _counts(case: Case, states: int) -> list[int]:
    """Pieces of each recording, falling: so many that each says something, and that there is room for their starts."""
    rows, recordings = min(len(r.time) for r in (*case.fit, *case.validate)), len(case.fit)
    values = sum(len(r.time) for r in case.fit) * len(case.outputs) * states * recordings
    most = min(PIECES, rows // MIN_SAMPLES, int(ROOM / values)) if states else 0  # what has none, begins nowhere
    joins = int(np.log2(most) / np.log2(JOINED)) if most >= JOINED else 0
    first = most // JOINED ** min(joins, 2) * JOINED ** min(joins, 2)  # so that the pieces of a join are whole
    return [first // JOINED**k for k in range(joins + 1) if first // JOINED**k > 1] if joins else []


def _courses(machine: Machine, case: Case, point: Mapping[str, float]) -> Courses:
    """What the states do from a point; nothing of a recording that does not run."""
    found = {}
    for recording in case.fit:
        with suppress(SimulationError):
            found[recording.piece] = machine.trajectory(point, recording, list(machine.model.states))
    return found


def _piece_starts(machine: Machine, piece: Recording, courses: Courses) -> list[Free]:
    """The start values of a piece; those of states that are not recorded begin on their courses."""
    whole, begin = piece.piece, 0
    if whole not in courses and "+" in whole:  # what comes after a gap has a course of its own
        whole, _, begin = whole.rpartition("+")
    courses_here = courses.get(whole, {})
    found = []
    for f in uncertain_starts(machine, piece, {}):
        course = courses_here.get(state_of(f.name))
        if course is not None and machine.recorded(state_of(f.name)) is None:
            f = replace(f, centre=float(course[int(begin)]), scale=float(np.ptp(course)) or f.scale)
        found.append(f)
    return found
