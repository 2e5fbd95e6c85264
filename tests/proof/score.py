"""Diagnoses against truths: one `Score` a case, and the figures that the proof reports."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
import json
import math
from pathlib import Path
import tomllib

import numpy as np

CONCEALED = ("effect", "two", "law")
NULL = ("consistent", "parameters")


@dataclass(frozen=True)
class Estimate:
    """A reported parameter beside the true one; `covered` by value +- 1.96 std, None without a std."""

    name: str
    true: float
    value: float
    covered: bool | None

    @property
    def error(self) -> float:
        """Relative, or absolute where the truth is zero."""
        return abs(self.value - self.true) / (abs(self.true) or 1.0)


@dataclass(frozen=True)
class Score:
    """What one diagnosis got right."""

    case: str
    kind: str
    model: str
    effects: tuple[str, ...]
    verdict: str
    verdict_right: bool
    first: str  # first finding, or the verdict where there is none
    first_right: bool
    location_right: bool
    all_right: bool  # says that physics is missing, and names every concealed effect and nothing else
    false_finding: bool  # on a null case
    gain_share: float | None
    misfit: float  # the refitted believed model's error on the fit recordings, over the floor
    estimates: tuple[Estimate, ...] = field(default=())
    seconds: float = math.nan


def wilson(hits: int, trials: int) -> tuple[float, float]:
    """95 % interval of a proportion (Wilson 1927)."""
    if trials == 0:
        return 0.0, 1.0
    z, p = 1.96, hits / trials
    centre = (p + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * math.sqrt(p * (1 - p) / trials + z * z / (4 * trials**2))
    return max(0.0, centre - half), min(1.0, centre + half)


def gain_share(before: float, after: float, floor: float) -> float | None:
    """(log before - log after) / (log before - log floor), at most 1; None where there was next to nothing to gain."""
    if not (before > 1.15 * floor and after > 0 and math.isfinite(after)):
        return None
    return min(1.0, math.log(before / after) / math.log(before / floor))


def _matches(finding: Mapping, effect: Mapping) -> bool:
    return finding["effect"] in effect.get("accept_effects", [effect["effect"]])


def _located(finding: Mapping, effect: Mapping) -> bool:
    return finding["location"] in effect["accept_locations"]


def _estimate(name: str, true: float, unit: str, reported: Mapping) -> Estimate:
    value, std = reported["value"], reported.get("std")
    if unit == "rad" and name in ("phi", "phase"):  # the same angle a turn away
        value = true + (value - true + math.pi) % (2 * math.pi) - math.pi
    covered = None if not std or not math.isfinite(std) else abs(value - true) <= 1.96 * std
    return Estimate(name, true, value, covered)


def _effect_estimates(finding: Mapping, effect: Mapping) -> Iterable[Estimate]:
    reported = {k.lower(): v for k, v in finding.get("parameters", {}).items()}
    for name, truth in effect.get("parameters", {}).items():
        found = next((reported[n.lower()] for n in (name, *truth["aliases"]) if n.lower() in reported), None)
        same_unit = found is not None and found.get("unit", "1") in (truth["unit"], "1")
        if found is not None and same_unit and found.get("value") is not None:
            yield _estimate(name, truth["value"], truth["unit"], found)


def _model_estimates(diagnosis: Mapping, truth: Mapping) -> Iterable[Estimate]:
    for name, true in truth["true_parameters"].items():
        reported = diagnosis.get("parameters", {}).get(name)
        if reported and reported.get("value") is not None:
            yield _estimate(name, true, "", reported)


def score(case: str, diagnosis: Mapping, truth: Mapping, seconds: float = math.nan) -> Score:
    """One diagnosis against its truth, both as parsed."""
    findings, effects = diagnosis.get("findings", []), truth.get("effects", [])
    kind, verdict = truth["kind"], diagnosis.get("verdict", "none")
    first = findings[0] if findings and verdict == "missing_physics" else None
    hit = [e for e in effects if first and _matches(first, e)]
    pairs = [(f, e) for f in findings for e in effects if _matches(f, e) and _located(f, e)]
    estimates = [x for f, e in pairs for x in _effect_estimates(f, e)]
    if verdict in truth["accept_verdicts"] and len({e["effect"] for _, e in pairs}) == len(effects):
        estimates += _model_estimates(diagnosis, truth)
    ends, share = truth["nrmse"]["validate"], None
    if kind in CONCEALED:
        after = diagnosis.get("nrmse", {}).get("validate", {}).get("after") if first else ends["refit_believed"]
        share = gain_share(ends["refit_believed"], after or ends["refit_believed"], ends["floor"])
    return Score(
        case=case,
        kind=kind,
        model=truth["model"],
        effects=tuple(e["effect"] for e in effects),
        verdict=verdict,
        verdict_right=verdict in truth["accept_verdicts"],
        first=first["effect"] if first else verdict,
        first_right=bool(hit),
        location_right=any(_located(first, e) for e in hit) if first else False,
        all_right=first is not None and len(pairs) == len(effects) == len(findings),
        false_finding=kind in NULL and (verdict == "missing_physics" or bool(findings)),
        gain_share=share,
        misfit=truth["nrmse"]["fit"]["refit_believed"] / truth["nrmse"]["fit"]["floor"],
        estimates=tuple(estimates),
        seconds=seconds,
    )


def score_folder(diagnoses: Path, truths: Path, names: Iterable[str]) -> list[Score]:
    """Scores of DIAGNOSES/NAME/diagnosis.json against TRUTHS/NAME.toml; where there is none, the
    verdict is what the run came to (out of time, say), which is never right."""
    scores = []
    for name in names:
        truth = tomllib.loads((truths / f"{name}.toml").read_text())
        file, run = diagnoses / name / "diagnosis.json", diagnoses / name / "run.json"
        outcome = json.loads(run.read_text()) if run.exists() else {}
        diagnosis = json.loads(file.read_text()) if file.exists() else {"verdict": outcome.get("status", "none")}
        scores.append(score(name, diagnosis, truth, outcome.get("seconds", math.nan)))
    return scores


def share_right(scores: Iterable[Score], right: str, kinds: Iterable[str] | None = None) -> tuple[int, int]:
    """How many of the cases (of the kinds) have the attribute `right`, and how many there are."""
    chosen = [s for s in scores if kinds is None or s.kind in kinds]
    return sum(getattr(s, right) for s in chosen), len(chosen)


def confusion(scores: Iterable[Score]) -> dict[str, Counter]:
    """First findings of the cases with one effect, by what was concealed."""
    table: dict[str, Counter] = {}
    for s in scores:
        if s.kind == "effect":
            table.setdefault(s.effects[0], Counter())[s.effects[0] if s.first_right else s.first] += 1
    return table


def median_share(scores: Iterable[Score]) -> float:
    """Median gain share over the cases that had a gain to take."""
    shares = [s.gain_share for s in scores if s.gain_share is not None]
    return float(np.median(shares)) if shares else math.nan


def coverage(scores: Iterable[Score]) -> tuple[int, int]:
    """How many 95 % intervals of reported parameters contain the truth, of how many."""
    judged = [e.covered for s in scores for e in s.estimates if e.covered is not None]
    return sum(judged), len(judged)


def median_error(scores: Iterable[Score]) -> float:
    """Median relative error of the reported parameters."""
    errors = [e.error for s in scores for e in s.estimates]
    return float(np.median(errors)) if errors else math.nan
