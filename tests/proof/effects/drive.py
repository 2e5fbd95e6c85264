"""What a DC machine's winding and its drive, or a joint's drive, may hide."""

from tests.proof.effects.concealed import Concealed, Maker, value


def winding_and_drive(bench: str) -> dict[str, Maker]:
    screw = bench == "ScrewEma"
    volt, amp = (3.0, 4.0) if screw else (1.0, 0.7)

    def dead_time(rng, s):
        v = 0.3 * volt * s
        return Concealed(
            "drive.dead_time", "drive", {"V_d": v}, {"V_d": value(v, "V", "Vd", "V_dead", "u_d")}, ("drive", "winding")
        )

    def sag(rng, s):
        k = 0.12 * s / amp
        return Concealed(
            "drive.supply_sag",
            "drive",
            {"sag": k},
            {"k": value(k, "1/A", "sag")},
            ("drive", "winding"),
            law="u (1 - k |i|)",
        )

    def saturation(rng, s):
        limit = (26.0 if screw else 5.0) / s**0.7
        return Concealed(
            "drive.saturation",
            "drive",
            {"u_max": limit},
            {"u_max": value(limit, "V", "limit", "V_max")},
            ("drive", "winding"),
        )

    def deadband(rng, s):
        v = 0.35 * volt * s
        return Concealed(
            "drive.deadband",
            "drive",
            {"u_dead": v},
            {"width": value(v, "V", "u_dead", "deadband", "band")},
            ("drive", "winding"),
            law="0 while |u| <= width, else u",
        )

    def delay(rng, s):
        v = (0.012 if screw else 0.003) * s
        return Concealed(
            "drive.delay",
            "drive",
            delay=v,
            parameters={"T": value(v, "s", "delay", "T_d")},
            accept_locations=("drive", "winding", "input:theta_cmd"),
        )

    def heating(rng, s):
        k, tau = 0.15 * s / (20 if screw else 1), rng.uniform(1.2, 3.0)
        return Concealed(
            "motor.heating",
            "winding",
            {"heat_k": k, "heat_tau": tau},
            {"k": value(k, "1/W"), "tau": value(tau, "s", "T", "tau_th")},
            law="R (1 + r), tau der(r) = k R (1 + r) i^2 - r",
        )

    def magnetic(rng, s):
        i_s = (9.0 if screw else 1.2) / s**0.5
        return Concealed(
            "motor.saturation",
            "winding",
            {"i_sat": i_s},
            {"i_sat": value(i_s, "A", "I_s"), "k_sat": value(1 / i_s**2, "1/A2")},
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


def joint_drive() -> dict[str, Maker]:
    def saturation(rng, s):
        limit = 0.013 / s**0.7
        return Concealed(
            "drive.saturation", "drive", {"u_max": limit}, {"tau_max": value(limit, "N.m", "limit")}, ("drive", "shaft")
        )

    def deadband(rng, s):
        v = 0.004 * s
        return Concealed(
            "drive.deadband", "drive", {"u_dead": v}, {"width": value(v, "N.m", "deadband", "band")}, ("drive", "shaft")
        )

    return {"drive.saturation": saturation, "drive.deadband": deadband}
