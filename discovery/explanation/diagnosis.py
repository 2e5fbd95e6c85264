"""diagnosis.json: the contract of FORMAT.md, written from an explanation."""

from __future__ import annotations

from collections.abc import Mapping
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.experiment.files import described
from lacuna.discovery.explanation.confidence import alternatives, certainty, confidence, explained, odds, tie
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.wording import at, in_a_sentence, in_words
from lacuna.discovery.fit.evidence import CLEARLY, whiteness
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.law.law import form_at, law_at
from lacuna.discovery.naming.name import Finding
from lacuna.written import write_whole

PARTIAL = 0.9  # share of the misfit, below which an explanation is called partial


def build(result: Explanation, amended: Path | None) -> dict[str, Any]:
    """The diagnosis as plain data."""
    errors = result.errors()
    diagnosis: dict[str, Any] = {
        "case": result.case.label, "model": result.case.model, "verdict": result.verdict,
        "findings": [_finding(result, f, errors) for f in result.findings],
    }  # fmt: skip
    if result.before is not None:
        diagnosis["nrmse"] = _nrmse(result.before, result.after)
        diagnosis["per_signal"] = {
            c: {"before": result.before.validate[c], "after": result.after.validate[c], "noise_floor": result.floor[c]}
            for c in result.floor
        }
        diagnosis["parameters"] = _parameters(result, errors)
    diagnosis["explained"] = explained(result) if result.findings else 0.0
    diagnosis["ties"] = [t for f in result.findings if len(t := tie(f)) > 1]
    diagnosis["places"] = _places(result)
    if amended is not None:
        diagnosis["amended_model"] = amended.name
    diagnosis["sentence"], diagnosis["certainty"] = sentence(result), certainty(result)
    if result.reason:
        diagnosis["reason"] = result.reason
    if result.experiment:
        diagnosis["experiment"] = result.experiment
    diagnosis["next_experiment"] = described(result.case, result.trial) if result.trial else None
    if result.problems:
        diagnosis["recordings"] = [p.as_dict() for p in result.problems]
    diagnosis["seconds"] = {k: round(v, 2) for k, v in result.seconds.items()}
    return _rounded(diagnosis)


def write(result: Explanation, folder: Path, amended: Path | None) -> Path:
    path = folder / "diagnosis.json"
    write_whole(path, json.dumps(build(result, amended), indent=2) + "\n")
    return path


def _finding(result: Explanation, finding: Finding, errors: dict[str, float]) -> dict[str, Any]:
    attachment = finding.ranked.attachment
    point, share = result.final.point, explained(result)
    parameters = {}
    for parameter in attachment.effect.parameters:
        full = attachment.full_name(parameter.name)
        value = point.get(full, dict(attachment.values).get(parameter.name))
        if value is not None and parameter.name != attachment.effect.interval:
            unit = _unit(result, finding, parameter.name)
            parameters[parameter.name] = {"value": value, "std": errors.get(full, 0.0), "unit": unit}
    if attachment.effect.polar:
        _positive_phase(parameters, attachment.effect.polar[1])
    law = {"law": law_text(result, finding)} if attachment.law else {}
    if form := _form(result, finding):
        law["form"] = form
    if added := _coefficient(finding):
        law["coefficient"] = added
    return {
        "effect": attachment.effect.identifier,
        "location": attachment.location,
        **law,
        "confidence": confidence(finding, share),
        "odds": odds(finding, share),
        "where": _where(result, finding),
        "parameters": parameters,
        "alternatives": alternatives(finding, share),
        "nrmse": _nrmse(finding.before, finding.after),
    }


def _unit(result: Explanation, finding: Finding, name: str) -> str:
    """A parameter's unit; what a sensor adds to its signal is in the signal's."""
    attachment = finding.ranked.attachment
    if attachment.variable and name == "offset":
        return next(s.model_unit for s in result.case.outputs if s.variable == attachment.variable)
    return attachment.effect.parameter(name).unit


def law_text(result: Explanation, finding: Finding) -> str:
    """An empirical law with its numbers, in variables of the model."""
    return law_at(finding.ranked.attachment, result.final.point)


def _form(result: Explanation, finding: Finding) -> str:
    """The name of a law that has the form of a known one; "" where it has none."""
    return form_at(finding.ranked.attachment, result.final.point)


