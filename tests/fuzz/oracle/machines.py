"""Random event programs on piecewise linear states: equations of what is discrete, chains of when and elsewhen in
equations and algorithms, pre, edge, change, samples, located crossings, reinit, rates that follow from both.

The oracle plays them by the specification: event iteration of appendix B, a state reset at the end of a step of it
(8.3.6), a condition that acts where it becomes true, an earlier branch of a chain before a later one, and none of
them while the start is computed (8.6).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
import math
import random

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.programs import declared
from tests.fuzz.oracle.terms import Growth, Kind, Term, value_of

Values = dict[str, m.Value]
STOP = 1.0
MOST_ROUNDS, MOST_EVENTS = 12, 120
# Instants nearer than this are one or two, as rounding will have it: a run is compared up to there.
APART = 1e-5


@dataclass(frozen=True)
class Crossing:
    """state > level, or a sample where `state` is none."""

    text: str
    state: int
    level: float
    greater: bool

    def holds(self, x: float) -> bool:
        return (x > self.level) == self.greater


@dataclass(frozen=True)
class Clock:
    text: str
    start: float
    interval: float


@dataclass(frozen=True)
class Branch:
    """Acts where one of `conditions` becomes true; `sets` a term for each variable of its chain, and resets states."""

    conditions: tuple[Term, ...]
    sets: dict[str, Term]
    resets: dict[int, Term]


@dataclass
class Machine:
    kinds: dict[str, Kind]
    crossings: list[Crossing]
    clocks: list[Clock]
    rates: list[Term]
    starts: list[float]
    steps: list[tuple[str, Term] | list[Branch]]  # each reads what stands before it
    first: Values = field(default_factory=dict)
    orders: list[int] = field(default_factory=list)  # how they are written down
    in_algorithm: list[bool] = field(default_factory=list)

    @property
    def text(self) -> str:
        lines = ["model Machine", "  type E = enumeration(a, b, c);"]
        for name, kind in self.kinds.items():
            prefix = "discrete " if kind.base == "R" else ""
            value = _text(self.first[name], kind)
            lines.append(f"  {declared(name, kind, prefix)[:-1]}(start={value}, fixed=true);")
        lines += [f"  Real x{k}(start={x!r}, fixed=true);" for k, x in enumerate(self.starts)]
        lines += ["equation", *(f"  der(x{k}) = {rate.text};" for k, rate in enumerate(self.rates))]
        steps = [(self.steps[k], self.in_algorithm[k]) for k in self.orders]
        for step, _ in [s for s in steps if not s[1]]:
            lines += [f"  {step[0]} = {step[1].text};"] if isinstance(step, tuple) else _when(step, "=")
        for step, _ in [s for s in steps if s[1]]:
            lines += ["algorithm", *_when(step, ":=")]
        return "\n".join([*lines, "end Machine;", ""])


def _when(branches: list[Branch], sign: str) -> list[str]:
    lines = []
    for k, branch in enumerate(branches):
        texts = [c.text for c in branch.conditions]
        condition = texts[0] if len(texts) == 1 else "{" + ", ".join(texts) + "}"
        lines.append(f"  {'elsewhen' if k else 'when'} {condition} then")
        lines += [f"    {name} {sign} {term.text};" for name, term in branch.sets.items()]
        lines += [f"    reinit(x{k}, {term.text});" for k, term in branch.resets.items()]
    return [*lines, "  end when;"]


def _text(value: m.Value, kind: Kind) -> str:
    if kind.base == "E":
        return f"E.{'abc'[int(value) - 1]}"
    return str(value).lower() if kind.base == "B" else repr(value)


class _Draw:
    def __init__(self, dice: random.Random) -> None:
        self.dice = dice
        names = [f"{base.lower()}{k}" for base, most in (("I", 3), ("B", 3), ("E", 1), ("R", 2)) for k in range(most)]
        self.kinds = {n: Kind({"i": "I", "b": "B", "e": "E", "r": "R"}[n[0]]) for n in names if dice.random() < 0.8}
        self.crossings = [self._crossing() for _ in range(dice.randrange(2, 5))]
        intervals = (0.0625, 0.125, 0.1875, 0.25, 0.3125)
        pairs = [(dice.choice((0.0625, 0.125, 0.03125)), dice.choice(intervals)) for _ in range(dice.randrange(3))]
        self.clocks = [Clock(f"sample({s!r}, {i!r})", s, i) for s, i in pairs]
        self.known: dict[str, Kind] = {c.text: Kind("B") for c in self.crossings}
        for n, kind in self.kinds.items():
            self.known[f"pre({n})"] = kind

    def _crossing(self) -> Crossing:
        state, level = self.dice.randrange(2), round(self.dice.uniform(-1.5, 1.5), 3)
        sign = self.dice.choice((">", "<", ">=", "<="))
        return Crossing(f"(x{state} {sign} {level!r})", state, level, sign[0] == ">")

    def term(self, base: str, more: dict[str, Kind] | None = None) -> Term:
        return Growth(self.dice, {**self.known, **(more or {})}).grow(Kind(base), self.dice.choice((1, 2, 2, 3)))

    def small(self, base: str, more: dict[str, Kind] | None = None) -> Term:
        """Of a size that cannot grow from event to event."""
        term = self.term(base, more)
        if base == "I":
            return Term(f"mod({term.text}, 7)", lambda s: term.worth(s) % 7)
        if base == "R":
            return Term(f"sin({term.text})", lambda s: math.sin(term.worth(s)))
        return term

    def condition(self) -> Term:
        dice = self.dice
        flags = [n for n in self.known if n in self.kinds and self.kinds[n].base == "B"]
        now = [n for n in self.known if n in self.kinds and self.kinds[n].base != "R"]
        clock = [c.text for c in self.clocks]
        plain = [*clock, *clock, *(c.text for c in self.crossings), *(f"edge({n})" for n in flags), *flags]
        plain += [f"change({n})" for n in now]
        if dice.random() < 0.75:
            name = dice.choice(plain)
            return Term(name, lambda s: bool(s[name]))
        return self.term("B")

    def chain(self, names: list[str], states: list[int]) -> list[Branch]:
        branches = []
        for _ in range(self.dice.choice((1, 1, 2, 3))):
            conditions = tuple(self.condition() for _ in range(self.dice.choice((1, 1, 1, 2))))
            sets: dict[str, Term] = {}
            for name in names:
                sets[name] = self.small(self.kinds[name].base, {n: self.kinds[n] for n in sets})
            level = round(self.dice.uniform(-1, 1), 3)
            resets = {k: Term(repr(level), lambda _, level=level: level) for k in states if self.dice.random() < 0.5}
            branches.append(Branch(conditions, sets, resets))
        return branches

    def machine(self) -> Machine:
        steps: list[tuple[str, Term] | list[Branch]] = []
        in_algorithm = []
        names, states = list(self.kinds), [0, 1]
        self.dice.shuffle(names)
        while names:
            owned = [names.pop() for _ in range(min(len(names), self.dice.choice((1, 1, 2))))]
            if len(owned) == 1 and self.kinds[owned[0]].base != "R" and self.dice.random() < 0.4:
                steps.append((owned[0], self.small(self.kinds[owned[0]].base)))
                in_algorithm.append(False)
            else:
                reset = [states.pop()] if states and self.dice.random() < 0.3 else []
                steps.append(self.chain(owned, reset))
                in_algorithm.append(not reset and self.dice.random() < 0.3)
            for name in owned:
                self.known[name] = self.kinds[name]
                self.known |= {f"edge({name})": Kind("B")} if self.kinds[name].base == "B" else {}
        only = {n: k for n, k in self.known.items() if n in self.kinds}
        rates = [Growth(self.dice, only).grow(Kind("R"), 2) for _ in range(2)]
        rates = [
            Term(f"3*sin({r.text} + {k + 1})", lambda s, r=r, k=k: 3 * math.sin(r.worth(s) + k + 1))
            for k, r in enumerate(rates)
        ]
        starts = [round(self.dice.uniform(-1, 1), 4) for _ in range(2)]
        orders = list(range(len(steps)))
        self.dice.shuffle(orders)
        return Machine(self.kinds, self.crossings, self.clocks, rates, starts, steps, {}, orders, in_algorithm)


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
        machine = _Draw(dice).machine()
        try:
            return machine, Play(machine)
        except m.Unfit:
            continue
