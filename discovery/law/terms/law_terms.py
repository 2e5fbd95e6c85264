"""Terms of empirical laws: expressions in the variables at a place, each made dimensionless by its largest value.

A term's text is Modelica, and what it is along a trajectory is read from that same text (`courses.py`). `{p}`,
`{k}`, `{tau}` and `{omega}` stand for shape parameters, which a fit may move. `lag(x, tau)` is x behind a first-order
lag that begins at rest: a state of the law's own; `warmth(x, tau)` begins cold, at nothing, as does `total(x, tau)`,
all of x since the start, over tau, and `spent(x, tau)`, the share of what x uses up that is gone. `swing(x, w, z)` is
what a mass on a spring of its own does to what moves at x, over that mass times w: the stretch of the spring, and its
damper, of damping ratio z. `delay(x, late, apart)` is x as it was, kept in samples so far apart; before the start it
was what it is there, or nothing: `onset(x, late, apart)`. `dry(x)` truly sticks: it has modes and events. `bounded(x,
q)` is what keeps a rate x within q either way: what it would be beyond that without the effort; it has modes and
events, too. `hysteresis(y, t)` is the bend, up to one, of bristles that what moves at y drags along: by 1/t of its way,
less the more they are bent.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
import re

import numpy as np

from lacuna.discovery.efforts.places.families import meant
from lacuna.discovery.law.terms.courses import OF_TIME, Courses

STICKS = "dry{x}"  # its sign while it moves; at rest whatever holds it there, up to one in size
DRY = "tanh(50*{x})"  # the sign of a variable, smooth over two per cent of its range: no second sticking element
ORDERS = (0.5, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12)  # per turn
TIMES = (0.1, 0.3, 1.0)  # of the longest recording: time constants of what fades or drifts
EXPONENTS = (0.5, 1.5, 2.0, 3.0, 4.0)  # where powers start: flow through an orifice to radiation
BEYOND = (1.5, 2.0)  # powers of what is beyond a threshold: weirs, contacts
WHOLE = (1 / 3, 2 / 3, 1.0, 7 / 4, *EXPONENTS, 5.0)  # exponents that are told as such
AGES = re.compile(r"(?:^|(?<=\*))(?:warmth|total|spent)\((.*), [^,()]+\)$")  # of what was done since the start
MEMORY = re.compile(rf"\b(?:{'|'.join(OF_TIME)})\(.*")
HIGHEST = 200.0  # rad/s: fastest vibration that is looked for
OCTAVE = 1.6  # times pi over the longest recording: spacing of the frequencies that are looked at


@dataclass(frozen=True)
class Variable:
    """A quantity at a place: its name in the law's component and in the model; `size` makes it dimensionless.

    `minus` is a quantity of the same unit that it is taken against: what drives a flow is often a difference. A rate
    `unheld` is screened as what it would be without the effort.
    """

    local: str
    name: str
    unit: str
    kind: str  # speed | position | current
    size: float
    switch: bool = False  # a Boolean of the model: 1 while it is true
    minus: str = ""
    sticks: bool = False  # an effort at the place acts on its rate at once: dry friction there holds it at rest
    rate: str = ""  # the variable here that is its rate: what a stop's damper follows
    turns: bool = True  # whether it goes both ways in the recordings

    @property
    def dry(self) -> str:
        """Dry friction of this speed."""
        return (STICKS if self.sticks else DRY).format(x=self.scaled)

    @property
    def reading(self) -> str:
        """What the law's component reads of the model, in Modelica."""
        if self.minus:
            return f"({self.name} - {self.minus})"
        return f"(if {self.name} then 1.0 else 0.0)" if self.switch else self.name

    def course(self, values: Mapping[str, np.ndarray | float]) -> np.ndarray:
        """(n,) along a trajectory, whose variables, parameters and `time` `values` holds."""
        name = f"unheld {self.name}" if self.kind == "unheld" else self.name
        found = values[name] - values[self.minus] if self.minus else values[name]
        return found if np.ndim(found) else np.full(len(values["time"]), found)

    def of_member(self, here: str, there: str) -> Variable:
        """The same quantity of another member of a family."""
        return replace(self, name=meant(self.name, here, there), minus=meant(self.minus, here, there))

    @property
    def scaled(self) -> str:
        return f"({self.local}/{self.local}_ref)"


@dataclass(frozen=True)
class Shape:
    """A parameter inside a term. Values of `simple` are preferred where the data allows them."""

    name: str
    unit: str
    start: float
    lower: float
    upper: float
    simple: tuple[float, ...] = ()
    step: float = 0.0  # from one value to the next that is screened


