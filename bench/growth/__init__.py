"""What models of 100 to 10 000 states cost: translation, C compiler, and simulation beside programs written by hand.

Times are processor times of the translating process and of the compiler. The exponent is the slope of the whole between
this size and the one before, on logarithmic scales: 1 is a cost in proportion to the model.
"""

from __future__ import annotations

import ctypes
import math
from pathlib import Path
import resource
import tempfile
import time

import numpy as np

from bench.by_hand import LIBRARY
from bench.timing import take_turns
from lacuna import runtime
from lacuna.codegen.compile import compile_model

FOLDER = Path(__file__).parent
SIZES = (100, 1000, 10_000)
GOALS = {100: 1.0, 1000: 8.0, 10_000: 90.0}  # s of translation and compilation on an idle core
STOP = {"Ladder": 0.01, "Chain": 0.1}  # s
POINTS = 101
RTOL, ATOL = 1e-6, 1e-8
Row = dict[str, object]


def growth(rounds: int) -> list[Row]:
    """One row for each model and size."""
    rows: list[Row] = []
    for name in STOP:
        before: tuple[int, float] | None = None
        for n in SIZES:
            with tempfile.TemporaryDirectory() as cache:
                row, whole = _measured(name, n, cache, max(1, rounds // 3))
            if before is not None:
                row["exponent"] = math.log(whole / before[1]) / math.log(n / before[0])
            before = n, whole
            rows.append(row)
    return rows


def _measured(name: str, n: int, cache: str, rounds: int) -> tuple[Row, float]:
    compiler, own = _children(), time.process_time()
    compiled = compile_model(str(FOLDER / f"{name}.mo"), cache_directory=cache, modifications={"n": n})
    own, compiler = time.process_time() - own, _children() - compiler
    model = runtime.Model(compiled.path)
    rivals = {"by hand": lambda: by_hand(name, n), "generated": lambda: generated(model, name, n)}
    timings = take_turns(rivals, rounds)
    reference = by_hand(name, n, 1e-9, 1e-12)
    row: Row = {
        "model": name, "states": n, "translation s": own, "compiler s": compiler, "goal s": GOALS[n], "exponent": None,
        "by hand ms": 1e3 * timings["by hand"].seconds, "IDA ratio": timings["generated"].ratio,
        "error": _error(name, generated(model, name, n), reference),
        "by hand error": _error(name, by_hand(name, n), reference),
    }  # fmt: skip
    return row, own + compiler


def _children() -> float:
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def generated(model: runtime.Model, name: str, n: int) -> np.ndarray:
    """The states on the output grid in the order of the program by hand."""
    names = _states(name, n)
    result = runtime.simulate(
        model, solver="ida", stop=STOP[name], rtol=RTOL, atol=ATOL, interval=STOP[name] / (POINTS - 1), outputs=names,
        events=False,
    )  # fmt: skip
    if not result.complete:
        raise RuntimeError(f"{name}: {result.failure}")
    return np.column_stack([result[state] for state in names])


def _states(name: str, n: int) -> list[str]:
    patterns = {"Ladder": ["c[{}].v"], "Chain": ["body[{}].s", "body[{}].v"]}[name]
    return [pattern.format(k + 1) for k in range(n // len(patterns)) for pattern in patterns]


def by_hand(name: str, n: int, rtol: float = RTOL, atol: float = ATOL) -> np.ndarray:
    """The states on the output grid, one row an instant, by the program over IDA and KLU."""
    library, rows, steps = ctypes.CDLL(str(LIBRARY)), np.empty((POINTS, n)), ctypes.c_long()
    status = library.solve_sparse(
        int(name == "Chain"), n, ctypes.c_double(STOP[name]), POINTS, ctypes.c_double(rtol), ctypes.c_double(atol),
        rows.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), ctypes.byref(steps),
    )  # fmt: skip
    if status != 0:
        raise RuntimeError(f"solve_sparse ended with status {status}")
    return rows


def _error(name: str, rows: np.ndarray, reference: np.ndarray) -> float:
    """Largest difference over the largest magnitude of its kind (voltage, position, speed)."""
    step = 2 if name == "Chain" else 1
    return max(
        float(np.max(np.abs(rows[:, k::step] - reference[:, k::step])) / np.max(np.abs(reference[:, k::step])))
        for k in range(step)
    )
