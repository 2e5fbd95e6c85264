"""The usual alternative: equation-error regression with sparse selection (as PySINDy's STLSQ does), then a polish.

It answers in the contract of a diagnosis, so that the same scoring judges it.
"""

from collections.abc import Mapping, Sequence
import json
from pathlib import Path
import tomllib

import numpy as np
from scipy.ndimage import uniform_filter1d

from tests.proof.benches import BENCHES, Bench
from tests.proof.equations import EQUATIONS, Equation
from tests.proof.naming import named
from tests.proof.refit import Refit, case_nrmse

WORTH = 0.88  # a term (or pair of terms) must leave at most this share of the residual's RMS
MOST_TERMS = 3

Solution = tuple[dict[str, float], list[str]]  # every coefficient, and the groups of terms in the order of their choice


def _solve(columns: Mapping[str, np.ndarray], target: np.ndarray) -> dict[str, float]:
    A = np.column_stack(list(columns.values()))
    scale = np.linalg.norm(A, axis=0) + 1e-30
    solution, *_ = np.linalg.lstsq(A / scale, target, rcond=1e-8)
    return dict(zip(columns, solution / scale, strict=True))


def _left(columns: Mapping[str, np.ndarray], target: np.ndarray) -> float:
    solution = _solve(columns, target)
    return float(np.sqrt(np.mean((target - sum(solution[n] * columns[n] for n in columns)) ** 2)))


def _groups(library: Mapping[str, np.ndarray]) -> dict[str, list[str]]:
    """Terms by group: a sine and its cosine enter together."""
    groups: dict[str, list[str]] = {}
    for name in library:
        groups.setdefault(name.replace("cos", "sin"), []).append(name)
    return groups


def sparse(equation: Equation) -> Solution:
    """Forward selection: again and again the term that leaves least, while it is worth its place."""
    chosen: list[str] = []
    columns, groups = dict(equation.known), _groups(equation.library)
    left = _left(columns, equation.target)
    while groups and len(chosen) < MOST_TERMS:
        trials = {
            g: _left(columns | {n: equation.library[n] for n in names}, equation.target) for g, names in groups.items()
        }
        best = min(trials, key=trials.get)
        if trials[best] > WORTH * left:
            break
        columns |= {n: equation.library[n] for n in groups.pop(best)}
        chosen.append(best)
        left = trials[best]
    return _solve(columns, equation.target), chosen


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
    """Equations over all recordings, every column averaged over the same moving window: derivatives are as noisy as
    they are, and a window leaves a linear relation as it was."""
    width = max(3, round((0.004 if period < 1e-3 else 0.05) / period))
    each = [EQUATIONS[model](believed, r, period) for r in recordings]

    def joined(columns: list[np.ndarray]) -> np.ndarray:
        return np.concatenate([uniform_filter1d(c, width) for c in columns])

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


def diagnose(case: Path, out: Path) -> str:
    """Writes the diagnosis of a case, unless it is there; returns a word for the log."""
    target = out / "diagnosis.json"
    if target.exists() and target.stat().st_mtime > (case / "case.toml").stat().st_mtime:
        return "kept"
    out.mkdir(parents=True, exist_ok=True)
    diagnosis = explain(case)
    after = diagnosis["nrmse"]["validate"]["after"]
    diagnosis["nrmse"]["validate"]["after"] = after if np.isfinite(after) else None
    target.write_text(json.dumps(diagnosis))
    return "ok"
