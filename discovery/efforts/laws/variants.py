"""Laws like one that was fitted: which of them has the right form, fits from there say."""

from __future__ import annotations

from dataclasses import replace
import re

from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.terms.law_terms import BEYOND, DRY, Group, Shape, Variable, exponent, stribeck


def varied(best: Proposal) -> list[Proposal]:
    """A fitted law with any exponent in the place of one that physics has, with what is beyond a threshold to another
    power, with dry friction that truly sticks in that of a steep one, with one that falls from rest on in that of a
    level one, with a sign as steep as the data says, with a zero elsewhere of what divides it, or changed otherwise by
    what was done; one group at a time."""
    law, values = best.law, best.candidate.attachment.own_values(best.candidate.fit.point)
    found = [*stuck(law, values), *_falling(law, values), *_steep(law, values), *_from_elsewhere(law, values)]
    found += [*_aged(law, values), *_beyond(law, values)]
    for n, group in enumerate(law.groups):
        text = group.texts[0]
        linear = re.fullmatch(r"\((\w+)/\w+_ref\)", text)
        power = re.search(r"(?<=abs)(\(\w+/\w+_ref\))\^([\d.]+)$", text)
        if len(group.texts) > 1 or group.shapes or not (linear or power):
            continue
        start = float(power[2]) if power else 1.0
        freed = f"{text[: power.start(2)]}{{p}}" if power else f"sign({linear[1]})*abs{text}^{{p}}"
        groups = (*law.groups[:n], Group((freed,), (exponent(start),)), *law.groups[n + 1 :])
        found.append(Proposal(Law(law.site, groups), values | {f"p_{n + 1}": start}))
    return found


