"""What may stand at a place: its variables, all groups of terms of them, and the regression that tells them apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
import re

import numpy as np

from lacuna.discovery.efforts.guide import Guided
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.laws.regression import Regression
from lacuna.discovery.efforts.laws.terms import counts, dividing, groups, saturating
from lacuna.discovery.efforts.laws.variables import MOVES, variables
from lacuna.discovery.efforts.laws.written import written_differences
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places import sites
from lacuna.discovery.efforts.places.families import is_shared, meant
from lacuna.discovery.efforts.places.place import Place
from lacuna.discovery.law.law import Site as LawSite
from lacuna.discovery.law.terms.law_terms import Group, Variable
from lacuna.units import per_second


def offered_at(locator: Locator, place: Place, guided: Guided) -> tuple[Regression, range]:
    """The regression at a place, or at all of a family at once, and all groups of terms that may stand there."""
    along, members = [p.along for p in guided.pieces], place.sites[0].members
    answering = _answering(locator, along[0], place.columns[0])
    added, known = locator.base.machine.amendment.adds, locator.base.machine.model.variables
    hidden = locator.opened.hidden
    near = re.sub(r"^der\((.*)\)$", r"\1", members[0]) if members else place.location
    seen = [_of_all(a, members) for a in along] if members else along
    found = variables(
        seen, near, known, locator.opened.linear.states, answering, lambda n: added(n) or n in hidden,
        written_differences(locator.opened),
    )  # fmt: skip
    found, ranges = _ranged(along, found, members)
    if place.only:
        found = [v for v in found if v.name == place.only and not v.minus]
    told = {o.only for o in place.other} - {""}
    longest = max((a.time for a in along), key=lambda t: t[-1] - t[0])
    interval, duration = float(np.median(np.diff(longest))), float(longest[-1] - longest[0])
    aliases = locator.opened.linear.prepared.aliases
    sent = {aliases.get(end, (end, 1))[0] for s in place.sites if s.kind == "signal" for end in s.ends}
    found = [replace(v, kind="input") if _is_sent(v, sent, along) else v for v in found]
    varies = place.sites[0].kind in ("parameter", "input")
    if varies:  # it holds nothing at rest
        found = [replace(v, sticks=False) for v in found]
    found += [] if members else _unheld(locator, guided, found)
    ranges |= {v.local: (-1.0, 1.0) for v in found if v.kind == "unheld"}
    coefficient = is_coefficient(place.sites[0])
    if coefficient:  # no command, that may be late
        found = [replace(v, kind="other") if v.kind == "input" else v for v in found]
    terms = groups(found, ranges, interval, duration)
    if coefficient:
        terms = [g for g in terms if len(read_by(g, found)) < 2 and len(g.texts) == 1]
        terms += [g for v in found if v.kind != "rate" for g in dividing(v)]
    if varies:
        terms += [saturating(v) for v in found if v.kind != "rate"]
    terms = sorted((g for g in terms if not _reads_only(g, found, told)), key=lambda g: g.memory)
    where = LawSite(place.sites[0], place.location, place.unit, tuple(found), counts(found, terms))
    regression = Regression(guided, where, place.columns)
    return regression, regression.add(terms)


def _is_sent(v: Variable, ends: set[str], along: Sequence[Along]) -> bool:
    """Whether a variable is what stands at an end of a signal, whatever equations may say of it in between."""
    if v.name in ends or v.minus:
        return v.name in ends
    near = MOVES * v.size
    return any(all(np.allclose(a.values[v.name], a.values.get(end, np.inf), 0.0, near) for a in along) for end in ends)


def _of_all(along: Along, members: Sequence[str]) -> Along:
    """A run with those variables only that every member of a family has."""
    first, *others = members
    shared = {
        n: v for n, v in along.values.items()
        if is_shared(n, members) and all(meant(n, first, other) in along.values for other in others)
    }  # fmt: skip
    return replace(along, values=shared)


def _ranged(
    along: Sequence[Along], found: list[Variable], members: Sequence[str]
) -> tuple[list[Variable], dict[str, tuple[float, float]]]:  # fmt: skip
    """The variables with the size that they have at any member of a family, and their ranges in that."""
    ranges: dict[str, tuple[float, float]] = {}
    sized = []
    for v in found:
        everywhere = [v.of_member(members[0], member) for member in members] if members else [v]
        course = np.concatenate([own.course(a.values) for own in everywhere for a in along])
        if members:
            v = replace(v, size=float(f"{np.abs(course).max():.2g}"))
        low, high = ranges[v.local] = float(course.min()) / v.size, float(course.max()) / v.size
        sized.append(replace(v, turns=low < 0 < high))
    return sized, ranges


def _unheld(locator: Locator, guided: Guided, found: list[Variable]) -> list[Variable]:
    """The rates that an effort at a place sets at once, as they would be without the one that guides the run."""
    rates, column = [], int(guided.latent.column[0, 0])
    for v in (v for v in found if v.sticks):
        name, largest = f"der({v.name})", 0.0
        row = unknowns(locator).index(name)
        for piece, effort in zip(guided.pieces, guided.efforts, strict=True):
            values = piece.along.values
            values[f"unheld {name}"] = values[name] - piece.along.direct[:, row, column] * effort
            largest = max(largest, float(np.abs(values[f"unheld {name}"]).max()))
        local, unit = f"x{len(found) + len(rates) + 1}", per_second(v.unit)
        rates.append(Variable(local, name, unit, "unheld", float(f"{largest:.2g}")))
    return rates if all(v.size > 0 for v in rates) else []


def is_coefficient(site: sites.Site) -> bool:
    """Whether it is a parameter of one equation, all laws of which are laws in that balance: those are told of it that
    are shorter so, functions of one variable and a level beside them."""
    return site.kind == "parameter" and len(site.parts) == 1


def _reads_only(group: Group, found: list[Variable], told: set[str]) -> bool:
    """Whether a group has one variable, which is one of inputs that laws are `told` of instead of the balance."""
    read = read_by(group, found)
    return len(read) == 1 and read <= told


def read_by(group: Group, found: list[Variable]) -> set[str]:
    """What a group reads of the model."""
    return {v.reading for v in found if any(f"{v.local}_ref" in text for text in group.texts)}


def _answering(locator: Locator, along: Along, column: int) -> frozenset[str]:
    """Unknowns that an effort at a place changes at once."""
    return frozenset(n for k, n in enumerate(unknowns(locator)) if along.answering[k, column])


def unknowns(locator: Locator) -> list[str]:
    return [f"der({u.args[0].value})" if u.op == "der" else str(u.value) for u in locator.opened.linear.unknowns]
