"""What the proof conceals: for each bench and effect, its place, its law and how large it may be.

A maker takes the random generator and a size (1 = nominal) and returns the concealed thing. Sizes are tuned by the
generator until the believed model's misfit is of the wanted order.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Concealed:
    """One piece of physics in the data and not in the model.

    `kernel` are parameters of the simulator, `parameters` those of the truth (value, unit, other names); the sensor
    fields name the signal that they spoil.
    """

    effect: str
    location: str
    kernel: Mapping[str, float] = field(default_factory=dict)
    parameters: Mapping[str, tuple] = field(default_factory=dict)
    accept_locations: tuple[str, ...] = ()
    accept_effects: tuple[str, ...] = ()
    law: str = ""
    outside_vocabulary: bool = False
    delay: float = 0.0
    lag: Mapping[str, float] = field(default_factory=dict)
    offset: Mapping[str, float] = field(default_factory=dict)
    gain: Mapping[str, float] = field(default_factory=dict)
    once_per_rev: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    needs: tuple[str, ...] = ()  # outputs without which the effect cannot be seen
    lacks: tuple[str, ...] = ()  # outputs that would drown it
    stop_share: float = 0.0  # where an end stop stands, over the farthest angle reached without it


Maker = Callable[[np.random.Generator, float], Concealed]
Scale = Mapping[str, float]

# Nominal sizes: of a torque (N.m or N), a speed and an angle of the place where a friction or load acts.
_SHAFT = {
    "DcServo": {"t": 0.0016, "w": 60.0, "a": 1.0},
    "Joint": {"t": 0.004, "w": 40.0, "a": 1.0},
    "ScrewEma": {"t": 0.03, "w": 60.0, "a": 1.0},
    "BldcDrive": {"t": 0.03, "w": 80.0, "a": 1.0},
    "FrictionDevice": {"t": 6000.0, "w": 0.08, "a": 0.01},
}


def _name(value: float, unit: str, *aliases: str) -> tuple:
    return (value, unit, aliases)


def _frictions(bench: str) -> dict[str, Maker]:
    """Dry frictions and drag of the bench's shaft (or device)."""
    t, w, a = (_SHAFT[bench][k] for k in "twa")
    place = "device" if bench == "FrictionDevice" else "shaft"
    force, speed, angle = ("N", "m/s", "m") if place == "device" else ("N.m", "rad/s", "rad")
    level = "F_c" if place == "device" else "tau_c"

    def coulomb(rng, s):
        return Concealed(
            "friction.coulomb",
            place,
            {f"{place}_tau_c": t * s},
            {level: _name(t * s, force, "Tc", "T_c", "fc", "F_c", "tau_c")},
        )

    def asymmetric(rng, s):
        d = rng.choice([-1, 1]) * rng.uniform(0.3, 0.6)
        return Concealed(
            "friction.asymmetric",
            place,
            {f"{place}_tau_c": t * s, f"{place}_tau_d": d * t * s},
            {
                "tau_pos": _name(t * s * (1 + d), force, "F_pos", "tau_c_pos", "tau_plus"),
                "tau_neg": _name(t * s * (1 - d), force, "F_neg", "tau_c_neg", "tau_minus"),
            },
        )

    def stribeck(rng, s):
        ratio, w_s = rng.uniform(1.8, 3.0), w * rng.uniform(0.1, 0.3)
        return Concealed(
            "friction.stribeck",
            place,
            {f"{place}_tau_c": t * s, f"{place}_tau_e": (ratio - 1) * t * s, f"{place}_w_s": w_s},
            {
                level: _name(t * s, force, "F_c", "tau_c"),
                "tau_s": _name(ratio * t * s, force, "F_s"),
                "w_s": _name(w_s, speed, "v_s", "w_stribeck"),
            },
            law="tau_c + (tau_s - tau_c) exp(-(w/w_s)^2)",
        )

    def presliding(rng, s):
        micro = a * rng.uniform(0.1, 0.5)
        return Concealed(
            "friction.presliding",
            place,
            {f"{place}_tau_c": t * s, f"{place}_sigma0": t * s / micro},
            {
                level: _name(t * s, force, "F_c", "tau_c"),
                "sigma_0": _name(t * s / micro, f"{force}/{angle}", "sigma0", "k", "stiffness"),
            },
            law="sigma_0 z, der(z) = w - sigma_0 |w| z / tau_c",
        )

    def position(rng, s):
        depth, periods = rng.uniform(0.5, 0.8), 0.08 / a if place == "shaft" else 2.0 / a
        phase = rng.uniform(-1, 1)
        return Concealed(
            "friction.position",
            place,
            {f"{place}_tau_c": t * s, f"{place}_pos_a": depth, f"{place}_pos_n": periods, f"{place}_pos_phi": phase},
            {level: _name(t * s, force, "F_c", "tau_c"), "depth": _name(depth, "1", "amplitude", "a")},
            law="tau_c (1 + depth sin(n angle + phase)) sign(w)",
        )

    def quadratic(rng, s):
        c = t * s / w**2
        return Concealed(
            "drag.quadratic",
            place,
            {f"{place}_c2": c},
            {"c": _name(c, f"{force}.s2/{angle}2", "c2", "c_2", "k2", "b2")},
            law="c w |w|",
        )

    made = {
        "friction.coulomb": coulomb,
        "friction.asymmetric": asymmetric,
        "friction.stribeck": stribeck,
        "friction.presliding": presliding,
        "friction.position": position,
        "drag.quadratic": quadratic,
    }
    if bench == "BldcDrive":  # its believed model has the Coulomb level already
        return {
            "drag.quadratic": quadratic,
            "friction.asymmetric": _bldc_asymmetric,
            "friction.stribeck": _bldc_stribeck,
        }
    return made


