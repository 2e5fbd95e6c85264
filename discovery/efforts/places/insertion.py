"""Components that put something at a site: an input that acts there, or a law."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from lacuna.discovery.catalogue.attachment import OWN, Attachment
from lacuna.discovery.catalogue.catalogue import Effect, EffectParameter
from lacuna.discovery.efforts.places.sites import Site

Signal = tuple[str, str, str]  # name in the component, expression of the model, unit
Lag = tuple[
    str, str, str, str
]  # name of a state of the component, one of _FOLLOWER, what it follows, its time constant
Late = tuple[str, str, str, str, str]  # a variable, delay | onset, what arrives in it, how late, kept how far apart
Swing = tuple[str, str, str, str]  # a variable, what it swings behind, its natural frequency and damping ratio
Bristle = tuple[str, str, str]  # the bend of it, what drags it along, the time it takes to bend at one of that
Bound = tuple[str, str, str]  # a variable, the rate that it holds, the limit of that

_FOLLOWER = {"lag": ", late", "warmth": ", late", "total": ", all since the start", "spent": " has used up"}
KEPT = 128  # samples of what is late: the interpolation between them is off by less than a thousandth of a slow wave


@dataclass(frozen=True)
class States:
    """What a law remembers; speeds that stick have a `sense_` of the sliding."""

    lags: Sequence[Lag] = ()
    late: Sequence[Late] = ()
    swings: Sequence[Swing] = ()
    bounds: Sequence[Bound] = ()
    bristles: Sequence[Bristle] = ()
    sticking: Sequence[str] = ()

    def declarations(self) -> list[str]:
        lines = [line for lag in self.lags for line in _follower(*lag)]
        lines += [f'  Real {n}, stretch_{n}, behind_{n} "What swings behind {x}";' for n, x, *_ in self.swings]
        lines += [f'  Real {bend} "Bend of bristles along {along}";' for bend, along, _ in self.bristles]
        for n, rate, _ in self.bounds:
            lines.append(f'  Integer side_{n}(start=0, fixed=true) "1 at the upper limit of {rate}, -1 at the lower";')
            lines.append(f'  Real {n} "What {rate} would be beyond its limit";')
        lines += [line for speed in self.sticking for line in _modes(speed)]
        return lines + [line for quantity in self.late for line in _kept(*quantity)]

    def beginning(self) -> list[str]:
        """At rest with what they follow, cold, bristles straight."""
        starts = [f"  {state} = {followed if kind == 'lag' else 0};" for state, kind, followed, _ in self.lags]
        starts += [line for n, x, *_ in self.swings for line in (f"  stretch_{n} = 0;", f"  behind_{n} = {x};")]
        starts += [f"  {bend} = 0;" for bend, *_ in self.bristles]
        lines = ["initial equation", *starts] if starts else []
        return lines + [line for quantity in self.late for line in _keeping(quantity[0], quantity[2])]

    def equations(self) -> list[str]:
        lines = [line for quantity in self.late for line in _arrives(*quantity[:4])]
        lines += [_follows(*lag) for lag in self.lags]
        lines += [line for swing in self.swings for line in _swings(*swing)]
        lines += [f"  {t}*der({bend}) = {y} - noEvent(abs({y}))*{bend};" for bend, y, t in self.bristles]
        lines += [line for bound in self.bounds for line in _holds(*bound)]
        return lines + [line for speed in self.sticking for line in _sticks(speed)]


def effort_at(number: int) -> str:
    """The model's input that acts as effort at a site."""
    return f"{OWN}site_{number}_effort"


def probe(site: Site, number: int) -> tuple[Attachment, str]:
    """(attachment, name of the model's input) of an input that acts as effort at a site."""
    own, name = f"{OWN}site_{number}", effort_at(number)
    effect = Effect("unknown", own.title(), "Missing effort", "site", ())
    source = component(site, effect.class_path, "Missing effort", (("u", "", ""),), [], "u")
    return Attachment(effect, own, site.label, site=site, signals=(("u", name),), definition=source), name


def component(
    site: Site, name: str, title: str, signals: Sequence[Signal], parameters: Sequence[EffectParameter], text: str,
    unit: str = "", states: States = States(),
) -> str:  # fmt: skip
    """Source of a class that gives the effort `text`: into a node, lost across an edge, from the first port of a
    component to its second beside it, or added to an equation."""
    site = site.parts[0] if site.members else site
    declared, does = site.acting(text) if site.outside else (f"Real effort{_unit(unit)};", [f"effort = {text};"])
    lines = [f'model {name} "{title}"', f"  {declared}"]
    for local, _, its in signals:
        lines.append(f"  input Real {local}{_unit(its)};")
    lines += [f'  parameter Real {p.name}{_unit(p.unit)} = {p.default:.10g} "{p.description}";' for p in parameters]
    lines += [*states.declarations(), *states.beginning(), "equation", *states.equations()]
    lines += [f"  {equation}" for equation in does]
    return "\n".join([*lines, f"end {name};"])


def _follower(state: str, kind: str, followed: str, time: str) -> list[str]:
    lines = [f'  Real {state} "{followed}{_FOLLOWER[kind]}";']
    return [*lines, f'  constant Real over_{state}(unit="s") = {time};'] if kind == "total" else lines


