"""Which laws are worth a fit: terms at a place ranked by the regression on its effort, alone and in pairs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain, islice

import numpy as np

from lacuna.discovery.efforts.guide import Guided
from lacuna.discovery.efforts.laws.offered import is_coefficient, offered_at, read_by, unknowns
from lacuna.discovery.efforts.laws.regression import FURTHER, Regression
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.efforts.places.place import Place
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.terms.courses import evaluate
from lacuna.discovery.law.terms.law_terms import AGES, DRY, Group, Variable

Scored = tuple[float, Regression, tuple[int, ...]]  # deviance and prices, groups of a regression

FAMILIES = 12  # kinds of terms whose shapes are refined, and beside which, and a constant, a second one is looked for
ZOOMS, FINE = 3, 9  # times that a shape is refined, and values each time; each is a quarter of the last one's spacing
PAIRS = 6  # kinds of pairs whose shapes are refined
SAME = 1e-3  # share of what a law explains, by which another one must differ to be tried beside it


def proposals(
    locator: Locator, site: Site, guided: Guided, most: int, strained: bool = True, apart: bool = False,
    short: bool = False,
) -> Iterator[list[Proposal]]:  # fmt: skip
    """Laws of one group of terms at a place, then, where `strained` ones are wanted, such as parameters would have to
    leave their beliefs for, then, unless `short` ones alone are, of two groups; `most` of each, the most telling first,
    each list found when it is asked for. In any of the quantities in which an effort does the same there, and at last,
    where wanted, in each of them `apart`: where parameters are far off, what a law promises in one says little beside
    another one's promise.

    Along a run that an effort of a smooth course leads, a stiff contact is met too early or too late; to first order
    parameters stand for that, and a fit puts them back.
    """
    quantities = (site.place, *site.place.other)
    offered = [offered_at(locator, place, guided) for place in quantities]
    ones = [_told_here(place, r, _refined(r, every)) for place, (r, every) in zip(quantities, offered, strict=True)]
    first = _best([(r, groups) for (r, _), groups in zip(offered, ones, strict=True)], most)
    first += _held(locator, guided, offered, first)
    first += _limited(offered, ones, first)
    yield _forgetting(offered, first)
    if strained:
        yield _forgetting(offered, _best([(r, _refined(r, every, strained=True)) for r, every in offered], most))
    if short:
        return
    twos = [(r, _doubled(r, groups, every)) for (r, every), groups in zip(offered, ones, strict=True)]
    pairs = _best(twos, most)
    yield _forgetting(offered, pairs + _from_a_level(twos, pairs))
    for (r, _), one, (_, two) in list(zip(offered, ones, twos, strict=True))[1:] if apart else ():
        for groups in (one, two):
            yield _forgetting(offered, _best([(r, groups)], most))


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
    for regression, every in (pair for pair in offered if len(pair[0].columns) == 1):
        along = guided.pieces[0].along
        for v in (v for v in regression.place.variables if v.sticks and v.turns):
            level = _level(guided, v)
            sense = np.mean(along.direct[:, unknowns(locator).index(f"der({v.name})"), regression.columns[0]])
            laws = [_proposal(regression, (g,)) for g in every if regression.groups[g].texts == (v.dry,)]
            found += [replace(p, start={"c_1": level}) for p in laws if level * sense < 0 and p.law.text() not in known]
    return found


def _limited(
    offered: list[tuple[Regression, range]], ones: list[list[tuple[int, ...]]], others: list[Proposal]
) -> list[Proposal]:  # fmt: skip
    """A limit of a rate, where it is among the best kinds and no other law of it is tried. Parameters that have stood
    for it (a time constant that is too long) leave little of it beyond what is in proportion; only a fit puts them
    back."""
    known = {text for law in others for group in law.law.groups for text in group.texts}
    found = []
    for (regression, _), best in zip(offered, ones, strict=True):
        limits = (law for law in best[:FAMILIES] if regression.groups[law[0]].texts[0].startswith("bounded("))
        found += [_proposal(regression, law) for law in limits if regression.groups[law[0]].texts[0] not in known]
    return found[:1]


def _from_a_level(twos: list[tuple[Regression, list[tuple[int, ...]]]], others: list[Proposal]) -> list[Proposal]:
    """The best term beside a level in each quantity, which is one term from a zero of its own (of a temperature, say),
    where none of two groups that is tried is so: others with more numbers bend further to what is no law. What is
    the same in several balances has none: it would be one of any of them."""

    def is_level(texts: tuple[str, ...]) -> bool:
        return texts == ("1",)

    if any(is_level(group.texts) for law in others for group in law.law.groups):
        return []
    own = ((r, pairs) for r, pairs in twos if r.place.place.kind not in ("exchange", "every"))
    found = ((r, [p for p in pairs if any(is_level(r.groups[g].texts) for g in p)]) for r, pairs in own)
    return [_proposal(r, pairs[0]) for r, pairs in found if pairs]


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
    if not place.only and not is_coefficient(place.sites[0]):
        return laws
    return [law for law in laws if any(regression.groups[g].texts != ("1",) for g in law)]


def _best(found: list[tuple[Regression, list[tuple[int, ...]]]], most: int) -> list[Proposal]:
    """The best laws in a place's own quantity, and before them those in its others that promise more than any of these;
    all explain different things. The last of them is of the state alone whose balance it is, where none is: along a run
    that a smooth effort leads, speeds on both ends of a stiff rope change their sign as one, and which of them rubs
    only fits tell."""
    own, *others = (sorted(_scored(r, groups), key=_in_order) for r, groups in found)
    promised = own[0][0] if own else np.inf
    more = [law for law in sorted(chain.from_iterable(others), key=_in_order) if law[0] < promised]
    beyond = _distinct((law for law in more if not _ages(law)), most)
    best = _distinct([*beyond, *(law for law in own if not _ages(law))], len(beyond) + most)
    alone = next((law for law in own if _is_own(law)), None)
    if alone is not None and len(best) >= most > 1 and not any(map(_is_own, best)):
        best[-1] = alone
    worst = best[-1][0] if best else np.inf
    aged = _distinct((law for law in (*more, *own) if _ages(law) and law[0] < worst), most - 1)
    return [_proposal(r, groups) for _, r, groups in sorted([*best, *aged], key=_in_order)]


def _ages(law: Scored) -> bool:
    """Whether a law is of what was done since the start: many such are alike, and leave no others room."""
    _, regression, chosen = law
    return any(regression.groups[g].ages for g in chosen)


def _in_order(law: Scored) -> tuple[int, int]:
    """By the score to a nat, in which a level over another one of the same unit comes after the level itself."""
    score, regression, chosen = law
    texts = [text for g in chosen for text in regression.groups[g].texts]
    apart = [v for v in regression.place.variables if v.minus and any(v.scaled in text for text in texts)]
    return round(score), len(apart)


def _is_own(law: Scored) -> bool:
    """Whether a law is of one group, in the state alone whose rate the effort changes at once."""
    _, regression, chosen = law
    found = list(regression.place.variables)
    read = read_by(regression.groups[chosen[0]], found)
    return len(chosen) == 1 and bool(read) and read <= {v.reading for v in found if v.sticks}


def _scored(regression: Regression, found: list[tuple[int, ...]]) -> list[Scored]:
    return [(regression.scores(groups[:-1], groups[-1:])[0], regression, groups) for groups in found]


def _distinct(found: Iterable[Scored], most: int) -> list[Scored]:
    """The first `most` that explain different things: |x| beside x, where x has one sign, is the same law again, and so
    is what is late beside what is late by the same quantity, whatever it was before the start, and what has changed by
    one quantity, however."""
    kept: list[Scored] = []
    courses: list[np.ndarray] = []
    kinds: set[tuple[tuple[int, ...], frozenset[str]]] = set()
    for law in found:
        _, regression, chosen = law
        texts = (text.replace("onset(", "delay(") for g in chosen for text in regression.groups[g].kind)
        kind = regression.columns, frozenset(AGES.sub(r"aged(\1)", text) for text in texts)
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
        finer = [(g, n) for g in _foremost(regression, kinds) for n in _finer(regression.groups[g], zoom)]
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


def _foremost(regression: Regression, kinds: list[int]) -> list[int]:
    """The best kinds, and the best of those of what was done since the start."""
    aged = [g for g in kinds if regression.groups[g].ages]
    return [*[g for g in kinds if not regression.groups[g].ages][:FAMILIES], *aged[: FAMILIES // 2]]


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
    plain = [(g,) for (g,) in single if not regression.groups[g].ages]  # the second may be of what was done
    beside = [] if is_coefficient(regression.place.place) else plain[:FAMILIES]
    firsts = list(dict.fromkeys([level, *beside]))
    for others in (every, finer):
        for first, scores in zip(firsts, regression.scores_of(firsts, others), strict=True):
            scored |= {(*first, other): score for other, score in zip(others, scores, strict=True)}
    kinds: dict[frozenset, tuple[int, ...]] = {}
    for key in sorted(scored, key=lambda k: scored[k]):
        kinds.setdefault(frozenset(regression.groups[g].kind for g in key), key)
    likely = (pair for pair in kinds.values() if regression.strain(pair) < 1)  # asked of the best alone: it takes long
    kept = [pair for _, _, pair in _distinct(((scored[p], regression, p) for p in likely), PAIRS)]
    from_a_level = (pair for pair in kinds.values() if level[0] in pair and pair not in kept)
    kept += islice((pair for pair in from_a_level if regression.strain(pair) < 1), 1)
    better = _refined_pairs(regression, [(pair, scored[pair]) for pair in kept])
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
