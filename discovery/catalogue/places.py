"""Where physics can be missing, found from the model itself.

A place is a rigid shaft (a torque can act on it), a line between two pins (a voltage can be lost in it), a component (a
richer law can take its stead) or a recorded variable (its sensor can err). They are read from the instance tree and
the connections of any model in the language.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
import re

from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.language import LOWERING
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.places.sites import root

_FLANGES = ("Flange_a", "Flange_b")
_PINS = ("PositivePin", "NegativePin")


@dataclass(frozen=True)
class Shaft:
    """Flanges that turn as one, with at least one inertia: `flange` is where to connect."""

    location: str
    flange: str
    members: tuple[str, ...]


@dataclass(frozen=True)
class Line:
    """A connection between pins of two components, `source` and `load`; `phase` is "" where there is only one."""

    source: str
    load: str
    left: str
    right: str
    phase: str = ""


@dataclass(frozen=True)
class Part:
    """A component of the model's own level: its class, what that extends, and its modification as written."""

    name: str
    class_path: str
    ancestors: tuple[str, ...]
    modification: str
    description: str


@dataclass(frozen=True)
class Device:
    """A part whose motion is imposed; the model's `variable` is bound to its force."""

    part: str
    variable: str


@dataclass
class Structure:
    """What `read` finds of a model."""

    model: str
    path: str
    cls: ast.Class | None = None
    parts: dict[str, Part] = field(default_factory=dict)
    connections: list[tuple[str, str]] = field(default_factory=list)
    shafts: list[Shaft] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    devices: list[Device] = field(default_factory=list)
    driven: set[str] = field(default_factory=set)  # parts that an input of the model drives: what they do changes none
    states: tuple[str, ...] = ()  # variables that are to be states, as a case speaks of their start values

    @property
    def open(self) -> bool:
        """Whether there is a place besides the sensors."""
        return bool(self.shafts or self.lines or self.devices)

    def shaft_of(self, flange: str) -> Shaft | None:
        return next((s for s in self.shafts if flange in s.members), None)

    def friction_of(self, shaft: Shaft) -> Part | None:
        """The element of the model that holds this shaft by dry friction."""
        owners = dict.fromkeys(m.split(".")[0] for m in shaft.members)
        return next((self.parts[o] for o in owners if "PartialFriction" in self.parts[o].ancestors), None)

    def phases(self) -> list[list[Line]]:
        """Lines that carry a load's current: one list for each load, a line for each of its phases."""
        loads: dict[str, list[Line]] = {}
        for line in self.lines:
            loads.setdefault(line.load, []).append(line)
        return list(loads.values())


def read(library: Library, model: str) -> Structure:
    """The places of class `model` (a name that `Library.find` knows). Raises Diagnostic."""
    cls = library.find(model)
    top = Instance(Context(library, Path(cls.span.file).resolve().parent, LOWERING), cls, "", None, None)
    structure = Structure(model, cls.path, cls)
    instances: dict[str, Instance] = {}
    for name, element in top.elements.items():
        node = top.child(name)
        if isinstance(node, Instance) and node.cls.kind in ("model", "block"):
            instances[name] = node
            declaration = element.declaration
            structure.parts[name] = Part(
                name, node.cls.path, tuple(c.name for c in node.classes), _modification_text(declaration),
                declaration.description,
            )  # fmt: skip
    structure.devices = _devices(top, structure)
    for section, _ in top.sections:
        for item in section.items:
            if isinstance(item, ast.Connect):
                structure.connections.append((written(item.left), written(item.right)))
            elif isinstance(item, ast.Equality) and isinstance(item.left, ast.Ref) and _of_inputs(item, top):
                structure.driven.add(str(item.left).split(".")[0])
    structure.shafts = _shafts(structure, instances)
    structure.lines = _lines(structure, instances)
    return structure


def _of_inputs(equation: ast.Equality, top: Instance) -> bool:
    """Whether the right side is made of inputs of the model and parameters alone."""
    names = {n.split(".")[0] for n in re.findall(r"[A-Za-z_][\w.]*", equation.text.partition("=")[2])}
    declared = [e.declaration for name, e in top.elements.items() if name in names]
    inputs = [d for d in declared if d.causality == "input"]
    return bool(inputs) and all(d.causality == "input" or d.variability for d in declared)


