"""Calls the callbacks of a compiled model one by one, without the runtime: the second half of the tests of codegen."""

from __future__ import annotations

import ctypes
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int, c_long, c_ubyte, c_void_p
from pathlib import Path

import numpy as np

from lacuna.codegen.compile import CompiledModel, compile_model

_DOUBLES = POINTER(c_double)


class Failure(Structure):
    _fields_ = [("kind", c_int), ("equation", c_int), ("variable", c_int), ("value", c_double), ("bound", c_double)]


class Data(Structure):
    _fields_ = [
        *((name, _DOUBLES) for name in ("p", "u", "x", "xdot", "v", "d", "pre_d")),
        *((name, POINTER(c_ubyte)) for name in ("rel", "tick", "when", "warned")),
        *((name, c_int) for name in ("initial", "terminal", "reinitialised", "terminated")),
        ("failure", Failure),
        *((name, c_double) for name in ("start_time", "homotopy")),
        *((name, c_long) for name in ("stack", "rounds")),
        ("undetermined", c_int),
        ("transports", c_void_p),
        ("carried", c_void_p),
        ("brief", c_int),
        ("shift", c_double),
        ("contraction_ratio", c_double),
        *((f"contraction_{name}", c_int) for name in ("equation", "only", "turned")),
        *((name, _DOUBLES) for name in ("orientation", "facing")),
    ]


_COUNTS = (
    "n_p", "n_u", "n_x", "n_z", "n_v", "n_d", "n_rel", "n_sample", "n_when", "n_variables", "n_equations", "n_asserts",
    "n_messages",
)  # fmt: skip
_POINT = CFUNCTYPE(c_int, POINTER(Data), c_double, _DOUBLES, _DOUBLES, _DOUBLES)
_POINT_ROOTS = CFUNCTYPE(c_int, POINTER(Data), c_double, _DOUBLES, _DOUBLES, _DOUBLES, _DOUBLES)
_CALLBACKS = {
    "parameters": CFUNCTYPE(c_int, POINTER(Data)),
    "samples": CFUNCTYPE(c_int, POINTER(Data), _DOUBLES, _DOUBLES),
    "starts": CFUNCTYPE(c_int, POINTER(Data)),
    "initial_system": CFUNCTYPE(c_int, POINTER(Data), c_double),
    "rhs": _POINT,
    "residual": _POINT,
    "jacobian": CFUNCTYPE(c_int, POINTER(Data), c_double, _DOUBLES, _DOUBLES, c_double, _DOUBLES),
    "roots": _POINT_ROOTS,
    "time_relations": CFUNCTYPE(c_int, POINTER(Data), c_double),
    "next_time_event": CFUNCTYPE(c_double, POINTER(Data), c_double),
    "event": _POINT,
    "check": _POINT,
}


class Descriptor(Structure):
    _fields_ = [
        ("abi_version", c_int), ("name", c_char_p), ("hash", c_char_p), *((name, c_int) for name in _COUNTS),
        *((name, c_void_p) for name in ("variables", "equations", "asserts", "relations", "messages")),
        ("z_index", POINTER(c_int)), ("residual_equation", POINTER(c_int)), ("p_start", _DOUBLES),
        *((name, c_double) for name in ("start_time", "stop_time", "tolerance", "interval")),
        ("jac_nnz", c_int), ("jac_colptr", POINTER(c_int)), ("jac_rowidx", POINTER(c_int)), *_CALLBACKS.items(),
    ]  # fmt: skip


def write_model(folder: Path, text: str) -> str:
    """Put one model into a file that is named after it; returns its path, which is a name for the translator."""
    path = folder / f"{text.split()[1]}.mo"
    path.write_text(text, encoding="utf-8")
    return str(path)


class Generated:
    """A compiled model with memory of its own. Arrays are NumPy views of what the callbacks read and write."""

    def __init__(self, name: str, cache: Path, **options: object):
        self.compiled: CompiledModel = compile_model(name, cache_directory=str(cache), **options)
        library = ctypes.CDLL(self.compiled.path)
        library.mdl_descriptor_get.restype = POINTER(Descriptor)
        self._library = library
        self.descriptor: Descriptor = library.mdl_descriptor_get().contents
        d = self.descriptor
        sizes = {"p": d.n_p, "u": d.n_u, "x": d.n_x, "xdot": d.n_x, "v": d.n_v, "d": d.n_d, "pre_d": d.n_d}
        sizes |= {"orientation": d.n_equations, "facing": d.n_equations}
        self.data, self.arrays = Data(), {}
        for key, size in sizes.items():
            self.arrays[key] = np.zeros(size + 1)
            setattr(self.data, key, self.arrays[key].ctypes.data_as(_DOUBLES))
        for key, size in {"rel": d.n_rel, "tick": d.n_sample, "when": d.n_when, "warned": d.n_asserts}.items():
            self.arrays[key] = np.zeros(size + 1, dtype=np.uint8)
            setattr(self.data, key, self.arrays[key].ctypes.data_as(POINTER(c_ubyte)))
        self.arrays["p"][: d.n_p] = np.ctypeslib.as_array(d.p_start, (d.n_p,)) if d.n_p else []
        assert self.call("parameters") == 0
        assert self.call("starts") == 0

    def call(self, name: str, *arguments: float | np.ndarray) -> int:
        """The status that a callback returns, 0 of one that the model does without; arrays are passed as they are."""
        callback = getattr(self.descriptor, name)
        converted = [a.ctypes.data_as(_DOUBLES) if isinstance(a, np.ndarray) else a for a in arguments]
        return callback(ctypes.byref(self.data), *converted) if callback else 0

    def rhs(self, t: float, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(xdot, v) of the explicit form."""
        xdot, v = np.zeros(self.descriptor.n_x), self.arrays["v"][: self.descriptor.n_v].copy()
        status = self.call("rhs", t, np.ascontiguousarray(x), xdot, v)
        assert status == 0, self.data.failure.kind
        return xdot, v

    def residual(self, t: float, y: np.ndarray, yp: np.ndarray) -> np.ndarray:
        r = np.zeros(self.descriptor.n_x + self.descriptor.n_z)
        assert self.call("residual", t, np.ascontiguousarray(y), np.ascontiguousarray(yp), r) == 0
        return r

    def dae_point(self, t: float, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(y, y') of the residual form that belongs to states x, through the explicit form."""
        xdot, v = self.rhs(t, x)
        z = [v[self.descriptor.z_index[k]] for k in range(self.descriptor.n_z)]
        return np.concatenate([x, z]), np.concatenate([xdot, np.zeros(len(z))])

    def jacobian(self, t: float, y: np.ndarray, yp: np.ndarray, cj: float) -> np.ndarray:
        """dF/dy + cj dF/dy' as a full matrix."""
        d, size = self.descriptor, len(y)
        values = np.zeros(d.jac_nnz + 1)
        assert self.call("jacobian", t, np.ascontiguousarray(y), np.ascontiguousarray(yp), cj, values) == 0
        full = np.zeros((size, size))
        for column in range(size):
            for k in range(d.jac_colptr[column], d.jac_colptr[column + 1]):
                full[d.jac_rowidx[k], column] = values[k]
        return full