def _bldc_asymmetric(rng, s):
    d = rng.choice([-1, 1]) * 0.025 * s
    return Concealed(
        "friction.asymmetric",
        "shaft",
        {"shaft_tau_d": d},
        law="tau_c + tau_d sign(w)",
        parameters={"difference": _name(2 * d, "N.m", "tau_d")},
        accept_effects=("load.constant",),
    )


def _bldc_stribeck(rng, s):
    extra, w_s = 0.06 * s, rng.uniform(15, 40)
    return Concealed(
        "friction.stribeck",
        "shaft",
        {"shaft_tau_e": extra, "shaft_w_s": w_s},
        {"w_s": _name(w_s, "rad/s", "v_s")},
        law="tau_c + tau_e exp(-(w/w_s)^2)",
    )


def _loads(bench: str) -> dict[str, Maker]:
    """Loads and torques periodic in the angle, at the bench's shaft (ScrewEma: some at the surface)."""
    t = _SHAFT[bench]["t"]
    if bench == "FrictionDevice":
        return {
            "stiffness": lambda rng, s: Concealed(
                "stiffness", "device", {"k_s": 2e5 * s}, {"k": _name(2e5 * s, "N/m", "c", "k_s")}
            ),
            "load.constant": lambda rng, s: Concealed(
                "load.constant",
                "device",
                {"F_0": 3000 * s},
                {"F": _name(3000 * s, "N", "F_0", "tau")},
                ("device", "sensor:F"),
                ("sensor.offset",),
            ),
        }
    place, _unit = ("surface", 300.0) if bench == "ScrewEma" else ("shaft", 1.0)
    load = 10.0 if bench == "ScrewEma" else 0.7 * t
    spring = {"ScrewEma": 300.0, "DcServo": 5e-5, "Joint": 2e-4, "BldcDrive": 1e-3}[bench]

    def constant(rng, s):
        v = load * s * rng.choice([-1, 1])
        return Concealed("load.constant", place, {"tau_l": v}, {"tau": _name(v, "N.m", "tau_0", "T")})

    def stiffness(rng, s):
        return Concealed("stiffness", place, {"k_s": spring * s}, {"k": _name(spring * s, "N.m/rad", "c", "k_s")})

    def gravity(rng, s):
        phase = rng.uniform(-0.6, 0.6)
        return Concealed(
            "load.gravity",
            "shaft",
            {"mgl": 1.2 * t * s, "mgl_phi": phase},
            {"mgl": _name(1.2 * t * s, "N.m", "tau_g"), "phi": _name(phase, "rad", "phase")},
            law="mgl sin(theta + phi)",
        )

    def cogging(rng, s):
        n, phase = float(rng.choice([3, 4, 6, 8])), rng.uniform(-1, 1)
        return Concealed(
            "torque.cogging",
            "shaft",
            {"cog_a": 1.2 * t * s, "cog_n": n, "cog_phi": phase},
            {
                "amplitude": _name(1.2 * t * s, "N.m", "tau_cog", "A"),
                "periods": _name(n, "1", "n"),
                "phase": _name(phase, "rad", "phi"),
            },
            law="amplitude sin(periods angle + phase)",
        )

    def ripple(rng, s):
        n, phase, depth = float(rng.choice([3, 4, 6])), rng.uniform(-1, 1), min(0.25 * s, 0.9)
        return Concealed(
            "torque.ripple",
            "shaft",
            {"rip_a": depth, "rip_n": n, "rip_phi": phase},
            {"amplitude": _name(depth, "1", "a"), "periods": _name(n, "1", "n"), "phase": _name(phase, "rad", "phi")},
            ("shaft", "winding"),
            law="Ke i (1 + amplitude sin(periods angle + phase))",
        )

    made = {
        "load.constant": constant,
        "stiffness": stiffness,
        "load.gravity": gravity,
        "torque.cogging": cogging,
        "torque.ripple": ripple,
    }
    if bench == "ScrewEma":
        del made["load.gravity"]  # within this stroke it is a constant load and a spring
    if bench == "Joint":
        del made["torque.ripple"]  # no current
    return made


