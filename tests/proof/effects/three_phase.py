"""What a three-phase machine and its bridge may hide."""

from tests.proof.effects.concealed import Concealed, Maker, value


def three_phase() -> dict[str, Maker]:
    def short_circuit(rng, s):
        phase, f = rng.choice(list("abc")), min(0.08 * s, 0.5)
        return Concealed(
            "motor.short_circuit",
            f"winding:{phase}",
            {f"short_{phase}": f},
            {"fraction": value(f, "1", "f", "s", "short")},
            law="a fraction f of the turns drops out: R (1-f), Ke (1-f), L (1-f)^2",
        )

    def imbalance(rng, s):
        phase, share = rng.choice(list("abc")), 0.3 * s * rng.choice([-0.5, 1.0])
        return Concealed(
            "motor.imbalance",
            f"winding:{phase}",
            {f"R{phase}": 2.13 * share},
            {"dR": value(2.13 * share, "ohm", "delta_R", "R_x")},
            law="R + dR in one phase",
        )

    def eccentricity(rng, s):
        z = 0.06 * s
        return Concealed(
            "motor.eccentricity",
            "winding",
            {"zeta": z},
            {"zeta": value(z, "1", "eps", "e", "zeta_e")},
            ("winding", "shaft"),
            law="k_x (1 + zeta cos(theta_e - 60 deg))",
        )

    def dead_time(rng, s):
        return Concealed(
            "drive.dead_time",
            "bridge",
            {"V_d": 0.3 * s},
            {"V_d": value(0.3 * s, "V", "Vd", "V_dead", "u_d")},
            ("bridge", "drive", "winding"),
            law="every leg of the bridge loses V_d against the sign of its current",
        )

    def sag(rng, s):
        return Concealed(
            "drive.supply_sag",
            "bridge",
            {"sag": 0.8 * s},
            {"R": value(0.8 * s, "ohm", "R_s", "r")},
            ("bridge", "drive", "winding"),
            law="v_bus - R times the bus current",
        )

    def saturation(rng, s):
        limit = 22.0 / s**0.5
        return Concealed(
            "drive.saturation",
            "bridge",
            {"u_max": limit},
            {"v_max": value(limit, "V", "limit")},
            ("bridge", "drive", "winding"),
        )

    def heating(rng, s):
        k, tau = 0.8 * s, rng.uniform(0.3, 0.8)
        return Concealed(
            "motor.heating",
            "winding",
            {"heat_k": k, "heat_tau": tau},
            {"k": value(k, "1/W"), "tau": value(tau, "s", "T", "tau_th")},
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
