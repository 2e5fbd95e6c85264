"""modelDescription.xml of both versions of FMI, from the same variables."""

from __future__ import annotations

from dataclasses import dataclass
import math
from xml.etree import ElementTree as ET

from lacuna.fmi.errors import FmuError
from lacuna.fmi.variable import FmiVariable
from lacuna.fmi.variables import FmiVariables
from lacuna.units import factors_of, parse_unit

_BASE = ("m", "kg", "s", "A", "K", "mol", "cd")
_ANGLES = ("rad", "deg", "rev", "rpm")  # each a power of FMI's base unit rad, which counts nothing in Modelica
_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}  # of FMI 3.0


@dataclass(frozen=True)
class Header:
    """What is said of the FMU as a whole. `kinds`: me, cs or both; `derivatives`: directional ones are there."""

    model: str
    identifier: str
    token: str
    description: str
    tool: str
    kinds: tuple[str, ...]
    derivatives: bool
    start: float
    stop: float
    tolerance: float
    interval: float
    sources: tuple[str, ...]  # C files, for FMI 2.0


def _text(value: float) -> str:
    return repr(float(value))


def describe(header: Header, variables: FmiVariables, version: str) -> bytes:
    """The XML of `version`, "2.0" or "3.0"."""
    root = _root_2(header, variables) if version == "2.0" else _root_3(header)
    _interfaces(root, header, version)
    _units(root, variables.all)
    categories = ET.SubElement(root, "LogCategories")
    ET.SubElement(categories, "Category", name="logStatusError", description="why a call failed")
    ET.SubElement(
        categories, "Category", name="logStatusWarning", description="an assertion of level warning is violated"
    )
    experiment = {
        "startTime": _text(header.start),
        "stopTime": _text(header.stop),
        "tolerance": _text(header.tolerance),
    }
    if header.interval > 0:
        experiment["stepSize"] = _text(header.interval)
    ET.SubElement(root, "DefaultExperiment", experiment)
    place = ET.SubElement(root, "ModelVariables")
    if version == "2.0":
        indicators = {v.reference for v in variables.indicators}
        listed = [v for v in variables.all if v.reference not in indicators]
        places = {v.reference: k for k, v in enumerate(listed, 1)}
        place.extend([_variable_2(v, places) for v in listed])
        _structure_2(root, variables, places)
    else:
        place.extend([_variable_3(v) for v in variables.all])
        _structure_3(root, variables)
    ET.indent(root)
    return ET.tostring(root, encoding="UTF-8", xml_declaration=True)


def _common(header: Header, version: str) -> dict[str, str]:
    return {
        "fmiVersion": version, "modelName": header.model, "description": header.description,
        "generationTool": header.tool, "variableNamingConvention": "structured",
    }  # fmt: skip


def _root_3(header: Header) -> ET.Element:
    return ET.Element("fmiModelDescription", _common(header, "3.0") | {"instantiationToken": header.token})


def _root_2(header: Header, variables: FmiVariables) -> ET.Element:
    more = {"guid": header.token, "numberOfEventIndicators": str(len(variables.indicators))}
    return ET.Element("fmiModelDescription", _common(header, "2.0") | more)


def _interfaces(root: ET.Element, header: Header, version: str) -> None:
    state = "FMUState" if version == "3.0" else "FMUstate"
    derivative = "providesDirectionalDerivatives" if version == "3.0" else "providesDirectionalDerivative"
    common = {"modelIdentifier": header.identifier, f"canGetAndSet{state}": "true", f"canSerialize{state}": "true"}
    if header.derivatives:
        common[derivative] = "true"
    own = {
        "me": ("ModelExchange", {"needsCompletedIntegratorStep": "true"} if version == "3.0" else {}),
        "cs": (
            "CoSimulation",
            {"canHandleVariableCommunicationStepSize": "true"} | ({"hasEventMode": "true"} if version == "3.0" else {}),
        ),
    }
    for kind in header.kinds:
        name, more = own[kind]
        element = ET.SubElement(root, name, common | more)
        if version == "2.0":
            files = ET.SubElement(element, "SourceFiles")
            for source in header.sources:
                ET.SubElement(files, "File", name=source)