def _dc_only() -> dict[str, Maker]:
    def compliance(rng, s):
        share, k = rng.uniform(0.35, 0.6), 0.02 / s * rng.uniform(0.7, 1.4)
        return Concealed(
            "compliance",
            "shaft",
            {"J_share": share, "k_c": k, "d_c": 4e-5},
            {"k": _name(k, "N.m/rad", "c"), "d": _name(4e-5, "N.m.s/rad")},
            ("shaft", "transmission"),
            law="part of J behind a spring and damper",
        )

    def backlash(rng, s):
        play, share = 0.5 * s, rng.uniform(0.35, 0.6)
        return Concealed(
            "backlash",
            "shaft",
            {"J_share": share, "k_c": 0.3, "d_c": 1e-4, "play": play},
            {"play": _name(play, "rad", "gap", "b", "backlash")},
            ("shaft", "transmission"),
            law="part of J behind a play",
        )

    return {"compliance": compliance, "backlash": backlash}


def _stop(bench: str) -> dict[str, Maker]:
    place = "surface" if bench == "ScrewEma" else "shaft"
    k, d = {"ScrewEma": (2e5, 300.0), "DcServo": (0.02, 2e-4), "Joint": (0.1, 2e-3)}[bench]

    def end_stop(rng, s):
        return Concealed(
            "end_stop",
            place,
            {"stop_low": -1e9, "k_e": k, "d_e": d},
            stop_share=float(np.clip(0.85 / s**0.3, 0.4, 0.97)),
            law="k (angle - position) + d w beyond position",
        )

    return {"end_stop": end_stop}


def _screw_only() -> dict[str, Maker]:
    def backlash(rng, s):
        return Concealed(
            "backlash", "transmission", {"play": 0.0012 * s}, {"play": _name(0.0012 * s, "rad", "gap", "b", "backlash")}
        )

    def load(rng, s):
        return Concealed(
            "friction.load",
            "shaft",
            {"shaft_mu": 0.12 * s},
            {"mu": _name(0.12 * s, "1", "k", "c_load")},
            ("shaft", "transmission"),
            law="mu |Ts / N| sign(wm)",
        )

    return {"backlash": backlash, "friction.load": load}


