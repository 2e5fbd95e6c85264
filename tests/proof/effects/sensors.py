"""Errors of the instruments."""

from tests.proof.effects.concealed import Concealed, Maker, value


def sensors(bench: str) -> dict[str, Maker]:
    """Errors of the instruments, which the control loops of these benches do not see."""

    def offset(signal, nominal, unit):
        def make(rng, s):
            v = nominal * s * rng.choice([-1, 1])
            return Concealed(
                "sensor.offset",
                f"sensor:{signal}",
                offset={signal: v},
                needs=(signal,),
                parameters={"offset": value(v, unit, "b", "bias")},
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
                parameters={"gain": value(v, "1", "k", "scale")},
            )

        return make

    def lag(signal, nominal, needs=()):
        def make(rng, s):
            return Concealed(
                "sensor.lag",
                f"sensor:{signal}",
                lag={signal: nominal * s},
                needs=(signal, *needs),
                parameters={"tau": value(nominal * s, "s", "T", "lag")},
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
                parameters={"amplitude": value(nominal * s, "rad", "a"), "phase": value(phase, "rad", "phi")},
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
