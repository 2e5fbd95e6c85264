"""The amended model: a Modelica class that extends the believed one by components of the catalogue.

The same text serves the search (with free values and a tracker) and the answer (with fitted values). Where an element
has to be put in series or take another's place, the class is extended selectively (Modelica 3.6, section 7.4).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.discovery.catalogue.attachment import OWN, Attachment
from lacuna.discovery.catalogue.modifications import entries, modified, wrapped
from lacuna.discovery.catalogue.places import Line, Shaft, Structure
from lacuna.discovery.efforts.places.copied import Added, copied
from lacuna.discovery.efforts.places.families import meant
from lacuna.discovery.efforts.places.sites import Site


@dataclass
class Amendment:
    """What the class text is made of; later attachments see the places that earlier ones changed."""

    structure: Structure
    attachments: list[Attachment] = field(default_factory=list)
    parameters: dict[str, float] = field(default_factory=dict)  # modified values of the believed model
    trackers: list[Shaft] = field(default_factory=list)
    probes: tuple[Shaft | Line, ...] = ()  # places where an input acts as effort
    inputs: tuple[str, ...] = ()  # declared beside those of the believed model
    beside: tuple[Attachment, ...] = ()  # errors of sensors, none of which another one reads
    seen: Attachment | None = None  # of these, the one that is in the outputs

    def output(self, variable: str) -> str:
        """The variable that a sensor's reading is compared with: the last sensor effect after it."""
        if self.seen is not None and self.seen.variable == variable:
            return f"{self.seen.component}.y"
        for attachment in reversed(self.attachments):
            if attachment.variable == variable:
                return f"{attachment.component}.y"
        return variable

    def adds(self, variable: str) -> bool:
        """Whether a variable, or the one whose rate it is, stands in a component that the believed model has not, or is
        what is added to it, also inside of its components."""
        first, *inner = (part.partition("[")[0] for part in variable.removeprefix("der(").split("."))
        parts = {name for a in self.attachments for name in _components(a)}
        terms = {_missing(k) for k in range(2 * len(parts))}  # an exchange adds two
        return first in parts or any(name.removeprefix("at_") in terms for name in (first, *inner))

    def text(self, name: str, values: dict[str, float] | None = None, comment: str = "") -> str:
        """Modelica source of the class; `values` gives parameters of the effects by full name."""
        writer = _Writer(self, values or {})
        return writer.write(name, comment)


