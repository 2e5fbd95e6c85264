"""An empirical law: a sparse sum of terms at a place, and the component of a model that it becomes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
import re

from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.catalogue import Effect, EffectParameter
from lacuna.discovery.catalogue.places import Device, Line, Shaft
from lacuna.discovery.efforts.places import sites
from lacuna.discovery.efforts.places.families import said_of_all
from lacuna.discovery.efforts.places.insertion import States, component
from lacuna.discovery.law.terms.forms import form_of, picked
from lacuna.discovery.law.terms.law_terms import Group, Shape, Variable
from lacuna.discovery.law.terms.unscaled import unscaled


@dataclass(frozen=True)
class Site:
    """A place with the variables that a law there may use and the unit of the effort that it gives; `offered` are the
    kinds of groups of one variable and of several that laws are picked from, where the pick has a price."""

    place: Shaft | Line | Device | sites.Site
    location: str
    unit: str
    variables: tuple[Variable, ...]
    offered: tuple[int, int] | None = None

    @property
    def sizes(self) -> dict[str, float]:
        return {v.local: v.size for v in self.variables}


@dataclass(frozen=True)
class Law:
    """An `Empirical` law: groups of terms at a site; coefficients are c_1, c_2, ... in the order of the terms."""

    site: Site
    groups: tuple[Group, ...] = ()

    @property
    def terms(self) -> int:
        """Groups beside a constant: zero of a temperature, or of a sensor, is anywhere."""
        return sum(g.texts != ("1",) for g in self.groups)

    def numbered(self) -> list[tuple[str, Group, dict[str, str]]]:
        """(coefficient, group, names of its shapes) of every term's text, in order."""
        result, count = [], 0
        for n, group in enumerate(self.groups):
            shapes = {s.name: f"{s.name}_{n + 1}" for s in group.shapes}
            for text in group.texts:
                count += 1
                result.append((f"c_{count}", text, shapes))
        return result

    def held(self) -> set[str]:
        """Coefficients that no fit moves."""
        flags = [group.held for group in self.groups for _ in group.texts]
        return {c for (c, _, _), held in zip(self.numbered(), flags, strict=True) if held}

    def shapes(self) -> dict[str, Shape]:
        return {f"{s.name}_{n + 1}": s for n, group in enumerate(self.groups) for s in group.shapes}

    def text(self) -> str:
        """The right-hand side in the names of the component."""
        return " + ".join(f"{c}*{text.format(**shapes)}" for c, text, shapes in self.numbered())

    def references(self) -> list[Variable]:
        return [v for v in self.site.variables if f"{v.local}_ref" in self.text()]

    def course(self) -> str:
        """The right-hand side in variables of the model, its numbers as names."""
        whole = self.text()
        for v in self.references():
            whole = _renamed(whole.replace(v.scaled, v.reading), v.local, v.reading)
        return whole

    def expression(self, values: Mapping[str, float]) -> str:
        """The law in variables of the model, with its numbers; `values` by the component's own names."""
        known = dict(values) | {f"{v.local}_ref": v.size for v in self.site.variables}
        terms = []
        for c, text, shapes in self.numbered():
            limit = self._limit(text.format(**{s: f"{values[full]:.4g}" for s, full in shapes.items()}))
            terms.append(limit or unscaled(f"{c}*{text.format(**shapes)}", known))
        whole = " + ".join(terms).replace("+ -", "- ")
        for v in self.site.variables:
            whole = _renamed(whole, v.local, v.reading)
        return said_of_all(whole, self.site.place.members) if isinstance(self.site.place, sites.Site) else whole

    def _limit(self, text: str) -> str:
        """What holds a rate, of which the coefficient only is the unit, as said to readers; "" of other terms."""
        found = re.fullmatch(r"bounded\(\((\w+)/\w+_ref\), ([^)]+)\)", text)
        if not found:
            return ""
        rate = next(v for v in self.site.variables if v.local == found[1])
        return f"limit({rate.reading}, {float(found[2]) * rate.size:.4g})"

    def pick(self) -> float:
        """Nats that say which groups these are among all that there are; 0 where the pick has no price."""
        if self.site.offered is None:
            return 0.0
        return sum(picked(g.texts, self.site.variables, self.site.unit, self.site.offered) for g in self.groups)

    def alike(self) -> tuple[str, str]:
        """What a law is not told from, by its name, and the variable to blame: dry friction of a speed that never turns
        is a level."""
        if not any(group.texts == ("1",) for group in self.groups):
            return "", ""
        steady = [v for v in self.site.variables if v.sticks and not v.turns]
        names = [(form_of([(v.dry, {})], [v], self.site.unit, {}), v.name) for v in steady]
        return next((pair for pair in names if pair[0]), ("", ""))

    def form(self, values: Mapping[str, float]) -> str:
        """The name of a known form that the law has; "" where it has none."""
        terms = [(text, shapes) for _, text, shapes in self.numbered()]
        return form_of(terms, self.site.variables, self.site.unit, values)


def component_of(law: Law) -> str:
    return f"law_{re.sub(r'[^A-Za-z0-9]+', '_', law.site.location).strip('_')}"


def law_at(attachment: Attachment, point: Mapping[str, float]) -> str:
    """A law with its numbers at a point, in variables of the model; "" for a named effect."""
    return attachment.law.expression(attachment.own_values(point)) if attachment.law else ""


def form_at(attachment: Attachment, point: Mapping[str, float]) -> str:
    """The name of a known form that a law has at a point; "" where it has none."""
    return attachment.law.form(attachment.own_values(point)) if attachment.law else ""


