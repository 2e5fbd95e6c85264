"""Where a term can stand in a model: each place goes another way through the translator."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
import math
import random

import numpy as np

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.programs import declared, draw_function
from tests.fuzz.oracle.terms import Growth, Kind, Scope, Term, value_of

PARAMETERS: dict[str, tuple[Kind, str, m.Value]] = {
    "q": (Kind("R"), "0.7", 0.7), "h": (Kind("R"), "-1.3", -1.3), "l": (Kind("I"), "3", 3), "j": (Kind("I"), "-4", -4),
    "g": (Kind("B"), "true", True), "z": (Kind("E"), "E.b", 2),
    "p": (Kind("R", (3,)), "{0.4, -1.1, 2.2}", np.array([0.4, -1.1, 2.2])),
    "A": (Kind("R", (2, 3)), "[1, -2, 0.5; 0.3, 4, -1]", np.array([[1, -2, 0.5], [0.3, 4, -1]])),
    "o": (Kind("I", (4,)), "{3, -1, 0, 5}", np.array([3, -1, 0, 5])),
}  # fmt: skip
# What varies: names, kinds, texts, and their worth as functions of time.
SIGNALS: dict[str, tuple[Kind, str, Callable[[float], m.Value]]] = {
    "t": (Kind("R"), "time", lambda t: t),
    "s": (Kind("R"), "sin(5*time)", lambda t: math.sin(5 * t)),
    "n": (Kind("I"), "integer(7*time) - 2", lambda t: math.floor(7 * t) - 2),
    "b": (Kind("B"), "sin(11*time) > 0.2", lambda t: math.sin(11 * t) > 0.2),
    "e": (Kind("E"), "if time < 0.4 then E.a elseif time < 0.8 then E.c else E.b",
          lambda t: 1 if t < 0.4 else 3 if t < 0.8 else 2),
    "v": (Kind("R", (3,)), "{time, 1 - 2*time, cos(3*time)}", lambda t: np.array([t, 1 - 2 * t, math.cos(3 * t)])),
    "B": (Kind("R", (2, 3)), "[time, 1, -time; 2, sin(4*time), 0.5]",
          lambda t: np.array([[t, 1, -t], [2, math.sin(4 * t), 0.5]])),
}  # fmt: skip
KNOWN = {n: k for n, (k, *_) in PARAMETERS.items()}
VARYING = {n: k for n, (k, *_) in SIGNALS.items()}
TIMES = np.array([0.0131 + 0.0197 * k for k in range(50)])
TICK = 0.125


def scope_at(t: float) -> dict[str, m.Value]:
    return {n: value for n, (_, _, value) in PARAMETERS.items()} | {n: f(t) for n, (_, _, f) in SIGNALS.items()}


@dataclass(frozen=True)
class Probe:
    """One variable of a model that is worth `worth(t)`; `declarations` and `equations` bring it, after `classes`."""

    name: str
    kind: Kind
    place: str
    worth: Callable[[float], tuple[m.Value, bool]]
    declarations: list[str]
    equations: list[str] = field(default_factory=list)
    algorithm: list[str] = field(default_factory=list)
    classes: str = ""


def draw_probe(dice: random.Random, name: str) -> Probe:
    """Raises Unfit where the draw has no value at some time."""
    shapes = ((), (), (), (), (3,), (2, 2), (3, 3), (1,), (4,))
    kind = Kind(dice.choice("RRRIB"))
    kind = Kind("R", dice.choice(shapes)) if kind.base == "R" else kind
    if dice.random() < 0.04:
        kind = Kind("E")
    probe = dice.choice(PLACES)(dice, name, kind)
    for t in np.linspace(0, 1, 101):
        probe.worth(float(t))
    return probe


def _at(term: Term) -> Callable[[float], tuple[m.Value, bool]]:
    return lambda t: value_of(term, scope_at(t))


def _term(dice: random.Random, kind: Kind, names: dict[str, Kind] | None = None) -> Term:
    return Growth(dice, names or {**KNOWN, **VARYING}).grow(kind)


def binding(dice: random.Random, name: str, kind: Kind) -> Probe:
    term = _term(dice, kind)
    return Probe(name, kind, "binding", _at(term), [declared(name, kind, value=term.text)])


def equation(dice: random.Random, name: str, kind: Kind) -> Probe:
    term = _term(dice, kind)
    sides = [name, term.text] if kind.base in "BE" or dice.random() < 0.5 else [term.text, name]
    return Probe(name, kind, "equation", _at(term), [declared(name, kind)], [f"{sides[0]} = {sides[1]};"])


def algorithm(dice: random.Random, name: str, kind: Kind) -> Probe:
    """Assigned twice, the second time from the first under a condition."""
    first, condition = _term(dice, kind), _term(dice, Kind("B"))
    other = _term(dice, kind, {**KNOWN, **VARYING, name: kind})

    def worth(scope: Scope) -> m.Value:
        value = m.as_kind(first.worth(scope), kind.base)
        changed = other.worth({**scope, name: value})
        return changed if condition.worth(scope) else value

    lines = [f"{name} := {first.text};", f"if {condition.text} then", f"  {name} := {other.text};", "end if;"]
    return Probe(name, kind, "algorithm", _at(Term("", worth)), [declared(name, kind)], algorithm=lines)


def if_equation(dice: random.Random, name: str, kind: Kind) -> Probe:
    terms, conditions = [_term(dice, kind) for _ in range(3)], [_term(dice, Kind("B")) for _ in range(2)]

    def worth(scope: Scope) -> m.Value:
        a, b, c = (t.worth(scope) for t in terms)
        first, second = (t.worth(scope) for t in conditions)
        return a if first else b if second else c

    a, b, c = (f"{name} = {t.text};" for t in terms)
    text = f"if {conditions[0].text} then {a} elseif {conditions[1].text} then {b} else {c} end if;"
    return Probe(name, kind, "if-equation", _at(Term("", worth)), [declared(name, kind)], [text])


def parameter(dice: random.Random, name: str, kind: Kind) -> Probe:
    term = _term(dice, kind, KNOWN)
    prefix = dice.choice(("parameter ", "final parameter "))
    return Probe(name, kind, "parameter", _at(term), [declared(name, kind, prefix, term.text)])


def constant(dice: random.Random, name: str, kind: Kind) -> Probe:
    """Of literals alone: all of it is computed at translation."""
    term = _term(dice, kind, {"c0": Kind("R")})
    known = f"c_{name}"
    lines = [f"constant Real {known} = 1.75;", declared(name, kind, "constant ", term.text.replace("c0", known))]
    return Probe(name, kind, "constant", lambda t: value_of(term, {"c0": 1.75}), lines)


def start(dice: random.Random, name: str, kind: Kind) -> Probe:
    """The start of a state that keeps it, or an initial equation of one."""
    kind = Kind("R")
    term = _term(dice, kind, KNOWN)
    initial = [f"initial equation {name} = {term.text};"]
    lines = [f"Real {name}(start={term.text}, fixed=true);"] if dice.random() < 0.5 else [f"Real {name};"]
    rest = [f"der({name}) = 0;"] + ([] if "fixed" in lines[0] else initial)
    return Probe(name, kind, "start", _at(term), lines, rest)


def sampled(dice: random.Random, name: str, kind: Kind) -> Probe:
    """Set by a clock and held."""
    kind = Kind(kind.base)
    term = _term(dice, kind)
    prefix = "discrete " if kind.base == "R" else ""
    at = lambda t: value_of(term, scope_at(math.floor(t / TICK) * TICK))  # noqa: E731
    text = f"when sample(0, {TICK}) then {name} = {term.text}; end when;"
    return Probe(name, kind, "sampled", at, [declared(name, kind, prefix)], [text])


def implicit(dice: random.Random, name: str, kind: Kind) -> Probe:
    """y + sin(y)/2 = term: one y for each, found here by Newton's method."""
    term = _term(dice, Kind("R"))

    def worth(t: float) -> tuple[m.Value, bool]:
        value, close = value_of(term, scope_at(t))
        y = float(value)
        for _ in range(200):
            y -= (y + math.sin(y) / 2 - value) / (1 + math.cos(y) / 2)
        if abs(y + math.sin(y) / 2 - value) > 1e-9 * (1 + abs(value)):
            raise m.Unfit
        return y, close

    return Probe(name, Kind("R"), "implicit", worth, [f"Real {name};"], [f"{name} + sin({name})/2 = {term.text};"])