class _Writer:
    def __init__(self, amendment: Amendment, values: dict[str, float]) -> None:
        self.amendment, self.values = amendment, values
        self.left_out: list[str] = []
        self.declarations: list[str] = []
        self.equations: list[str] = []
        self.sums: dict[str, list[str]] = {}  # variable -> terms of its new binding
        self.sums_into: dict[Site, list[str]] = {}  # signal -> what is added to it on its way
        self.edits: dict[tuple, Added] = {}  # text of the believed model -> what is added there

    def write(self, name: str, comment: str) -> str:
        for attachment in self.amendment.attachments:
            getattr(self, f"_{attachment.effect.attaches}")(attachment)
        for attachment in self.amendment.beside:
            self._reads(attachment, replace(self.amendment, seen=None))
        given = self._given()
        self._signals_changed()
        self._trackers()
        self._probes()
        modification = modified(self.amendment.parameters)
        modification += [f"{n}(stateSelect=StateSelect.always)" for n in self.amendment.structure.states]
        modification += [f"{variable}={' + '.join(terms)}" for variable, terms in self.sums.items()]
        modification += [*given, *(f"break {item}" for item in self.left_out)]
        self.declarations[:0] = [f"input Real {i};" for i in self.amendment.inputs]
        base, nested = self.amendment.structure.path, []
        if self.edits:
            base, nested = copied(self.amendment.structure.cls, [(e.site, e.variable) for e in self.edits.values()])
        inherited = f"extends {base}" + (f"({', '.join(modification)})" if modification else "") + ";"
        lines = [
            f'model {name} "{comment or "Believed model with what was found missing"}"',
            *nested,
            *wrapped(inherited),
        ]
        definitions = dict.fromkeys(a.definition for a in self.amendment.attachments if a.definition)
        lines += [f"  {line}" for text in definitions for line in text.split("\n")]
        lines += [f"  {d}" for d in self.declarations]
        if self.equations:
            lines += ["equation", *(f"  {e}" for e in self.equations)]
        return "\n".join([*lines, f"end {name};", ""])

    def _given(self) -> list[str]:
        """Modifications that give components what is added in them; that of the class itself is equated."""
        given = []
        for added in self.edits.values():
            steps = [c for step in added.site.way if step.component for c in step.component.split(".")]
            if steps:
                given.append(f"{'('.join(steps)}({added.variable}={added.value()}{')' * len(steps)}")
            else:
                self.equations.append(f"{added.variable} = {added.value()};")
        return given

    def _signals_changed(self) -> None:
        for site, terms in self.sums_into.items():
            self.left_out.append(f"connect({', '.join(site.ends)})")
            source = next(end for end in site.ends if end != site.into)
            self.equations.append(f"{site.into} = {source} + {' + '.join(terms)};")

    def _declare(
        self, attachment: Attachment, extra: str = "", bound: dict[str, str] | None = None, name: str = ""
    ) -> None:
        effect = attachment.effect
        entries = [extra] if extra else []
        bound = bound or {}
        for parameter in effect.parameters:
            full = attachment.full_name(parameter.name)
            if parameter.name in bound:
                entries.append(f"{parameter.name}={bound[parameter.name]}")
            elif full in self.values:
                entries.append(f"{parameter.name}={self.values[full]:.10g}")
            elif parameter.name in dict(attachment.values):
                entries.append(f"{parameter.name}={dict(attachment.values)[parameter.name]:g}")
        inside = f"({', '.join(entries)})" if entries else ""
        self.declarations.append(f'{effect.class_path} {name or attachment.component}{inside} "{effect.title}";')

    def _flange(self, attachment: Attachment) -> None:
        bound = {}
        friction = self.amendment.structure.friction_of(attachment.shaft) if attachment.effect.friction else None
        if friction is not None:
            self.left_out.append(friction.name)
            names = [p.name for p in attachment.effect.parameters]
            bound = {n: v for n, v in entries(friction.modification).items() if n in names}
        self._declare(attachment, bound=bound)
        self.equations.append(f"connect({attachment.component}.flange, {attachment.shaft.flange});")
        self._signals(attachment)

    def _signals(self, attachment: Attachment) -> None:
        for name, variable in attachment.signals:
            self.equations.append(f"{attachment.component}.{name} = {variable};")

    def _phases(self, attachment: Attachment) -> None:
        names = _components(attachment)
        for k, (name, line) in enumerate(zip(names, attachment.lines, strict=True)):
            shared = {p.name: attachment.full_name(p.name) for p in attachment.effect.parameters} if k else {}
            self._declare(attachment, bound=shared, name=name)
            self._insert(name, line)
            for total, part in attachment.effect.summed.items():
                self.equations.append(f"{name}.{total} = {' + '.join(f'{n}.{part}' for n in names)};")
        self._signals(attachment)

    _line = _star = _phases

    def _phase(self, attachment: Attachment) -> None:
        self._declare(attachment)
        self._insert(attachment.component, attachment.lines[0])

    def _insert(self, name: str, line: Line) -> None:
        """Put pins p, n of component `name` into the line, current positive into the load."""
        left, right = (line.left, line.right) if line.left.startswith(line.source + ".") else (line.right, line.left)
        previous = f"connect({left}, {right});"
        chain = next((e for e in self.equations if e.startswith("connect(") and e.endswith(f", {right});")), None)
        if chain is not None:  # an earlier effect already sits in this line
            self.equations.remove(chain)
            left = chain[len("connect(") : chain.index(",")]
        elif previous:
            self.left_out.append(f"connect({line.left}, {line.right})")
        self.equations += [f"connect({left}, {name}.p);", f"connect({name}.n, {right});"]

    def _replace(self, attachment: Attachment) -> None:
        part = attachment.part
        self.left_out.append(part.name)
        self._declare(attachment, part.modification[1:-1])
        chained = set(self.equations)
        for left, right in self.amendment.structure.connections:
            opened = f"connect({left}, {right})" in self.left_out
            if part.name in (left.split(".")[0], right.split(".")[0]) and not opened:
                text = f"connect({left}, {right});"
                if text not in chained:
                    self.equations.append(text)

    def _imposed(self, attachment: Attachment) -> None:
        self._declare(attachment)
        name, device = attachment.component, attachment.device
        self.equations += [f"{name}.s = {device.part}.s;", f"{name}.v = {device.part}.v;"]
        self.sums.setdefault(device.variable, [f"{device.part}.f"]).append(f"{name}.f")

    def _site(self, attachment: Attachment) -> None:
        """At any place: a port at a node, two in an edge or past a component, or a term of a signal or equation; in
        every one of a family by a component of its own."""
        site, together = attachment.site, attachment.site.together
        for k, part in enumerate(site.parts if site.members else (site,)):
            name = _components(attachment)[k]
            shared = {p.name: attachment.full_name(p.name) for p in attachment.effect.parameters} if k else {}
            self._declare(attachment, ", ".join(_read_by(attachment, k)), shared, name)
            if together is None:
                self._put(part, name)
            else:
                self._add(together, (k + 1,), f"{name}.effort")

    def _put(self, site: Site, name: str) -> None:
        """What a component of a law gives, at a site."""
        if not site.outside:
            self._inside(site, name)
        elif site.kind == "node":
            self.equations.append(f"connect({site.ends[0]}, {name}.port);")
        elif site.kind == "branch":
            self.equations += [f"connect({end}, {name}.{port});" for end, port in zip(site.ends, "ab", strict=True)]
        else:
            left, right = site.ends
            chain = next((e for e in self.equations if e.endswith(f", {right});")), None)
            if chain is not None:
                self.equations.remove(chain)
                left = chain[len("connect(") : chain.index(",")]
            else:
                self.left_out.append(f"connect({left}, {right})")
            self.equations += [f"connect({left}, {name}.a);", f"connect({name}.b, {right});"]

    def _inside(self, site: Site, name: str) -> None:
        """What a component gives as a term of equations, of a signal, or inside of another component."""
        if site.kind == "signal" and not site.instance:
            self.sums_into.setdefault(site, []).append(f"{name}.effort")
            return
        exchanged = site.kind == "exchange"
        for sense, part in zip(("", "-"), site.parts if exchanged else (site,), strict=False):
            lost = exchanged and sense != part.sign
            self._add(part, part.element[0], f"(-{name}.effort)" if lost else f"{name}.effort")

    def _add(self, site: Site, element: tuple[int, ...], term: str) -> None:
        """A term to what is added in the text of a site, to one element of it."""
        added = self.edits.setdefault(site.text, Added(site, _missing(len(self.edits))))
        added.sums.setdefault(element, []).append(term)

    def _sensor(self, attachment: Attachment) -> None:
        earlier = self.amendment.attachments[: self.amendment.attachments.index(attachment)]
        self._reads(attachment, replace(self.amendment, attachments=earlier))

    def _reads(self, attachment: Attachment, earlier: Amendment) -> None:
        self._declare(attachment)
        self.equations.append(f"{attachment.component}.u = {earlier.output(attachment.variable)};")
        self._signals(attachment)

    def _probes(self) -> None:
        for k, place in enumerate(self.amendment.probes):
            name, effort = f"{OWN}source_{k + 1}", probe_name(k)
            if isinstance(place, Shaft):
                self.declarations.append(f"Lacuna.Components.Mechanics.TorqueSource {name};")
                self.equations.append(f"connect({name}.flange, {place.flange});")
            else:
                self.declarations.append(f"Lacuna.Components.Electrical.SignalVoltage {name};")
                self._insert(name, place)
            unit = "N.m" if isinstance(place, Shaft) else "V"
            self.declarations.append(f'input Real {effort}(unit="{unit}") "Missing effort";')
            self.equations.append(f"{name}.u = {effort};")

    def _trackers(self) -> None:
        for k, shaft in enumerate(self.amendment.trackers):
            name = tracker_name(k)
            self.declarations += [
                f'Lacuna.Effects.Interfaces.Tracker {name} "Draws the shaft towards the recording";',
                f'input Real {name}_phi(unit="rad") "Recorded angle";',
                f'input Real {name}_w(unit="rad/s") "Recorded speed";',
            ]
            self.equations += [
                f"connect({name}.flange, {shaft.flange});", f"{name}.phi = {name}_phi;", f"{name}.w = {name}_w;",
            ]  # fmt: skip


def _components(attachment: Attachment) -> list[str]:
    """Those of an attachment: one, or one for each phase or member of a family, of which the first says the numbers."""
    members = range(2, 1 + len(attachment.site.members)) if attachment.site else ()
    further = [*(line.phase for line in attachment.lines[1:]), *(f"of_{number}" for number in members)]
    return [attachment.component, *(f"{attachment.component}_{which}" for which in further)]


def _read_by(attachment: Attachment, member: int) -> list[str]:
    """Bindings of what a law's component reads, at a site or at one member of a family."""
    site, signals = attachment.site, attachment.signals
    if site.members:
        signals = [(local, meant(name, site.members[0], site.members[member])) for local, name in signals]
    return [f"{local}={name}" for local, name in signals]


def _missing(k: int) -> str:
    return f"missing_{k + 1}"


def probe_name(k: int) -> str:
    return f"{OWN}effort_{k + 1}"


def tracker_name(k: int) -> str:
    return f"{OWN}tracker_{k + 1}"