def _coefficient(finding: Finding) -> str:
    """The parameter that a law is added to; "" where it is added to a balance."""
    site = finding.ranked.attachment.site
    return site.label if site is not None and site.kind == "parameter" else ""


def _positive_phase(parameters: dict[str, dict], name: str) -> None:
    """Angles as people write them: within (-pi, pi]."""
    if name in parameters:
        parameters[name]["value"] = math.remainder(parameters[name]["value"], 2 * math.pi)


def _places(result: Explanation) -> list[dict[str, Any]]:
    """What was open to a finding: places of the equations and sensors, the most telling first."""
    if result.opened is not None and result.opened.sites:
        return [
            {"location": s.location, "kind": s.kind, "explains": s.explains}
            | ({"at": s.place.sites[0].stands} if s.place else {}) for s in result.opened.sites
        ]  # fmt: skip
    located = result.located.places if result.located else []
    return [{"location": p.location, "kind": p.kind, "explains": p.explained} for p in located]


def _where(result: Explanation, finding: Finding) -> dict[str, Any]:
    """Where the model without the effect misses most: the regime of most of its misfit, the moments of the largest."""
    power = {r.name: _misfit(result.base, r.name) for r in result.case.fit}
    times = []
    for recording in result.case.fit:
        width = max(1, len(recording.time) // 25)
        mean = np.convolve(power[recording.name], np.ones(width) / width, mode="same")
        k = int(np.argmax(mean))
        span = recording.time[[max(k - width, 0), min(k + width, len(mean) - 1)]]
        times.append((float(mean[k]), [float(t) for t in span]))
    times.sort(reverse=True)
    variable = _variable(finding)
    place = {"variable": variable} | _regime(result, variable, power)
    return place | {"time": [t for _, t in times[:3]], "text": finding.ranked.attachment.effect.signature}


def _misfit(base: Fit, recording: str) -> np.ndarray:
    """Squared residual (n,) of all signals of a recording, each in units of its level."""
    residuals = base.residuals[recording]
    return sum((np.nan_to_num(residuals[c]) / (base.noise[c].std * base.level[c])) ** 2 for c in base.noise)


def _regime(result: Explanation, variable: str, power: dict[str, np.ndarray]) -> dict[str, list[float]]:
    """The range of a variable in which four fifths of the misfit lie; empty where the model has no such variable."""
    machine = result.final.machine
    if variable not in machine.model.variables:
        return {}
    courses = [machine.trajectory(result.final.point, r, [variable])[variable] for r in result.case.fit]
    values, weight = np.concatenate(courses), np.concatenate([power[r.name] for r in result.case.fit])
    order = np.argsort(values)
    share = np.cumsum(weight[order]) / weight.sum()
    return {"interval": [float(values[order][np.searchsorted(share, s)]) for s in (0.1, 0.9)]}


def _variable(finding: Finding) -> str:
    """The variable that organises the effect's effort."""
    attachment = finding.ranked.attachment
    if attachment.variable:
        return attachment.variable
    identifier = attachment.effect.identifier
    if attachment.shaft is not None:
        along = ("torque.", "load.", "stiffness", "end_stop", "friction.position")
        return f"{attachment.location}.phi" if identifier.startswith(along) else f"{attachment.location}.w"
    if attachment.site is not None:
        used = [v for _, v in attachment.signals if not v.startswith("der(")]
        return used[0] if used else attachment.location
    if attachment.device is not None:
        return f"{attachment.location}.{'s' if identifier in ('stiffness', 'friction.position') else 'v'}"
    if attachment.lines:
        return f"{attachment.lines[0].load}.i"
    return (
        f"{attachment.part.name}.phi_rel" if identifier in ("backlash", "compliance") else f"{attachment.part.name}.i"
    )


def _nrmse(before: Any, after: Any) -> dict[str, Any]:
    return {
        "fit": {"before": before.fit[""], "after": after.fit[""]},
        "validate": {"before": before.validate[""], "after": after.validate[""]},
    }


def _parameters(result: Explanation, errors: dict[str, float]) -> dict[str, Any]:
    variables = result.final.machine.model.variables
    table = {}
    for f in result.base.estimate.free:
        if f.name.startswith("start:"):
            continue
        unit = variables[f.name.partition("@")[0]].unit or "1"
        value = result.final.point[f.name]
        table[f.name] = {
            "believed": f.centre, "value": value, "std": errors.get(f.name, 0.0), "unit": unit,
            "outside_belief": _outside(f, value),
        }  # fmt: skip
    return table


def _outside(f: Free, value: float) -> bool:
    return bool(f.sigma and abs(value - f.centre) > 3 * f.sigma)


def sentence(result: Explanation) -> str:
    """The verdict as an engineer would say it."""
    if result.verdict == "missing_physics":
        parts = [_named(result, f) for f in result.findings]
        if result.instead:
            return f"The model lacks {' and '.join(parts)}; without it {_moved(result)} from what was believed."
        share = explained(result)
        rest = "" if share >= PARTIAL else f" This is a part of it only: {1 - share:.0%} of the misfit is left."
        rest += f" {result.stopped.capitalize()}." if result.stopped else ""
        falls = f"with it the error {_fall(result)}."
        return f"The model lacks {' and '.join(parts)}; {falls}{rest}"
    if result.verdict == "parameters":
        fitted = _parameters(result, {})
        outside = [(n, p) for n, p in fitted.items() if p["outside_belief"]]
        return f"Nothing is missing; {' and '.join(_is(name, p) for name, p in outside)}."
    if result.verdict == "consistent":
        left = [w.column for w in whiteness(result.final).values() if not w.passed]
        more = f", and less than that of {' and '.join(left)}, as of an instrument that drifts" if left else ""
        if left and result.final.only_instruments:
            more = f"; that of {' and '.join(left)} has a memory, and nothing in the equations would explain it better"
        return f"The model explains the recordings: what is left is noise{more}."
    if result.stopped:
        return f"What is missing is not known yet: {result.reason}."
    return "These recordings cannot say what is missing: " + (result.reason or "the residual is not noise") + "."


def _is(name: str, parameter: Mapping[str, Any]) -> str:
    unit = "" if parameter["unit"] == "1" else f" {parameter['unit']}"
    return f"{name} is {parameter['value']:.3g}{unit}, where {parameter['believed']:.3g} was believed"


def _fall(result: Explanation) -> str:
    """By how much the error falls on unseen recordings: of all signals, or of the one in which it falls most, where the
    noise of others hides it."""
    gains = {c: error / max(result.after.validate[c], 1e-12) for c, error in result.before.validate.items()}
    if gains[""] * CLEARLY > 1:
        return f"on unseen recordings falls by a factor of {gains['']:.2g}"
    column = max(result.floor, key=lambda c: gains[c])
    by = f"a factor of {gains[column]:.2g}" if gains[column] * CLEARLY > 1 else f"{1 - 1 / gains[column]:.0%}"
    return f"of {column} on unseen recordings falls by {by}"


def _moved(result: Explanation) -> str:
    return f"{' and '.join(result.instead)} would have to be far"


def _named(result: Explanation, finding: Finding) -> str:
    """What a finding is and where; the other places, where the data does not tell."""
    a = finding.ranked.attachment
    others = dict.fromkeys(r.attachment.label for r in finding.elsewhere) if finding.tied else {}
    or_else = f" (or {', '.join(others)}: the data does not tell)" if others else ""
    if a.law is not None:
        form = _form(result, finding)
        named = f" ({in_words(form)})" if form else ""
        where, added = at(a.location), _coefficient(finding)
        if added:
            where = f"added to {added}" if added == a.location else f"added to {added}, {where}"
        return f"a term {law_text(result, finding)} {where}{named}{_as_well(a)}{or_else}"
    return f"{in_a_sentence(a.effect.title)} at {a.location}{or_else}"


def _as_well(attachment: Attachment) -> str:
    """What else a law may be, since something does not turn in the recordings."""
    name, variable = attachment.alike
    return f" (or {name}, since {variable} never turns: the data does not tell)" if name else ""


def left_over(result: Explanation) -> list[str]:
    """Signals whose residual is not noise in the end, as sentences."""
    return [
        f"{w.column}: block means over {w.block} samples have {w.ratio:.3g} times the power of noise"
        for w in whiteness(result.final).values() if not w.passed
    ]  # fmt: skip


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {k: _rounded(v) for k, v in value.items()}
    if isinstance(value, list):
        return [_rounded(v) for v in value]
    if isinstance(value, np.floating | float):
        return float(f"{float(value):.6g}") if math.isfinite(value) else None
    return value.item() if isinstance(value, np.generic) else value
