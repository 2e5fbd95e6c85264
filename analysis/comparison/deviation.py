"""How far two trajectories of the same model lie apart, in signals and in event times."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class SignalDeviation:
    """Candidate minus reference of one signal, in its own unit; `scale` is the magnitude it is relative to."""

    name: str
    maximum: float
    rms: float
    scale: float
    at_time: float
    unit: str = ""

    @property
    def relative(self) -> float:
        """Maximum deviation over the scale (the deviation itself for a signal without one)."""
        return self.maximum / self.scale if self.scale > 0 else self.maximum


@dataclass(frozen=True)
class EventDeviation:
    """Matched events: their number, the largest time difference (s), how many have no partner; what differs most."""

    matched: int
    maximum: float
    unmatched: int
    kind: str = ""
    at_time: float = float("nan")


Events = Sequence[tuple[float, str]]  # time (s) and kind: what happened


def signal_deviation(
    name: str, time: Array, reference: Array, candidate: Array, use: Array, scale: float | None = None, unit: str = ""
) -> SignalDeviation:
    """Maximum and RMS of the difference over the samples marked in `use` (all arrays [n]).

    `scale` defaults to the largest magnitude of the reference.
    """
    if scale is None:
        scale = float(np.nanmax(np.abs(reference), initial=0.0))
    if not use.any():
        return SignalDeviation(name, np.nan, np.nan, scale, np.nan, unit)
    difference = np.abs(candidate - reference)[use]
    worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
    return SignalDeviation(
        name, float(difference[worst]), float(np.sqrt(np.mean(difference**2))), scale, float(time[use][worst]), unit
    )


def event_pairs(reference: Events, candidate: Events) -> tuple[list[tuple[float, float, str]], int]:
    """Times of the events both runs have, with their kind, and how many have no partner.

    The k-th event of a kind is the partner of the k-th; where one run has more of them, its surplus is left out.
    """
    pairs: list[tuple[float, float, str]] = []
    unmatched = 0
    first, second = _by_kind(reference), _by_kind(candidate)
    for kind in sorted(first.keys() | second.keys()):
        ours, theirs = np.array(first.get(kind, [])), np.array(second.get(kind, []))
        if len(ours) < len(theirs):
            theirs = theirs[_partners(ours, theirs)]
        elif len(ours) > len(theirs):
            ours = ours[_partners(theirs, ours)]
        pairs += [(float(a), float(b), kind) for a, b in zip(ours, theirs, strict=True)]
        unmatched += abs(len(first.get(kind, [])) - len(second.get(kind, [])))
    return sorted(pairs), unmatched


def _partners(few: Array, many: Array) -> Array:
    """Which of the instants `many` belong to the `few`, in order and with the least sum of differences [len(few)].

    Partner i of `few` is i + s_i of `many` with s_i not falling: dynamic programming over the shift s.
    """
    shifts = np.arange(len(many) - len(few) + 1)
    cost = np.zeros(len(shifts))
    before = []
    for i, instant in enumerate(few):
        lowest = np.minimum.accumulate(cost)
        before.append(np.maximum.accumulate(np.where(cost == lowest, shifts, 0)))
        cost = lowest + np.abs(many[i + shifts] - instant)
    partners = np.empty(len(few), dtype=int)
    shift = int(np.argmin(cost))
    for i in reversed(range(len(few))):
        partners[i] = i + shift
        shift = before[i][shift]
    return partners


def _by_kind(events: Events) -> Mapping[str, list[float]]:
    grouped: dict[str, list[float]] = defaultdict(list)
    for time, kind in events:
        grouped[kind].append(time)
    return grouped


def event_deviation(reference: Events, candidate: Events) -> EventDeviation:
    """Event times against event times (see `event_pairs`)."""
    pairs, unmatched = event_pairs(reference, candidate)
    if not pairs:
        return EventDeviation(0, 0.0, unmatched)
    ours, theirs, kind = max(pairs, key=lambda pair: abs(pair[0] - pair[1]))
    return EventDeviation(len(pairs), abs(ours - theirs), unmatched, kind, ours)


def outside_event_gaps(time: Array, pairs: Sequence[tuple[float, float, str]]) -> Array:
    """True for samples at which both runs are on the same side of every matched event.

    A signal that jumps at an event differs by the whole jump between the two event times, however small that gap;
    this difference is an event-time deviation, reported as such, and not a deviation of the signal.
    """
    use = np.ones(time.shape, dtype=bool)
    resolution = 4 * np.finfo(float).eps * max(1.0, float(np.max(np.abs(time), initial=0.0)))
    for a, b, _ in pairs:
        low, high = np.searchsorted(time, [min(a, b) - resolution, max(a, b) + resolution])
        use[low:high] = False
    return use


def observed_order(steps: Array, errors: Array, floor: float) -> float:
    """Slope of log error over log step by least squares, over the steps whose error is above `floor`.

    NaN where fewer than two steps are left: a slope through rounding errors says nothing.
    """
    keep = np.isfinite(errors) & (errors > floor)
    if np.count_nonzero(keep) < 2:
        return float("nan")
    return float(np.polyfit(np.log(np.asarray(steps)[keep]), np.log(np.asarray(errors)[keep]), 1)[0])