def _units(root: ET.Element, variables: list[FmiVariable]) -> None:
    """Each unit with its exponents of SI units; one that cannot be read (of another tool's library) by its name."""
    names = sorted({v.unit for v in variables if v.unit and v.type == "Real"})
    if not names:
        return
    place = ET.SubElement(root, "UnitDefinitions")
    for name in names:
        unit = ET.SubElement(place, "Unit", name=name)
        try:
            parsed = parse_unit(name)
        except ValueError:
            continue
        if any(e.denominator != 1 for e in parsed.exponents) or parsed.factor is None:
            continue
        powers = {b: str(int(e)) for b, e in zip(_BASE, parsed.exponents, strict=True) if e}
        turns = sum(power for symbol, power in factors_of(name) if symbol in _ANGLES)
        if turns and turns.denominator == 1:
            powers["rad"] = str(turns)
        if parsed.factor != 1:
            powers["factor"] = _text(parsed.factor)
        if name == "degC":
            powers["offset"] = "273.15"
        ET.SubElement(unit, "BaseUnit", powers)


def _attributes(v: FmiVariable) -> dict[str, str]:
    attributes = {"name": v.name, "valueReference": str(v.reference), "causality": v.causality}
    if v.description:
        attributes["description"] = v.description
    attributes["variability"] = v.variability
    if v.initial:
        attributes["initial"] = v.initial
    return attributes


def _typed(v: FmiVariable) -> dict[str, str]:
    """Attributes of the type: start, bounds, unit."""

    def number(value: float) -> str:
        if v.type == "Boolean":
            return "true" if value else "false"
        if v.type != "Integer":
            return _text(value)
        if not fits(value):
            raise FmuError(f"{v.name} would start at {value:.17g}, and an Integer of FMI has 32 bits")
        return str(int(value))

    def fits(value: float) -> bool:
        return math.isfinite(value) and (v.type != "Integer" or -(2**31) <= value < 2**31)

    found = {}
    if v.type != "Boolean":
        found = {key: number(value) for key, value in (("min", v.min), ("max", v.max)) if fits(value)}
    if v.type == "Real":
        found |= {key: value for key, value in (("quantity", v.quantity), ("unit", v.unit)) if value}
        if v.nominal > 0 and math.isfinite(v.nominal):
            found["nominal"] = _text(v.nominal)
    if v.start is not None:
        found["start"] = " ".join(map(number, v.start)) if isinstance(v.start, tuple) else number(v.start)
    return found


def _variable_3(v: FmiVariable) -> ET.Element:
    attributes = _attributes(v) | _typed(v)
    if v.derivative_of is not None:
        attributes["derivative"] = str(v.derivative_of)
    element = ET.Element(_TYPES[v.type], attributes)
    for size in v.dimensions:
        ET.SubElement(element, "Dimension", start=str(size))
    return element


def _variable_2(v: FmiVariable, places: dict[int, int]) -> ET.Element:
    """`places`: where a value reference stands in the list, of which the first is 1."""
    element = ET.Element("ScalarVariable", _attributes(v))
    typed = _typed(v)
    if v.derivative_of is not None:
        typed["derivative"] = str(places[v.derivative_of])
    ET.SubElement(element, v.type, typed)
    return element


def _structure_3(root: ET.Element, variables: FmiVariables) -> None:
    place = ET.SubElement(root, "ModelStructure")
    lists = {
        "Output": variables.outputs, "ContinuousStateDerivative": variables.derivatives,
        "InitialUnknown": variables.initial_unknowns, "EventIndicator": variables.indicators,
    }  # fmt: skip
    for name, members in lists.items():
        for v in members:
            ET.SubElement(place, name, valueReference=str(v.reference))


def _structure_2(root: ET.Element, variables: FmiVariables, places: dict[int, int]) -> None:
    place = ET.SubElement(root, "ModelStructure")
    lists = {
        "Outputs": variables.outputs, "Derivatives": variables.derivatives,
        "InitialUnknowns": variables.initial_unknowns,
    }  # fmt: skip
    for name, members in lists.items():
        if members:
            group = ET.SubElement(place, name)
            for v in members:
                ET.SubElement(group, "Unknown", index=str(places[v.reference]))


def build_description(identifier: str, sources: tuple[str, ...], options: tuple[str, ...]) -> bytes:
    """sources/buildDescription.xml of FMI 3.0: how to compile what is there."""
    root = ET.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = ET.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = ET.SubElement(
        configuration, "SourceFileSet", language="C11", compiler="gcc", compilerOptions=" ".join(options)
    )
    for source in sources:
        ET.SubElement(files, "SourceFile", name=source)
    for option in options:
        if option.startswith("-D"):
            name, _, value = option[2:].partition("=")
            ET.SubElement(files, "PreprocessorDefinition", {"name": name} | ({"value": value} if value else {}))
    ET.SubElement(files, "IncludeDirectory", name=".")
    ET.SubElement(configuration, "Library", name="m", external="true")
    ET.indent(root)
    return ET.tostring(root, encoding="UTF-8", xml_declaration=True)
