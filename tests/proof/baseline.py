"""The usual alternative: equation-error regression with sparse selection (as PySINDy's STLSQ does), then a polish.

It answers in the contract of a diagnosis, so that the same scoring judges it.
"""

from collections.abc import Mapping, Sequence
import json
from pathlib import Path
import tomllib

import numpy as np

from tests.proof.benches import BENCHES, Bench
from tests.proof.equations import EQUATIONS, Equation
from tests.proof.refit import Refit, case_nrmse

THRESHOLD = 0.25  # a term stays when its share of the unexplained residual is at least this
WORTH = 0.8  # the terms must leave at most this share of the residual's RMS

Solution = tuple[dict[str, float], dict[str, float]]  # known parameters, library coefficients


def _solve(columns: Mapping[str, np.ndarray], target: np.ndarray) -> dict[str, float]:
    if not columns:
        return {}
    A = np.column_stack(list(columns.values()))
    scale = np.linalg.norm(A, axis=0) + 1e-30
    solution, *_ = np.linalg.lstsq(A / scale, target, rcond=1e-8)
    return dict(zip(columns, solution / scale, strict=True))


def _value(columns: Mapping[str, np.ndarray], solution: Mapping[str, float]) -> np.ndarray:
    return sum((solution[n] * columns[n] for n in solution), start=np.float64(0))


def sparse(equation: Equation) -> Solution:
    """Sequentially thresholded least squares: refit and drop the least term until every one left is worth its place."""
    known = _solve(equation.known, equation.target)
    alone = equation.target - _value(equation.known, known)
    active = dict(equation.library)
    while True:
        columns = {**equation.known, **active}
        solution = _solve(columns, equation.target)
        shares = {n: np.std(solution[n] * active[n]) + abs(np.mean(solution[n] * active[n])) for n in active}
        least = min(shares, key=shares.get, default=None)
        if least is None or shares[least] >= THRESHOLD * np.std(alone):
            break
        del active[least]
    left = equation.target - _value(columns, solution)
    if np.std(left) > WORTH * np.std(alone):
        return known, {}
    return {n: solution[n] for n in equation.known}, {n: solution[n] for n in active}


def _wave(terms: Mapping[str, float], n: int, prefix: str = "") -> tuple[float, float]:
    s, c = terms.get(f"{prefix}sin{n}", 0.0), terms.get(f"{prefix}cos{n}", 0.0)
    return float(np.hypot(s, c)), float(np.arctan2(c, s))


def name_terms(place: str, terms: Mapping[str, float], Ke: float) -> list[tuple[str, str, dict[str, float], float]]:
    """(effect, location, simulator parameters, size) of what a regression kept."""
    found, at = [], "device" if place == "device" else "shaft"
    simple = {
        "square": ("drag.quadratic", {f"{at}_c2": 1}),
        "angle": ("stiffness", {"k_s": 1}),
        "load": ("friction.load", {"shaft_mu": 1}),
        "dead": ("drive.dead_time", {"V_d": 1}),
        "sag": ("drive.supply_sag", {"sag": 1}),
        "warm": ("motor.heating", {}),
        "late": ("drive.delay", {}),
        "offset": ("sensor.offset", {}),
        "Ra": ("motor.imbalance", {"Ra": 1}),
        "Rb": ("motor.imbalance", {"Rb": 1}),
        "Rc": ("motor.imbalance", {"Rc": 1}),
    }
    for term, (effect, kernel) in simple.items():
        if term in terms:
            where = {"drive.dead_time": "drive", "drive.supply_sag": "drive", "sensor.offset": "sensor:i"}.get(
                effect, place
            )
            found.append((effect, where, {k: terms[term] * v for k, v in kernel.items()}, abs(terms[term])))
    if "sign" in terms or "stribeck" in terms:
        effect = (
            "friction.stribeck"
            if "stribeck" in terms
            else "friction.asymmetric"
            if "one" in terms
            else "friction.coulomb"
        )
        kernel = {f"{at}_tau_c": terms.get("sign", 0.0)}
        if "stribeck" in terms:
            kernel |= {f"{at}_tau_e": terms["stribeck"], f"{at}_w_s": 10.0 if at == "shaft" else 0.02}
        if "one" in terms:
            kernel[f"{at}_tau_d"] = terms["one"]
        found.append((effect, place, kernel, abs(terms.get("sign", 0)) + abs(terms.get("stribeck", 0))))
    elif "one" in terms:
        found.append(("load.constant", place, {"F_0" if at == "device" else "tau_l": terms["one"]}, abs(terms["one"])))
    for n in (1, 3, 4, 6, 8):
        amplitude, phase = _wave(terms, n)
        if amplitude:
            gravity = {"mgl": amplitude, "mgl_phi": phase}
            cogging = {"cog_a": amplitude, "cog_n": float(n), "cog_phi": phase}
            found.append(
                ("load.gravity", place, gravity, amplitude) if n == 1 else ("torque.cogging", place, cogging, amplitude)
            )
        amplitude, phase = _wave(terms, n, "i_")
        if amplitude:
            found.append(
                (
                    "torque.ripple",
                    place,
                    {"rip_a": amplitude / Ke, "rip_n": float(n), "rip_phi": phase + np.pi},
                    amplitude,
                )
            )
    if "flux" in terms or "cube" in terms:
        found.append(("motor.saturation", "winding", {}, abs(terms.get("flux", terms.get("cube", 0)))))
    return sorted(found, key=lambda f: -f[3])


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
    each = [EQUATIONS[model](believed, r, period) for r in recordings]
    stacked = []
    for parts in zip(*each, strict=True):
        known = {n: np.concatenate([p.known[n] for p in parts]) for n in parts[0].known}
        library = {n: np.concatenate([p.library[n] for p in parts]) for n in parts[0].library}
        stacked.append(Equation(parts[0].place, np.concatenate([p.target for p in parts]), known, library))
    return stacked


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
    fitted, found, terms = dict(believed), [], {}
    for equation in _stacked(bench.model, believed, recordings[:fit], bench.period):
        known, kept = sparse(equation)
        fitted |= {n: v for n, v in known.items() if v > 0}
        terms |= kept
        found += name_terms(equation.place, kept, fitted.get("Ke", 1.0))
    outputs = [n for n in bench.machine.outputs if description["signals"].get(n, {}).get("role") == "output"]
    pairs = [
        (np.column_stack([r[n] for n in bench.machine.inputs]), np.column_stack([r[n] for n in outputs]))
        for r in recordings
    ]
    extra = {k: v for _, _, kernel, _ in found for k, v in kernel.items()}
    best, after = _polish(bench, outputs, pairs, fit, fitted | extra)
    off = {n: abs(best.get(n, v) / v - 1) / bench.uncertainty.get(n, 0.05) for n, v in believed.items()}
    verdict = "missing_physics" if found else "parameters" if max(off.values()) > 3 else "consistent"
    return {
        "model": bench.model,
        "verdict": verdict,
        "findings": [{"effect": e, "location": where, "confidence": 1.0, "parameters": {}} for e, where, _, _ in found],
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
