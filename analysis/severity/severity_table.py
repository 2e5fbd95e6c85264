"""The severity table: a map as one compact file with a checksum, which desktop and on-board chain both read.

The format stands in include/lacuna/severity_table.hpp.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from pathlib import Path
import struct
import weakref
import zlib

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.spectra.chain import Features
from lacuna.analysis.spectra.library import MESSAGE_SIZE, CEstimate, library
from lacuna.given import require_file


@dataclass(frozen=True)
class TableContents:
    """What a severity table holds; c conditions, m severities, n features a signature."""

    channels: int
    sections: tuple[int, int, int, int]  # samples of a record, of a section, of a hop, of a padded section
    sampling_rate: float  # Hz
    peak_rule: tuple[float, float]  # Hz, share of the largest line
    speed_after: float  # s
    misfit_limit: float
    severity: np.ndarray  # [m]
    rms_mean: np.ndarray  # A, [m]
    signature: np.ndarray  # [c, m, n]
    covariance: np.ndarray  # [c, m, n, n] of the signature
    bands: list[tuple[str, float, float]]


def table_bytes(contents: TableContents) -> bytes:
    """The file. Raises AnalysisError where a covariance is not positive definite."""
    c, m, n = contents.signature.shape
    try:
        factors = np.linalg.cholesky(contents.covariance)
    except np.linalg.LinAlgError:
        raise AnalysisError("the covariance of the features is singular: give [assessment] floors above zero") from None
    whitening = np.linalg.inv(factors)[(..., *np.tril_indices(n))]
    log_determinant = 2 * np.log(np.diagonal(factors, axis1=-2, axis2=-1)).sum(axis=-1)
    head = struct.pack("<8s8I", b"LACUNAM2", contents.channels, m, c, len(contents.bands), *contents.sections)
    numbers = [contents.sampling_rate, *contents.peak_rule, contents.speed_after, contents.misfit_limit]
    arrays = [contents.severity, contents.rms_mean]
    for condition in zip(contents.signature, whitening, log_determinant, strict=True):
        arrays += condition
    body = [head, struct.pack("<5d", *numbers), *(np.ascontiguousarray(a, dtype="<f8").tobytes() for a in arrays)]
    body += [struct.pack("<16s2d", name.encode()[:15], first, last) for name, first, last in contents.bands]
    data = b"".join(body)
    return data + struct.pack("<I", zlib.crc32(data))


@dataclass(frozen=True)
class Estimate:
    """Severity of one recording."""

    severity: float
    low: float  # 95 % interval
    high: float
    misfit: float  # squared distance to the map, in standard deviations
    paper: float  # severity by the paper's method, the mean RMS alone
    band: int  # row of the bands
    covered: bool  # False: the map explains this recording at no severity


class SeverityTable:
    """A table from its file. Raises AnalysisError where the file is missing, damaged or not a severity table."""

    def __init__(self, path: Path | str):
        if not Path(path).exists():
            raise AnalysisError(f"{path} is missing: the map was not prepared for assessment")
        require_file(Path(path), AnalysisError)
        data = Path(path).read_bytes()
        self._lib = library()
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        self._table = self._lib.lacuna_table_new(data, len(data), message, MESSAGE_SIZE)
        if not self._table:
            raise AnalysisError(f"{path}: {message.value.decode(errors='replace')}")
        weakref.finalize(self, self._lib.lacuna_table_free, self._table)
        self.channels: int = self._lib.lacuna_table_channels(self._table)

    def estimate(self, features: Features) -> Estimate | None:
        """None where a channel has no first peak, which no severity of a running motor gives."""
        if len(features.rms) != self.channels:
            raise AnalysisError(f"{len(features.rms)} channels where the table has {self.channels}")
        found = CEstimate()
        if self._lib.lacuna_table_estimate(self._table, features.channels, features.rms_mean, ctypes.byref(found)):
            return None
        return Estimate(
            found.severity, found.low, found.high, found.misfit, found.paper, found.band, bool(found.covered)
        )
