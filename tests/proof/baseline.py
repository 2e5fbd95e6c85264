"""The usual alternative: equation-error regression with sparse selection (PySINDy's STLSQ), then a polish.

    python -m tests.proof.baseline CASE --out DIR

It answers in the contract of a diagnosis, so that the same scoring judges it.
"""

import argparse
from collections.abc import Mapping, Sequence
import json
from pathlib import Path
import tomllib
import warnings

import numpy as np
from pysindy.optimizers import STLSQ
from scipy.ndimage import uniform_filter1d

from tests.proof.benches import BENCHES, Bench
from tests.proof.equations import EQUATIONS, Equation
from tests.proof.naming import named
from tests.proof.refit import Refit, case_nrmse

THRESHOLDS = np.geomspace(0.05, 1.0, 10)  # of a term's share in what the known terms leave of the target
SLACK = 1.25  # the sparsest solution is taken that leaves at most this many times what the best leaves

Columns = Mapping[str, np.ndarray]
Solution = tuple[dict[str, float], list[str]]  # every coefficient, and the groups of terms, the largest first


def _solve(columns: Columns, target: np.ndarray) -> tuple[dict[str, float], float]:
    """Least squares: coefficients, and the RMS of what they leave."""
    A = np.column_stack(list(columns.values()))
    scale = np.linalg.norm(A, axis=0) + 1e-30
    solution, *_ = np.linalg.lstsq(A / scale, target, rcond=1e-8)
    left = float(np.sqrt(np.mean((target - A / scale @ solution) ** 2)))
    return dict(zip(columns, solution / scale, strict=True)), left


def _groups(library: Columns) -> dict[str, list[str]]:
    """Terms by group: a sine and its cosine enter together."""
    groups: dict[str, list[str]] = {}
    for name in library:
        groups.setdefault(name.replace("cos", "sin"), []).append(name)
    return groups


def _beside(known: Columns, columns: np.ndarray) -> np.ndarray:
    """What the known terms leave of each column, at unit length: those keep their place whatever is thresholded."""
    basis, _ = np.linalg.qr(np.column_stack([c / (np.linalg.norm(c) + 1e-30) for c in known.values()]))
    left = columns - basis @ (basis.T @ columns)
    return left / (np.linalg.norm(left, axis=0) + 1e-12 * np.linalg.norm(columns, axis=0) + 1e-30)


def _support(equation: Equation, threshold: float) -> list[str]:
    """Groups of library terms that sequential thresholding keeps, the largest first."""
    library, target = np.column_stack(list(equation.library.values())), equation.target[:, None]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that nothing is kept is an answer
        model = STLSQ(threshold=threshold, unbias=False)
        model.fit(_beside(equation.known, library), _beside(equation.known, target))
    share = dict(zip(equation.library, model.coef_[0], strict=True))
    size = {g: float(np.hypot.reduce([share[n] for n in names])) for g, names in _groups(equation.library).items()}
    return [g for g in sorted(size, key=size.get, reverse=True) if size[g] > 0]


def sparse(equation: Equation) -> Solution:
    """The sparsest of the solutions over a path of thresholds that leaves little more than the best of them."""
    groups, solutions = _groups(equation.library), []
    for chosen in [[], *(_support(equation, threshold) for threshold in THRESHOLDS)]:
        kept = {n: equation.library[n] for g in chosen for n in groups[g]}
        coefficients, left = _solve({**equation.known, **kept}, equation.target)
        solutions.append((len(chosen), left, coefficients, chosen))
    least = min(left for _, left, _, _ in solutions)
    _, _, coefficients, chosen = min((s for s in solutions if s[1] <= SLACK * least), key=lambda s: s[:2])
    return coefficients, chosen


def _read(case: Path) -> tuple[dict, Bench, list[dict[str, np.ndarray]], int]:
    description = tomllib.loads((case / "case.toml").read_text())
    files = description["recordings"]["fit"] + description["recordings"]["validate"]
    recordings = []
    for file in files:
        names = (case / file).read_text().split("\n", 1)[0].split(",")
        data = np.genfromtxt(case / file, delimiter=",", skip_header=1)
        recordings.append(dict(zip(names, data.T, strict=True)))
    bench = next(b for b in BENCHES.values() if b.model == description["model"])
    return description, bench, recordings, len(description["recordings"]["fit"])


def _stacked(model: str, believed: Mapping[str, float], recordings: Sequence[Mapping], period: float) -> list[Equation]:
    """Equations over all recordings, every column averaged over the same moving window and thinned to three rows a
    window: derivatives are as noisy as they are, and a window leaves a linear relation as it was."""
    width = max(3, round((0.004 if period < 1e-3 else 0.05) / period))
    each = [EQUATIONS[model](believed, r, period) for r in recordings]

    def joined(columns: list[np.ndarray]) -> np.ndarray:
        return np.concatenate([uniform_filter1d(c, width)[:: width // 3] for c in columns])

    return [
        Equation(
            parts[0].place,
            joined([p.target for p in parts]),
            {n: joined([p.known[n] for p in parts]) for n in parts[0].known},
            {n: joined([p.library[n] for p in parts]) for n in parts[0].library},
        )
        for parts in zip(*each, strict=True)
    ]


def _polish(bench: Bench, outputs: Sequence[str], pairs: list, fit: int, start: Mapping[str, float]) -> tuple:
    """The regressed model fitted on the outputs, as (parameters, validation NRMSE); (start, nan) if it diverges."""
    try:
        best, _ = Refit(bench, outputs, pairs[:fit]).fit(start, iterations=4)
        simulated = Refit(bench, outputs, pairs[fit:]).simulate(best)
        return best, case_nrmse([y for _, y in pairs[fit:]], simulated)
    except (ArithmeticError, np.linalg.LinAlgError):
        return dict(start), float("nan")


def explain(case: Path) -> dict:
    """A diagnosis of the case by regression."""
    description, bench, recordings, fit = _read(case)
    believed = {n: v for n, v in description["parameters"].items() if n in bench.believed}
    fitted, found = dict(believed), []
    for equation in _stacked(bench.model, believed, recordings[:fit], bench.period):
        coefficients, chosen = sparse(equation)
        fitted |= {n: coefficients[n] for n in equation.known if coefficients[n] > 0}
        found += named(equation.place, chosen, coefficients, fitted.get("Ke", 1.0))
    outputs = [n for n in bench.machine.outputs if description["signals"].get(n, {}).get("role") == "output"]
    pairs = [
        (np.column_stack([r[n] for n in bench.machine.inputs]), np.column_stack([r[n] for n in outputs]))
        for r in recordings
    ]
    extra = {k: v for _, _, kernel in found for k, v in kernel.items()}
    best, after = _polish(bench, outputs, pairs, fit, fitted | extra)
    off = {n: abs(best.get(n, v) / v - 1) / bench.uncertainty.get(n, 0.05) for n, v in believed.items()}
    verdict = "missing_physics" if found else "parameters" if max(off.values()) > 3 else "consistent"
    return {
        "model": bench.model,
        "verdict": verdict,
        "findings": [{"effect": e, "location": where, "confidence": 1.0, "parameters": {}} for e, where, _ in found],
        "nrmse": {"validate": {"after": after}},
        "parameters": {n: {"value": best.get(n, v)} for n, v in believed.items()},
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    diagnosis = explain(arguments.case)
    after = diagnosis["nrmse"]["validate"]
    after["after"] = after["after"] if np.isfinite(after["after"]) else None
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "diagnosis.json").write_text(json.dumps(diagnosis))


if __name__ == "__main__":
    main()
