"""The C++ chain against the same formulas in NumPy and SciPy, on the same samples."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
import numpy as np
import pytest
import scipy.signal

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import load_settings
from lacuna.analysis.spectra.chain import Chain
from tests.analysis.reference import simulate

PAPER = load_settings()
CHAIN = Chain(PAPER)
PADDED = 2**17


def section_spectra(record: np.ndarray) -> np.ndarray:
    """|F| of every windowed, padded section."""
    window = scipy.signal.windows.hann(25000, sym=True)
    return np.array([np.abs(np.fft.rfft(record[s : s + 25000] * window, PADDED)) for s in range(0, 75001, 8250)])


def peak_hold(record: np.ndarray) -> np.ndarray:
    scale = np.full(PADDED // 2 + 1, 2.0)
    scale[[0, -1]] = 1.0
    return scale * section_spectra(record).max(axis=0) / scipy.signal.windows.hann(25000, sym=True).sum()


@pytest.mark.parametrize("zeta", [0.0, 0.34])
def test_features_equal_numpy(zeta):
    record = simulate(zeta)
    features = CHAIN.analyse(record[:3], record[4])
    np.testing.assert_allclose(features.rms, np.sqrt((record[:3] ** 2).mean(axis=1)), rtol=1e-12)
    assert features.rms_mean == pytest.approx(features.rms.mean(), rel=1e-15)
    for channel in range(3):
        held = peak_hold(record[channel])
        np.testing.assert_allclose(features.held[channel], held, rtol=0, atol=1e-12 * held.max())


def test_sections_are_those_of_the_paper():
    assert CHAIN.section_starts == list(range(0, 75001, 8250))
    assert CHAIN.section_length == 25000
    assert pytest.approx(1e5 / 2**17) == CHAIN.resolution


def test_mean_speed_equals_the_integral_of_speed():
    record = simulate(0.2)
    features = CHAIN.analyse(record[:3], record[4])
    first = np.searchsorted(np.arange(record.shape[1]) * 1e-5, 0.3, side="right")
    last = np.searchsorted(record[4], record[4][first] + 2 * np.pi * features.turns)
    mean = np.trapezoid(record[3][first : last + 1]) / (last - first)
    assert features.speed_mean == pytest.approx(mean, rel=1e-5)


def test_parseval():
    section = np.random.default_rng(1).normal(size=25000)
    _, power = CHAIN.section_spectrum(section)
    window = scipy.signal.windows.hann(25000, sym=True)
    assert power.sum() == pytest.approx(((window * section) ** 2).sum() / (window**2).sum(), rel=1e-12)


def test_power_of_a_tone_is_half_its_amplitude_squared():
    section = 3 * np.cos(2 * np.pi * 0.0712345 * np.arange(25000))
    _, power = CHAIN.section_spectrum(section)
    assert power.sum() == pytest.approx(4.5, rel=1e-9)


def test_power_spectrum_equals_scipy():
    section = np.random.default_rng(2).normal(size=25000)
    _, power = CHAIN.section_spectrum(section)
    _, density = scipy.signal.periodogram(
        section, fs=1e5, window=scipy.signal.windows.hann(25000, sym=True), nfft=PADDED, detrend=False
    )
    np.testing.assert_allclose(power, density * 1e5 / PADDED, rtol=0, atol=1e-12 * power.max())


@given(line=st.floats(50, 65000), amplitude=st.floats(1e-3, 1e3), phase=st.floats(0, 6.2))
@hypothesis_settings(max_examples=25, deadline=None)
def test_a_padded_tone_reads_within_its_scalloping_loss(line, amplitude, phase):
    """Padded 5.2 times, a tone is at most half a padded line off, where the window loses 0.55 %."""
    section = amplitude * np.cos(2 * np.pi * line / PADDED * np.arange(25000) + phase)
    spectrum, _ = CHAIN.section_spectrum(section)
    assert spectrum.max() == pytest.approx(amplitude, rel=6e-3)
    assert abs(int(spectrum.argmax()) - line) <= 0.6


def test_refusals_name_what_is_wrong():
    record = np.zeros((3, PAPER.samples))
    with pytest.raises(AnalysisError, match="2 currents"):
        CHAIN.analyse(record[:2])
    with pytest.raises(AnalysisError, match="99999 samples"):
        CHAIN.analyse(record[:, 1:])
    with pytest.raises(AnalysisError, match="differ in length"):
        CHAIN.analyse([record[0], record[1], record[2][1:]])
    record[2, 500] = np.inf
    with pytest.raises(AnalysisError, match=r"not a finite number at 0\.005"):
        CHAIN.analyse(record)
    with pytest.raises(AnalysisError, match="25000 samples"):
        CHAIN.section_spectrum(np.zeros(10))
    with pytest.raises(AnalysisError, match="overlap"):
        Chain(replace(PAPER, overlap=1.0))
    with pytest.raises(AnalysisError, match="padding is 'twice'"):
        Chain(replace(PAPER, padding="twice"))