def _winding_and_drive(bench: str) -> dict[str, Maker]:
    screw = bench == "ScrewEma"
    volt, amp = (3.0, 4.0) if screw else (1.0, 0.7)

    def dead_time(rng, s):
        v = 0.3 * volt * s
        return Concealed(
            "drive.dead_time", "drive", {"V_d": v}, {"V_d": _name(v, "V", "Vd", "V_dead", "u_d")}, ("drive", "winding")
        )

    def sag(rng, s):
        k = 0.12 * s / amp
        return Concealed(
            "drive.supply_sag",
            "drive",
            {"sag": k},
            {"k": _name(k, "1/A", "sag")},
            ("drive", "winding"),
            law="u (1 - k |i|)",
        )

    def saturation(rng, s):
        limit = (26.0 if screw else 5.0) / s**0.7
        return Concealed(
            "drive.saturation",
            "drive",
            {"u_max": limit},
            {"u_max": _name(limit, "V", "limit", "V_max")},
            ("drive", "winding"),
        )

    def deadband(rng, s):
        v = 0.35 * volt * s
        return Concealed(
            "drive.deadband",
            "drive",
            {"u_dead": v},
            {"width": _name(v, "V", "u_dead", "deadband")},
            ("drive", "winding"),
            law="0 while |u| <= width, else u",
        )

    def delay(rng, s):
        v = (0.012 if screw else 0.003) * s
        return Concealed(
            "drive.delay",
            "drive",
            delay=v,
            parameters={"T": _name(v, "s", "delay", "T_d")},
            accept_locations=("drive", "winding", "input:theta_cmd"),
        )

    def heating(rng, s):
        k, tau = 0.15 * s / (20 if screw else 1), rng.uniform(1.2, 3.0)
        return Concealed(
            "motor.heating",
            "winding",
            {"heat_k": k, "heat_tau": tau},
            {"k": _name(k, "1/W"), "tau": _name(tau, "s", "T")},
            law="R (1 + r), tau der(r) = k R (1 + r) i^2 - r",
        )

    def magnetic(rng, s):
        i_s = (9.0 if screw else 1.2) / s**0.5
        return Concealed(
            "motor.saturation",
            "winding",
            {"i_sat": i_s},
            {"i_sat": _name(i_s, "A", "I_s")},
            ("winding", "shaft"),
            law="Ke / (1 + (i / i_sat)^2)",
        )

    return {
        "drive.dead_time": dead_time,
        "drive.supply_sag": sag,
        "drive.saturation": saturation,
        "drive.deadband": deadband,
        "drive.delay": delay,
        "motor.heating": heating,
        "motor.saturation": magnetic,
    }


def _joint_drive() -> dict[str, Maker]:
    def saturation(rng, s):
        limit = 0.013 / s**0.7
        return Concealed(
            "drive.saturation", "drive", {"u_max": limit}, {"tau_max": _name(limit, "N.m", "limit")}, ("drive", "shaft")
        )

    def deadband(rng, s):
        v = 0.004 * s
        return Concealed(
            "drive.deadband", "drive", {"u_dead": v}, {"width": _name(v, "N.m", "deadband")}, ("drive", "shaft")
        )

    return {"drive.saturation": saturation, "drive.deadband": deadband}