def _modification_text(declaration: ast.Component) -> str:
    """The modification of a component as its source has it, parentheses included; "" where there is none."""
    span = declaration.span
    text = Path(span.file).read_text(encoding="utf-8").split("\n")
    rest = "\n".join([text[span.line - 1][span.column - 1 :], *text[span.line :]])
    start = rest.find(declaration.name) + len(declaration.name)
    if not rest[start:].lstrip().startswith("("):
        return ""
    begin = rest.index("(", start)
    level = 0
    for end in range(begin, len(rest)):
        level += {"(": 1, ")": -1}.get(rest[end], 0)
        if level == 0:
            return re.sub(r"\s+", " ", rest[begin : end + 1])
    return ""


def _devices(top: Instance, structure: Structure) -> list[Device]:
    forces = {f"{p.name}.f": p.name for p in structure.parts.values() if "ImposedMotion" in p.ancestors}
    devices = []
    for name, element in top.elements.items():
        bound = element.declaration.modification.value
        if isinstance(bound, ast.Ref) and str(bound) in forces:
            devices.append(Device(forces[str(bound)], name))
    return devices


def _connector(instances: dict[str, Instance], end: str) -> str:
    """The class name of the connector `component.connector`; "" where it is none."""
    parts = end.split(".")
    node = instances.get(parts[0].split("[")[0])
    for name in parts[1:]:
        if node is None:
            return ""
        node = node.child(name.split("[")[0])
        if not isinstance(node, Instance):
            return ""
    return node.cls.name if node is not None and len(parts) > 1 else ""


def _flanges(name: str, node: Instance) -> list[str]:
    return [f"{name}.{e}" for e in node.elements if isinstance(c := node.child(e), Instance) and c.cls.name in _FLANGES]


def _shafts(structure: Structure, instances: dict[str, Instance]) -> list[Shaft]:
    group: dict[str, str] = {}
    for name, node in instances.items():
        flanges = _flanges(name, node)
        rigid = _turn_as_one(node, [f.removeprefix(f"{name}.") for f in flanges])
        for flange in flanges:
            group[root(group, flange)] = root(group, flanges[0] if rigid else flange)
    for left, right in structure.connections:
        if _connector(instances, left) in _FLANGES and _connector(instances, right) in _FLANGES:
            group[root(group, left)] = root(group, right)
    members: dict[str, list[str]] = {}
    for end in group:
        members.setdefault(root(group, end), []).append(end)
    shafts = []
    for ends in members.values():
        owners = dict.fromkeys(e.split(".")[0] for e in ends)
        inertias = [o for o in owners if structure.parts[o].ancestors[0] == "Inertia"]
        if inertias:
            shafts.append(Shaft(inertias[0], f"{inertias[0]}.flange_b", tuple(ends)))
    return shafts


def _turn_as_one(node: Instance, flanges: list[str]) -> bool:
    """Whether the equations of a component say that all of its flanges have one angle."""
    group: dict[str, str] = {}
    for section, _ in node.sections:
        for item in () if section.algorithm or section.initial else section.items:
            if isinstance(item, ast.Equality) and isinstance(item.left, ast.Ref) and isinstance(item.right, ast.Ref):
                group[root(group, written(item.left))] = root(group, written(item.right))
    return len({root(group, f"{flange}.phi") for flange in flanges}) == 1


def _lines(structure: Structure, instances: dict[str, Instance]) -> list[Line]:
    lines = []
    for left, right in structure.connections:
        if _connector(instances, left) not in _PINS or _connector(instances, right) not in _PINS:
            continue
        ends = sorted((left, right), key=lambda e: _is_load(structure, instances, e))
        source, load = (e.split(".")[0] for e in ends)
        feeds = _connector(instances, ends[1]) == "PositivePin" and _is_load(structure, instances, ends[1])
        if feeds and not _is_load(structure, instances, ends[0]) and structure.parts[source].ancestors[0] != "Ground":
            suffix = re.search(r"_([a-z]|\d+)$", ends[1])
            lines.append(Line(source, load, left, right, suffix.group(1) if suffix else ""))
    return lines


def _is_load(structure: Structure, instances: dict[str, Instance], end: str) -> bool:
    """Whether the component of this pin turns current into torque: it has a flange."""
    name = end.split(".")[0]
    return bool(_flanges(name, instances[name]))
