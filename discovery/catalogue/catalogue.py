"""The catalogue of effects: the components of `model/Effects/` with what their `__Lacuna` annotation says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, partial
from typing import Any

from lacuna.codegen.flatten import flatten
from lacuna.codegen.flatten.names.scope import base_classes
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast

ATTACHMENTS = ("flange", "line", "star", "phases", "phase", "imposed", "replace", "sensor")


class CatalogueError(Exception):
    """An effect whose annotation is not understood: the message names the file."""

    user_error = True


@dataclass(frozen=True)
class EffectParameter:
    name: str
    unit: str
    description: str
    lower: float
    upper: float
    default: float


@dataclass(frozen=True)
class Effect:
    """One component of the catalogue; see the documentation of package Lacuna.Effects for the fields."""

    identifier: str
    class_path: str
    title: str
    attaches: str
    parameters: tuple[EffectParameter, ...]
    replaces: str = ""
    friction: bool = False  # truly sticks: no second such element on one shaft
    neutral: dict[str, float] = field(default_factory=dict)
    starts: dict[str, list[float]] = field(default_factory=dict)
    relative: dict[str, str] = field(default_factory=dict)
    variants: dict[str, list[float]] = field(default_factory=dict)
    signals: dict[str, str] = field(default_factory=dict)
    summed: dict[str, str] = field(default_factory=dict)  # inputs that take the sum of a variable over the phases
    whole: tuple[str, ...] = ()
    polar: tuple[str, ...] = ()
    fixed: tuple[str, ...] = ()
    levels: tuple[str, ...] = ()  # of friction: neutral at the level of the element that it takes the place of
    location: tuple[str, ...] = ()
    nests_in: tuple[str, ...] = ()
    interval: str = ""  # the parameter that takes the recordings' sampling interval
    unit: str = ""  # of the sensor it belongs to; "" any
    twin: str = ""  # of a sensor's error: the effect of a device that is the same signal in its recorded force
    signature: str = ""
    excitation: str = ""
    reference: str = ""

    @property
    def name(self) -> str:
        return self.class_path.rsplit(".", 1)[-1]

    def parameter(self, name: str) -> EffectParameter:
        return next(p for p in self.parameters if p.name == name)

    def two_sided(self, variable: str) -> bool:
        """Whether parameters in units of this variable begin on both sides of zero."""
        return any(s < 0 for n, v in self.relative.items() if v == variable for s in self.starts.get(n, []))


def read(library: Library, package: str = "Effects") -> list[Effect]:
    """Every effect of the package, in order of name. Raises CatalogueError."""
    folder = library.find(package)
    replaced = cache(partial(_names_of, library))
    effects = []
    for name in library.members(folder):
        cls = library.member(folder, name)
        entry = _annotation(cls)
        if entry is not None and not cls.partial:
            effects.append(_effect(library, cls, entry, replaced))
    return effects


def _annotation(cls: ast.Class) -> ast.Modification | None:
    for argument in cls.annotation.arguments if cls.annotation else ():
        if argument.name == "__Lacuna":
            return argument.modification
    return None


def _plain(value: ast.Expression) -> Any:
    if isinstance(value, ast.Literal):
        return value.value
    if isinstance(value, ast.Unary) and value.op == "-":
        return -_plain(value.operand)
    if isinstance(value, ast.ArrayLiteral):
        return [_plain(v) for v in value.elements]
    raise CatalogueError(f"{value.span}: an annotation holds numbers, texts and lists of them")


def _effect(
    library: Library, cls: ast.Class, entry: ast.Modification, replaced: Callable[[str], set[str]]
) -> Effect:  # fmt: skip
    fields: dict[str, Any] = {}
    for argument in entry.arguments:
        nested = argument.modification
        if nested.value is not None:
            fields[argument.name] = _plain(nested.value)
        else:
            fields[argument.name] = {a.name: _plain(a.modification.value) for a in nested.arguments}
    where = f"{cls.span.file}: {cls.name}"
    identifier = fields.pop("effect", None)
    attaches = fields.get("attaches")
    if not identifier or attaches not in ATTACHMENTS:
        raise CatalogueError(f"{where}: __Lacuna needs effect, and attaches as one of {', '.join(ATTACHMENTS)}")
    unknown = set(fields) - set(Effect.__dataclass_fields__)
    if unknown:
        raise CatalogueError(f"{where}: __Lacuna does not know {', '.join(sorted(unknown))}")
    for name in ("whole", "polar", "fixed", "levels", "location", "nests_in"):
        value = fields.get(name, ())
        fields[name] = (value,) if isinstance(value, str) else tuple(value)
    friction = any(base.name == "FrictionEffect" for base in base_classes(library, cls))
    known = replaced(fields["replaces"]) if fields.get("replaces") else {""}
    if not known:
        raise CatalogueError(f"{where} replaces {fields['replaces']}, which is no component")
    parameters = _parameters(library, cls, known)
    return Effect(identifier, cls.path, cls.description, parameters=parameters, friction=friction, **fields)


def _parameters(library: Library, cls: ast.Class, replaced: set[str]) -> tuple[EffectParameter, ...]:
    """The effect's own parameters: those that the component it replaces does not have."""
    flat = flatten(library, cls.path)
    names = [n for n, v in flat.variables.items() if v.variability == "parameter" and "." not in n and "[" not in n]
    return tuple(
        EffectParameter(
            n, v.unit or "1", v.description, _number(v.min, -1e30), _number(v.max, 1e30), _number(v.binding, 0.0)
        )
        for n in names
        if n not in replaced and not (v := flat.variables[n]).final and not _protected(cls, n)
    )  # fmt: skip


def _names_of(library: Library, component: str) -> set[str]:
    """The variables of a component; none where there is no such."""
    for found in library.all_classes(library.find("Components")):
        if found.name == component:
            return set(flatten(library, found.path).variables)
    return set()


def _protected(cls: ast.Class, name: str) -> bool:
    return any(c.name == name and c.protected for c in cls.components)


def _number(value: Any, default: float) -> float:
    return float(value.value) if value is not None and value.op == "const" else default


def group(effects: list[Effect]) -> dict[str, list[Effect]]:
    """Effects by identifier: several components may be laws of one physics."""
    result: dict[str, list[Effect]] = {}
    for effect in effects:
        result.setdefault(effect.identifier, []).append(effect)
    return result


__all__ = ["CatalogueError", "Effect", "EffectParameter", "group", "read"]
