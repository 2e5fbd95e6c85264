"""Diagnoses of machines against truths, and the page. The rules stand before the first run (README.md)."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
import json
from pathlib import Path
import tomllib

import numpy as np

from tests.proof.score import gain_share, wilson

PRESENT, NULL = ("effect", "two"), ("consistent", "parameters")


@dataclass(frozen=True)
class Score:
    """One diagnosis: what was in the case and what of it was right."""

    case: str
    kind: str
    machine: str
    style: str
    effects: tuple[str, ...]
    verdict: str
    said: tuple[str, ...]
    right: bool  # the verdict is one that the truth accepts
    located: (
        bool  # some finding of a verdict of missing physics, or a place told as tied with it, is where an effect is
    )
    all_located: bool  # every effect has a finding at its place
    false: bool  # a null of which missing physics is said
    share: float | None  # of the gain in error on validation recordings, in logarithms
    misfit: float
    seconds: float


def score(name: str, truth: dict, diagnosis: dict, seconds: float) -> Score:
    """One case."""
    verdict = diagnosis.get("verdict", "none")
    findings = diagnosis.get("findings", []) if verdict == "missing_physics" else []
    places = {f["location"] for f in findings}
    tied = {t["location"] for group in diagnosis.get("ties", []) for t in group}
    effects = truth.get("effects", [])
    ends = truth["nrmse"]["validate"]
    after = diagnosis.get("nrmse", {}).get("validate", {}).get("after") if findings else None
    share = gain_share(ends["refit_believed"], after or ends["refit_believed"], ends["floor"]) if effects else None
    right = verdict in truth["accept_verdicts"]
    if truth["kind"] == "parameters" and right:
        right = truth["off"] in {n for n, p in diagnosis.get("parameters", {}).items() if p["outside_belief"]}
    return Score(
        case=name, kind=truth["kind"], machine=truth["model"], style=truth["style"],
        effects=tuple(e["name"] for e in effects), verdict=verdict,
        said=tuple(f"{f.get('form') or f.get('law') or f['effect']} at {f['location']}" for f in findings), right=right,
        located=any((places | (tied if findings else set())) & set(e["accept_locations"]) for e in effects),
        all_located=bool(effects) and all(places & set(e["accept_locations"]) for e in effects),
        false=truth["kind"] in NULL and verdict == "missing_physics",
        share=None if share is None else max(share, 0.0),
        misfit=truth["nrmse"]["fit"]["refit_believed"] / truth["nrmse"]["fit"]["floor"], seconds=seconds,
    )  # fmt: skip


def score_folder(diagnoses: Path, truths: Path, names: list[str]) -> list[Score]:
    """Every case that has run; one without a diagnosis has the verdict of its run (out of time, say)."""
    found = []
    for name in names:
        run = diagnoses / name / "run.json"
        if not run.exists():
            continue
        outcome, file = json.loads(run.read_text()), diagnoses / name / "diagnosis.json"
        diagnosis = json.loads(file.read_text()) if file.exists() else {"verdict": outcome["status"]}
        found.append(score(name, tomllib.loads((truths / f"{name}.toml").read_text()), diagnosis, outcome["seconds"]))
    return found


def share_of(hits: int, of: int) -> str:
    """A share with its 95 % interval, in words."""
    low, high = wilson(hits, of)
    return f"{hits} of {of} ({low:.0%} to {high:.0%})" if of else "none run"


def table(scores: list[Score]) -> str:
    """The figures against their goals."""
    present = [s for s in scores if s.kind in PRESENT]
    null = [s for s in scores if s.kind in NULL]
    two = [s for s in scores if s.kind == "two"]
    shares = [s.share for s in present if s.share is not None]
    sides = [[s.right for s in side] for side in (present, null) if side]
    balanced = float(np.mean([np.mean(side) for side in sides])) if sides else float("nan")
    seconds = [s.seconds for s in scores]
    rows = [
        ("verdict, balanced over missing and null", f"{balanced:.0%}", "92 %"),
        ("verdict right where something is missing", share_of(sum(s.right for s in present), len(present)), ""),
        ("verdict right where nothing is missing", share_of(sum(s.right for s in null), len(null)), ""),
        ("located", share_of(sum(s.located for s in present), len(present)), "90 %"),
        ("two effects, both located", share_of(sum(s.all_located for s in two), len(two)), "80 %"),
        ("false findings where nothing is missing", share_of(sum(s.false for s in null), len(null)), "2 %"),
        ("share of the gain, median", f"{np.median(shares):.2f}" if shares else "none run", "0.9"),
        ("seconds a case, median and slowest", f"{np.median(seconds):.0f}, {max(seconds):.0f}" if seconds else "", ""),
    ]
    return "| | measured | goal |\n| --- | --- | --- |\n" + "".join(f"| {a} | {b} | {c} |\n" for a, b, c in rows)


def listing(scores: list[Score]) -> str:
    """Every case in a line."""
    lines = [
        "| case | machine | concealed | misfit | verdict | said | right | located | share | s |",
        "| --- " * 10 + "|",
    ]
    for s in sorted(scores, key=lambda s: (s.kind, s.machine, s.case)):
        concealed = (", ".join(s.effects) or s.kind) + (f" ({s.kind})" if s.kind in ("weak", "half") else "")
        share = "" if s.share is None else f"{s.share:.2f}"
        lines.append(
            f"| {s.case} | {s.machine} | {concealed} | {s.misfit:.2f} "
            f"| {s.verdict} | {'; '.join(s.said)} | {'yes' if s.right else 'no'} "
            f"| {('yes' if s.located else 'no') if s.effects else ''} | {share} | {s.seconds:.0f} |"
        )
    return "\n".join(lines) + "\n"


def by_style(scores: list[Score]) -> str:
    """Verdicts by how the model was written."""
    right, every = Counter(s.style for s in scores if s.right), Counter(s.style for s in scores)
    return "; ".join(f"{style}: {share_of(right[style], every[style])}" for style in sorted(every))