def _follows(state: str, kind: str, followed: str, time: str) -> str:
    x = f"noEvent({followed})" if "abs(" in followed else followed
    does = {"total": x, "spent": f"{x}*(1 - {state})"}.get(kind, f"{x} - {state}")
    return f"  {f'over_{state}' if kind == 'total' else time}*der({state}) = {does};"


def _kept(name: str, begins: str, followed: str, late: str, apart: str) -> list[str]:
    return [
        f'  Real {name} "{followed}, by {late} late";',
        f'  constant Real apart_{name}(unit="s") = {apart};',
        f'  discrete Real kept_{name}[{KEPT}](each start=0, each fixed=true) "Its latest samples, newest first";',
        f'  discrete Real latest_{name}(unit="s", start=0, fixed=true) "Time of the newest";',
        f'  discrete Real begin_{name}(unit="s", start=0, fixed=true) "Time of the first";',
        f'  Real age_{name}(unit="s") = time - latest_{name} "Time since the newest";',
    ]


def _keeping(name: str, followed: str) -> list[str]:
    """What is late, sampled as long as it lasts; before the start it was what it is there."""
    kept = f"kept_{name}"
    return [
        "algorithm",
        f"  when {{initial(), sample(0, apart_{name})}} then",
        f"    for k in {KEPT}:-1:2 loop",
        f"      {kept}[k] := if initial() then {followed} else pre({kept}[k - 1]);",
        "    end for;",
        f"    {kept}[1] := {followed};",
        f"    latest_{name} := time;",
        f"    begin_{name} := if initial() then time else pre(begin_{name});",
        "  end when;",
    ]


def _arrives(name: str, begins: str, followed: str, late: str) -> list[str]:
    kept, age, apart = f"kept_{name}", f"age_{name}", f"apart_{name}"
    start = f"min(1, max(0, (time - begin_{name} - {late})/{apart} + 0.5))*" if begins == "onset" else ""
    return [
        f"  {name} = noEvent({start}(if {age} > {late} then {followed} + ({kept}[1] - {followed})*{late}/{age}",
        f"    else sum({kept}[k]*max(0, 1 - abs(({age} - {late})/{apart} + k - 1)) for k in 1:{KEPT})));",
    ]


def _swings(name: str, followed: str, w: str, z: str) -> list[str]:
    """A mass on a spring, moved at the other end: its speed `behind`, the `stretch` in units of the speed."""
    return [
        f"  {name} = stretch_{name} + 2*{z}*(behind_{name} - {followed});",
        f"  der(stretch_{name}) = {w}*(behind_{name} - {followed});",
        f"  der(behind_{name}) = -{w}*{name};",
    ]


def _holds(name: str, rate: str, limit: str) -> list[str]:
    """What keeps a rate at its limit while it would go beyond."""
    side = f"side_{name}"
    return [
        f"  0 = if {side} == 0 then {name} else {rate} - {side}*{limit};",
        f"  {side} = if pre({side}) == 0 then (if {rate} > {limit} then 1 elseif {rate} < -{limit} then -1 else 0)",
        f"    elseif pre({side})*{name} < 0 then 0 else pre({side});",
    ]


def _modes(speed: str) -> list[str]:
    return [
        f'  Integer mode_{speed}(start=0, fixed=true) "1 slides forward, -1 backward, 0 stuck";',
        f'  Real sense_{speed} "Sense in which it slides; while stuck, share of the level that holds it";',
        f'  Real own_{speed} "{speed}";',
        f'  Real hold_{speed} "Share of the level that holds it; zero while it slides";',
        f'  Real stuck_{speed} "Speed while stuck: zero unless something else sets it";',
        f'  Real along_{speed} "Speed in the sense in which it slides; positive while stuck";',
        f'  constant Real second_{speed}(unit="s") = 1;',
    ]


def _sticks(speed: str) -> list[str]:
    """Dry friction that truly sticks (see Lacuna.Interfaces.PartialFriction), its level one."""
    mode, own, small = f"mode_{speed}", f"own_{speed}", f"1e-10*{speed}_ref"
    return [
        f"  {own} = {speed};",
        f"  0 = if {mode} == 0 then second_{speed}*der({own})/{speed}_ref else sense_{speed} - {mode};",
        f"  hold_{speed} = if {mode} == 0 then sense_{speed} else 0;",
        f"  stuck_{speed} = if {mode} == 0 then {own} else 0;",
        f"  along_{speed} = if {mode} == 0 then 1 else {mode}*{own}/{speed}_ref;",
        f"  {mode} = if pre({mode}) == 0 then",
        f"      (if stuck_{speed} > {small} then 1 elseif stuck_{speed} < -{small} then -1",
        f"       elseif hold_{speed} > 1 then 1 elseif hold_{speed} < -1 then -1 else 0)",
        f"    elseif along_{speed} < 0 then 0 else pre({mode});",
        f"  when {mode} == 0 then",
        f"    reinit({own}, 0);",
        "  end when;",
    ]


def _unit(unit: str) -> str:
    return f'(unit="{unit}")' if unit else ""
