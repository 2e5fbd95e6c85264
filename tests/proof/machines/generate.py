"""Cases from plans: the machine drawn within belief, its inputs, what is concealed sized by the believed model's refit.

python -m tests.proof.machines.generate --seed 101 --out DIR [--only m003]
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tests.proof.machines.machine import Hidden, Machine, simulate
from tests.proof.machines.plan import Plan, plan
from tests.proof.machines.truth import columns, each_shows, truth
from tests.proof.machines.write import write_case, write_truth

NUISANCE = (0.3, 0.8)  # of the noise, the RMS of what is wrong with the instruments beside it
SIZINGS = 6  # refits at most to bring what is concealed to its size
REACHED = 1.5  # times the misfit that is wanted, or its inverse, within which a case counts as sized
DRAWS = 6  # of one case, until what is concealed shows at all in its fit recordings


@dataclass
class Drawn:
    """A case in memory. Outputs and inputs are (samples, recordings)."""

    plan: Plan
    believed: dict[str, float]
    true: dict[str, float]
    drive: dict[str, np.ndarray]
    noise: dict[str, float]
    given: bool  # whether case.toml says how much noise there is
    error: dict[str, np.ndarray] = field(default_factory=dict)  # noise and nuisances
    hidden: tuple[tuple[Hidden, float], ...] = ()
    substeps: int = 0  # of the truth's integration; the machine's own until it is known what they are to be
    off: str = ""
    nuisances: list[str] = field(default_factory=list)

    @property
    def machine(self) -> Machine:
        return self.plan.machine

    @property
    def recordings(self) -> int:
        return next(iter(self.drive.values())).shape[1]

    @property
    def outputs(self) -> tuple[str, ...]:
        return self.plan.outputs or tuple(self.machine.outputs)


def draw(wanted: Plan, seed: int) -> tuple[Drawn, dict[str, np.ndarray], dict]:
    """(the case, what was measured (samples, recordings), the errors of both ends).

    Where what is concealed cannot be brought to its size, or one of two does not show at all (a threshold that no input
    comes near), the case is drawn anew.
    """
    for attempt in range(DRAWS):
        rng = np.random.default_rng([seed, attempt] if attempt else seed)
        case = _drawn(wanted, rng)
        target = float(np.exp(rng.uniform(*np.log(wanted.misfit))))
        measured, ends = _sized(case, target)
        sized = not case.hidden or abs(np.log(_misfit(ends) / target)) < np.log(REACHED)
        if sized and each_shows(case, slice(0, _fitted(case.recordings))):
            return case, measured, ends
    raise ValueError(f"{wanted.machine.name}: {[h.name for h, _ in case.hidden]} cannot be brought to a size")


def _drawn(wanted: Plan, rng: np.random.Generator) -> Drawn:
    machine = wanted.machine
    believed = {
        n: p.value * (np.exp(0.25 * rng.standard_normal()) if p.sigma else 1.0) for n, p in machine.parameters.items()
    }
    true = {
        n: v * (1 + machine.parameters[n].sigma * np.clip(rng.standard_normal(), -2, 2)) for n, v in believed.items()
    }
    believed = {n: float(f"{v:.4g}") for n, v in believed.items()}
    recordings = int(rng.integers(3, 5))
    drive = {n: np.column_stack([_input(rng, machine.samples, i.low, i.high) for _ in range(recordings)])
             for n, i in machine.inputs.items()}  # fmt: skip
    case = Drawn(wanted, believed, true, drive, {}, bool(rng.random() < 0.6))
    if wanted.kind == "parameters":
        _put_off(case, rng)
    clean = simulate(machine, columns(case.true, recordings), drive)
    case.noise = {n: float(np.std(clean[n]) * rng.uniform(0.004, 0.012)) for n in machine.outputs}
    _instruments(case, rng, recordings)
    case.hidden = tuple((machine.hidden[k], machine.hidden[k].size) for k in wanted.hidden)
    return case


def _input(rng: np.random.Generator, samples: int, low: float, high: float) -> np.ndarray:
    """Steps of random levels, or a sum of sines, over the whole range or a part of it."""
    middle, reach = (low + high) / 2, (high - low) / 2 * rng.uniform(0.6, 1.0)
    if rng.random() < 0.5:
        edges = np.cumsum(rng.integers(samples // 16, samples // 5, 20))
        course = rng.uniform(-1, 1, 21)[np.searchsorted(edges, np.arange(samples))]
    else:
        turns = rng.uniform(1, 14, 5) * 2 * np.pi * np.arange(samples)[:, None] / samples
        course = np.sin(turns + rng.uniform(0, 2 * np.pi, 5)) @ rng.uniform(0.3, 1.0, 5)
        course /= np.abs(course).max()
    return middle + reach * course


def _put_off(case: Drawn, rng: np.random.Generator) -> None:
    """One parameter that the recordings determine well, four to seven believed sigmas from its belief."""
    machine = case.machine
    names = [n for n, p in machine.parameters.items() if p.sigma]
    recordings = case.recordings
    clean = simulate(machine, columns(case.true, recordings), case.drive)
    level = {n: 0.01 * float(np.std(clean[n])) for n in case.outputs}
    jacobian = _jacobian(case, case.true, clean, level, names)
    error = np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian)))
    case.off = str(
        rng.choice([n for n, e in zip(names, error, strict=True) if e < 0.3] or [names[int(np.argmin(error))]])
    )
    sigma = machine.parameters[case.off].sigma
    move = rng.uniform(4, 7) * sigma * rng.choice([-1, 1])
    case.true[case.off] = case.believed[case.off] * (1 + (move if move > -0.75 else abs(move)))


def _instruments(case: Drawn, rng: np.random.Generator, recordings: int) -> None:
    """White noise and two small nuisances: a drift, colour, an error that follows the signal's own past."""
    samples = case.machine.samples
    for name in case.outputs:
        case.error[name] = case.noise[name] * rng.standard_normal((samples, recordings))
    for kind in rng.choice(["drift", "colour", "offset"], 2, replace=False):
        name = str(rng.choice(case.outputs))
        size = case.noise[name] * rng.uniform(*NUISANCE) / np.sqrt(2)
        if kind == "drift":
            turns = rng.uniform(0.5, 2.5, recordings) * 2 * np.pi * np.arange(samples)[:, None] / samples
            added = np.sqrt(2) * np.sin(turns + rng.uniform(0, 2 * np.pi, recordings))
        elif kind == "colour":
            added = np.zeros((samples, recordings))
            for k in range(1, samples):
                added[k] = 0.9 * added[k - 1] + np.sqrt(1 - 0.81) * rng.standard_normal(recordings)
        else:
            added = np.full((samples, recordings), rng.choice([-1.0, 1.0]))
        case.error[name] = case.error[name] + size * added
        case.nuisances.append(f"{kind} of {name}, {size / case.noise[name]:.2f} of the noise")


