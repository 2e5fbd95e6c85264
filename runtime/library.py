"""liblacuna_runtime.so through ctypes: its structures and the types of its functions (runtime/include)."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, Structure, c_char_p, c_double, c_int, c_long, c_size_t, c_void_p
from functools import lru_cache
from pathlib import Path

from lacuna.native import native_library
from lacuna.runtime.errors import SimulationError

STATUS = (
    "ok", "model", "argument", "bound", "initialisation", "inconsistent", "event_cycle", "chattering",
    "step_collapse", "non_finite", "singular", "domain", "assert", "memory",
    "interrupted",
)  # fmt: skip
EVENT_KINDS = ("state", "time", "sample", "terminate")
FLAG_KINDS = ("grazing", "order", "non_finite", "rounding", "fold", "arrival")
OF_TIME = 1  # a bit of the kind of a relation
STORAGE = ("state", "algebraic", "discrete", "parameter", "input", "derivative")
TYPES = ("Real", "Integer", "Boolean")


class CVariable(Structure):
    _fields_ = [
        *((name, c_char_p) for name in ("name", "unit", "description", "file")),
        *((name, c_int) for name in ("line", "type", "storage", "index", "sign", "settable", "is_output")),
        *((name, c_double) for name in ("start", "min", "max", "nominal")),
        ("inferred_unit", c_char_p),
        ("is_parameter", c_int),
    ]


class CEquation(Structure):
    _fields_ = [("text", c_char_p), ("file", c_char_p), ("line", c_int), ("origin", c_char_p)]


class CRelation(Structure):
    _fields_ = [("source", CEquation), ("kind", c_int)]


COUNTS = (
    "n_p", "n_u", "n_x", "n_z", "n_v", "n_d", "n_rel", "n_sample", "n_when", "n_variables", "n_equations", "n_asserts",
    "n_messages",
)  # fmt: skip


class CDescriptor(Structure):
    """The tables at the head of mdl_descriptor; its functions are the runtime's business alone."""

    _fields_ = [
        ("abi_version", c_int), ("name", c_char_p), ("hash", c_char_p), *((name, c_int) for name in COUNTS),
        ("variables", POINTER(CVariable)), ("equations", POINTER(CEquation)), ("asserts", c_void_p),
        ("relations", POINTER(CRelation)), ("messages", POINTER(c_char_p)), ("z_index", POINTER(c_int)),
        ("residual_equation", POINTER(c_int)), ("p_start", POINTER(c_double)), ("start_time", c_double),
        ("stop_time", c_double), ("tolerance", c_double), ("interval", c_double),
    ]  # fmt: skip


class CFailure(Structure):
    _fields_ = [
        ("status", c_int), ("time", c_double), ("variable", c_int), ("line", c_int), ("file", c_char_p),
        ("message", ctypes.c_char * 600),
    ]  # fmt: skip


class CCounters(Structure):
    _fields_ = [
        (name, c_long)
        for name in (
            "steps", "error_test_fails", "rhs", "residuals", "jacobians", "root_evaluations", "newton_iterations",
            "newton_fails", "state_events", "time_events", "sample_events", "input_jumps", "event_passes", "restarts",
            "tangents",
        )
    ]  # fmt: skip


class CEvent(Structure):
    _fields_ = [("time", c_double), ("kind", c_int), ("index", c_int), ("direction", c_int), ("reach", c_double)]


class CFlag(Structure):
    _fields_ = [("time", c_double), ("kind", c_int), ("relation", c_int), ("other", c_int)]


class COptions(Structure):
    _fields_ = [
        ("solver", c_char_p), ("rtol", c_double), ("atol", c_double), ("step", c_double), ("max_step", c_double),
        ("locate_events", c_int), ("record_events", c_int), ("max_steps", c_long), ("unchecked", c_int),
        ("patience", c_double),
    ]  # fmt: skip


_INTS, _DOUBLES = POINTER(c_int), POINTER(c_double)
INTERRUPTED = ctypes.CFUNCTYPE(c_int, c_double)

_SIGNATURES = {
    "rt_model_open": (c_void_p, c_char_p, c_char_p, c_size_t),
    "rt_model_close": (None, c_void_p),
    "rt_model_descriptor": (POINTER(CDescriptor), c_void_p),
    "rt_session_new": (c_void_p, c_void_p, POINTER(COptions), c_char_p, c_size_t),
    "rt_session_free": (None, c_void_p),
    "rt_session_watch": (None, c_void_p, INTERRUPTED),
    "rt_session_failure": (POINTER(CFailure), c_void_p),
    "rt_session_parameters": (c_int, c_void_p, c_int, _INTS, _DOUBLES),
    "rt_session_initial": (c_int, c_void_p, c_int, _INTS, _DOUBLES),
    "rt_session_input": (c_int, c_void_p, c_int, c_int, c_void_p, c_void_p, c_int),
    "rt_session_outputs": (c_int, c_void_p, c_int, _INTS),
    "rt_session_grid": (c_int, c_void_p, c_int, c_void_p, c_double),
    "rt_session_sensitivities": (c_int, c_void_p, c_int, _INTS),
    "rt_session_tolerances": (None, c_void_p, _DOUBLES, _DOUBLES),
    "rt_session_run": (c_void_p, c_void_p, c_double, c_double),
    "rt_result_free": (None, c_void_p),
    "rt_result_failure": (POINTER(CFailure), c_void_p),
    "rt_result_terminated": (c_char_p, c_void_p),
    "rt_result_counters": (POINTER(CCounters), c_void_p),
    "rt_result_rows": (c_size_t, c_void_p),
    "rt_result_time": (c_void_p, c_void_p),
    "rt_result_event_flags": (c_void_p, c_void_p),
    "rt_result_column": (c_void_p, c_void_p, c_int),
    "rt_result_parameters": (c_void_p, c_void_p),
    "rt_result_sensitivity": (c_void_p, c_void_p, c_int, c_int),
    "rt_result_margins": (c_void_p, c_void_p),
    "rt_result_flags": (POINTER(CFlag), c_void_p, POINTER(c_size_t)),
    "rt_result_warnings": (POINTER(c_char_p), c_void_p, POINTER(c_size_t)),
    "rt_result_events": (POINTER(CEvent), c_void_p, POINTER(c_size_t)),
}


def library_path() -> Path:
    """Where liblacuna_runtime.so is (`lacuna.native`)."""
    return native_library("lacuna_runtime")


@lru_cache(maxsize=1)
def library() -> ctypes.CDLL:
    """The loaded library. Calls release the GIL. Raises SimulationError where it has not been built."""
    path = library_path()
    if not path.exists():
        raise SimulationError(f"{path} is missing: run `make build`")
    lib = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _SIGNATURES.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments
    return lib
