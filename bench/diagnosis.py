"""How long the practice cases take to explain, and where the time goes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import time

import numpy as np

from bench.generated import ROOT
from lacuna.discovery.case import cases
from lacuna.discovery.explain import explain
from lacuna.runtime import Session

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
    with _simulating() as simulated:
        result = explain(cases.load(folder))
    seconds = time.perf_counter() - begin
    parts = {step: result.seconds.get(step, 0.0) for step in ("fit", "locate", "name")}
    parts["simulate (processor)"] = sum(simulated)
    return {"case": folder.name, "verdict": result.verdict, **parts, "in all": seconds, "goal": None}


@contextmanager
def _simulating() -> Iterator[list[float]]:
    """Processor time of each simulation meanwhile, s, whichever thread it runs in."""
    run, seconds = Session.run, []

    def timed(session: Session, *arguments, **options):
        begin = time.thread_time()
        try:
            return run(session, *arguments, **options)
        finally:
            seconds.append(time.thread_time() - begin)

    Session.run = timed
    try:
        yield seconds
    finally:
        Session.run = run
