"""Which cases the proof consists of: kinds, benches and effects, in an order that tells nothing."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tests.proof.effects import catalogue


@dataclass(frozen=True)
class Plan:
    """One case to be: its kind, the bench, what is concealed, which parameters are off, and the wanted misfit."""

    kind: str  # effect | consistent | parameters | two | law | weak | one_way | rivals
    bench: str
    effects: tuple[str, ...] = ()
    off: tuple[str, ...] = ()
    gain: tuple[float, float] = (1.7, 6.0)  # range of the refitted believed model's NRMSE over the floor
    outputs: tuple[str, ...] = ()  # the recorded ones, where it matters
    rival: Mapping[str, float] = field(default_factory=dict)  # simulator parameters that must explain the data as well


PAIRS = (
    ("DcServo", ("friction.coulomb", "torque.cogging")),
    ("DcServo", ("drive.dead_time", "load.gravity")),
    ("DcServo", ("friction.stribeck", "sensor.lag")),
    ("ScrewEma", ("friction.coulomb", "backlash")),
    ("ScrewEma", ("torque.cogging", "stiffness")),
    ("BldcDrive", ("motor.short_circuit", "drive.dead_time")),
    ("Joint", ("friction.coulomb", "load.gravity")),
    ("FlightControl", ("backlash", "stiffness")),
    ("FrictionDevice", ("friction.coulomb", "stiffness")),
    ("DcServo", ("drive.supply_sag", "friction.coulomb")),
)
LAWS = (
    ("DcServo", "cubic_drag"),
    ("DcServo", "vibration"),
    ("Joint", "position_drag"),
    ("FrictionDevice", "root_drag"),
    ("DcServo", "cold_grease"),
    ("DcServo", "hardening_spring"),
)
OF_EACH_LAW = 2  # cases of every law
OF_EACH_RIVAL = 5  # cases in which each of the two is what is missing
OFF = {
    "DcServo": ("R", "Ke", "J", "b", "R", "Ke", "J", "b"),
    "ScrewEma": ("R", "Ke", "Jm", "Js", "Ke"),
    "BldcDrive": ("R", "Ke", "J", "tau_c"),
    "Joint": ("J", "b"),
    "FrictionDevice": ("c",),
    "FlightControl": ("Ke", "tau_m"),
}
CONSISTENT = {"DcServo": 14, "ScrewEma": 10, "BldcDrive": 6, "Joint": 4, "FrictionDevice": 2, "FlightControl": 2}
EFFECTS = 64  # cases with one effect
MOST = {"FlightControl": 6}  # of them on a bench that takes long
# What a three-phase drive is known to suffer from is tried on the three-phase drive, wherever else it could be.
ALWAYS = tuple(
    (effect, "BldcDrive")
    for effect in ("motor.short_circuit", "motor.imbalance", "motor.eccentricity", "drive.dead_time", "torque.cogging")
)


def _effects(rng: np.random.Generator) -> list[Plan]:
    """Every effect once, on a bench drawn from those that have it or on that where it must be; then others, until
    there are enough."""
    pairs = [(effect, bench) for bench in CONSISTENT for effect in catalogue(bench)]
    shuffled = [pairs[k] for k in rng.permutation(len(pairs))]
    first = {effect: (effect, bench) for effect, bench in (*shuffled, *ALWAYS)}
    ordered = list(first.values()) + [p for p in shuffled if p not in first.values()]
    chosen: list[Plan] = []
    for effect, bench in ordered:
        there = sum(c.bench == bench for c in chosen)
        if len(chosen) < EFFECTS and there < MOST.get(bench, EFFECTS):
            chosen.append(Plan("effect", bench, (effect,)))
    return chosen


def _nulls() -> list[Plan]:
    consistent = [Plan("consistent", bench) for bench, count in CONSISTENT.items() for _ in range(count)]
    return consistent + [Plan("parameters", bench, off=(name,)) for bench, names in OFF.items() for name in names]


def _rivals() -> list[Plan]:
    """Something is missing, and nothing in the data tells a voltage drop from a friction: no current, no reversal."""
    drop, friction = ("drive.dead_time", {"shaft_tau_c": 0.002}), ("friction.coulomb", {"V_d": 0.2})
    return [
        Plan("rivals", "DcServo", (effect,), gain=(2.0, 4.0), outputs=("w",), rival=rival)
        for effect, rival in (drop, friction) * OF_EACH_RIVAL
    ]


def plan(seed: int) -> list[tuple[str, Plan, int]]:
    """Every case of the proof as (name, plan, seed of its own)."""
    rng = np.random.default_rng([seed, 0])
    cases = _effects(rng) + _nulls()
    cases += [Plan("two", bench, effects, gain=(2.5, 7.0)) for bench, effects in PAIRS]
    cases += [Plan("law", bench, (law,), gain=(2.5, 6.0)) for bench, law in LAWS * OF_EACH_LAW]
    cases += [Plan("weak", b, ("friction.coulomb",), gain=(1.02, 1.06)) for b in ("DcServo", "ScrewEma", "Joint")]
    cases += [Plan("one_way", bench, ("friction.coulomb",)) for bench in ("DcServo", "Joint")]
    cases += _rivals()
    return [(f"c{k + 1:03d}", cases[j], 1000 * seed + int(j)) for k, j in enumerate(rng.permutation(len(cases)))]


def spread(cases: list[tuple[str, Plan, int]]) -> list[tuple[str, Plan, int]]:
    """The cases in an order in which every beginning has of each kind and bench its share."""
    groups: dict[tuple[str, str], list] = {}
    for case in cases:
        groups.setdefault((case[1].kind, case[1].bench), []).append(case)
    places = [((k + 0.5) / len(group), case[0], case) for group in groups.values() for k, case in enumerate(group)]
    return [case for _, _, case in sorted(places)]


def quick(cases: list[tuple[str, Plan, int]]) -> list[tuple[str, Plan, int]]:
    """One case of each kind, on the bench that is quickest to simulate."""
    chosen: dict[str, tuple[str, Plan, int]] = {}
    for case in cases:
        if case[1].bench in ("DcServo", "Joint"):
            chosen.setdefault(case[1].kind, case)
    return list(chosen.values())
