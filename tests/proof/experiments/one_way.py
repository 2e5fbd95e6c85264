"""Cases that cannot tell a voltage drop from dry friction: a motor that never reverses, its speed alone recorded."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.proof.case import measure, noise_std, simulate
from tests.proof.generate import build
from tests.proof.plan import Plan, _rivals
from tests.proof.write import _table, write_case, write_truth

REACH = 0.6  # of the amplitude that the machine may be driven with, which the recordings use


def plan(seed: int) -> list[tuple[str, Plan, int]]:
    """What the proof calls rivals, as often as there."""
    return [(f"w{k + 1:03d}", item, 1000 * seed + 500 + k) for k, item in enumerate(_rivals())]


def generate(item: tuple[str, Plan, int], out: Path) -> None:
    """One case into OUT/cases/NAME with all of its voltage as limits, its truth into OUT/truth/NAME.toml."""
    name, wanted, seed = item
    case = build(name, wanted, seed)
    folder = out / "cases" / name
    write_case(case, folder, {n: noise_std(case, n) for n in case.outputs})
    reach = float(f"{max(np.abs(u).max() for u in case.inputs) / REACH:.3g}")
    with (folder / "case.toml").open("a") as file:
        for column in case.bench.machine.inputs:
            limits = {"min": -reach, "max": reach, "rate": 2 * reach / case.bench.period}
            file.write(_table(f"limits.{column}", limits))
    write_truth(case, out / "truth" / f"{name}.toml", seed)


def answers(item: tuple[str, Plan, int], played: list[np.ndarray]) -> tuple[float, list[np.ndarray], list[str]]:
    """(period, what the truth answers to each waveform (samples, inputs and outputs) with noise, columns).

    A waveform has `time` and a column for each input.
    """
    case = build(*item)
    machine, period = case.bench.machine, case.bench.period
    case.inputs = []
    for one in played:
        time = np.arange(0.0, one["time"][-1] + period / 2, period)
        case.inputs.append(np.column_stack([np.interp(time, one["time"], one[n]) for n in machine.inputs]))
    case.clean = simulate(case)
    measured = measure(case, np.random.default_rng([item[2], 9]))
    both = [np.hstack([u, y]) for u, y in zip(case.inputs, measured, strict=True)]
    return period, both, [*machine.inputs, *case.outputs]
