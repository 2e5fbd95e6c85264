"""Sets of connected scalars, and what the specification demands of them (Modelica 3.6, 9.2 and 9.3)."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.connections.connectors import End, Part
from lacuna.codegen.symbolic.union_find import UnionFind


@dataclass
class ConnectionSets:
    """Ends of flows, streams and potentials apart; remembers a place and a model for each set."""

    ends: UnionFind = field(default_factory=UnionFind)
    kind: dict[End, str] = field(default_factory=dict)
    parts: dict[End, Part] = field(default_factory=dict)
    span: dict[End, Span] = field(default_factory=dict)
    origin: dict[End, str] = field(default_factory=dict)
    sources: UnionFind = field(default_factory=UnionFind)  # (model, causal scalar)
    causal: dict[Hashable, tuple[Part, Span]] = field(default_factory=dict)
    outside: set[tuple[str, str]] = field(default_factory=set)  # (model, scalar of its own connector): acausal ones

    def join(self, a: Part, b: Part, span: Span, origin: str) -> None:
        ends = [p.end if p.kind != "potential" else End(p.end.name, False) for p in (a, b)]
        root = self.ends.find(ends[0])
        self.ends.join(*ends)
        for end, part in zip(ends, (a, b), strict=True):
            self.kind[end], self.parts[end] = part.kind, part
        self.span.setdefault(root, span)
        self.origin.setdefault(root, origin)
        if a.leaf.causality and b.leaf.causality:
            keys = [(origin, p.end.name) for p in (a, b)]
            self.sources.join(*keys)
            for key, part in zip(keys, (a, b), strict=True):
                self.causal[key] = (part, span)
        else:
            self.outside.update((origin, p.end.name) for p in (a, b) if p.end.outside)

    def members(self, end: End) -> list[End]:
        """The ends connected with `end`, itself among them."""
        root = self.ends.find(end)
        return [e for e in self.kind if self.ends.find(e) == root]

    def sources_of(self, key: Hashable) -> list[Hashable]:
        """The causal scalars connected with `key` in one model, itself among them."""
        root = self.sources.find(key)
        return [k for k in self.causal if self.sources.find(k) == root]

    def check_sources(self) -> None:
        """Raises R077 where two outputs drive one signal (9.3), or none a signal of a bus (9.1.3)."""
        for group in self.sources.groups():
            driving = [self.causal[key] for key in group if _is_source(self.causal[key][0])]
            if len(driving) > 1:
                names = " and ".join(part.end.name for part, _ in driving)
                hint = "one output drives a signal: remove a connection"
                raise Diagnostic("R077", f"{names} drive the same signal", driving[1][1], hint)
        signals: dict[Hashable, list[tuple[Part, Span]]] = {}
        for (_, name), found in self.causal.items():
            signals.setdefault(self.ends.find(End(name, False)), []).append(found)
        for members in signals.values():
            parts = [part for part, _ in members if not part.leaf.open_ended]
            brought = [(part, span) for part, span in members if part.leaf.open_ended]
            if brought and not any(map(_drives_a_bus, parts)):
                part, span = next((m for m in brought if m[0].end.name not in m[0].leaf.relayed), brought[0])
                hint = "connect an output to it"
                raise Diagnostic("R077", f"nothing drives {part.end.name}: only inputs are connected to it", span, hint)


def _drives_a_bus(part: Part) -> bool:
    """A source, or an output that a component keeps for itself."""
    return _is_source(part) or (part.leaf.declaration.protected and part.leaf.causality == "output")


def _is_source(part: Part) -> bool:
    """An output of a component, or an input of the model itself that can be connected from outside."""
    if part.end.name in part.leaf.relayed:
        return False
    outside = part.end.outside
    return part.leaf.causality == ("input" if outside else "output") and not (
        outside and part.leaf.declaration.protected
    )
