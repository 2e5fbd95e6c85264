"""Which laws are worth a fit: terms at a place ranked by the regression on its effort, alone and in pairs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from lacuna.codegen.units.inference import SECOND
from lacuna.discovery.efforts import sites
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.laws.regression import FURTHER, Regression
from lacuna.discovery.efforts.laws.terms import counts, groups, saturating
from lacuna.discovery.efforts.laws.variables import variables
from lacuna.discovery.efforts.located import Guided, Locator, Site
from lacuna.discovery.efforts.opened import Place
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law import Site as LawSite
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.law_terms import DRY, Group, Variable, evaluate
from lacuna.units import parse_unit

Scored = tuple[float, Regression, tuple[int, ...]]  # deviance and prices, groups of a regression

FAMILIES = 12  # kinds of terms whose shapes are refined, and beside which, and a constant, a second one is looked for
ZOOMS, FINE = 3, 9  # times that a shape is refined, and values each time; each is a quarter of the last one's spacing
PAIRS = 6  # kinds of pairs whose shapes are refined
SAME = 1e-3  # share of what a law explains, by which another one must differ to be tried beside it


def proposals(
    locator: Locator, site: Site, guided: Guided, most: int, strained: bool = True
) -> Iterator[list[Proposal]]:
    """Laws of one group of terms at a place, then, where `strained` ones are wanted, such as parameters would have to
    leave their beliefs for, then of two groups; `most` of each, the most telling first, each list found when it is
    asked for. In any of the quantities in which an effort does the same there.

    Along a run that an effort of a smooth course leads, a stiff contact is met too early or too late; to first order
    parameters stand for that, and a fit puts them back.
    """
    quantities = (site.place, *site.place.other)
    offered = [_offered(locator, place, guided) for place in quantities]
    ones = [_told_here(place, r, _refined(r, every)) for place, (r, every) in zip(quantities, offered, strict=True)]
    first = _best([(r, groups) for (r, _), groups in zip(offered, ones, strict=True)], most)
    first += _held(locator, guided, offered, first)
    yield _forgetting(offered, first)
    if strained:
        yield _forgetting(offered, _best([(r, _refined(r, every, strained=True)) for r, every in offered], most))
    twos = [(r, _doubled(r, groups, every)) for (r, every), groups in zip(offered, ones, strict=True)]
    yield _forgetting(offered, _best(twos, most))


def _forgetting(offered: list[tuple[Regression, range]], found: list[Proposal]) -> list[Proposal]:
    """What was found, regressions left with what little they need until they are asked again: fits come between."""
    for regression, _ in offered:
        regression.forget()
    return found


def _held(
    locator: Locator, guided: Guided, offered: list[tuple[Regression, range]], others: list[Proposal]
) -> list[Proposal]:  # fmt: skip
    """Dry friction of what an effort at a place changes at once, where the effort is against it and no other law is of
    it: at rest it is whatever holds, which a regression takes for its level."""
    known = {law.law.text() for law in others}
    found = []
    for regression, every in offered:
        along = guided.pieces[0].along
        for v in (v for v in regression.place.variables if v.sticks and v.turns):
            level = _level(guided, v)
            sense = np.mean(along.direct[:, _unknowns(locator).index(f"der({v.name})"), regression.column])
            laws = [_proposal(regression, (g,)) for g in every if regression.groups[g].texts == (v.dry,)]
            found += [replace(p, start={"c_1": level}) for p in laws if level * sense < 0 and p.law.text() not in known]
    return found


def _level(guided: Guided, v: Variable) -> float:
    """Of the effort along the way, with the sense of a speed, while that moves."""
    sense = []
    for along in (piece.along for piece in guided.pieces):
        path = {v.local: v.course(along.values), "time": along.time}
        sense.append(evaluate(DRY.format(x=v.scaled), path, {v.local: v.size}))
    return sum(float(e @ s) for e, s in zip(guided.efforts, sense, strict=True)) / sum(float(s @ s) for s in sense)


def _told_here(place: Place, regression: Regression, laws: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Laws without a level by itself where that is told otherwise: of a proportional input in the balance, of a
    coefficient as its value."""
    if not place.only and not _is_coefficient(place.sites[0]):
        return laws
    return [law for law in laws if any(regression.groups[g].texts != ("1",) for g in law)]


def _is_coefficient(site: sites.Site) -> bool:
    """Whether it is a parameter of one equation, all laws of which are laws in that balance: those are told of it that
    are shorter so, functions of one variable and a level beside them."""
    return site.kind == "parameter" and len(site.parts) == 1


def _best(found: list[tuple[Regression, list[tuple[int, ...]]]], most: int) -> list[Proposal]:
    """The best laws in all quantities, which explain different things; the last of them of the state alone whose
    balance it is, where none is: along a run that a smooth effort leads, speeds on both ends of a stiff rope change
    their sign as one, and which of them rubs only fits tell."""
    scored = sorted((law for r, groups in found for law in _scored(r, groups)), key=lambda law: law[0])
    best = _distinct(scored, most)
    own = next((law for law in scored if _is_own(law)), None)
    if own is not None and len(best) == most > 1 and not any(map(_is_own, best)):
        best[-1] = own
    return [_proposal(r, groups) for _, r, groups in best]


