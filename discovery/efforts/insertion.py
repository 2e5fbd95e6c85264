"""Components that put something at a site: an input that acts there, or a law."""

from __future__ import annotations

from collections.abc import Sequence

from lacuna.discovery.catalogue.amend import Attachment
from lacuna.discovery.catalogue.catalogue import Effect, EffectParameter
from lacuna.discovery.efforts.sites import Site

Signal = tuple[str, str, str]  # name in the component, expression of the model, unit
Lag = tuple[str, str, str]  # name of a state of the component, what it follows, its time constant


def probe(site: Site, number: int) -> tuple[Attachment, str]:
    """(attachment, name of the model's input) of an input that acts as effort at a site."""
    name = f"probe_site_{number}"
    effect = Effect("unknown", f"Probe{number}", "Missing effort", "site", ())
    source = component(site, effect.class_path, "Missing effort", (("u", "", ""),), [], "u")
    return Attachment(effect, f"probe{number}", site.label, site=site, signals=(("u", name),), definition=source), name


def component(
    site: Site, name: str, title: str, signals: Sequence[Signal], parameters: Sequence[EffectParameter], text: str,
    unit: str = "", lags: Sequence[Lag] = (),
) -> str:  # fmt: skip
    """Source of a class that gives the effort `text`: into a node, lost across an edge, from the first port of a
    component to its second beside it, or added to an equation."""
    lines = [f'model {name} "{title}"']
    port = site.port
    if site.kind == "node":
        lines.append(f"  {port.path} port;")
    elif site.kind in ("edge", "branch"):
        lines.append(f"  {port.path} a, b;")
    else:
        lines.append(f"  Real effort{_unit(unit)};")
    for local, _, unit in signals:
        lines.append(f"  input Real {local}{_unit(unit)};")
    lines += [f'  parameter Real {p.name}{_unit(p.unit)} = {p.default:.10g} "{p.description}";' for p in parameters]
    lines += [f'  Real {state} "{followed}, late";' for state, followed, _ in lags]
    lines += ["initial equation", *(f"  {state} = {followed};" for state, followed, _ in lags)] if lags else []
    lines.append("equation")
    lines += [f"  {time}*der({state}) = {followed} - {state};" for state, followed, time in lags]
    if site.kind == "node":
        lines.append(f"  port.{port.flow} = -({text});")
    elif site.kind == "edge":
        lines += [f"  a.{port.flow} + b.{port.flow} = 0;", f"  a.{port.potential} - b.{port.potential} = {text};"]
    elif site.kind == "branch":
        lines += [f"  a.{port.flow} + b.{port.flow} = 0;", f"  b.{port.flow} = -({text});"]
    else:
        lines.append(f"  effort = {text};")
    return "\n".join([*lines, f"end {name};"])


def _unit(unit: str) -> str:
    return f'(unit="{unit}")' if unit else ""