def _from_elsewhere(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law divided by a length that begins elsewhere than where it is counted from, at first by a tenth of it."""
    found, part = [], 10.0
    for n, group in enumerate(law.groups):
        if length := re.fullmatch(r"1/(\(\w+/\w+_ref\))", group.texts[0]):
            longer = Group((f"1/(1 + {{q}}*abs{length[1]})",), (Shape("q", "1", part, 0.01, 100.0),))
            amount = f"c_{1 + sum(len(g.texts) for g in law.groups[:n])}"
            start = values | {amount: part * values[amount], f"q_{n + 1}": part}
            found.append(Proposal(Law(law.site, (*law.groups[:n], longer, *law.groups[n + 1 :])), start))
    return found


def _aged(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with a coefficient that changes otherwise by what was done: by less and less of it, or by what is
    forgotten with time; or behind its own resistance, as a deposit is, at first by a quarter less at its largest."""
    found = []
    for n, group in enumerate(law.groups):
        text, time = group.texts[0], next((s for s in group.shapes if s.name == "t"), None)
        if not group.ages or len(group.texts) > 1:
            continue
        own = []
        if "{q}" not in text:
            own.append(Group((f"{text}/(1 + {{q}}*abs({text}))",), (*group.shapes, Shape("q", "1", 0.3, 1e-3, 1e3))))
        if time is not None:
            kind = "warmth(" if "spent(" in text else "spent("
            own.append(replace(group, texts=(re.sub(r"\b(warmth|spent)\(", kind, text),)))
        for other in own:
            groups = (*law.groups[:n], other, *law.groups[n + 1 :])
            start = {f"{s.name}_{n + 1}": s.start for s in other.shapes}
            found.append(Proposal(Law(law.site, groups), start | values))
    return found


def _beyond(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with what is beyond a threshold to the other powers that physics has: along a run that a smooth effort
    leads, a sharp bend further on looks like a soft one before it. As much at the end of the range at first."""
    found = []
    for n, group in enumerate(law.groups):
        beyond = re.fullmatch(r"(?:abs)?(\(abs\((.*) - \{q\}\) \+ \2 - \{q\}\))(?:\^([\d.]+))?", group.texts[0])
        if beyond is None or len(group.texts) > 1:
            continue
        end, amount = 2 * (1 - values[f"q_{n + 1}"]), f"c_{1 + sum(len(g.texts) for g in law.groups[:n])}"
        for power in {1.0, *BEYOND} - {float(beyond[3] or 1.0)}:
            text = beyond[1] if power == 1.0 else f"abs{beyond[1]}^{power}"
            groups = (*law.groups[:n], replace(group, texts=(text,)), *law.groups[n + 1 :])
            start = values | {amount: values[amount] * end ** (float(beyond[3] or 1.0) - power)}
            found.append(Proposal(Law(law.site, groups), start))
    return found


def stuck(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with dry friction that truly sticks in the place of a steep one."""
    return [
        _sticking(law, values, n, v) for n, g in enumerate(law.groups) for v in law.site.variables
        if v.sticks and g.texts == (f"tanh({{q}}*{v.scaled})",)
    ]  # fmt: skip


_BENT = (  # what falls with the part {q} that something has at the end of its range, and what it goes with where little
    (re.compile(r"\(1/\(1 \+ \{q\}\*(.+)\) - 1\)"), "{0}"),
    (re.compile(r"\((\(\w+/\w+_ref\))/\(1 \+ \{q\}\*(.+)\) - \1\)"), "{0}*{1}"),
)


def unbent(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with what saturates so far out that it has lost less than half at the end of the range as the power with
    which it begins."""
    found = []
    for n, group in enumerate(law.groups):
        name, amount = f"q_{n + 1}", f"c_{1 + sum(len(g.texts) for g in law.groups[:n])}"
        for bent, power in _BENT if len(group.texts) == 1 else ():
            parts = bent.fullmatch(group.texts[0])
            if parts is not None and values[name] < 1:
                straight = Group((power.format(*parts.groups()),))
                start = {k: v for k, v in values.items() if k != name} | {amount: -values[amount] * values[name]}
                found.append(Proposal(Law(law.site, (*law.groups[:n], straight, *law.groups[n + 1 :])), start))
    return found


def _steep(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with a smooth sign of any steepness in the place of a variable's own: under load what creeps near zero is
    told by it."""
    found, steepness = [], Shape("q", "1", 50.0, 0.5, 5e3, (), 40.0)  # from that of DRY
    for n, group in enumerate(law.groups):
        for v in law.site.variables if len(group.texts) == 1 and not group.shapes else ():
            smooth = f"tanh({{q}}*{v.scaled})"
            text = group.texts[0].replace(v.dry, smooth).replace(DRY.format(x=v.scaled), smooth)
            if text != group.texts[0]:
                groups = (*law.groups[:n], Group((text,), (steepness,)), *law.groups[n + 1 :])
                found.append(Proposal(Law(law.site, groups), values | {f"q_{n + 1}": steepness.start}))
    return found


def _falling(law: Law, values: dict[str, float]) -> list[Proposal]:
    """The law with a Stribeck curve in the place of dry friction of one level, which breaks away by a part higher, at
    several speeds that it falls over: fits end in dips, where what sticks slips a sample later."""
    found = []
    for n, group in enumerate(law.groups):
        for v in (v for v in law.site.variables if v.sticks and group.texts == (v.dry,)):
            changed = Law(law.site, (*law.groups[:n], stribeck(v, steep=True), *law.groups[n + 1 :]))
            at = sum(len(g.texts) for g in law.groups[:n])  # of its terms
            numbers = [values[c] for c, _, _ in law.numbered()]
            numbers.insert(at + 1, numbers[at])
            start = {n: x for n, x in values.items() if not n.startswith("c_")}
            start |= {c: x for (c, _, _), x in zip(changed.numbered(), numbers, strict=True)}
            start[f"p_{n + 1}"], higher, speed = 1.5, changed.numbered()[at + 1][0], f"q_{n + 1}"
            found += [
                Proposal(changed, start | {higher: part * numbers[at], speed: q})
                for part in (0.25, 0.5) for q in (0.03, 0.1, 0.3)
            ]  # fmt: skip
    return found


def _sticking(law: Law, values: dict[str, float], n: int, speed: Variable) -> Proposal:
    """The law with dry friction that sticks in the place of group n, which is as good as that where it is steep."""
    groups = [*law.groups[:n], Group((speed.dry,)), *law.groups[n + 1 :]]
    return Proposal(Law(law.site, tuple(groups)), {name: v for name, v in values.items() if name != f"q_{n + 1}"})
