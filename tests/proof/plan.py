"""Which cases the proof consists of: kinds, benches and effects, in an order that tells nothing."""

from dataclasses import dataclass

import numpy as np

from tests.proof.effects import catalogue, outside


@dataclass(frozen=True)
class Plan:
    """One case to be: its kind, the bench, what is concealed, which parameters are off, and the wanted misfit."""

    kind: str  # effect | consistent | parameters | two | law | weak | one_way
    bench: str
    effects: tuple[str, ...] = ()
    off: tuple[str, ...] = ()
    gain: tuple[float, float] = (1.7, 6.0)  # range of the refitted believed model's NRMSE over the floor


PAIRS = (
    ("DcServo", ("friction.coulomb", "torque.cogging")),
    ("DcServo", ("drive.dead_time", "load.gravity")),
    ("DcServo", ("friction.stribeck", "sensor.lag")),
    ("ScrewEma", ("friction.coulomb", "backlash")),
    ("ScrewEma", ("torque.cogging", "stiffness")),
    ("BldcDrive", ("motor.short_circuit", "drive.dead_time")),
    ("Joint", ("friction.coulomb", "load.gravity")),
    ("FrictionDevice", ("friction.coulomb", "stiffness")),
)
LAWS = (
    ("DcServo", "cubic_drag"),
    ("DcServo", "vibration"),
    ("Joint", "position_drag"),
    ("FrictionDevice", "root_drag"),
    ("DcServo", "cold_grease"),
    ("DcServo", "hardening_spring"),
)
OFF = {
    "DcServo": ("R", "Ke", "J", "b"),
    "ScrewEma": ("R", "Ke", "Jm", "Js"),
    "BldcDrive": ("R", "Ke", "J", "tau_c"),
    "Joint": ("J", "b"),
    "FrictionDevice": ("c",),
}
NULLS = {"DcServo": 14, "ScrewEma": 10, "BldcDrive": 6, "Joint": 4, "FrictionDevice": 2}


def _effects() -> list[Plan]:
    return [
        Plan("effect", bench, (effect,))
        for bench in ("DcServo", "ScrewEma", "BldcDrive", "Joint", "FrictionDevice")
        for effect in catalogue(bench)
    ]


def _nulls() -> list[Plan]:
    consistent = [Plan("consistent", bench) for bench, count in NULLS.items() for _ in range(count)]
    off = [
        Plan("parameters", bench, off=(names[k % len(names)],))
        for bench, names in OFF.items()
        for k in range(2 * len(names) if bench != "BldcDrive" else len(names))
    ]
    return consistent + off


def plan(seed: int) -> list[tuple[str, Plan, int]]:
    """Every case of the proof as (name, plan, seed of its own)."""
    cases = _effects() + _nulls()
    cases += [Plan("two", bench, effects, gain=(2.5, 7.0)) for bench, effects in PAIRS]
    cases += [Plan("law", bench, (law,), gain=(2.5, 6.0)) for bench, law in LAWS if law in outside(bench)]
    cases += [
        Plan("weak", bench, ("friction.coulomb",), gain=(1.02, 1.06)) for bench in ("DcServo", "ScrewEma", "Joint")
    ]
    cases += [Plan("one_way", bench, ("friction.coulomb",)) for bench in ("DcServo", "Joint")]
    order = np.random.default_rng([seed, 0]).permutation(len(cases))
    return [(f"c{k + 1:03d}", cases[j], 1000 * seed + int(j)) for k, j in enumerate(order)]


def quick(cases: list[tuple[str, Plan, int]]) -> list[tuple[str, Plan, int]]:
    """One case of each kind, on the bench that is quickest to simulate."""
    chosen: dict[str, tuple[str, Plan, int]] = {}
    for case in cases:
        if case[1].bench in ("DcServo", "Joint"):
            chosen.setdefault(case[1].kind, case)
    return list(chosen.values())
