"""Physics that no catalogue names."""

from tests.proof.effects.concealed import NOMINAL, Concealed, Maker, value


def laws(bench: str) -> dict[str, Maker]:
    """Physics that no catalogue names."""
    t, w = NOMINAL[bench]["t"], NOMINAL[bench]["w"]
    place = "device" if bench == "FrictionDevice" else "shaft"

    def law(name, text, kernel, parameters):
        def make(rng, s):
            values = kernel(rng, s)
            return Concealed(
                "unknown",
                place,
                values,
                {k: value(values[k], u) for k, u in parameters.items()},
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
