"""Loads, torques periodic in the angle, and what is wrong in a transmission."""

import numpy as np

from tests.proof.effects.concealed import NOMINAL, Concealed, Maker, value


def loads(bench: str) -> dict[str, Maker]:
    """Loads and torques periodic in the angle, at the bench's shaft (ScrewEma: some at the surface)."""
    t = NOMINAL[bench]["t"]
    if bench == "FrictionDevice":
        return {
            "stiffness": lambda rng, s: Concealed(
                "stiffness", "device", {"k_s": 2e5 * s}, {"k": value(2e5 * s, "N/m", "c", "k_s")}
            ),
            "load.constant": lambda rng, s: Concealed(
                "load.constant",
                "device",
                {"F_0": 3000 * s},
                {"F": value(3000 * s, "N", "F_0", "tau")},
                ("device", "sensor:F"),
                ("sensor.offset",),
            ),
        }
    place, _unit = ("surface", 300.0) if bench == "ScrewEma" else ("shaft", 1.0)
    load = 10.0 if bench == "ScrewEma" else 0.7 * t
    spring = {"ScrewEma": 300.0, "DcServo": 5e-5, "Joint": 2e-4, "BldcDrive": 1e-3}[bench]

    def constant(rng, s):
        v = load * s * rng.choice([-1, 1])
        return Concealed("load.constant", place, {"tau_l": v}, {"tau": value(v, "N.m", "tau_0", "T")})

    def stiffness(rng, s):
        return Concealed("stiffness", place, {"k_s": spring * s}, {"k": value(spring * s, "N.m/rad", "c", "k_s")})

    def gravity(rng, s):
        phase = rng.uniform(-0.6, 0.6)
        return Concealed(
            "load.gravity",
            "shaft",
            {"mgl": 1.2 * t * s, "mgl_phi": phase},
            {"mgl": value(1.2 * t * s, "N.m", "tau_g"), "phi": value(phase, "rad", "phase")},
            law="mgl sin(theta + phi)",
        )

    def cogging(rng, s):
        n, phase = float(rng.choice([3, 4, 6, 8])), rng.uniform(-1, 1)
        return Concealed(
            "torque.cogging",
            "shaft",
            {"cog_a": 1.2 * t * s, "cog_n": n, "cog_phi": phase},
            {
                "amplitude": value(1.2 * t * s, "N.m", "tau_cog", "A"),
                "periods": value(n, "1", "n"),
                "phase": value(phase, "rad", "phi"),
            },
            law="amplitude sin(periods angle + phase)",
        )

    def ripple(rng, s):
        n, phase, depth = float(rng.choice([3, 4, 6])), rng.uniform(-1, 1), min(0.25 * s, 0.9)
        return Concealed(
            "torque.ripple",
            "shaft",
            {"rip_a": depth, "rip_n": n, "rip_phi": phase},
            {"amplitude": value(depth, "1", "a"), "periods": value(n, "1", "n"), "phase": value(phase, "rad", "phi")},
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


def dc_only() -> dict[str, Maker]:
    def compliance(rng, s):
        share, k = rng.uniform(0.35, 0.6), 0.02 / s * rng.uniform(0.7, 1.4)
        return Concealed(
            "compliance",
            "shaft",
            {"J_share": share, "k_c": k, "d_c": 4e-5},
            {"k": value(k, "N.m/rad", "c"), "d": value(4e-5, "N.m.s/rad")},
            ("shaft", "transmission"),
            law="part of J behind a spring and damper",
        )

    def backlash(rng, s):
        play, share = 0.5 * s, rng.uniform(0.35, 0.6)
        return Concealed(
            "backlash",
            "shaft",
            {"J_share": share, "k_c": 0.3, "d_c": 1e-4, "play": play},
            {"play": value(play, "rad", "gap", "b", "backlash")},
            ("shaft", "transmission"),
            law="part of J behind a play",
        )

    return {"compliance": compliance, "backlash": backlash}


def stop(bench: str) -> dict[str, Maker]:
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


def screw_only() -> dict[str, Maker]:
    def backlash(rng, s):
        return Concealed(
            "backlash", "transmission", {"play": 0.0012 * s}, {"play": value(0.0012 * s, "rad", "gap", "b", "backlash")}
        )

    def load(rng, s):
        return Concealed(
            "friction.load",
            "shaft",
            {"shaft_mu": 0.12 * s},
            {"mu": value(0.12 * s, "1", "k", "c_load")},
            ("shaft", "transmission"),
            law="mu |Ts / N| sign(wm)",
        )

    return {"backlash": backlash, "friction.load": load}