def _sized(case: Drawn, target: float) -> tuple[dict[str, np.ndarray], dict]:
    """What is concealed scaled until the refit of the believed model errs `target` times the floor."""
    measured: dict[str, np.ndarray] = {}
    refitted = dict(case.believed)
    for _ in range(SIZINGS if case.hidden else 1):
        clean = truth(case)
        if clean is None:
            case.hidden = tuple((h, q / 4) for h, q in case.hidden)
            continue
        measured = {n: clean[n] + case.error[n] for n in case.outputs}
        refitted = _refit(case, measured, refitted)
        ends = _ends(case, measured, clean, refitted)
        ratio = _misfit(ends)
        if not case.hidden or abs(np.log(ratio / target)) < 0.1:
            break
        scale = np.sqrt((target**2 - 1) / max(ratio**2 - 1, 0.01))
        case.hidden = tuple((h, q * float(np.clip(scale, 0.1, 10.0))) for h, q in case.hidden)
    if not measured:
        raise ValueError(f"{case.machine.name} cannot be simulated with {[h.name for h, _ in case.hidden]}")
    return measured, ends


def _misfit(ends: dict) -> float:
    """Error of the refitted believed model over the floor, on the fit recordings."""
    return ends["fit"]["refit_believed"] / ends["fit"]["floor"]