def linear(dice: random.Random, name: str, kind: Kind) -> Probe:
    """Two unknowns of a linear system; the second is not looked at."""
    a, b = _term(dice, Kind("R")), _term(dice, Kind("R"))
    term = Term("", lambda s: (a.worth(s) + 2.0 * b.worth(s)) / 7.0)
    lines = [f"3*{name} - 2*{name}_ = {a.text};", f"2*{name} + {name}_ = {b.text};"]
    return Probe(name, Kind("R"), "linear", _at(term), [f"Real {name}, {name}_;"], lines)


def call(dice: random.Random, name: str, kind: Kind) -> Probe:
    """A function with a body; of what varies, of parameters, or of numbers."""
    which = dice.choice(("varying", "varying", "parameters", "literals"))
    pool = KNOWN if which == "parameters" else VARYING
    inputs = {n: k for n, k in pool.items() if dice.random() < 0.7 or n == "n"}
    function = draw_function(dice, f"f_{name}", inputs, kind)
    now = scope_at(0.3)
    texts = [_literal_text(now[n], k) if which == "literals" else n for n, k in inputs.items()]
    term = Term("", function.worth)
    at = (lambda t: value_of(term, now)) if which == "literals" else _at(term)
    text = f"f_{name}({', '.join(texts)})"
    if which == "varying" and kind.base != "R":  # what a function makes of Reals varies with them
        held = lambda t: value_of(term, scope_at(math.floor(t / TICK) * TICK))  # noqa: E731
        when = f"when sample(0, {TICK}) then {name} = {text}; end when;"
        return Probe(name, kind, "call when", held, [declared(name, kind)], [when], classes=function.text)
    return Probe(name, kind, f"call of {which}", at, [declared(name, kind, value=text)], classes=function.text)


def _literal_text(value: m.Value, kind: Kind) -> str:
    if isinstance(value, np.ndarray):
        return "{" + ", ".join(_literal_text(v, kind) for v in value) + "}"
    if kind.base == "E":
        return f"E.{'abc'[value - 1]}"
    return str(bool(value)).lower() if kind.base == "B" else repr(np.asarray(value).item())


PLACES = (
    binding, equation, algorithm, if_equation, parameter, constant, start, sampled, implicit, linear, call, call, call,
)  # fmt: skip
