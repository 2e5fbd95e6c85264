"""Where an effort is missing: the evidence of an unknown effort at every place, over all recordings together."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.values import is_read, is_start, state_of
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.chains import Colour, Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.smoother import Whitener
from lacuna.discovery.efforts.latent.thinned import thinned_all
from lacuna.discovery.efforts.places.opened import Opened
from lacuna.discovery.efforts.places.place import Place
from lacuna.discovery.fit.evidence import SIGMAS
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.side_by_side import side_by_side
from lacuna.runtime import RecordedInput

SIZES = 10.0 ** np.arange(-1.0, 2.1, 0.5)  # of the effort that would explain the misfit by itself: half decades
TIMES = (1 / 300, 1 / 50, 1 / 8)  # of the longest recording: shorter is noise, longer is a constant


@dataclass
class Site:
    """A place or a sensor with its evidence, in nats over no effort at all; `explains` of all that there is to gain."""

    location: str
    kind: str  # effort | sensor
    gain: float
    explains: float
    place: Place | None = None
    effort: dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]] = field(default_factory=dict)  # time, mean, std


class Locator:
    """Places of an opened model on a case; `base` is the fit of the model without any effort, `point` the parameters
    about whose runs it is linearised, if not those that were fitted."""

    def __init__(self, case: Case, opened: Opened, base: Fit, point: dict[str, float] | None = None) -> None:
        self.case, self.opened, self.base, self.point = case, opened, base, point or base.point
        self.free = [f for f in base.estimate.free if f.name in opened.linear.parameters] + self._unknown_starts()
        self.noise = np.array([base.noise[s.column].std for s in case.outputs])
        self.sigma = np.array([f.sigma or f.scale for f in self.free])
        self.sums: dict[int, tuple[int, ...]] = {}  # columns in which one course acts at all places of a family
        pieces = side_by_side(lambda r: self.piece(self.point, r), case.fit)
        self.places = opened.places([p.along for p in pieces])
        families = [p.columns for p in self.places if p.as_one]
        self.sums = dict(enumerate(families, pieces[0].along.drive.shape[2]))
        self.pieces = [replace(p, along=p.along.with_sums(families)) for p in pieces]
        self.null = -np.inf  # log evidence of no effort at all, once places are ranked
        self._chosen: dict[int, tuple[Latent, np.ndarray]] = {}
        self._weighed: tuple[Colour | None, list[Site]] | None = None
        self.colour: Colour | None = None  # errors of sensors, and an effort, that efforts are looked for beside

    def piece(
        self, point: dict[str, float], recording: Recording, efforts: Sequence[tuple[int, np.ndarray]] = ()
    ) -> Piece:
        """The linear model about a run from `point` with efforts (column, course), and what is left for them."""
        opened, time = self.opened, recording.time
        acting: dict[int, np.ndarray | float] = {}
        for column, course in efforts:
            for own in self.sums.get(column, (column,)):
                acting[own] = acting.get(own, 0.0) + course
        drive = {opened.linear.inputs[column]: RecordedInput(time, course, "hold") for column, course in acting.items()}
        along = opened.linear.along(point, recording, drive).with_sums([*self.sums.values()])
        left = np.stack(
            [recording.columns[c] - opened.linear.of(v, along) for c, v in opened.machine.columns.items()], 1
        )
        left = left + response(along, efforts)
        inputs, count = len(opened.linear.inputs), sum(not is_start(f.name) for f in self.free)
        answers = along.response(np.arange(inputs, inputs + count), np.ones((len(time), count)))
        answers = np.concatenate([answers, self._from_starts(along, recording)], axis=2) * self.sigma
        believed = np.array([(f.centre - point[f.name]) for f in self.free]) / self.sigma
        data = np.concatenate([(left - answers @ believed)[:, :, None], -answers], axis=2)
        return Piece(along, data, self.noise, self._start(recording, along.read.shape[2]))

    def _unknown_starts(self) -> list[Free]:
        """States that nobody knows at the first sample: as parameters, which may be anywhere within their size, or as
        far as they were fitted from where they were sought. Those of pieces stay where they were fitted: an effort puts
        a piece right with what it does first."""
        if any(r.after_gap for r in self.case.fit):
            return []
        unknown = (f for f in self.base.estimate.free if is_start(f.name) and not f.sigma)
        found = [(f, self.point[f.name]) for f in unknown if self._state(f.name) is not None]
        return [replace(f, centre=x, scale=max(f.scale, abs(x - f.centre))) for f, x in found]

    def _state(self, start: str) -> tuple[int, int] | None:
        """Number and sense of the state whose start value has this name; None where the linear model has none such."""
        states, (kept, sense) = self.opened.linear.states, self._alias(state_of(start))
        return (states.index(kept), sense) if kept in states else None

    def _alias(self, name: str) -> tuple[str, int]:
        return self.opened.linear.prepared.aliases.get(name, (name, 1))

    def _from_starts(self, along: Along, recording: Recording) -> np.ndarray:
        """(n, y, j): outputs to each of the j unknown starts of all recordings; nothing to those of others."""
        starts = [f.name for f in self.free if is_start(f.name)]
        result = np.zeros((len(along.time), along.read.shape[1], len(starts)))
        own = [k for k, name in enumerate(starts) if is_read(name, recording)]
        found = [self._state(starts[k]) for k in own]
        if own:
            result[:, :, own] = along.from_start([n for n, _ in found]) * [sense for _, sense in found]
        return result

    def _start(self, recording: Recording, count: int) -> np.ndarray:
        """Standard deviations of the states at the first sample: that of the noise where they are recorded."""
        result, machine = np.zeros(count), self.base.machine
        for name, sample in machine.uncertain_states(recording).items():
            kept, _ = self._alias(name)
            if sample is not None and kept in self.opened.linear.states:
                result[self.opened.linear.states.index(kept)] = self.base.noise[machine.recorded(name)].std
        return result

    def ranked(self) -> list[Site]:
        """Places and sensors, best first; weighed once beside the same errors of sensors."""
        if self._weighed is None or self._weighed[0] is not self.colour:
            self._weighed = self.colour, self._rank()
        return list(self._weighed[1])

    def _rank(self) -> list[Site]:
        self._chosen = {}
        hypotheses, owners = self.hypotheses()
        thin = thinned_all(self.pieces)
        found = evidence(thin, hypotheses)
        self.null = null = float(found.log[-1])
        samples = sum(np.isfinite(p.data[:, :, 0]).sum() for p in thin)
        whole = max(-0.5 * samples - null, 1e-9)
        result = []
        for owner in dict.fromkeys(owners[:-1]):
            mine = [k for k, o in enumerate(owners) if o == owner and np.isfinite(found.log[k])]
            best = max(mine, key=lambda k: found.log[k], default=None)
            if best is None:
                continue
            gain = float(found.log[best]) - null
            kind, number = owner
            place = self.places[number] if kind == "effort" else None
            location = place.location if place else f"sensor:{self.case.outputs[number].column}"
            site = Site(location, kind, gain, max(0.0, min(1.0, gain / whole)), place)
            self._chosen[id(site)] = hypotheses.of([best]), found.mean[best]
            result.append(site)
        return sorted(result, key=lambda s: -s.gain)

    def latent(self, site: Site) -> Latent:
        """The effort, or the error of a sensor, that explains most at a place that was ranked."""
        return self._chosen[id(site)][0]

    def hypotheses(self) -> tuple[Latent, list[tuple[str, int]]]:
        longest = max(p.along.time[-1] - p.along.time[0] for p in self.pieces)
        misfit, rows, owners = self.size([p.data[:, :, 0] for p in self.pieces]), [], []
        for number, place in enumerate(self.places):
            size = self.size([self._answer(p, place) for p in self.pieces])
            if size == 0:  # nothing of it is recorded
                continue
            unit = misfit / size
            for columns in (place.columns, *((k,) for k, own in self.sums.items() if own == place.columns)):
                rows += [(columns, -1, s * unit, t * longest) for s in SIZES for t in TIMES]
                owners += [("effort", number)] * (len(SIZES) * len(TIMES))
        for number in range(len(self.case.outputs)):
            rows += [((), number, s * misfit * self.noise[number], t * longest) for s in SIZES for t in TIMES]
            owners += [("sensor", number)] * (len(SIZES) * len(TIMES))
        rows.append(((), -1, 0.0, longest))
        columns, sensor, size, time = zip(*rows, strict=True)
        widest = max(1, *map(len, columns))
        column = np.array([[*own, *[-1] * (widest - len(own))] for own in columns])
        colour = self.colour.of([0] * len(size)) if self.colour else None
        return Latent(column, np.array(sensor), np.array(size), np.array(time), colour), [*owners, ("none", 0)]

    def _answer(self, piece: Piece, place: Place) -> np.ndarray:
        """(n, y) outputs to an effort of one at a place, to first order; of a family the root of what the squares of
        its members' add up to."""
        each = piece.along.response(np.array(place.columns), np.ones((len(piece.along.time), len(place.columns))))
        return np.sqrt(np.sum(each**2, axis=2))

    def white(self, site: Site) -> bool:
        """Whether what the effort at this place leaves has no memory from one sample to the next."""
        latent, mean = self._chosen[id(site)]
        pieces = thinned_all(self.pieces)
        left = Whitener(pieces, latent).innovations(
            [p.data[:, :, :1] + p.data[:, :, 1:] @ mean[:, None] for p in pieces]
        )
        for sensor in range(len(self.noise)):
            rows = [x[:, sensor, 0][np.isfinite(x[:, sensor, 0])] for x in left]
            power, count = sum(r @ r for r in rows), sum(map(len, rows))
            if abs(sum(r[1:] @ r[:-1] for r in rows)) > SIGMAS * power / np.sqrt(count):
                return False
        return True

    def size(self, outputs: list[np.ndarray]) -> float:
        """RMS over samples and outputs, in units of noise."""
        return float(np.sqrt(np.nanmean(np.concatenate([o / self.noise for o in outputs]) ** 2)))

    def beside(self, locator: Locator, site: Site) -> Locator:
        """Itself, where efforts are looked for beside the one that `locator` found at a place, or in a reading."""
        none = Colour(np.zeros(0, dtype=int), np.zeros((1, 0)), np.zeros((1, 0)))
        there = copy(self)
        there.colour = (self.colour or none).beside(locator.latent(site))
        return there


def response(along: Along, efforts: Sequence[tuple[int, np.ndarray]]) -> np.ndarray:
    """(n, y) outputs to efforts (column, course), to first order."""
    answers = (along.response(np.array([c]), effort[:, None], hold=True)[:, :, 0] for c, effort in efforts)
    return sum(answers, np.zeros(along.read.shape[:2]))
