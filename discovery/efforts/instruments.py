"""Whether what a fit leaves may be the instruments' own: noise with a memory and drifts, of a level that nobody gave,
and channels that are read early or late.

Two answers are weighed by their evidence, over all recordings together: sensors have errors of their own, chains with
sizes and time constants that the data chooses; or, beside these, an effort is missing at one place of the equations. An
effort reaches the outputs through the machine, all of them at once, and errors of sensors do not: so the colour of the
noise is estimated beside the physics and cannot eat it. What no instrument is off by is no error of one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.values import is_parameter
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.efforts.clocks import with_clocks
from lacuna.discovery.efforts.latent.chains import Colour, Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.latent.thinned import thinned_all
from lacuna.discovery.efforts.located import SIZES, TIMES, Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.fit.evidence import INSTRUMENTS, may_be_instruments, within_instruments
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.naming.comparison import MIN_GAIN
from lacuna.runtime import SimulationError

SAMPLES = 600, 600  # of all recordings together: what is weighed are tens of nats, and noise is slow where it matters
STEPS = (1.0, 0.5)  # half decades of size and time constant, in which a chain is sought: as near as tells a nat
WORST = 0.05  # of its span, that an error of an instrument may have: the worst class of IEC 60051 (class 5)
NATS = MIN_GAIN / 2  # of log evidence, below which nothing is believed to be there

Rows = tuple[np.ndarray, np.ndarray]  # (sizes (h,), times (h,)) that one chain is tried with


def only_instruments(case: Case, amendment: Amendment, fit: Fit) -> bool:
    """Whether what `fit`, that of `amendment`, leaves may be noise of an unknown level with a colour of its own.

    False where given levels are exceeded by more than instruments are off by, where it comes in bursts, and where no
    place of the equations is open.
    """
    if fit.only_instruments is None:
        locator = locator_of(case, amendment, fit) if may_be_instruments(fit) else None
        fit.only_instruments = locator is not None and bool(locator.places) and weighed(locator) < NATS
    return fit.only_instruments


def theirs(fit: Fit) -> bool:
    """Whether what a fit leaves may be what instruments are off by beside their noise: by its size, or as colour."""
    return within_instruments(fit) or is_colour(fit)


def is_colour(fit: Fit) -> bool:
    """Whether evidence says so of what a fit leaves, where nobody gave the level of some noise: what is coloured has no
    size to go by."""
    unknown = not all(noise.given for noise in fit.noise.values())
    return unknown and only_instruments(fit.machine.case, fit.machine.amendment, fit)


def gained(case: Case, before: tuple[Amendment, Fit], after: tuple[Amendment, Fit]) -> float:
    """Nats that a model has over another one where what either leaves is the instruments' own: what is found in noise
    with a colour has to explain more than the colour does. Minus infinity where one cannot be opened."""
    locators = [locator_of(case, *model) for model in (before, after)]
    if None in locators:
        return -np.inf
    clocks = may_be_instruments(before[1])
    without, with_it = (_fitted(_pieces(x, clocks), _NOTHING, _worst(x))[1] for x in locators)
    return with_it - without


def log_evidence(case: Case, amendment: Amendment, fit: Fit) -> float:
    """Log evidence of a fitted model with nothing else missing, on the scale on which places are ranked. Minus infinity
    where it cannot be opened."""
    locator = locator_of(case, amendment, fit)
    return -np.inf if locator is None else float(evidence(thinned_all(locator.pieces), _NOWHERE).log[0])


def locator_of(case: Case, amendment: Amendment, fit: Fit) -> Locator | None:
    """Where efforts are looked for in a fitted model, about its own runs; None where it cannot be opened."""
    try:
        common = [f.name for f in fit.estimate.free if is_parameter(f.name)]
        return Locator(case, opened(case, amendment, case.library(), common, fit.machine), fit)
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None


def weighed(locator: Locator) -> float:
    """What an effort at any place explains beside the instruments' own errors, in nats over these alone. It is sought
    beside those, which may have had to stand for it, and beside none."""
    pieces, worst = _pieces(locator, may_be_instruments(locator.base)), _worst(locator)
    alone, log = _fitted(pieces, _NOTHING, worst)
    begun = (_with_effort(locator, pieces, colour) for colour in (alone.colour, _NOTHING.colour))
    return max(_fitted(pieces, effort, worst)[1] for effort in begun) - log


def colour_of(locator: Locator) -> Colour:
    """Errors of instruments with a memory, as they are beside an effort at the best place."""
    pieces = _pieces(locator, False)
    return _fitted(pieces, _with_effort(locator, pieces, _NOTHING.colour), _worst(locator))[0].colour


def _pieces(locator: Locator, clocks: bool) -> list[Piece]:
    """What is weighed; with errors of the channels' `clocks`, where no more is left than instruments are off by: of a
    larger misfit a delay that is missing could say the same."""
    return thinned_all(with_clocks(locator) if clocks else locator.pieces, SAMPLES)


def _worst(locator: Locator) -> np.ndarray:
    """(outputs,) the largest errors with a memory that instruments have, by their spans or by noise that is given."""
    courses = [[r.columns[s.column] for r in locator.case.fit] for s in locator.case.outputs]
    spans = np.array([np.nanmax(np.concatenate(c)) - np.nanmin(np.concatenate(c)) for c in courses])
    given = np.array([locator.base.noise[s.column].given for s in locator.case.outputs])
    return np.where(given, np.sqrt(INSTRUMENTS**2 - 1.0) * locator.noise, WORST * spans)


_NOWHERE = Latent(np.array([[-1]]), np.array([-1]), np.zeros(1), np.ones(1))
_NOTHING = replace(_NOWHERE, colour=Colour(np.zeros(0, dtype=int), np.zeros((1, 0)), np.zeros((1, 0))))


def _with_effort(locator: Locator, pieces: list[Piece], colour: Colour) -> Latent:
    """The place, size and time constant of the effort that explains most beside these errors of sensors."""
    rows, _ = locator.hypotheses()
    efforts = np.flatnonzero(rows.width > 0)
    tried = replace(rows.of(efforts), colour=colour.of([0] * len(efforts)))
    return tried.of([int(np.nanargmax(evidence(pieces, tried).log))])


def _fitted(pieces: list[Piece], latent: Latent, worst: np.ndarray) -> tuple[Latent, float]:
    """The hypothesis with as many chains of sensors as the data asks for, none above the `worst` errors that there are;
    and its log evidence."""
    latent, log = _refined(pieces, latent, worst)
    while True:
        trials = [_best(pieces, *_with_chain(pieces, latent, sensor), worst) for sensor in range(len(worst))]
        trial = max(trials, key=lambda t: t[1])
        if trial[1] < log + NATS:
            return latent, log
        latent, log = _refined(pieces, trial[0], worst)


def _with_chain(pieces: list[Piece], latent: Latent, sensor: int) -> tuple[Latent, int, Rows]:
    """A further chain of a sensor, from noise to drift, small to large: what `_best` takes."""
    longest = max(p.along.time[-1] - p.along.time[0] for p in pieces)
    colour, more = latent.colour, np.ones((1, 1))
    own = Colour(np.append(colour.sensor, sensor), np.hstack([colour.size, more]), np.hstack([colour.time, more]))
    rows = _grid(SIZES * pieces[0].noise[sensor], longest * np.array(TIMES))
    return replace(latent, colour=own), len(colour.sensor), rows


def _refined(pieces: list[Piece], latent: Latent, worst: np.ndarray) -> tuple[Latent, float]:
    """Its chains moved one after the other while that is better, in ever finer steps."""
    log = float(evidence(pieces, latent).log[0])
    for step in STEPS:
        around, before = 10 ** (0.5 * step * np.array([-1.0, 0.0, 1.0])), -np.inf
        while log > before:
            before = log
            for k in range(len(latent.colour.sensor)):
                size, time = latent.colour.size[0, k], latent.colour.time[0, k]
                latent, log = _best(pieces, latent, k, _grid(size * around, time * around), worst)
    return latent, log


def _grid(sizes: np.ndarray, times: np.ndarray) -> Rows:
    size, time = np.meshgrid(sizes, times, indexing="ij")
    return size.ravel(), time.ravel()


def _best(pieces: list[Piece], latent: Latent, k: int, rows: Rows, worst: np.ndarray) -> tuple[Latent, float]:
    """The hypothesis with chain k at the best of these rows, and its log evidence."""
    tried = latent.of([0] * len(rows[0]))
    colour = tried.colour
    colour.size[:, k], colour.time[:, k] = np.minimum(rows[0], worst[colour.sensor[k]]), rows[1]
    log = evidence(pieces, tried).log
    best = int(np.nanargmax(log))
    return tried.of([best]), float(log[best])