def _fitted(recordings: int) -> int:
    return recordings - 1


def _jacobian(case: Drawn, at: dict, base: dict, level: dict, names: list[str]) -> np.ndarray:
    """(samples, names): change of the outputs on the fit recordings, in `level`s, for a relative change of each."""
    recordings = case.recordings
    batch = {n: np.repeat(np.full(len(names), v), recordings) for n, v in at.items()}
    for k, n in enumerate(names):
        batch[n][k * recordings : (k + 1) * recordings] *= 1.001
    drive = {n: np.tile(v, (1, len(names))) for n, v in case.drive.items()}
    moved = simulate(case.machine, batch, drive)
    fit = _fitted(recordings)
    columns = []
    for k in range(len(names)):
        part = slice(k * recordings, k * recordings + fit)
        columns.append(
            np.concatenate([((moved[o][:, part] - base[o][:, :fit]) / 0.001 / level[o]).ravel() for o in case.outputs])
        )
    return np.column_stack(columns)


def _refit(case: Drawn, measured: dict[str, np.ndarray], start: dict[str, float]) -> dict[str, float]:
    """The believed model's parameters fitted to the fit recordings from `start` on, beliefs as priors (Gauss-Newton,
    halved steps)."""
    machine = case.machine
    names = [n for n, p in machine.parameters.items() if p.sigma]
    sigma = np.array([machine.parameters[n].sigma for n in names])
    recordings = case.recordings
    fit = _fitted(recordings)
    factor = np.array([start[n] / case.believed[n] for n in names])

    def residual(factor: np.ndarray) -> tuple[np.ndarray, dict, dict]:
        at = case.believed | {n: case.believed[n] * f for n, f in zip(names, factor, strict=True)}
        base = simulate(machine, columns(at, recordings), case.drive)
        rows = [((measured[o] - base[o])[:, :fit] / case.noise[o]).ravel() for o in case.outputs]
        return np.concatenate([*rows, (1 - factor) / sigma]), base, at

    left, base, at = residual(factor)
    for _ in range(7):
        jacobian = np.vstack([_jacobian(case, at, base, case.noise, names) / factor, np.diag(1 / sigma)])
        step = np.linalg.lstsq(jacobian, left, rcond=1e-9)[0]
        for halving in 1.0, 0.5, 0.25, 0.06:
            trial = np.maximum(factor + halving * step, 0.05)
            found = residual(trial)
            if np.isfinite(found[0]).all() and found[0] @ found[0] < left @ left:
                break
        else:
            break
        done = left @ left - found[0] @ found[0] < 1e-4 * (left @ left)
        factor, (left, base, at) = trial, found
        if done:
            break
    return at


def _ends(case: Drawn, measured: dict, clean: dict, refitted: dict[str, float]) -> dict:
    """NRMSE of the refitted believed model and of the truth, on the fit and the validation recordings."""
    recordings = case.recordings
    base = simulate(case.machine, columns(refitted, recordings), case.drive)
    ends: dict = {"refitted": refitted}
    for part, of in (("fit", slice(0, _fitted(recordings))), ("validate", slice(_fitted(recordings), recordings))):

        def error(of_model: dict, of: slice = of) -> float:
            shares = [
                np.mean((measured[o] - of_model[o])[:, of] ** 2) / np.var(measured[o][:, of]) for o in case.outputs
            ]
            return float(np.sqrt(np.mean(shares)))

        ends[part] = {"refit_believed": error(base), "floor": error(clean)}
    return ends


def generate(item: tuple[str, Plan, int], out: Path) -> None:
    """One case into OUT/cases/NAME, its truth into OUT/truth/NAME.toml."""
    name, wanted, seed = item
    case, measured, ends = draw(wanted, seed)
    write_case(case, measured, name, out / "cases" / name)
    write_truth(case, ends, out / "truth" / f"{name}.toml", seed)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--only", nargs="*", default=())
    arguments = parser.parse_args()
    for item in plan(arguments.seed):
        if not arguments.only or item[0] in arguments.only:
            generate(item, arguments.out)


if __name__ == "__main__":
    main()
