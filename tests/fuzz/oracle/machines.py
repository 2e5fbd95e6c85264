"""Random event programs on piecewise linear states: equations of what is discrete, chains of when and elsewhen in
equations and algorithms, pre, edge, change, samples, located crossings, reinit, rates that follow from both.
"""

from __future__ import annotations

from dataclasses import dataclass, field
import math
import random

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.programs import declared
from tests.fuzz.oracle.terms import Growth, Kind, Term

Values = dict[str, m.Value]


@dataclass(frozen=True)
class Crossing:
    """state > level, or the reverse where not `greater`."""

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


def draw(dice: random.Random) -> Machine:
    return _Draw(dice).machine()
