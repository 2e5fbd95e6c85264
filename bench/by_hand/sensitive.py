"""T1 with its sensitivities, written by hand over IDAS, in the same process as its rivals."""

from __future__ import annotations

import ctypes

import numpy as np

from bench.by_hand import LIBRARY, T1, Run, _Counters

IDAS_LIBRARY = LIBRARY.with_name("liblacuna_by_hand_idas.so")
PARAMETERS = ("R", "L", "Ke", "J", "b", "tauc", "U")


def with_idas(rtol: float, atol: float) -> tuple[Run, np.ndarray]:
    """The run, and its sensitivities [points, parameters, states]."""
    library = ctypes.CDLL(str(IDAS_LIBRARY))
    rows = np.empty((T1.points, 1 + len(PARAMETERS), len(T1.states)))
    counters = _Counters()
    status = library.solve_t1_with_idas(
        ctypes.c_double(rtol), ctypes.c_double(atol), rows.ctypes.data_as(ctypes.POINTER(ctypes.c_double)),
        ctypes.byref(counters),
    )  # fmt: skip
    if status != 0:
        raise RuntimeError(f"the program over IDAS ended with status {status}")
    counts = {name: getattr(counters, name) for name, _ in _Counters._fields_ if name != "seconds"}
    return Run(dict(zip(T1.states, rows[:, 0].T.copy(), strict=True)), counts, counters.seconds), rows[:, 1:]
