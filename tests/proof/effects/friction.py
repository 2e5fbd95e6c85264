"""Dry frictions and drag."""

from tests.proof.effects.concealed import NOMINAL, Concealed, Maker, value


def frictions(bench: str) -> dict[str, Maker]:
    """Dry frictions and drag of the bench's shaft (or device)."""
    t, w, a = (NOMINAL[bench][k] for k in "twa")
    place = "device" if bench == "FrictionDevice" else "shaft"
    force, speed, angle = ("N", "m/s", "m") if place == "device" else ("N.m", "rad/s", "rad")
    level = "F_c" if place == "device" else "tau_c"

    def coulomb(rng, s):
        return Concealed(
            "friction.coulomb",
            place,
            {f"{place}_tau_c": t * s},
            {level: value(t * s, force, "Tc", "T_c", "fc", "F_c", "tau_c")},
        )

    def asymmetric(rng, s):
        d = rng.choice([-1, 1]) * rng.uniform(0.3, 0.6)
        return Concealed(
            "friction.asymmetric",
            place,
            {f"{place}_tau_c": t * s, f"{place}_tau_d": d * t * s},
            {
                "tau_pos": value(t * s * (1 + d), force, "F_pos", "tau_c_pos", "tau_plus"),
                "tau_neg": value(t * s * (1 - d), force, "F_neg", "tau_c_neg", "tau_minus"),
            },
        )

    def stribeck(rng, s):
        ratio, w_s = rng.uniform(1.8, 3.0), w * rng.uniform(0.1, 0.3)
        return Concealed(
            "friction.stribeck",
            place,
            {f"{place}_tau_c": t * s, f"{place}_tau_e": (ratio - 1) * t * s, f"{place}_w_s": w_s},
            {
                level: value(t * s, force, "F_c", "tau_c"),
                "tau_s": value(ratio * t * s, force, "F_s"),
                "w_s": value(w_s, speed, "v_s", "w_stribeck"),
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
                level: value(t * s, force, "F_c", "tau_c"),
                "sigma_0": value(t * s / micro, f"{force}/{angle}", "sigma0", "k", "stiffness"),
                "x_s": value(micro, angle, "s", "x_0"),
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
            {level: value(t * s, force, "F_c", "tau_c"), "depth": value(depth, "1", "amplitude", "a")},
            law="tau_c (1 + depth sin(n angle + phase)) sign(w)",
        )

    def quadratic(rng, s):
        c = t * s / w**2
        return Concealed(
            "drag.quadratic",
            place,
            {f"{place}_c2": c},
            {"c": value(c, f"{force}.s2/{angle}2", "c2", "c_2", "k2", "b2")},
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
        parameters={"difference": value(2 * d, "N.m", "tau_d")},
        accept_effects=("load.constant",),
    )


def _bldc_stribeck(rng, s):
    extra, w_s = 0.06 * s, rng.uniform(15, 40)
    return Concealed(
        "friction.stribeck",
        "shaft",
        {"shaft_tau_e": extra, "shaft_w_s": w_s},
        {"w_s": value(w_s, "rad/s", "v_s")},
        law="tau_c + tau_e exp(-(w/w_s)^2)",
    )