def _is_own(law: Scored) -> bool:
    """Whether a law is of one group, in the state alone whose rate the effort changes at once."""
    _, regression, chosen = law
    found = list(regression.place.variables)
    read = _read(regression.groups[chosen[0]], found)
    return len(chosen) == 1 and bool(read) and read <= {v.reading for v in found if v.sticks}


def _scored(regression: Regression, found: list[tuple[int, ...]]) -> list[Scored]:
    return [(regression.scores(groups[:-1], groups[-1:])[0], regression, groups) for groups in found]


def _offered(locator: Locator, place: Place, guided: Guided) -> tuple[Regression, range]:
    """The regression at a place, and all groups of terms that may stand there."""
    along = [p.along for p in guided.pieces]
    answering = _answering(locator, along[0], place.column)
    added = locator.base.machine.amendment.added()
    found = variables(
        along, place.location, locator.base.machine.model.variables, locator.opened.linear.states, answering, added
    )
    courses = {v.local: np.concatenate([v.course(a.values) for a in along]) / v.size for v in found}
    ranges = {local: (float(c.min()), float(c.max())) for local, c in courses.items()}
    found = [replace(v, turns=ranges[v.local][0] < 0 < ranges[v.local][1]) for v in found]
    if place.only:
        found = [v for v in found if v.name == place.only and not v.minus]
    told = {o.only for o in place.other} - {""}
    longest = max((a.time for a in along), key=lambda t: t[-1] - t[0])
    interval, duration = float(np.median(np.diff(longest))), float(longest[-1] - longest[0])
    aliases = locator.opened.linear.prepared.aliases
    sent = {aliases.get(end, (end, 1))[0] for s in place.sites if s.kind == "signal" for end in s.ends}
    found = [replace(v, kind="input") if v.name in sent else v for v in found]
    varies = place.sites[0].kind in ("parameter", "input")
    if varies:  # it holds nothing at rest
        found = [replace(v, sticks=False) for v in found]
    found += _unheld(locator, guided, found)
    ranges |= {v.local: (-1.0, 1.0) for v in found if v.kind == "unheld"}
    coefficient = _is_coefficient(place.sites[0])
    if coefficient:  # no command, that may be late
        found = [replace(v, kind="other") if v.kind == "input" else v for v in found]
    terms = groups(found, ranges, interval, duration)
    if coefficient:
        terms = [g for g in terms if len(_read(g, found)) < 2 and len(g.texts) == 1]
    if varies:
        terms += [saturating(v) for v in found if v.kind != "rate"]
    terms = [g for g in terms if not _reads_only(g, found, told)]
    where = LawSite(place.sites[0], place.location, place.unit, tuple(found), counts(found, terms))
    regression = Regression(guided, where, place.column)
    return regression, regression.add(terms)


def _unheld(locator: Locator, guided: Guided, found: list[Variable]) -> list[Variable]:
    """The rates that an effort at a place sets at once, as they would be without the one that guides the run."""
    rates, column = [], int(guided.latent.column[0])
    for v in (v for v in found if v.sticks):
        name, largest = f"der({v.name})", 0.0
        row = _unknowns(locator).index(name)
        for piece, effort in zip(guided.pieces, guided.efforts, strict=True):
            values = piece.along.values
            values[f"unheld {name}"] = values[name] - piece.along.direct[:, row, column] * effort
            largest = max(largest, float(np.abs(values[f"unheld {name}"]).max()))
        local, unit = f"x{len(found) + len(rates) + 1}", str(parse_unit(v.unit) / SECOND) if v.unit else ""
        rates.append(Variable(local, name, unit, "unheld", float(f"{largest:.2g}")))
    return rates if all(v.size > 0 for v in rates) else []


def _reads_only(group: Group, found: list[Variable], told: set[str]) -> bool:
    """Whether a group has one variable, which is one of inputs that laws are `told` of instead of the balance."""
    read = _read(group, found)
    return len(read) == 1 and read <= told


def _read(group: Group, found: list[Variable]) -> set[str]:
    """What a group reads of the model."""
    return {v.reading for v in found if any(f"{v.local}_ref" in text for text in group.texts)}


def _distinct(found: Iterable[Scored], most: int) -> list[Scored]:
    """The first `most` that explain different things: |x| beside x, where x has one sign, is the same law again, and so
    is what is late beside what is late by the same quantity, whatever it was before the start."""
    kept: list[Scored] = []
    courses: list[np.ndarray] = []
    kinds: set[tuple[int, frozenset[str]]] = set()
    for law in found:
        _, regression, chosen = law
        texts = (text for g in chosen for text in regression.groups[g].kind)
        kind = regression.column, frozenset(text.replace("onset(", "delay(") for text in texts)
        if kind in kinds:
            continue
        course = regression.explained(chosen)
        if all(np.sum((course - c) ** 2) > SAME * np.sum(c**2) for c in courses):
            kept.append(law)
            courses.append(course)
            kinds.add(kind)
        if len(kept) == most:
            break
    return kept


