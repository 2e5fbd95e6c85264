"""The oracle of random automata: plays them on their closed forms, and judges runs by that."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
import math

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from lacuna.runtime import Result
from tests.events.automata import Automaton, draw

LOOKS = 400  # at each guard, of one stretch: a body swings through at most three periods in it
MOST_EVENTS = 24
PASSES = 20
PLAYS = 8  # with errors


class Rejected(Exception):
    """The draw is no fair question: too many events, or instants that nearly meet."""


@dataclass
class Play:
    """(time, counts of all chains afterwards) of each instant at which one counted, and the states at the end."""

    counts: list[tuple[float, tuple[int, ...]]] = field(default_factory=list)
    end: list[float] = field(default_factory=list)


def play(a: Automaton, moved: Callable[[], Sequence[float]] | None = None) -> Play:
    """`moved`: by how much the states are off, anew on each stretch between events."""
    return _Player(a, moved).play()


class _Player:
    def __init__(self, a: Automaton, moved: Callable[[], Sequence[float]] | None):
        self.a, self.moved = a, moved
        self.t, self.state = 0.0, list(a.start)
        self.n, self.off = [0] * len(a.chains), [0.0] * len(a.start)
        self.held = [g.value(self.state) > 0 for g in a.guards]
        self.conditions = self._conditions(self.n)
        self.tiny = [1e-9 * sum(abs(w) * s for w, s in zip(g.weights, a.sizes, strict=True)) for g in a.guards]

    def _conditions(self, pre: Sequence[int]) -> list[list[bool]]:
        return [
            [self.held[b.guard] and (b.chain < 0 or pre[b.chain] >= b.count) for b in chain] for chain in self.a.chains
        ]

    def at(self, t: np.ndarray | float) -> list:
        found: list = []
        for k, body in enumerate(self.a.bodies):
            force = body.forces[self.n[body.chain] >= body.count]
            found += body.flow(*self.state[2 * k : 2 * k + 2], force, t)
        return [f + o for f, o in zip(found, self.off, strict=True)]

    def play(self) -> Play:
        done = Play()
        for _ in range(MOST_EVENTS):
            if self.moved:
                self.off = list(self.moved())
            ahead, which = self._next()
            if self.t + ahead >= self.a.stop:
                done.end = self.at(self.a.stop - self.t)
                return done
            self.state, self.t = self.at(ahead), self.t + ahead
            before = list(self.n)
            for g in which:
                self.held[g] = not self.held[g]
            self._happen()
            if before != self.n:
                _add(done.counts, self.t, tuple(self.n), self.a.stop)
        raise Rejected("too many events")

    def _happen(self) -> None:
        for _ in range(PASSES):
            pre, state = list(self.n), list(self.state)
            now = self._conditions(pre)
            for c, (chain, was, holds) in enumerate(zip(self.a.chains, self.conditions, now, strict=True)):
                for b, w, h in zip(chain, was, holds, strict=True):
                    if h and not w:
                        self.n[c] = pre[c] + 1
                        for s, factor, addend in b.throws:
                            self.state[s] = factor * state[s] + addend
                        break
            self.conditions = now
            for k, g in enumerate(self.a.guards):
                if abs(g.value(self.state)) > self.tiny[k]:
                    self.held[k] = g.value(self.state) > 0
            if pre == self.n and state == self.state and now == self._conditions(self.n):
                return
        raise Rejected("the event does not settle")

    def _next(self) -> tuple[float, list[int]]:
        """Time to the first crossing, and the guards that cross then."""
        times = np.linspace(0, self.a.stop - self.t, LOOKS)
        states = self.at(times)
        crossings = [self._crossing(k, times, states) for k in range(len(self.a.guards))]
        first = min(crossings, default=math.inf)
        near = [k for k, t in enumerate(crossings) if t - first < 1e-7 * self.a.stop]
        if any(crossings[k] - first > 1e-12 * self.a.stop for k in near):
            raise Rejected("instants nearly meet")
        return first, near

    def _crossing(self, k: int, times: np.ndarray, states: list[np.ndarray]) -> float:
        """When guard k is next on the other side. One that rests at zero leaves it, or goes back, at once."""
        sign, guard, h = (1 if self.held[k] else -1), self.a.guards[k], times[1]

        def margin(t: float) -> float:
            return sign * guard.value(self.at(t))

        values = sign * guard.value(states)
        if values[0] <= self.tiny[k]:  # at zero, but for rounding
            early = next((t for j in range(40, 8, -1) if abs(margin(t := h * 2.0**-j)) > 10 * self.tiny[k]), h)
            if margin(early) < 0:
                return 0.0
            times, values = np.array([early, *times[1:]]), np.array([margin(early), *values[1:]])
        lows = np.flatnonzero((values[1:-1] <= values[:-2]) & (values[1:-1] <= values[2:]) & (values[1:-1] >= 0)) + 1
        ends = np.flatnonzero(values < 0)
        end = int(ends[0]) if len(ends) else len(times)
        for j in lows[lows < end]:  # a dip between two looks?
            low = minimize_scalar(margin, bounds=(times[j - 1], times[j + 1]), method="bounded")
            if low.fun < 0:
                return float(brentq(margin, times[j - 1], low.x, xtol=1e-300, rtol=1e-15))
        return float(brentq(margin, times[end - 1], times[end], xtol=1e-300, rtol=1e-15)) if len(ends) else math.inf


def _add(counts: list[tuple[float, tuple[int, ...]]], time: float, now: tuple[int, ...], stop: float) -> None:
    """Events as close as that are one instant."""
    if counts and time - counts[-1][0] <= 1e-9 * stop:
        counts.pop()
    counts.append((time, now))


def fair(rng: np.random.Generator, number: int) -> tuple[Automaton, Play]:
    """A draw that counts something, and how it goes."""
    while True:
        a = draw(rng, number)
        try:
            played = play(a)
        except Rejected:
            continue
        if played.counts:
            return a, played


def wrong(a: Automaton, expected: Play, result: Result, rtol: float) -> str:
    """ "" where the run is right within what an error of its steps may do; "error: ..." where it ended with one."""
    if not result.complete:
        return f"error: {result.failure}"
    rng, error = np.random.default_rng(a.number), math.sqrt(2) * rtol * result.counters["steps"]
    reach = [max(s, abs(e)) for s, e in zip(a.sizes, expected.end, strict=True)]
    spread, last = 1e-9 * a.stop, [1e-9 * r for r in reach]
    for _ in range(PLAYS):
        try:
            other = play(a, lambda: [error * r * rng.choice([-1, 1]) for r in reach])
        except Rejected:
            return ""
        if [n for _, n in other.counts] != [n for _, n in expected.counts]:
            return ""
        spread = max([spread, *(3 * abs(p - q) for (p, _), (q, _) in zip(other.counts, expected.counts, strict=True))])
        last = [max(most, 3 * abs(p - q)) for most, p, q in zip(last, other.end, expected.end, strict=True)]
    return _compare(a, result, expected, spread, last)


def _compare(a: Automaton, result: Result, expected: Play, spread: float, last: Sequence[float]) -> str:
    n = np.array([result[f"n{c}"] for c in range(len(a.chains))])
    found: list[tuple[float, tuple[int, ...]]] = []
    for k in np.flatnonzero(np.any(np.diff(n), axis=0)) + 1:
        _add(found, float(result.time[k]), tuple(int(i) for i in n[:, k]), a.stop)
    if [c for _, c in found] != [c for _, c in expected.counts]:
        at = next(
            (k for k, (p, q) in enumerate(zip(found, expected.counts, strict=False)) if p[1] != q[1]),
            min(len(found), len(expected.counts)),
        )
        return f"counts {found[at : at + 1]} for {expected.counts[at : at + 1]} (instant {at})"
    off = max(abs(p - q) for (p, _), (q, _) in zip(found, expected.counts, strict=True))
    if off > spread:
        return f"an instant {off:.3g} s off, budget {spread:.3g} s"
    names = [f"{kind}{k}" for k in range(len(a.bodies)) for kind in "xv"]
    for name, e, most in zip(names, expected.end, last, strict=True):
        if abs(result[name][-1] - e) > most:
            return f"{name} ends at {result[name][-1]!r} for {e!r}, budget {most:.3g}"
    return ""
