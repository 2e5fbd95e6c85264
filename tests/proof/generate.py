"""Writes the proof's cases: `python -m tests.proof.generate --seed 1 --out DIR [--only NAME ...]`.

DIR/cases/NAME is a recording case as the tool reads it; DIR/truth/NAME.toml is what really is in it.
"""

import argparse
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
import os
from pathlib import Path

import numpy as np

from tests.proof.benches import BENCHES, Bench
from tests.proof.case import Case, measure, noise_std, place_stops, simulate
from tests.proof.effects import Concealed, catalogue, outside
from tests.proof.plan import Plan, plan
from tests.proof.refit import Refit, case_nrmse
from tests.proof.write import write_case, write_truth


def _outputs(bench: Bench, rng: np.random.Generator, drawn: Sequence[Concealed], fewest: int) -> tuple[str, ...]:
    needs = {n for c in drawn for n in c.needs}
    lacks = {n for c in drawn for n in c.lacks}
    sets = [s for s in bench.sets_of_outputs if needs <= set(s) and not lacks & set(s) and len(s) >= fewest]
    if not sets:
        return tuple(n for n in bench.instruments if n not in lacks)
    return sets[rng.integers(len(sets))]


def _conceal(bench_name: str, item: Plan, seed: int, size: float) -> list[Concealed]:
    known, unknown = catalogue(bench_name), outside(bench_name)
    made = []
    for k, effect in enumerate(item.effects):
        maker = known.get(effect) or unknown[effect]
        made.append(maker(np.random.default_rng([seed, 7, k]), size * (0.8 if k else 1.0)))
    return made


def _scaled_defaults(bench: Bench, rng: np.random.Generator) -> dict[str, float]:
    return {
        n: float(f"{v * (1 + 2 * bench.uncertainty.get(n, 0.05) * np.clip(rng.standard_normal(), -1.4, 1.4)):.4g}")
        for n, v in bench.believed.items()
    }


def _prepare(name: str, item: Plan, seed: int, variant: int) -> Case:
    rng = np.random.default_rng([seed, 1])
    bench = BENCHES[item.bench]
    believed = _scaled_defaults(bench, rng)
    true = {
        n: v * float(1 + bench.uncertainty.get(n, 0.05) * np.clip(rng.standard_normal(), -2, 2))
        for n, v in believed.items()
    }
    for parameter in item.off:
        sigma = bench.uncertainty[parameter]
        sign = 1 if sigma > 0.12 or rng.random() < 0.5 else -1
        true[parameter] = believed[parameter] * (1 + sign * sigma * rng.uniform(4.5, 7.0))
    concealed = _conceal(item.bench, item, seed, 1.0)
    rng = np.random.default_rng([seed, 4, variant])
    fits = int(rng.integers(2, 4)) if item.bench not in ("BldcDrive",) else 3
    first = int(rng.integers(0, 4)) if item.bench != "BldcDrive" else 0
    one_way = item.kind in ("one_way", "rivals")
    kinds = [("one_way" if one_way else "fit", first + k) for k in range(fits)]
    kinds.append(("one_way" if one_way else "validate", int(rng.integers(0, 3))))
    inputs = [bench.experiment(rng, kind, index) for kind, index in kinds]
    return Case(
        name,
        item,
        bench,
        item.outputs or _outputs(bench, rng, concealed, 2 if item.off else 1),
        believed,
        true,
        concealed,
        inputs,
        fits,
        noise_scale=float(rng.choice([0.6, 1.0, 1.0, 1.5])),
        colour=float(rng.choice([0.0, 0.0, 0.0, 0.5, 0.8])),
        unknown_noise=bool(rng.random() < 0.2),
    )


def _aligned(case: Case, start: dict[str, float], iterations: int) -> dict[str, float]:
    """A start from which a fit does not stick: with the angle right that the edges of the currents follow."""
    lead = case.bench.leads
    others = [n for n in case.outputs if n != lead]
    keep = [case.outputs.index(n) for n in others]
    angles = simulate(replace(case, outputs=(lead,)))
    pairs = [(u, np.hstack([y[:, keep], a])) for u, y, a in zip(case.inputs, case.measured, angles, strict=True)]
    return Refit(case.bench, (*others, lead), pairs[: case.fit], spread={lead: 0.005}).fit(start, iterations)[0]


