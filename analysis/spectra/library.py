"""liblacuna_analysis.so through ctypes: its structures and the types of its functions (include/lacuna_analysis.h)."""

from __future__ import annotations

import ctypes
from functools import lru_cache
from pathlib import Path

from lacuna.analysis.errors import AnalysisError
from lacuna.native import native_library

MESSAGE_SIZE = 500
DOUBLES = ctypes.POINTER(ctypes.c_double)
INTEGERS = ctypes.POINTER(ctypes.c_int)


class CSettings(ctypes.Structure):
    _fields_ = [
        ("sampling_rate", ctypes.c_double),
        ("duration", ctypes.c_double),
        ("channels", ctypes.c_size_t),
        ("currents", ctypes.POINTER(ctypes.c_char_p)),
        ("angle", ctypes.c_char_p),
        ("section", ctypes.c_double),
        ("overlap", ctypes.c_double),
        ("padding", ctypes.c_int),
        ("peak_above", ctypes.c_double),
        ("peak_threshold", ctypes.c_double),
        ("speed_after", ctypes.c_double),
    ]


class CChannel(ctypes.Structure):
    _fields_ = [
        ("rms", ctypes.c_double),
        ("peak_hz", ctypes.c_double),
        ("peak_amplitude", ctypes.c_double),
        ("peak_bin", ctypes.c_longlong),
        ("frequency", ctypes.c_double),
        ("harmonic", ctypes.c_double * 4),
    ]


class CSummary(ctypes.Structure):
    _fields_ = [("rms_mean", ctypes.c_double), ("speed_mean", ctypes.c_double), ("turns", ctypes.c_int)]


class CEstimate(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_double) for name in ("severity", "low", "high", "misfit", "paper")),
        ("band", ctypes.c_int),
        ("covered", ctypes.c_int),
    ]


class CHypotheses(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_size_t) for name in ("laws", "histories", "columns", "points")),
        *((name, DOUBLES) for name in ("severity", "growth", "age", "life", "wander2", "diffusion2", "change",
                                       "common")),
        *((name, ctypes.c_double) for name in ("wide", "wide_scale", "outlier", "outlier_range", "change_size",
                                               "gone")),
    ]  # fmt: skip


class CBeliefs(ctypes.Structure):
    _fields_ = [(name, DOUBLES) for name in ("x", "l", "xx", "xl", "ll", "w")]


class CTests(ctypes.Structure):
    _fields_ = [*((name, DOUBLES) for name in ("use", "value", "below", "above")), ("valid", ctypes.c_void_p)]


class CLinearModel(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_size_t) for name in ("samples", "states", "outputs", "inputs")),
        *((name, DOUBLES) for name in ("time", "step", "drive", "read", "feed", "noise", "start")),
    ]


class CLatent(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_size_t) for name in ("hypotheses", "forces")),
        *((name, INTEGERS) for name in ("column", "sensor")),
        *((name, DOUBLES) for name in ("size", "time")),
    ]


class CLatentGains(ctypes.Structure):
    _fields_ = [(name, DOUBLES) for name in ("row", "gain", "deviation", "drive", "keep")]


def library_path() -> Path:
    """Where liblacuna_analysis.so is (`lacuna.native`)."""
    return native_library("lacuna_analysis")


# Name: (result, arguments).
_ADDRESS, _SIZE, _TEXT = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p
_MESSAGE = [_TEXT, _SIZE]
_LATENT = [ctypes.POINTER(CLinearModel), ctypes.POINTER(CLatent)]
_GAINS = [ctypes.POINTER(CLinearModel), ctypes.POINTER(CLatentGains)]
_FUNCTIONS = {
    "lacuna_chain_new": (_ADDRESS, [ctypes.POINTER(CSettings), *_MESSAGE]),
    "lacuna_chain_free": (None, [_ADDRESS]),
    "lacuna_chain_channels": (_SIZE, [_ADDRESS]),
    "lacuna_chain_samples": (_SIZE, [_ADDRESS]),
    "lacuna_chain_sections": (_SIZE, [_ADDRESS]),
    "lacuna_chain_section_length": (_SIZE, [_ADDRESS]),
    "lacuna_chain_section_start": (_SIZE, [_ADDRESS, _SIZE]),
    "lacuna_chain_lines": (_SIZE, [_ADDRESS]),
    "lacuna_chain_resolution": (ctypes.c_double, [_ADDRESS]),
    "lacuna_chain_analyse": (
        ctypes.c_int,
        [_ADDRESS, ctypes.POINTER(DOUBLES), DOUBLES, _SIZE, ctypes.POINTER(CChannel), ctypes.POINTER(CSummary), DOUBLES]
        + _MESSAGE,
    ),
    "lacuna_chain_section_spectrum": (ctypes.c_int, [_ADDRESS, DOUBLES, DOUBLES, DOUBLES, *_MESSAGE]),
    "lacuna_transform_name": (_TEXT, []),
    "lacuna_signature_size": (_SIZE, [_SIZE]),
    "lacuna_signature": (ctypes.c_int, [ctypes.POINTER(CChannel), _SIZE, DOUBLES]),
    "lacuna_hypotheses_test": (
        None,
        [
            *(ctypes.POINTER(kind) for kind in (CHypotheses, CTests, CBeliefs, CBeliefs)),
            *[DOUBLES] * 4,
        ],
    ),
    "lacuna_lognormals_reached": (None, [*[DOUBLES] * 3, _SIZE, _SIZE, DOUBLES, _SIZE, DOUBLES]),
    "lacuna_latent_evidence": (ctypes.c_int, [*_LATENT, DOUBLES, _ADDRESS, _SIZE, DOUBLES, DOUBLES]),
    "lacuna_latent_filter": (ctypes.c_int, [*_LATENT, _ADDRESS, ctypes.POINTER(CLatentGains)]),
    "lacuna_latent_whiten": (None, [*_GAINS, _SIZE, DOUBLES, _ADDRESS, _SIZE]),
    "lacuna_latent_whiten_transposed": (None, [*_GAINS, _SIZE, DOUBLES, _ADDRESS, _SIZE]),
    "lacuna_latent_smooth": (ctypes.c_int, [*_LATENT, DOUBLES, _ADDRESS, DOUBLES, DOUBLES]),
    "lacuna_linear_response": (
        None,
        [ctypes.POINTER(CLinearModel), INTEGERS, DOUBLES, _SIZE, ctypes.c_int, _SIZE, DOUBLES],
    ),
    "lacuna_linear_response_transposed": (
        None,
        [ctypes.POINTER(CLinearModel), _SIZE, DOUBLES, _SIZE, _SIZE, DOUBLES],
    ),
    "lacuna_table_new": (_ADDRESS, [_TEXT, _SIZE, *_MESSAGE]),
    "lacuna_table_free": (None, [_ADDRESS]),
    "lacuna_table_channels": (_SIZE, [_ADDRESS]),
    "lacuna_table_estimate": (
        ctypes.c_int,
        [_ADDRESS, ctypes.POINTER(CChannel), ctypes.c_double, ctypes.POINTER(CEstimate)],
    ),
}


@lru_cache(maxsize=1)
def library() -> ctypes.CDLL:
    path = library_path()
    if not path.exists():
        raise AnalysisError(f"{path} is missing: run `make build`")
    lib = ctypes.CDLL(str(path))
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments
    return lib


def pointer(array):
    """To the first of an array of doubles."""
    return array.ctypes.data_as(DOUBLES)
