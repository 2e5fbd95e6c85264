"""Words and numbers of the report: what to do next, values with as many digits as their errors leave, equations."""

from __future__ import annotations

import math
from pathlib import Path

from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.naming.name import Finding

FORMS = {
    "friction.coulomb": "dry friction",
    "friction.stribeck": "dry friction that falls with speed",
    "friction.viscous": "viscous friction",
    "drag.quadratic": "quadratic drag",
    "stiffness": "a linear spring",
    "stiffness.hardening": "a hardening spring",
    "leakage.laminar": "laminar leakage",
    "leakage.turbulent": "turbulent leakage",
    "loss.turbulent": "turbulent loss",
    "heat.loss": "loss of heat",
    "convection.natural": "natural convection",
    "drive.dead_time": "dead time of an inverter",
    "drive.delay": "a delay",
    "drive.deadband": "a dead band of the drive",
    "drive.saturation": "saturation of the drive",
    "torque.cogging": "cogging",
    "motor.saturation": "magnetic saturation",
    "motor.heating": "heating of a winding",
    "load.power": "a load of constant power",
    "end_stop": "an end stop",
    "overflow": "an overflow",
    "rate_limit": "a limit of the rate",
    "saturation": "a saturation",
    "friction.presliding": "presliding friction",
}
HALF_WIDTH = 1.96  # standard deviations: half of a 95 % interval


def action(result: Explanation, amended: Path | None) -> str:
    """What to do next, in a sentence."""
    if result.experiment:
        return result.experiment
    if result.verdict == "missing_physics" and amended is not None:
        return f"go on with {amended.name}, which holds it, and look for its cause in the machine"
    if result.verdict == "parameters" and amended is not None:
        return f"go on with {amended.name}, which holds the fitted values, or measure those parameters"
    if result.verdict != "consistent":
        return ""
    fitted = f"; {amended.name} has its parameters as fitted" if amended is not None else ""
    return f"nothing: the model can be used as it is{fitted}"


def in_a_sentence(title: str) -> str:
    """The title of an effect inside a sentence: what follows a colon in it is told in brackets."""
    name, _, more = title.partition(": ")
    return f"{name[0].lower()}{name[1:]}{f' ({more})' if more else ''}"


def in_words(form: str) -> str:
    """The name of a known form as a reader says it; where it is a word it stands for itself."""
    return FORMS.get(form, form)


def with_error(value: float, std: float | None) -> str:
    """A value and the half width of its 95 % interval, to two digits of that; a direction without data has no end."""
    if std is None or not math.isfinite(std):
        return f"{value:.3g} (not determined)"
    half = HALF_WIDTH * std
    if half <= 0:
        return f"{value:.4g}"
    size = math.floor(math.log10(max(abs(value), half)))
    scale = 10.0**size if not -4 <= size < 6 else 1.0
    digits = max(1 - math.floor(math.log10(half / scale)), 0)
    text = f"{value / scale:.{digits}f} \u00b1 {half / scale:.{digits}f}"
    return text if scale == 1.0 else f"({text})e{size}"


def rounded(value: float, std: float | None) -> str:
    """The value alone, to the digits that `with_error` gives it."""
    shown, _, rest = with_error(value, std).partition(" \u00b1")
    return shown.removeprefix("(") + rest.partition(")")[2] if rest else shown


def equation_of(result: Explanation, finding: Finding) -> str:
    """The equations of an effect of the catalogue, as its file has them; "" where it has no class of its own."""
    effect = finding.ranked.attachment.effect
    cls = result.case.library().find(effect.class_path) if "." in effect.class_path else None
    if cls is None or not cls.span.file:
        return ""
    body = Path(cls.span.file).read_text(encoding="utf-8").partition("\nequation\n")[2]
    lines = body.partition("\n  annotation")[0].partition("\nend ")[0].splitlines()
    return "\n".join(line.strip() for line in lines)


def at(location: str) -> str:
    """Where something is, in words: at one place, at every element of an array, or at each of several instances."""
    if ", " in location:
        return f"at each of {location}"
    return f"at every {location}" if "[:]" in location else f"at {location}"