def judge(case: Case, seed: int, start: dict[str, float], iterations: int = 10) -> float:
    """Simulates, measures and refits; returns the believed model's misfit over the floor on the fit recordings."""
    case.clean = simulate(case)
    case.measured = measure(case, np.random.default_rng([seed, 3]))
    pairs = list(zip(case.inputs, case.measured, strict=True))
    refit = Refit(case.bench, case.outputs, pairs[: case.fit])
    if case.bench.leads:
        start = _aligned(case, start, 2 * iterations)
    fitted, _ = refit.fit(start, iterations)
    every = Refit(case.bench, case.outputs, pairs)
    case.refit = {"parameters": fitted}
    simulated = {
        "believed": every.simulate(case.believed),
        "refit_believed": every.simulate(fitted),
        "floor": case.clean,
    }
    for part, of in (("fit", slice(0, case.fit)), ("validate", slice(case.fit, None))):
        case.refit[part] = {k: case_nrmse(case.measured[of], s[of]) for k, s in simulated.items()}
    if case.plan.rival:
        _, error = refit.fit(case.true | case.plan.rival)
        case.refit["rival"] = {"fit": error / case.refit["fit"]["floor"]}
    return case.refit["fit"]["refit_believed"] / case.refit["fit"]["floor"]


def _next_size(tried: list[tuple[float, float]], target: float) -> float:
    """A size from the (size, gain) pairs so far: between two that enclose the target, else along a parabola."""
    below = max((s for s, g in tried if g <= target), default=None)
    above = min((s for s, g in tried if g > target), default=None)
    if below is not None and above is not None:
        return float(np.sqrt(below * above))
    size, gain = tried[-1]
    return size * float(np.clip(np.sqrt(max(target**2 - 1, 0.02) / max(gain**2 - 1, 0.005)), 0.3, 3.0))


def _tune(case: Case, seed: int, target: float) -> float:
    """Sizes the concealed effects until the misfit is near the target; returns the distance from it, as a logarithm."""
    size, tried, gain = 1.0, [], np.inf
    for _ in range(6):
        case.concealed = _conceal(case.plan.bench, case.plan, seed, size)
        try:
            place_stops(case)
            gain = judge(case, seed, case.true, iterations=3)
        except ArithmeticError:
            gain = np.inf
        if abs(np.log(gain / target)) < 0.25:
            break
        tried.append((size, gain))
        size = _next_size(tried, target) if np.isfinite(gain) else size * 0.5
    return abs(float(np.log(gain / target)))


def build(name: str, item: Plan, seed: int) -> Case:
    """One case. A concealed effect is sized so that the believed model's misfit is of the planned order, and the
    experiments are drawn again when they do not show it, in the fit or in the validation recordings."""
    if not item.effects:
        case = _prepare(name, item, seed, 0)
        judge(case, seed, case.true)
        return case
    target = float(np.exp(np.random.default_rng([seed, 2]).uniform(*np.log(item.gain))))
    best, least = None, np.inf
    for variant in range(3):
        case = _prepare(name, item, seed, variant)
        distance = _tune(case, seed, target)
        if not np.isfinite(distance):
            continue
        validate = case.refit["validate"]["refit_believed"] / case.refit["validate"]["floor"]
        unseen = item.gain[0] > 1.3 and validate < 1.3
        told_apart = bool(item.rival) and case.refit["rival"]["fit"] > 1.01
        distance += unseen + told_apart
        if distance < least and _judged(case, seed):
            best, least = case, distance
        if least < 0.4:
            break
    if best is None:
        raise RuntimeError(f"{name}: no size of {item.effects} on {item.bench} can be simulated")
    return best


def _judged(case: Case, seed: int) -> bool:
    """Judges to the end; False where a step of the refit diverges, as it may near the edge of a loop's stability."""
    try:
        judge(case, seed, case.true)
    except ArithmeticError:
        return False
    return True


def generate(item: tuple[str, Plan, int, Path]) -> str:
    """Builds and writes one case; returns a line about it."""
    name, planned, seed, out = item
    case = build(name, planned, seed)
    write_case(case, out / "cases" / name, {n: noise_std(case, n) for n in case.outputs})
    write_truth(case, out / "truth" / f"{name}.toml", seed)
    fit, validate = case.refit["fit"], case.refit["validate"]
    return (
        f"{name} {planned.kind:12s} {planned.bench:14s} {'+'.join(planned.effects or planned.off) or '-':34s} "
        f"{','.join(case.outputs):18s} fit {fit['refit_believed']:.4f}/{fit['floor']:.4f} = "
        f"{fit['refit_believed'] / fit['floor']:.2f}  validate {validate['refit_believed'] / validate['floor']:.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--only", nargs="*", help="names of cases; all when absent")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    planned = plan(arguments.seed)
    chosen = [(n, p, s, arguments.out) for n, p, s in planned if not arguments.only or n in arguments.only]
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for line in pool.map(generate, chosen):
            print(line, flush=True)


if __name__ == "__main__":
    main()