def _answering(locator: Locator, along: Along, column: int) -> frozenset[str]:
    """Unknowns that an effort at a place changes at once."""
    return frozenset(n for k, n in enumerate(_unknowns(locator)) if along.answering[k, column])


def _unknowns(locator: Locator) -> list[str]:
    return [f"der({u.args[0].value})" if u.op == "der" else str(u.value) for u in locator.opened.linear.unknowns]


def _refined(regression: Regression, every: range, strained: bool = False) -> list[tuple[int, ...]]:
    """The best of each kind of term, its shape refined, best first; those that leave parameters where they are believed
    to be, or of those that do not (`strained`)."""

    def admitted(g: int) -> bool:
        strain = regression.strain((g,))
        return 1 <= strain < FURTHER if strained else strain < 1

    scored = dict(zip(every, regression.scores((), every), strict=True))
    best: dict[tuple[str, ...], int] = {}
    for g in sorted(scored, key=lambda g: scored[g]):
        if regression.groups[g].kind not in best and admitted(g):
            best[regression.groups[g].kind] = g
    kinds = list(best.values())
    for zoom in range(ZOOMS):
        finer = [(g, n) for g in kinds[:FAMILIES] for n in _finer(regression.groups[g], zoom)]
        if not finer:
            break
        added = regression.add([n for _, n in finer])
        for (g, _), n, score in zip(finer, added, regression.scores((), added), strict=True):
            scored[n] = score
            k = next(k for k, old in enumerate(kinds) if regression.groups[old].texts == regression.groups[g].texts)
            if scored[n] < scored[kinds[k]] and admitted(n):
                kinds[k] = n
    kinds.sort(key=lambda g: scored[g])
    return [(g,) for g in kinds]


def _finer(group: Group, zoom: int) -> list[Group]:
    """The group with its first shape at values around the present one."""
    if not group.shapes:
        return []
    shape, *others = group.shapes
    reach = shape.step / 4.0**zoom
    values = shape.start + reach * np.linspace(-1, 1, FINE)
    values = values[(values > shape.lower) & (values < shape.upper) & (values != shape.start)]
    return [replace(group, shapes=(replace(shape, start=float(v)), *others)) for v in values]


def _doubled(regression: Regression, single: list[tuple[int, ...]], every: range) -> list[tuple[int, ...]]:
    """The best two groups together, best first, a kind of pair once."""
    scored: dict[tuple[int, ...], float] = {}
    finer = [g for (g,) in single if g not in every]
    level = next((g,) for g in every if regression.groups[g].texts == ("1",))
    beside = [] if _is_coefficient(regression.place.place) else single[:FAMILIES]
    firsts = list(dict.fromkeys([level, *beside]))
    for others in (every, finer):
        for first, scores in zip(firsts, regression.scores_of(firsts, others), strict=True):
            scored |= {(*first, other): score for other, score in zip(others, scores, strict=True)}
    kinds: dict[frozenset, tuple[int, ...]] = {}
    for key in sorted(scored, key=lambda k: scored[k]):
        kinds.setdefault(frozenset(regression.groups[g].kind for g in key), key)
    likely = ((scored[pair], regression, pair) for pair in kinds.values() if regression.strain(pair) < 1)
    better = _refined_pairs(regression, [(pair, score) for score, _, pair in _distinct(likely, PAIRS)])
    return [pair for pair, _ in sorted(better, key=lambda b: b[1])]


def _refined_pairs(
    regression: Regression, pairs: list[tuple[tuple[int, ...], float]]
) -> list[tuple[tuple[int, ...], float]]:  # fmt: skip
    """Pairs with their scores, the shape of either group refined beside the other's."""
    for zoom in range(2):
        for k in (0, 1):
            finer = [_finer(regression.groups[pair[k]], zoom) for pair, _ in pairs]
            added = iter(regression.add([g for group in finer for g in group], wanted=True) if any(finer) else ())
            for n, ((pair, score), group) in enumerate(zip(pairs, finer, strict=True)):
                own = [next(added) for _ in group]
                scores = regression.scores((pair[1 - k],), own) if own else [score]
                best = int(np.argmin(scores))
                if scores[best] < score:
                    trial = (own[best], pair[1]) if k == 0 else (pair[0], own[best])
                    if regression.strain(trial) < 1:
                        pairs[n] = trial, scores[best]
    return pairs


def _proposal(regression: Regression, chosen: tuple[int, ...]) -> Proposal:
    law = Law(regression.place, tuple(regression.groups[g] for g in chosen))
    start = {name: shape.start for name, shape in law.shapes().items()}
    held, found = law.held(), zip(law.numbered(), map(float, regression.coefficients(chosen)), strict=True)
    return Proposal(law, start | {c: -abs(v) if c in held else v for (c, _, _), v in found})  # held is what resists
