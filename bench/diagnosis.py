"""How long the practice cases take to explain, and where the time goes."""

from __future__ import annotations

import os
from pathlib import Path
import time

import numpy as np

from bench.generated import ROOT
from discovery import cases
from discovery.explain import explain

GOAL = 60.0  # s, median on two cores


def split(rounds: int) -> list[dict[str, object]]:
    """One row a case and the median; times in s, each case once whatever `rounds` says. Empty without the cases."""
    shared = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared"))
    rows = [_row(folder) for folder in sorted((shared / "recordings" / "practice").glob("p*"))]
    if rows:
        steps = [key for key in rows[0] if key not in ("case", "verdict", "goal")]
        medians = {step: float(np.median([row[step] for row in rows])) for step in steps}
        rows.append({"case": "median", "verdict": "", **medians, "goal": GOAL})
    return rows


def _row(folder: Path) -> dict[str, object]:
    begin = time.perf_counter()
    result = explain(cases.load(folder))
    seconds = time.perf_counter() - begin
    parts = {step: result.seconds.get(step, 0.0) for step in ("fit", "locate", "name")}
    return {"case": folder.name, "verdict": result.verdict, **parts, "in all": seconds, "goal": None}