def _signature(law: Law) -> str:
    """What a law is like, in words: of what it is made."""
    names = dict.fromkeys(f"{v.name} - {v.minus}" if v.minus else v.name for v in law.references())
    return f"an effort in {law.site.unit or '1'}, {'a function of ' + ', '.join(names) if names else 'constant'}"


def attach(law: Law) -> Attachment:
    """The law as an effect of identifier `unknown`, its component's source carried along."""
    site = law.site
    parameters = [EffectParameter(c, site.unit, "Coefficient", -1e30, 1e30, 0.0) for c, _, _ in law.numbered()]
    parameters += [EffectParameter(n, s.unit, "Shape", s.lower, s.upper, s.start) for n, s in law.shapes().items()]
    component, place = component_of(law), site.place
    effect = Effect(
        "unknown", class_name(law), "Empirical law", _ATTACHES[type(place)], tuple(parameters),
        signature=_signature(law),
    )  # fmt: skip
    own = _OWN[type(place)]
    signals = tuple((v.local, v.reading) for v in law.references() if v.local not in own)
    return Attachment(
        effect, component, site.location,
        shaft=place if isinstance(place, Shaft) else None,
        lines=(place,) if isinstance(place, Line) else (),
        device=place if isinstance(place, Device) else None,
        site=place if isinstance(place, sites.Site) else None,
        signals=signals, definition=_source(law, signals), law=law,
    )  # fmt: skip


_ATTACHES = {Shaft: "flange", Line: "line", Device: "imposed", sites.Site: "site"}
_OWN = {Shaft: ("angle", "w"), Line: ("i",), Device: ("s", "v"), sites.Site: ()}
_BASE = {
    Shaft: ("Lacuna.Effects.Interfaces.FlangeEffect", "tau"),
    Line: ("Lacuna.Interfaces.TwoPin", "v"),
    Device: ("Lacuna.Interfaces.ImposedMotion", "f"),
}


def class_name(law: Law) -> str:
    return "Law" + "".join(part.capitalize() for part in re.split(r"[^A-Za-z0-9]+", law.site.location))


def _source(law: Law, signals: tuple[tuple[str, str], ...]) -> str:
    """The component's class, to be nested in the amended model."""
    if isinstance(law.site.place, sites.Site):
        return _source_at(law, law.site.place)
    base, effort = _BASE[type(law.site.place)]
    lines = [f'model {class_name(law)} "Empirical law"', f"  extends {base};"]
    units = {v.local: v.unit for v in law.site.variables}
    for name, _ in signals:
        lines.append(f'  Lacuna.Interfaces.RealInput {name}(unit="{units[name]}") "Variable of the law";')
    for c, _, _ in law.numbered():
        lines.append(f'  parameter Real {c}(unit="{law.site.unit}") = 0 "Coefficient";')
    for name, shape in law.shapes().items():
        lines.append(f'  parameter Real {name}(unit="{shape.unit}") = {shape.start:.6g} "Shape";')
    for v in law.references():
        lines.append(f'  parameter Real {v.local}_ref(unit="{v.unit}") = {v.size:.6g} "Largest value recorded";')
    lines += ["equation", f"  {effort} = noEvent({law.text()});", f"end {class_name(law)};"]
    return "\n".join(lines)


def _source_at(law: Law, place: sites.Site) -> str:
    unit = law.site.unit
    parameters = [EffectParameter(c, unit, "Coefficient", -1e30, 1e30, 0.0) for c, _, _ in law.numbered()]
    parameters += [EffectParameter(n, s.unit, "Shape", 0, 0, s.start) for n, s in law.shapes().items()]
    used = law.references()
    parameters += [EffectParameter(f"{v.local}_ref", v.unit, "Largest value", 0, 0, v.size) for v in used]
    signals = [(v.local, v.name, v.unit) for v in used]
    text, states = _with_states(law.text())
    sticking = [v.local for v in used if f"dry{v.scaled}" in text]
    text = re.sub(r"\bdry\((\w+)/\w+_ref\)", r"sense_\1", text)
    states = replace(states, sticking=sticking)
    return component(place, class_name(law), "Law", signals, parameters, f"noEvent({text})", unit, states)


def _with_states(text: str) -> tuple[str, States]:
    """A law's text with a variable in the place of each quantity that has a memory, and what these are."""
    text, lags = _named(text, r"\b(lag|warmth|total|spent)\(([^,]+), ([^,)]+)\)", "lagged")
    text, late = _named(text, r"\b(delay|onset)\(([^,]+), ([^,)]+), ([^,)]+)\)", "late")
    text, swings = _named(text, r"\bswing\(([^,]+), ([^,)]+), ([^,)]+)\)", "swing")
    text, bounds = _named(text, r"\bbounded\(([^,]+), ([^,)]+)\)", "beyond")
    text, bristles = _named(text, r"\bhysteresis\(([^,]+), ([^,)]+)\)", "bent")
    return text, States(lags, late, swings, bounds, bristles)


def _named(text: str, pattern: str, name: str) -> tuple[str, list[tuple[str, ...]]]:
    """The text with numbered names for what the pattern finds, alike ones once; (name, groups of the pattern)."""
    known: dict[tuple[str, ...], str] = {}
    text = re.sub(pattern, lambda found: known.setdefault(found.groups(), f"{name}_{len(known) + 1}"), text)
    return text, [(number, *groups) for groups, number in known.items()]


def _renamed(text: str, local: str, name: str) -> str:
    return re.sub(rf"(?<![\w.]){local}(?![\w.(])", name, text)
