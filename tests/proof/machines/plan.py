"""Which cases there are: every concealed effect of every machine once, nulls, pairs, weak and half-recorded ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.proof.machines import electrical, hydraulic, mechanical, rotating, strangers, thermal
from tests.proof.machines.machine import Machine

MACHINES: tuple[Machine, ...] = (
    *thermal.MACHINES,
    *hydraulic.MACHINES,
    mechanical.SLIDE,
    rotating.GEARED,
    mechanical.PENDULUM,
    rotating.TWO_MASS,
    *electrical.MACHINES,
)
STRANGERS_FROM = 201  # seeds
STRANGE_PAIRS = (
    ("Radiator", (0, 1)),
    ("OrificeTanks", (0, 1)),
    ("Solenoid", (0, 2)),
    ("Boost", (0, 1)),
    ("SurgeLine", (0, 1)),
)
PAIRS = (("House", (0, 2)), ("Cylinder", (0, 2)), ("GearedMotor", (0, 2)), ("TwoMass", (0, 3)), ("Filter", (0, 3)))
WEAK = (("Pendulum", 0), ("ThreeTanks", 0), ("Loudspeaker", 0))
HALF = (
    ("TwoMass", 0, "w1"),
    ("TwoMass", 3, "w1"),
    ("Furnace", 0, "Tm"),
    ("AirVessels", 0, "p1"),
    ("ThreeTanks", 0, "h3"),
)


@dataclass(frozen=True)
class Plan:
    """One case to be: the machine, what is concealed, and how large the refitted believed model's error is to be."""

    kind: str  # effect | two | weak | half | consistent | parameters
    machine: Machine
    hidden: tuple[int, ...] = ()
    outputs: tuple[str, ...] = ()  # those recorded; all where empty
    misfit: tuple[float, float] = (1.2, 6.0)  # over the floor


def plan(seed: int) -> list[tuple[str, Plan, int]]:
    """Every case as (name, plan, seed of its own), in an order that tells nothing."""
    strange = seed >= STRANGERS_FROM
    machines = strangers.MACHINES if strange else MACHINES
    named = {m.name: m for m in machines}
    cases = [Plan("effect", m, (k,)) for m in machines for k in range(len(m.hidden))]
    cases += [Plan(kind, m) for m in machines for kind in ("consistent", "parameters")]
    cases += [Plan("two", named[m], pair, misfit=(2.0, 7.0)) for m, pair in (STRANGE_PAIRS if strange else PAIRS)]
    if not strange:
        cases += [Plan("weak", named[m], (k,), misfit=(1.02, 1.06)) for m, k in WEAK]
        cases += [Plan("half", named[m], (k,), (output,)) for m, k, output in HALF]
    order = np.random.default_rng([seed, 2]).permutation(len(cases))
    return [(f"m{n + 1:03d}", cases[j], 1000 * seed + int(j)) for n, j in enumerate(order)]


def small(cases: list[tuple[str, Plan, int]]) -> list[tuple[str, Plan, int]]:
    """Two cases of every machine, one with something missing and one null, drawn by the order of the plan; and, of
    strangers, every pair."""
    chosen: dict[tuple[str, bool], tuple[str, Plan, int]] = {}
    for case in cases:
        wanted = case[1]
        if wanted.kind in ("effect", "consistent", "parameters"):
            chosen.setdefault((wanted.machine.name, wanted.kind == "effect"), case)
    pairs = [c for c in cases if c[1].kind == "two" and c[1].machine in strangers.MACHINES]
    return [*chosen.values(), *pairs]
