"""Laws that have a name: the form of a term, with the units of what it gives and of what it depends on, says which.

Units tell the domain (Paynter 1961: effort, flow and their integrals); sources of the forms: radiation Stefan 1879,
natural convection Churchill and Chu 1975, dry friction Coulomb 1785 and Stribeck 1902, drag Newton 1687, leakage
Hagen-Poiseuille and Torricelli, losses of pipes Darcy 1857, weirs Poleni 1717, diode Shockley 1949, saturation
Langmuir 1918, presliding Dahl 1968, relaxation Maxwell 1867.

A law that was picked among many has to pay for the pick: the length of its name in a two-part code (Rissanen 1978), in
which known forms have short names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
import re

from lacuna.discovery.law.terms.law_terms import AGES, Variable
from lacuna.units import parse_unit

NEAR = 0.15  # by which an exponent may differ from that of a form

FORCE, SPEED, PLACE = ("N", "N.m"), ("m/s", "rad/s"), ("m", "rad")
HEAT, WARMTH, FLOW, LEVEL = ("W",), ("K",), ("m3/s", "kg/s"), ("Pa", "m")
CURRENT, VOLTAGE = ("A",), ("V",)
POWER = r"^(?:sign\(\w+\)\*)?abs\(X\)\^({p}|[\d.]+)$"
ANY = ("",)
DRY = r"^(?:tanh\(\S+\*X\)|dryX)"
BEYOND = r"^(?:\(abs\(-?X - \S+\) [+-] X - \S+\)|\(X - 0.5\*abs\(X \+ \S+\) \+ 0.5\*abs\(X - \S+\)\))$"


@dataclass(frozen=True)
class Form:
    """A term's text, X its variable, with the exponent that it has to have (0: any), and the units on both sides."""

    name: str
    text: str
    gives: tuple[str, ...]
    of: tuple[str, ...]
    exponent: float = 0.0
    between: bool = False  # its variable is what one place has over another
    commanded: bool = False  # its variable is a command, in the unit of what the term gives


FORMS = (
    Form("radiation", POWER, HEAT, WARMTH, 4.0),
    Form("radiation", r"^\(abs\(X\)\^({p}|[\d.]+) - abs\(\S+\*Y\)\^", HEAT, WARMTH, 4.0),
    Form("convection.natural", POWER, HEAT, WARMTH, 1.25),
    Form("drag.quadratic", POWER, FORCE, SPEED, 2.0),
    Form("stiffness.hardening", POWER, FORCE, PLACE, 3.0),
    Form("leakage.turbulent", POWER, FLOW, LEVEL, 0.5),
    Form("leakage.laminar", r"^X$", FLOW, LEVEL),
    Form("heat.loss", r"^X$", HEAT, WARMTH),
    Form("friction.viscous", r"^X$", FORCE, SPEED),
    Form("stiffness", r"^X$", FORCE, PLACE),
    Form("friction.coulomb", DRY + "$", FORCE, SPEED),
    Form("friction.stribeck", DRY + r"\*exp", FORCE, SPEED),
    Form("drive.dead_time", DRY + "$", VOLTAGE, CURRENT),
    Form("diode", r"^exp\(\S+\*X\)$", CURRENT, VOLTAGE),
    Form("torque.cogging", r"^(sin|cos)\(\S+\*X\)$", FORCE, PLACE),
    Form("relaxation", r"^\(X - (lag|warmth)\(X, ", ANY, ANY),
    Form("compliance", r"^swing\(X, ", FORCE, SPEED),
    Form("resonance", r"^swing\(X, ", ANY, ANY),
    Form("drive.delay", r"^\(X - (delay|onset)\(X, ", ANY, ANY),
    Form("friction.presliding", r"^hysteresis\(X, ", FORCE, SPEED),
    Form("hysteresis", r"^hysteresis\(X, ", ANY, ANY),
    Form("rate_limit", r"^bounded\(X, ", ANY, ANY),
    Form("motor.saturation", r"^\(X/\(1 \+ \S+Y\^2\) - X\)$", VOLTAGE, ("A/s",)),
    Form("motor.saturation", r"^\(1/\(1 \+ \S+X\^2\) - 1\)$", ("V.s/rad", "N.m/A", "H"), CURRENT),
    Form("saturation", r"^\(X/\(1 \+ \S+abs\(X\)\) - X\)$", ANY, ANY),
    Form("motor.heating", r"^X\*warmth\(X\^2, ", VOLTAGE, CURRENT),
    Form("load.power", r"^1/X$", CURRENT, VOLTAGE),
    Form("clamp", BEYOND, CURRENT, VOLTAGE),
    Form("end_stop", BEYOND, FORCE, PLACE),
    Form("overflow", BEYOND, FLOW, LEVEL),
    Form("overflow", r"^abs\(abs\(X - \S+\) \+ X - \S+\)\^1.5$", ("m3/s",), ("m",)),
    Form("loss.turbulent", POWER, LEVEL, FLOW, 2.0),
    Form("end_stop", r"^X\*\(1 \+ sign\((?:abs|-)?Y - \S+\)\)$", FORCE, SPEED),
    Form("drive.deadband", r"^\(abs\(X \+ \S+\) - abs\(X - \S+\)\)$", ANY, ANY, commanded=True),
    Form("drive.saturation", BEYOND, ANY, ANY, commanded=True),
    Form("backlash", r"^\(abs\(X \+ \S+\) - abs\(X - \S+\)\)$", FORCE, PLACE, between=True),
    Form("backlash", r"^X\*\(1 - sign\(absY - \S+\)\)$", FORCE, SPEED, between=True),
)

