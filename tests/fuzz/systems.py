"""Random systems compiled and run by three solvers: they agree, or one of them says why not."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
import shutil

import numpy as np

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from tests.fuzz.models import random_system

SOLVERS = ("ida", "dopri5", "rodas4")
STOP, ROWS = 1.0, 101
COARSE, FINE = 1e-5, 1e-8
# Global errors are tolerances times what the system makes of them: a solver is believed where a thousandth of the
# tolerance does not move it by more than this many tolerances, and systems that amplify more are left out.
TAME = 1e3


@dataclass(frozen=True)
class Run:
    """`values` [variables, rows], `sizes` the largest magnitude of each; None with a reason where it ended early."""

    values: np.ndarray | None
    failure: str


def run(model: runtime.Model, solver: str, rtol: float) -> Run:
    result = runtime.simulate(
        model, solver=solver, rtol=rtol, stop=STOP, output_times=np.linspace(0, STOP, ROWS), events=False,
        max_steps=200_000, patience=20,
    )  # fmt: skip
    if result.failure is not None:
        return Run(None, str(result.failure))
    values = np.array([result[name] for name in model.states])
    assert np.isfinite(values).all(), "a complete run holds numbers that are not finite"
    return Run(values, "")


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """The largest difference, relative to each variable's largest magnitude; a row in ten may lie beside an event."""
    size = np.maximum(np.abs(a).max(axis=1), np.abs(b).max(axis=1)) + 1e-6
    worst = (np.abs(a - b) / size[:, None]).max(axis=0)
    return float(np.sort(worst)[: int(0.9 * len(worst))].max())


def try_system(seed: int, folder: Path) -> str:
    """What came out, in a word. Raises AssertionError where solvers differ although all of them are sure."""
    text = random_system(seed)
    path = folder / f"M{seed}.mo"
    path.write_text(text, encoding="utf-8")
    store = folder / "cache"
    try:
        model = runtime.Model(compile_model(f"{path}:M", cache_directory=str(store)).path)
    except Diagnostic as refused:
        return f"refused {refused.code}"
    finally:
        shutil.rmtree(store, ignore_errors=True)
    coarse, fine = ({s: run(model, s, rtol) for s in SOLVERS} for rtol in (COARSE, FINE))
    sure = {}
    for solver in SOLVERS:
        a, b = coarse[solver].values, fine[solver].values
        if a is not None and b is not None and distance(a, b) < TAME * COARSE:
            sure[solver] = b
    if len(sure) < 2:
        failed = sum(fine[s].values is None for s in SOLVERS)
        return f"{failed} failed" if failed else "not tame"
    (_, first), *others = sure.items()
    for solver, values in others:
        apart = distance(first, values)
        assert apart < TAME * COARSE, f"{'/'.join(sure)}: {solver} is {apart:.2g} away\n{text}"
    return f"{len(sure)} agree"
