"""Plays an event machine by the specification: what its variables are worth between any two events.

Event iteration of appendix B; a state reset at the end of a step of it (8.3.6); a condition that acts where it becomes
true, an earlier branch of a chain before a later one; none of them while the start is computed (8.6).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math
import random

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.machines import Branch, Clock, Crossing, Machine, Values, draw
from tests.fuzz.oracle.terms import Term, value_of

STOP = 1.0
MOST_ROUNDS, MOST_EVENTS = 12, 120
# Instants nearer than this are one or two, as rounding will have it: a run is compared up to there.
APART = 1e-5


@dataclass(frozen=True)
class Stretch:
    """From `begin` on, until the next one: constant values, and states with their rates."""

    begin: float
    values: Values
    states: tuple[float, ...]
    rates: tuple[float, ...]


class Play:
    """The machine from 0 to STOP, or to `until`, where it can no longer be told which of two instants is first."""

    def __init__(self, machine: Machine) -> None:
        self.machine, self.until = machine, STOP
        self.x = list(machine.starts)
        self.holds = {c.text: c.holds(self.x[c.state]) for c in machine.crossings}
        self.conditions: dict[tuple[int, int, int], bool] = {}
        self.values = self._first()
        machine.first = dict(self.values)
        self._step(self.values, (), acts=False)
        self.stretches = list(self._stretches())

    def _first(self) -> Values:
        """Start values that are what the equations give of them: nothing happens at the start."""
        blank = {"I": 1, "B": False, "E": 1, "R": 0.5}
        values: Values = {n: blank[k.base] for n, k in self.machine.kinds.items()}
        for _ in range(MOST_ROUNDS):
            new, _ = self._step(values, (), acts=False)
            if new == values:
                return values
            values = new
        raise m.Unfit

    def _step(self, before: Values, ticks: tuple[str, ...], acts: bool = True) -> tuple[Values, dict[int, float]]:
        """One step of event iteration: the new values, and the states that are reset."""
        scope: Values = {f"pre({n})": v for n, v in before.items()} | dict(self.holds)
        scope |= {c.text: c.text in ticks for c in self.machine.clocks}
        new, resets = dict(before), dict[int, float]()
        for k, step in enumerate(self.machine.steps):
            if isinstance(step, tuple):
                new[step[0]] = _value(step[1], scope)
            else:
                fired = self._fired(k, step, scope, acts)
                for name, term in fired.sets.items() if fired else ():
                    new[name] = _value(term, scope | {n: new[n] for n in fired.sets})
                    scope[name] = new[name]
                resets |= {s: float(_value(t, scope)) for s, t in fired.resets.items()} if fired else {}
            for name in [step[0]] if isinstance(step, tuple) else step[0].sets:
                scope[name] = new[name]
                scope[f"change({name})"] = new[name] != before[name]
                scope[f"edge({name})"] = bool(new[name]) and not before[name]
        return new, resets

    def _fired(self, k: int, branches: list[Branch], scope: Values, acts: bool) -> Branch | None:
        """The first branch of which a condition became true; the others' conditions are noted all the same."""
        fired = None
        for b, branch in enumerate(branches):
            for c, condition in enumerate(branch.conditions):
                now = bool(_value(condition, scope))
                if acts and now and not self.conditions[k, b, c] and fired is None:
                    fired = branch
                self.conditions[k, b, c] = now
        return fired

    def _stretches(self) -> Iterator[Stretch]:
        t = 0.0
        for _ in range(MOST_EVENTS):
            rates = tuple(float(_value(r, self.values)) for r in self.machine.rates)
            yield Stretch(t, dict(self.values), tuple(self.x), rates)
            event, ticks, crossed = self._next(t, rates)
            if event >= STOP or self.until < STOP:
                return
            self.x = [x + rate * (event - t) for x, rate in zip(self.x, rates, strict=True)]
            t = event
            self.holds |= {c.text: not self.holds[c.text] for c in crossed}
            self._iterate(ticks)
        self.until = min(self.until, t)

    def _next(self, t: float, rates: tuple[float, ...]) -> tuple[float, tuple[str, ...], list[Crossing]]:
        """The next instant, with the clocks that tick and the crossings there."""
        instants: list[tuple[float, Clock | Crossing]] = []
        for clock in self.machine.clocks:
            count = max(0, math.floor((t - clock.start) / clock.interval) + 1)
            instants.append((clock.start + count * clock.interval, clock))
        for c in self.machine.crossings:
            gap, towards = c.level - self.x[c.state], rates[c.state]
            if towards and gap / towards > 0 and self.holds[c.text] == ((gap < 0) == c.greater):
                instants.append((t + gap / towards, c))
        first = min((when for when, _ in instants), default=STOP)
        there = [what for when, what in instants if when == first]
        near = sorted(when for when, what in instants if first < when < first + APART)
        levels = {(c.state, c.level) for c in there if isinstance(c, Crossing)}
        if near or (levels and (len(levels) > 1 or any(isinstance(w, Clock) for w in there))):
            self.until = min(self.until, first)
        crossed = [w for w in there if isinstance(w, Crossing)]
        return first, tuple(w.text for w in there if isinstance(w, Clock)), crossed

    def _iterate(self, ticks: tuple[str, ...]) -> None:
        for _ in range(MOST_ROUNDS):
            new, resets = self._step(self.values, ticks)
            before = dict(self.holds)
            for state, value in resets.items():
                self.x[state] = value
                for c in self.machine.crossings:
                    if c.state == state:
                        if abs(value - c.level) < APART:
                            raise m.Unfit
                        self.holds[c.text] = c.holds(value)
            if new == self.values and self.holds == before:
                self._released()
                return
            self.values = new
        raise m.Unfit

    def _released(self) -> None:
        """After the instant no clock ticks: conditions are as they are between events."""
        self._step(self.values, (), acts=False)


def _value(term: Term, scope: Values) -> m.Value:
    value, close = value_of(term, scope)
    if close:
        raise m.Unfit
    return value


def draw_machine(dice: random.Random) -> tuple[Machine, Play]:
    while True:
        machine = draw(dice)
        try:
            return machine, Play(machine)
        except m.Unfit:
            continue