KINDS = 3  # of groups, each as likely before: of a known form, of one variable, of several or of what was done


Term = tuple[str, Mapping[str, str]]  # text, and the names that its shapes have among the values


def form_of(terms: Sequence[Term], variables: Sequence[Variable], gives: str, values: Mapping[str, float]) -> str:
    """The name of a law of one kind of term (a constant beside it is where its zero lies); "" where it has none.

    `gives` is the unit of the effort.
    """
    told = [(text, shapes) for text, shapes in terms if text != "1"]
    names = {_named(text, variables, gives, {s: values[n] for s, n in shapes.items()}) for text, shapes in told}
    if whole := names & {"friction.stribeck", "compliance", "resonance"}:  # what else there is belongs to it
        return min(whole)
    return names.pop() if len(names) == 1 else ""


def picked(
    texts: Sequence[str], variables: Sequence[Variable], gives: str, offered: tuple[int, int]
) -> float:  # fmt: skip
    """Nats of a group's name among all groups that a law at a place may have; `offered`: how many kinds there are of
    one variable and of several. A constant, where the zero of the others lies, is of the known ones."""
    if tuple(texts) == ("1",) or any(_named(text, variables, gives, {}) for text in texts):
        known = sum(_may_be(f, gives, v) for f in FORMS for v in variables)
        return math.log(KINDS * (1 + known))
    return math.log(KINDS * max(offered[is_of_several(texts, variables)], 1))


def is_of_several(texts: Sequence[str], variables: Sequence[Variable]) -> bool:
    """Whether a group is of several variables, or of one and what was done since the start."""
    read = {v.local for v in variables for text in texts if f"{v.local}_ref" in text}
    return len(read) > 1 or any(AGES.search(text) for text in texts)


def _named(text: str, variables: Sequence[Variable], gives: str, shapes: Mapping[str, float]) -> str:
    used = [v for v in variables if f"{v.local}_ref" in text]
    if not 1 <= len(used) <= 2:
        return ""
    first = min(used, key=lambda v: text.index(v.scaled))
    plain = text
    for v in used:
        plain = plain.replace(v.scaled, "X" if v is first else "Y")
    plain = plain.replace("absX", "abs(X)")
    for form in FORMS:
        found = re.match(form.text, plain)
        if not found or (form.between and not first.minus):
            continue
        if _may_be(form, gives, first) and _has(form, found, shapes):
            return form.name
    return ""


def _may_be(form: Form, gives: str, of: Variable) -> bool:
    """Whether an effort of a unit may be a form's of a variable."""
    commanded = of.kind == "input" and _alike(gives, (of.unit,))
    return _alike(gives, form.gives) and _alike(of.unit, form.of) and (commanded or not form.commanded)


def _has(form: Form, found: re.Match, shapes: Mapping[str, float]) -> bool:
    if not form.exponent:
        return True
    if found[1] == "{p}" and "p" not in shapes:
        return False
    exponent = shapes["p"] if found[1] == "{p}" else float(found[1])
    return abs(exponent - form.exponent) <= NEAR * form.exponent


def _alike(unit: str, units: tuple[str, ...]) -> bool:
    return units == ANY or (bool(unit) and any(parse_unit(unit) == parse_unit(u) for u in units))
