"""What the terms that a regression kept are called, and what they are in the simulator."""

from collections.abc import Callable, Mapping, Sequence
import re

import numpy as np

Named = tuple[str, str, dict[str, float]]  # effect, location, simulator parameters
Coefficients = Mapping[str, float]


def _wave(c: Coefficients, prefix: str, n: int) -> tuple[float, float]:
    sine, cosine = c[f"{prefix}sin{n}"], c[f"{prefix}cos{n}"]
    return float(np.hypot(sine, cosine)), float(np.arctan2(cosine, sine))


def _periodic(place: str, group: str, c: Coefficients, Ke: float) -> Named:
    n = int(re.sub(r"\D", "", group))
    if group.startswith("i_"):
        amplitude, phase = _wave(c, "i_", n)
        return "torque.ripple", place, {"rip_a": amplitude / Ke, "rip_n": float(n), "rip_phi": phase + np.pi}
    amplitude, phase = _wave(c, "", n)
    if n == 1:
        return "load.gravity", place, {"mgl": amplitude, "mgl_phi": phase}
    return "torque.cogging", place, {"cog_a": amplitude, "cog_n": float(n), "cog_phi": phase}


def _dry(place: str, chosen: Sequence[str], c: Coefficients) -> Named:
    """Dry friction of a constant, a falling or an asymmetric level, from the terms with the sign of the speed."""
    level, speed = (f"{place}_tau_c", 0.02) if place == "device" else ("shaft_tau_c", 10.0)
    site = level.removesuffix("_tau_c")
    kernel = {level: c.get("sign", 0.0)}
    if "stribeck" in chosen:
        return "friction.stribeck", place, kernel | {f"{site}_tau_e": c["stribeck"], f"{site}_w_s": speed}
    if "one" in chosen:
        return "friction.asymmetric", place, kernel | {f"{site}_tau_d": c["one"]}
    return "friction.coulomb", place, kernel


def _simple(place: str, c: Coefficients) -> dict[str, Callable[[], Named]]:
    """Groups of one term each."""
    device = place == "device"
    return {
        "square": lambda: ("drag.quadratic", place, {"device_c2" if device else "shaft_c2": c["square"]}),
        "angle": lambda: ("stiffness", place, {"k_s": c["angle"]}),
        "one": lambda: ("load.constant", place, {"F_0" if device else "tau_l": c["one"]}),
        "load": lambda: ("friction.load", place, {"shaft_mu": c["load"]}),
        "cube": lambda: ("motor.saturation", "winding", {}),
        "flux": lambda: ("motor.saturation", "winding", {}),
        "eccentric": lambda: ("motor.eccentricity", "winding", {"zeta": c["eccentric"] / c["Ke"]}),
        "dead": lambda: ("drive.dead_time", "drive", {"V_d": c["dead"]}),
        "sag": lambda: ("drive.supply_sag", "drive", {"sag": c["sag"]}),
        "warm": lambda: ("motor.heating", "winding", {}),
        "late": lambda: ("drive.delay", "drive", {}),
        "offset": lambda: ("sensor.offset", "sensor:i", {}),
        **{f"R{x}": lambda x=x: ("motor.imbalance", f"winding:{x}", {f"R{x}": c[f"R{x}"]}) for x in "abc"},
    }


def named(place: str, chosen: Sequence[str], coefficients: Coefficients, Ke: float) -> list[Named]:
    """Effects of the chosen groups of terms, in the order of their choice."""
    simple, found, dry = _simple(place, coefficients), [], {"sign", "stribeck"} & set(chosen)
    for group in chosen:
        if group in ("sign", "stribeck"):
            if dry:
                found.append(_dry(place, chosen, coefficients))
            dry = set()
        elif "sin" in group:
            found.append(_periodic(place, group, coefficients, Ke))
        elif not (group == "one" and {"sign", "stribeck"} & set(chosen)):
            found.append(simple[group]())
    return found
