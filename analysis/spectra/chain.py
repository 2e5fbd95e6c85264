"""The C++ spectral chain (liblacuna_analysis.so) on NumPy arrays. Calls release the GIL: use threads."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
import weakref

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import Settings
from lacuna.analysis.spectra.library import DOUBLES, MESSAGE_SIZE, CChannel, CSettings, CSummary, library, pointer

_PADDINGS = ("none", "section", "record")  # as lacuna_padding counts them


@dataclass(frozen=True)
class Features:
    """What the chain finds in one recording; one entry a channel in the arrays."""

    rms: np.ndarray  # A
    rms_mean: float  # A
    peak_bin: np.ndarray  # first peak of the peak-hold spectrum; -1: none
    peak_hz: np.ndarray  # NaN: none
    peak_amplitude: np.ndarray  # A; NaN: none
    frequency: np.ndarray  # Hz, of the fundamental, between the lines; NaN: none
    harmonic: np.ndarray  # A, [channels, 4] peak-hold amplitude at 0, 1, 2, 3 times the fundamental; NaN: none
    speed_mean: float  # rad/s over whole turns after the start-up; NaN: not one whole turn, or no angle
    turns: int
    held: np.ndarray  # A, [channels, lines] peak-hold amplitude spectra
    channels: ctypes.Array  # the same, for the C interface


def _in_c(settings: Settings) -> CSettings:
    """Raises AnalysisError for a padding that there is not; all else is checked where it is used."""
    if settings.padding not in _PADDINGS:
        known = ", ".join(_PADDINGS)
        raise AnalysisError(f"{settings.path}: spectrum.padding is {settings.padding!r}, not one of {known}")
    names = (ctypes.c_char_p * len(settings.currents))(*(name.encode() for name in settings.currents))
    return CSettings(
        settings.sampling_rate, settings.duration, len(names), names, settings.angle.encode(), settings.section,
        settings.overlap, _PADDINGS.index(settings.padding), settings.peak_above, settings.peak_threshold,
        settings.speed_after,
    )  # fmt: skip


class Chain:
    """Sections, Hann window, padded transform, peak hold, first peak, RMS and speed, as the settings say.

    Built once (window, FFT plan); then any number of threads may use it.
    Raises AnalysisError for settings or recordings that it cannot use.
    """

    def __init__(self, settings: Settings):
        self._lib = library()
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        self._chain = self._lib.lacuna_chain_new(_in_c(settings), message, MESSAGE_SIZE)
        if not self._chain:
            raise AnalysisError(message.value.decode(errors="replace"))
        weakref.finalize(self, self._lib.lacuna_chain_free, self._chain)
        self.channels: int = self._lib.lacuna_chain_channels(self._chain)
        self.samples: int = self._lib.lacuna_chain_samples(self._chain)
        self.lines: int = self._lib.lacuna_chain_lines(self._chain)
        self.section_length: int = self._lib.lacuna_chain_section_length(self._chain)
        self.resolution: float = self._lib.lacuna_chain_resolution(self._chain)  # Hz between lines
        sections = self._lib.lacuna_chain_sections(self._chain)
        self.section_starts = [self._lib.lacuna_chain_section_start(self._chain, k) for k in range(sections)]

    def analyse(self, currents, angle=None) -> Features:
        """Features of one recording: `currents` (A) [channels, samples], `angle` (rad, not wrapped) [samples]."""
        rows = [np.ascontiguousarray(current, dtype=float) for current in currents]
        if angle is not None:
            angle = np.ascontiguousarray(angle, dtype=float)
        if len(rows) != self.channels:
            raise AnalysisError(f"{len(rows)} currents given where the settings name {self.channels}")
        lengths = {len(row) for row in rows} | ({len(angle)} if angle is not None else set())
        if len(lengths) > 1:
            raise AnalysisError(f"the signals of a recording differ in length: {sorted(lengths)} samples")
        channels, summary = (CChannel * self.channels)(), CSummary()
        held = np.empty((self.channels, self.lines))
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        failed = self._lib.lacuna_chain_analyse(
            self._chain,
            (DOUBLES * len(rows))(*map(pointer, rows)),
            pointer(angle) if angle is not None else None,
            lengths.pop(),
            channels,
            ctypes.byref(summary),
            pointer(held),
            message,
            MESSAGE_SIZE,
        )
        if failed:
            raise AnalysisError(message.value.decode(errors="replace"))
        return Features(
            rms=np.array([channel.rms for channel in channels]),
            rms_mean=summary.rms_mean,
            peak_bin=np.array([channel.peak_bin for channel in channels]),
            peak_hz=np.array([channel.peak_hz for channel in channels]),
            peak_amplitude=np.array([channel.peak_amplitude for channel in channels]),
            frequency=np.array([channel.frequency for channel in channels]),
            harmonic=np.array([list(channel.harmonic) for channel in channels]),
            speed_mean=summary.speed_mean,
            turns=summary.turns,
            held=held,
            channels=channels,
        )

    def section_spectrum(self, section) -> tuple[np.ndarray, np.ndarray]:
        """Single-sided (amplitude, power) [lines] of one section of `section_length` samples.

        A tone on a line reads its peak value in the amplitude; the powers add up to the windowed mean square,
        sum((w x)^2) / sum(w^2).
        """
        section = np.ascontiguousarray(section, dtype=float)
        if section.shape != (self.section_length,):
            raise AnalysisError(f"a section has {self.section_length} samples, not {section.shape}")
        amplitude, power = np.empty(self.lines), np.empty(self.lines)
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        if self._lib.lacuna_chain_section_spectrum(
            self._chain, pointer(section), pointer(amplitude), pointer(power), message, MESSAGE_SIZE
        ):
            raise AnalysisError(message.value.decode(errors="replace"))
        return amplitude, power


def signature(features: Features) -> np.ndarray | None:
    """The vector that a severity is estimated from (include/lacuna/signature.hpp); None where a channel has no peak."""
    count = len(features.rms)
    vector = np.empty(library().lacuna_signature_size(count))
    return None if library().lacuna_signature(features.channels, count, pointer(vector)) else vector