def _sensors(bench: str) -> dict[str, Maker]:
    """Errors of the instruments, which the control loops of these benches do not see."""

    def offset(signal, nominal, unit):
        def make(rng, s):
            v = nominal * s * rng.choice([-1, 1])
            return Concealed(
                "sensor.offset",
                f"sensor:{signal}",
                offset={signal: v},
                needs=(signal,),
                parameters={"offset": _name(v, unit, "b", "bias")},
            )

        return make

    def gain(signal, other, nominal):
        def make(rng, s):
            v = 1 + nominal * s * rng.choice([-1, 1])
            return Concealed(
                "sensor.gain",
                f"sensor:{signal}",
                gain={signal: v},
                needs=(signal, other),
                parameters={"gain": _name(v, "1", "k", "scale")},
            )

        return make

    def lag(signal, nominal, needs=()):
        def make(rng, s):
            return Concealed(
                "sensor.lag",
                f"sensor:{signal}",
                lag={signal: nominal * s},
                needs=(signal, *needs),
                parameters={"tau": _name(nominal * s, "s", "T", "lag")},
            )

        return make

    def once(signal, nominal, lacks):
        def make(rng, s):
            phase = rng.uniform(-2, 2)
            return Concealed(
                "sensor.once_per_rev",
                f"sensor:{signal}",
                once_per_rev={signal: (nominal * s, phase)},
                needs=(signal,),
                lacks=lacks,
                law="angle + amplitude sin(angle + phase)",
                parameters={"amplitude": _name(nominal * s, "rad", "a"), "phase": _name(phase, "rad", "phi")},
            )

        return make

    return {
        "DcServo": {
            "sensor.offset": offset("i", 0.04, "A"),
            "sensor.gain": gain("w", "theta", 0.06),
            "sensor.lag": lag("i", 0.004),
            "sensor.once_per_rev": once("theta", 0.02, ("i", "w")),
        },
        "ScrewEma": {
            "sensor.offset": offset("i", 0.2, "A"),
            "sensor.gain": gain("ths", "thm", 0.06),
            "sensor.lag": lag("ths", 0.008, ("thm",)),
        },
        "BldcDrive": {
            "sensor.offset": offset("ia", 0.05, "A"),
            "sensor.gain": gain("ib", "ic", 0.1),
            "sensor.lag": lag("ic", 4e-4),
        },
        "Joint": {
            "sensor.offset": offset("w", 2.0, "rad/s"),
            "sensor.gain": gain("w", "theta", 0.06),
            "sensor.lag": lag("w", 0.05, ("theta",)),
            "sensor.once_per_rev": once("theta", 0.02, ("w",)),
        },
        "FrictionDevice": {"sensor.lag": lag("F", 0.03)},
    }[bench]


def _three_phase() -> dict[str, Maker]:
    def short_circuit(rng, s):
        phase, f = rng.choice(list("abc")), min(0.08 * s, 0.5)
        return Concealed(
            "motor.short_circuit",
            f"winding:{phase}",
            {f"short_{phase}": f},
            {"fraction": _name(f, "1", "f", "s", "short")},
            law="a fraction f of the turns drops out: R (1-f), Ke (1-f), L (1-f)^2",
        )

    def imbalance(rng, s):
        phase, share = rng.choice(list("abc")), 0.3 * s * rng.choice([-0.5, 1.0])
        return Concealed(
            "motor.imbalance",
            f"winding:{phase}",
            {f"R{phase}": 2.13 * share},
            {"dR": _name(2.13 * share, "ohm", "delta_R", "R_x")},
            law="R + dR in one phase",
        )

    def eccentricity(rng, s):
        z = 0.06 * s
        return Concealed(
            "motor.eccentricity",
            "winding",
            {"zeta": z},
            {"zeta": _name(z, "1", "eps", "e")},
            ("winding", "shaft"),
            law="k_x (1 + zeta cos(theta_e - 60 deg))",
        )

    def dead_time(rng, s):
        return Concealed(
            "drive.dead_time",
            "bridge",
            {"V_d": 0.3 * s},
            {"V_d": _name(0.3 * s, "V", "Vd", "V_dead", "u_d")},
            ("bridge", "drive", "winding"),
            law="every leg of the bridge loses V_d against the sign of its current",
        )

    def sag(rng, s):
        return Concealed(
            "drive.supply_sag",
            "bridge",
            {"sag": 0.8 * s},
            {"R": _name(0.8 * s, "ohm", "R_s", "r")},
            ("bridge", "drive", "winding"),
            law="v_bus - R times the bus current",
        )

    def saturation(rng, s):
        limit = 22.0 / s**0.5
        return Concealed(
            "drive.saturation",
            "bridge",
            {"u_max": limit},
            {"v_max": _name(limit, "V", "limit")},
            ("bridge", "drive", "winding"),
        )

    def heating(rng, s):
        k, tau = 0.8 * s, rng.uniform(0.3, 0.8)
        return Concealed(
            "motor.heating",
            "winding",
            {"heat_k": k, "heat_tau": tau},
            {"k": _name(k, "1/W"), "tau": _name(tau, "s", "T")},
            law="R (1 + r), tau der(r) = k sum(R i^2) - r",
        )

    return {
        "motor.short_circuit": short_circuit,
        "motor.imbalance": imbalance,
        "motor.eccentricity": eccentricity,
        "drive.dead_time": dead_time,
        "drive.supply_sag": sag,
        "drive.saturation": saturation,
        "motor.heating": heating,
    }


