"""The benches' equations as regressions, for the usual alternative: target = known terms + whatever a library offers.

Signals are smoothed and differentiated by a Savitzky-Golay filter; what is not recorded is derived from what is.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.signal import savgol_filter

Columns = dict[str, np.ndarray]


@dataclass(frozen=True)
class Equation:
    """target = sum(parameter x known column) + sum(coefficient x library column), sample by sample."""

    place: str
    target: np.ndarray
    known: Columns
    library: Columns


def smooth(y: np.ndarray, period: float, order: int = 0, window: int = 25) -> np.ndarray:
    """A signal or its derivative of the given order, over `window` samples."""
    return savgol_filter(np.nan_to_num(y), window, 3, deriv=order, delta=period)


def _motion(s: Mapping[str, np.ndarray], angle: str, period: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle, speed and acceleration from whichever is recorded."""
    if "w" in s:
        w = smooth(s["w"], period)
        theta = s[angle] if angle in s else np.cumsum(w) * period
        return theta, w, smooth(s["w"], period, 1)
    return s[angle], smooth(s[angle], period, 1), smooth(s[angle], period, 2)


def _mechanical(theta: np.ndarray, w: np.ndarray, current: np.ndarray | None) -> Columns:
    slow = 0.15 * np.max(np.abs(w))
    columns = {
        "one": np.ones_like(w),
        "sign": np.sign(w),
        "square": w * np.abs(w),
        "angle": theta,
        "stribeck": np.sign(w) * np.exp(-((w / slow) ** 2)),
    }
    for n in (1, 3, 4, 6, 8):
        columns |= {f"sin{n}": np.sin(n * theta), f"cos{n}": np.cos(n * theta)}
    if current is not None:
        columns |= {f"i_{f.__name__}{n}": current * f(n * theta) for n in (3, 4, 6) for f in (np.sin, np.cos)}
        columns["cube"] = current**3
    return columns


def _winding(u: np.ndarray, i: np.ndarray, w: np.ndarray, period: float) -> Equation:
    time = np.cumsum(np.ones_like(u)) * period
    return Equation(
        "winding",
        u,
        {"R": i, "L": smooth(i, period, 1), "Ke": w},
        {
            "dead": np.sign(i),
            "sag": np.abs(i) * u,
            "offset": np.ones_like(i),
            "flux": -i * i * w,
            "warm": i * time,
            "late": smooth(u, period, 1),
        },
    )


def dc_servo(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    theta, w, acceleration = _motion(s, "theta", period)
    i = smooth(s["i"], period, window=7) if "i" in s else (s["u"] - p["Ke"] * w) / p["R"]
    shaft = Equation("shaft", p["Ke"] * i, {"J": acceleration, "b": w}, _mechanical(theta, w, i))
    return [_winding(s["u"], i, w, period), shaft] if "i" in s else [shaft]


def joint(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    theta, w, acceleration = _motion(s, "theta", period)
    return [Equation("shaft", s["tau"], {"J": acceleration, "b": w}, _mechanical(theta, w, None))]


def friction_device(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    x, v = s["x"], s["v"]
    slow = 0.15 * np.max(np.abs(v))
    return [
        Equation(
            "device",
            s["F"],
            {"c": v},
            {
                "one": np.ones_like(v),
                "sign": np.sign(v),
                "square": v * np.abs(v),
                "angle": x,
                "stribeck": np.sign(v) * np.exp(-((v / slow) ** 2)),
            },
        )
    ]


def screw_ema(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    N = 160
    angle = s["thm"] if "thm" in s else N * s["ths"]
    w, acceleration = smooth(angle, period, 1), smooth(angle, period, 2)
    i = smooth(s["i"], period, window=7)
    rigid = p["Jm"] + p["Js"] / N**2
    library = _mechanical(angle, w, i) | {"load": np.sign(w) * np.abs(s["T_aero"]) / N}
    shaft = Equation(
        "shaft",
        p["Ke"] * i - s["T_aero"] / N - (rigid - p["Jm"]) * acceleration - p["bs"] / N**2 * w,
        {"Jm": acceleration, "bm": w},
        library,
    )
    return [_winding(s["u"], i, w, period), shaft] if "u" in s else [shaft]


def _shapes(electrical: np.ndarray) -> list[np.ndarray]:
    """Trapezoids of the three phases, of an electrical angle in degrees."""
    corners = ([0, 30, 150, 210, 330, 360], [0, 1, 1, -1, -1, 0])
    return [np.interp((electrical - 120 * n) % 360, *corners) for n in range(3)]


def flight_control(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    N = 160
    angle, w, acceleration = s["thm"], smooth(s["thm"], period, 1), smooth(s["thm"], period, 2)
    phases = [s["ia"], s["ib"], s["ic"] if "ic" in s else -s["ia"] - s["ib"]]
    i = sum(k * current for k, current in zip(_shapes(np.degrees(2 * angle)), phases, strict=True))
    library = _mechanical(angle, w, i) | {"load": np.sign(w) * np.abs(s["T_aero"]) / N}
    del library["sign"]
    target = p["Ke"] * i - s["T_aero"] / N - p["Js"] / N**2 * acceleration - p["bs"] / N**2 * w
    return [Equation("shaft", target, {"Jm": acceleration, "bm": w, "tau_m": np.sign(w)}, library)]


def bldc_drive(p: Mapping[str, float], s: Mapping[str, np.ndarray], period: float) -> list[Equation]:
    if "theta" not in s:
        return []
    theta, w, acceleration = s["theta"], smooth(s["theta"], period, 1, 51), smooth(s["theta"], period, 2, 51)
    electrical = np.degrees(2 * theta)
    shape = [
        np.interp((electrical - 120 * n) % 360, [0, 30, 150, 210, 330, 360], [0, 1, 1, -1, -1, 0]) for n in range(3)
    ]
    phases = [smooth(s[x], period, window=5) for x in ("ia", "ib", "ic")]
    i = sum(k * current for k, current in zip(shape, phases, strict=True))
    shaft = Equation("shaft", p["Ke"] * i, {"J": acceleration, "b": w, "tau_c": np.sign(w)}, _mechanical(theta, w, i))
    del shaft.library["sign"]
    line = sum(np.sign(np.round(current, 1)) * k for k, current in zip(shape, phases, strict=True)) * w
    pair = sum(np.abs(current) for current in phases)
    steady = (s["v_bus"] > 1) & (pair > 0.3) & (np.min(np.abs(phases), axis=0) < 0.05)
    eccentric = line * np.cos(np.radians(electrical - 60))
    masked = {f"R{x}": np.abs(c) for x, c in zip("abc", phases, strict=True)} | {
        "sag": pair / 2,
        "eccentric": eccentric,
    }
    winding = Equation(
        "winding",
        (s["v_bus"] * np.sign(i) * s["dir"] * steady),
        {"R": pair * steady, "Ke": line * steady},
        {k: v * steady for k, v in masked.items()} | {"dead": 2.0 * steady},
    )
    return [winding, shaft]


EQUATIONS = {
    "Benches.DcServo": dc_servo,
    "Benches.Joint": joint,
    "Benches.FrictionDevice": friction_device,
    "Benches.ScrewEma": screw_ema,
    "Benches.BldcDrive": bldc_drive,
    "Benches.FlightControl": flight_control,
}
