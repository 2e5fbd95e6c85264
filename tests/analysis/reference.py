"""The hand-written simulation of the paper's actuator (reference_actuator.c), from Python."""

from __future__ import annotations

import ctypes
from functools import lru_cache

import numpy as np

from lacuna.analysis.spectra.library import library_path


class Parameters(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in ["V", "R", "L", "Ke", "pp", "J", "d", "tau_c", "f_cut", "zeta"]]


@lru_cache(maxsize=1)
def _library() -> ctypes.CDLL:
    lib = ctypes.CDLL(str(library_path().with_name("libreference_actuator.so")))
    lib.reference_defaults.restype = Parameters
    return lib


def declared(name: str) -> float:
    return getattr(_library().reference_defaults(), name)


@lru_cache(maxsize=64)
def simulate(zeta: float, step: float = 1e-5, rows: int = 100000, **others: float) -> np.ndarray:
    """[5, rows]: filtered currents a, b, c (A), speed (rad/s), angle (rad), every `step` seconds from standstill."""
    parameters = _library().reference_defaults()
    for name, value in {"zeta": zeta, **others}.items():
        setattr(parameters, name, value)
    out = np.empty((rows, 5))
    events = _library().reference_simulate(
        ctypes.byref(parameters), ctypes.c_double(step), rows, out.ctypes.data_as(ctypes.c_void_p)
    )
    assert events > 0
    return np.ascontiguousarray(out.T)