@dataclass(frozen=True)
class Group:
    """Terms that come together, one coefficient each, such as the sine and the cosine of one order; those of a group
    that is `held` stay where they start, as nothing tells them or nothing is to be told. Along a run that an effort
    leads, a rate that it changes has the effort's own error in it: what is `seen` there in the place of the texts has
    the rate without the effort."""

    texts: tuple[str, ...]
    shapes: tuple[Shape, ...] = ()
    held: bool = False
    seen: tuple[str, ...] = ()

    @cached_property
    def kind(self) -> tuple[str, ...]:
        """Its texts, but for how far apart what is late is kept: that follows how late it is."""
        return tuple(re.sub(r"\b(delay|onset)\(([^,]+, [^,)]+), [^,)]+\)", r"\1(\2)", text) for text in self.texts)

    @cached_property
    def ages(self) -> bool:
        """Whether it is of what was done since the start."""
        return any(AGES.search(text) for text in self.texts)

    @cached_property
    def memory(self) -> tuple[str, ...]:
        """What it remembers, none that has no memory: groups of the same are quick one after the other."""
        found = MEMORY.search(self.texts[0])
        return (found[0], *(str(s.start) for s in self.shapes)) if found else ()

    def values(self, courses: Courses) -> list[np.ndarray]:
        """Each term (n,) along a trajectory with its shapes at their starts."""
        shapes = {s.name: s.start for s in self.shapes}
        return [courses.of(text, shapes) for text in self.seen or self.texts]


def groups(variables: list[Variable], duration: float) -> list[Group]:
    """Every group of terms in these variables and time; `duration` (s) is that of the longest recording."""
    found = [Group(("exp(-time/{tau})",), (_fading(duration * t),)) for t in TIMES] + _vibrations(duration)
    angles = [v for v in variables if v.kind == "position" and v.unit == "rad"]
    for v in variables:
        found += _powers(v) + _with_time(v, duration)
        found += [g for angle in angles if angle is not v for g in _with_angle(v, angle)]
    for angle in angles:
        found += [Group((f"sin({{k}}*{angle.local})", f"cos({{k}}*{angle.local})"), (_order(m),)) for m in ORDERS]
    for n, a in enumerate(variables):
        found += [g for b in variables[n + 1 :] for g in _products(a, b)]
    return found


def _powers(v: Variable) -> list[Group]:
    x = v.scaled
    odd = [Group((f"sign({v.local})*abs{x}^{{p}}",), (exponent(p),)) for p in (0.5, 2.0, 3.0, 5.0)]
    return [*odd, Group((f"{x}^2",)), Group((f"abs{x}",)), Group((f"{x}^3",))]


def _products(a: Variable, b: Variable) -> list[Group]:
    x, y = a.scaled, b.scaled
    return [
        Group((f"{x}*{y}",)), Group((f"{x}*{y}^2",)), Group((f"{x}^2*{y}",)), Group((f"{x}*abs{y}",)),
        Group((f"abs{x}*{y}",)), Group((DRY.format(x=x) + f"*{y}",)), Group((DRY.format(x=x) + f"*{y}^2",)),
    ]  # fmt: skip


def _with_angle(v: Variable, angle: Variable) -> list[Group]:
    laws = [v.scaled] + ([DRY.format(x=v.scaled)] if v.kind == "speed" else [])
    return [Group((f"{x}*sin({{k}}*{angle.local})", f"{x}*cos({{k}}*{angle.local})"), (_order(m),))
            for x in laws for m in ORDERS]  # fmt: skip


def _with_time(v: Variable, duration: float) -> list[Group]:
    laws = [v.scaled] + ([DRY.format(x=v.scaled)] if v.kind == "speed" else [])
    return [Group((f"{x}*exp(-time/{{tau}})",), (_fading(duration * t),)) for x in laws for t in TIMES]


def _vibrations(duration: float) -> list[Group]:
    step = OCTAVE * np.pi / duration
    frequencies = np.arange(2 * step, HIGHEST, step)
    return [
        Group(("sin({omega}*time)", "cos({omega}*time)"), (Shape("omega", "rad/s", float(f), 0.5 * f, 2.0 * f),))
        for f in frequencies
    ]


def exponent(start: float, step: float = 0.0) -> Shape:
    """Any exponent; below and above, a power is a step or a wall."""
    return Shape("p", "1", start, 0.1, 8.0, WHOLE, step)


def stribeck(v: Variable, steep: bool = False) -> Group:
    """Dry friction that falls, or grows, from rest on: exponentially, or with an exponent of any steepness, as B.
    Armstrong-Helouvry, P. Dupont, C. Canudas de Wit (Automatica 30, 1994) collect them: from a half to two and more."""
    speed, falls = Shape("q", "1", 0.1, 0.01, 1.0, (), 0.08), Shape("p", "1", 1.5, 0.5, 3.0, (1.0, 2.0))
    exponent = f"-(abs{v.scaled}/{{q}})^{{p}}" if steep else f"-abs{v.scaled}/{{q}}"
    return Group((v.dry, f"{v.dry}*exp({exponent})"), (speed, falls) if steep else (speed,))


def _order(start: float) -> Shape:
    return Shape("k", "1", start, 0.5 * start, 2.0 * start, tuple(range(1, 25)))


def _fading(start: float) -> Shape:
    return Shape("tau", "s", start, 0.05 * start, 20.0 * start)
