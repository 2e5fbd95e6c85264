"""Hypotheses: every effect of the catalogue at every place of the model that suits it."""

from __future__ import annotations

from itertools import product

from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.signals import Signal
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.catalogue import Effect
from lacuna.discovery.catalogue.places import Line, Shaft, Structure
from lacuna.recorded_units import same_dimension

FINER = 4  # times, that an effect which samples inside a loop may do so between the recordings' samples


def enumerate_attachments(
    case: Case, structure: Structure, effects: list[Effect], amendment: Amendment
) -> list[Attachment]:
    """All attachments that can be added to `amendment`: one of each effect at each place, variants apart."""
    taken = {(a.effect.identifier, a.location, a.effect.name) for a in amendment.attachments}
    replaced = {a.part.name for a in amendment.attachments if a.part}
    stuck = {a.shaft.location for a in amendment.attachments if a.effect.friction}
    found: list[Attachment] = []
    for effect in effects:
        for attachment in _PLACES[effect.attaches](case, structure, effect):
            if (effect.identifier, attachment.location, effect.name) in taken:
                continue
            if attachment.part and attachment.part.name in replaced:
                continue
            if effect.friction and attachment.shaft.location in stuck:
                continue
            found.append(attachment)
    return found


def _component(effect: Effect, suffix: str = "") -> str:
    return effect.name[0].lower() + effect.name[1:] + (f"_{suffix}" if suffix else "")


def _values(effect: Effect) -> list[tuple[tuple[str, float], ...]]:
    """Combinations of the effect's variants, as values to write into the model."""
    names = list(effect.variants)
    return [tuple(zip(names, combination, strict=True)) for combination in product(*effect.variants.values())]


def _on_shafts(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    result = []
    for shaft in structure.shafts:
        component = _component(effect, shaft.location)
        for signals in _signal_choices(structure, shaft, effect):
            for values in _values(effect):
                result.append(
                    Attachment(effect, component, shaft.location, shaft=shaft, signals=signals, values=values)
                )
    return result


def _signal_choices(structure: Structure, shaft: Shaft, effect: Effect) -> list[tuple[tuple[str, str], ...]]:
    """Variables of the model for the effect's inputs: the machine's torque, torques that pass, the shaft's inertia."""
    if not effect.signals:
        return [()]
    choices = []
    for name, meaning in effect.signals.items():
        owners = list(dict.fromkeys(m.split(".")[0] for m in shaft.members))
        if meaning == "motor":
            variables = [f"{o}.tau" for o in owners if _is_machine(structure, o)]
        elif meaning == "inertia":
            variables = [f"{shaft.location}.J"]
        else:
            variables = [m + ".tau" for m in shaft.members if _passes_torque(structure, m.split(".")[0])]
        choices.append([(name, v) for v in variables])
    return list(product(*choices))


def _is_machine(structure: Structure, part: str) -> bool:
    return any(line.load == part for line in structure.lines)


def _passes_torque(structure: Structure, part: str) -> bool:
    ancestors = structure.parts[part].ancestors
    return not {"Rigid", "PartialFriction"} & set(ancestors)


def _in_phases(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    result = []
    for lines in structure.phases():
        if (effect.attaches == "line" and len(lines) > 1) or (effect.attaches == "star" and len(lines) == 1):
            continue
        location = _electrical_location(effect, lines[0], all_phases=True)
        result.append(Attachment(effect, _component(effect, lines[0].load), location, lines=tuple(lines)))
    return result


def _in_one_phase(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    return [
        Attachment(effect, _component(effect, line.phase), f"{line.load}:{line.phase}", lines=(line,))
        for lines in structure.phases() if len(lines) > 1 for line in lines
    ]  # fmt: skip


def _electrical_location(effect: Effect, line: Line, all_phases: bool) -> str:
    """What belongs to the power stage is at the source's end of the line, the rest in the load."""
    return line.source if effect.identifier.startswith("drive.") else line.load


def _instead_of_part(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    result = []
    for part in structure.parts.values():
        if part.ancestors[0] != effect.replaces:
            continue
        if effect.identifier.startswith("drive.") and structure.lines and "TorqueSource" in part.ancestors:
            continue  # where an electric machine drives, a source of torque is a load
        for k, values in enumerate(_values(effect)):
            location = _stage_of(structure, part.name) if effect.identifier.startswith("drive.") else part.name
            if effect.location:
                location = part.name + effect.location[k % len(effect.location)]
            for interval in _intervals(case, effect, part.name not in structure.driven):
                result.append(Attachment(effect, part.name, location, part=part, values=(*values, *interval)))
    return result


def _intervals(case: Case, effect: Effect, finer: bool) -> list[tuple[tuple[str, float], ...]]:
    """For an effect that samples: as the recordings do and, where asked for, `finer` too: inside a loop, which closes
    between samples."""
    if not effect.interval:
        return [()]
    return [((effect.interval, float(f"{case.fit[0].interval / n:.9g}")),) for n in ((1, FINER) if finer else (1,))]


def _stage_of(structure: Structure, source: str) -> str:
    """The power stage that a source feeds: an inverter between it and the machine, else the source itself.

    A controller belongs to the stage of the machine that it controls.
    """
    if structure.lines and "TwoPin" not in structure.parts[source].ancestors:
        return structure.lines[0].source
    neighbours = [
        other.split(".")[0]
        for left, right in structure.connections
        for end, other in ((left, right), (right, left))
        if end.split(".")[0] == source
    ]
    return next((n for n in neighbours if any(line.source == n for line in structure.lines) and n != source), source)


def _beside_devices(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    return [Attachment(effect, _component(effect, d.part), d.part, device=d) for d in structure.devices]


def _on_sensors(case: Case, structure: Structure, effect: Effect) -> list[Attachment]:
    """On a device whose force is recorded, the force of an effect's twin is the very same signal: one name suffices."""
    forces = {d.variable for d in structure.devices} if effect.twin else set()
    return [
        Attachment(
            effect, _component(effect, "_".join([s.column, *beside])), f"sensor:{s.column}", variable=s.variable,
            signals=signals, values=values,
        )
        for s in case.outputs if effect.unit in ("", s.model_unit) and s.variable not in forces
        for beside, signals in _recorded_beside(case, s, effect) for values in _intervals(case, effect, finer=False)
    ]  # fmt: skip


def _recorded_beside(
    case: Case, sensor: Signal, effect: Effect
) -> list[tuple[list[str], tuple[tuple[str, str], ...]]]:  # fmt: skip
    """(columns, the effect's inputs) of what an error of a sensor may be of: each other output of its unit, or, where
    the effect names a unit, each other variable of that quantity which is recorded."""
    if not effect.signals:
        return [([], ())]
    ((name, asked),) = effect.signals.items()
    if asked == "recorded":
        alike = [s for s in case.outputs if s.model_unit == sensor.model_unit]
    else:
        alike = [s for s in case.signals.values() if same_dimension(s.model_unit, asked)]
    return [([s.column], ((name, s.variable),)) for s in alike if s.variable != sensor.variable]


_PLACES = {
    "flange": _on_shafts, "line": _in_phases, "star": _in_phases, "phases": _in_phases,
    "phase": _in_one_phase, "replace": _instead_of_part,
    "sensor": _on_sensors, "imposed": _beside_devices,
}  # fmt: skip