def _laws(bench: str) -> dict[str, Maker]:
    """Physics that no catalogue names."""
    t, w = _SHAFT[bench]["t"], _SHAFT[bench]["w"]
    place = "device" if bench == "FrictionDevice" else "shaft"

    def law(name, text, kernel, parameters):
        def make(rng, s):
            values = kernel(rng, s)
            return Concealed(
                "unknown",
                place,
                values,
                {k: _name(values[k], u) for k, u in parameters.items()},
                law=text,
                outside_vocabulary=True,
            )

        return name, make

    cubic_name = "law_v3" if place == "device" else "law_w3"
    cubic = law("cubic_drag", "c w^3", lambda rng, s: {cubic_name: 1.5 * t * s / w**3}, {cubic_name: "SI"})
    root = law("root_drag", "c sign(w) sqrt(|w|)", lambda rng, s: {"law_sqrt": t * s / w**0.5}, {"law_sqrt": "SI"})
    vibration = law(
        "vibration",
        "a sin(w_0 t)",
        lambda rng, s: {"law_vib": t * s, "law_vib_w": rng.uniform(15, 60)},
        {"law_vib": "N.m", "law_vib_w": "rad/s"},
    )
    hardening = law("hardening_spring", "k theta^3", lambda rng, s: {"law_theta3": 2e-7 * s}, {"law_theta3": "SI"})
    angular = law(
        "position_drag", "c w (1 + sin theta)", lambda rng, s: {"law_wsin": 1.5 * t * s / w}, {"law_wsin": "N.m.s/rad"}
    )
    warm = law(
        "cold_grease",
        "c w exp(-t / tau)",
        lambda rng, s: {"law_warm": 2 * t * s / w, "law_warm_tau": rng.uniform(1, 3)},
        {"law_warm": "N.m.s/rad", "law_warm_tau": "s"},
    )
    return dict(
        {
            "DcServo": (cubic, vibration, angular, hardening, warm),
            "Joint": (root, vibration, angular),
            "ScrewEma": (warm, cubic),
            "BldcDrive": (warm,),
            "FrictionDevice": (cubic, root),
        }[bench]
    )


def catalogue(bench: str) -> dict[str, Maker]:
    """Effects that may be concealed on a bench, by identifier."""
    made = _frictions(bench) | _loads(bench) | _sensors(bench)
    if bench == "BldcDrive":
        made |= _three_phase()
        for absent in ("torque.ripple", "stiffness", "load.constant"):
            del made[absent]
    if bench in ("DcServo", "ScrewEma"):
        made |= _winding_and_drive(bench)
    if bench in ("DcServo", "ScrewEma", "Joint"):
        made |= _stop(bench)
    if bench == "DcServo":
        made |= _dc_only()
    if bench == "ScrewEma":
        made |= _screw_only()
    if bench == "Joint":
        made |= _joint_drive()
    return made


def outside(bench: str) -> dict[str, Maker]:
    """Laws outside the catalogue that may be concealed on a bench, by name."""
    return _laws(bench)
