"""Cases that say too little: machines of the second edition, driven over a small part of their range.

What is concealed is sized over the whole range as there; then the inputs move in a small part of it only, with the
same instruments, and some outputs are not recorded. Most such cases are consistent or decided.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from tests.proof.machines.generate import Drawn, _ends, _refit, draw
from tests.proof.machines.machine import simulate
from tests.proof.machines.plan import MACHINES, Plan
from tests.proof.machines.truth import columns
from tests.proof.machines.write import write_case, write_truth
from tests.proof.write import _table

PART = (0.1, 0.45)  # of the range, that the inputs move in
ONE_OUTPUT = 0.4  # share of the cases in which one output of several is recorded


@dataclass(frozen=True)
class Quiet:
    """A drawn case and the clean outputs of its quiet recordings (samples, recordings)."""

    drawn: Drawn
    measured: dict[str, np.ndarray]
    ends: dict


def plan(seed: int) -> list[tuple[str, Plan, int]]:
    """Every concealed effect of every machine once, in an order that tells nothing."""
    cases = [Plan("effect", m, (k,)) for m in MACHINES for k in range(len(m.hidden))]
    order = np.random.default_rng([seed, 3]).permutation(len(cases))
    return [(f"q{n + 1:03d}", cases[j], 1000 * seed + int(j)) for n, j in enumerate(order)]


def quiet(wanted: Plan, seed: int) -> Quiet:
    """The case with its inputs in a part of their range, and what its instruments then say."""
    rng = np.random.default_rng([seed, 1])
    names = list(wanted.machine.outputs)
    if len(names) > 1 and rng.random() < ONE_OUTPUT:
        wanted = replace(wanted, outputs=(str(rng.choice(names)),))
    drawn, _, _ = draw(wanted, seed)
    for name, of in drawn.machine.inputs.items():
        part, reach = rng.uniform(*PART), of.high - of.low
        middle = rng.uniform(of.low + part / 2 * reach, of.high - part / 2 * reach)
        drawn.drive[name] = middle + part * (drawn.drive[name] - (of.low + of.high) / 2)
    machine = replace(drawn.machine, substeps=drawn.substeps)  # as fine as the truth needs over the whole range
    clean = simulate(machine, columns(drawn.true, drawn.recordings), drawn.drive, drawn.hidden)
    measured = {n: clean[n] + drawn.error[n] for n in drawn.outputs}
    return Quiet(drawn, measured, _ends(drawn, measured, clean, _refit(drawn, measured, drawn.believed)))


def generate(item: tuple[str, Plan, int], out: Path) -> None:
    """One case into OUT/cases/NAME with the whole range as its limits, its truth into OUT/truth/NAME.toml."""
    name, wanted, seed = item
    case = quiet(wanted, seed)
    folder = out / "cases" / name
    write_case(case.drawn, case.measured, name, folder)
    with (folder / "case.toml").open("a") as file:
        for column, of in case.drawn.machine.inputs.items():
            file.write(_table(f"limits.{column}", {"min": of.low, "max": of.high, "rate": _rate(case.drawn, of)}))
    write_truth(case.drawn, case.ends, out / "truth" / f"{name}.toml", seed)


def _rate(drawn: Drawn, of: object) -> float:
    """From end to end within a sample."""
    return (of.high - of.low) / drawn.machine.period


def answers(item: tuple[str, Plan, int], played: list[np.ndarray]) -> tuple[float, list[np.ndarray], list[str]]:
    """(period, what the truth answers to each waveform (samples, inputs and outputs) with noise, columns).

    A waveform has `time` and a column for each input.
    """
    _, wanted, seed = item
    drawn = quiet(wanted, seed).drawn
    rng = np.random.default_rng([seed, 2])
    inputs, outputs = list(drawn.machine.inputs), drawn.outputs
    period = float(played[0]["time"][1] - played[0]["time"][0])
    both = []
    for one in played:
        machine = replace(drawn.machine, samples=len(one), period=period, substeps=drawn.substeps)
        clean = simulate(machine, columns(drawn.true, 1), {n: one[n][:, None] for n in inputs}, drawn.hidden)
        seen = [clean[n][:, 0] + drawn.noise[n] * rng.standard_normal(len(one)) for n in outputs]
        both.append(np.column_stack([*(one[n] for n in inputs), *seen]))
    return period, both, [*inputs, *outputs]
