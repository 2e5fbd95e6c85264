"""Waveforms of the proof's experiments. Every one starts with a moment at zero, as a recording from rest does."""

from collections.abc import Callable

import numpy as np

Wave = Callable[[np.random.Generator, np.ndarray, float], np.ndarray]  # (rng, time, amplitude) -> values


def _after(t: np.ndarray, start: float, values: np.ndarray) -> np.ndarray:
    return np.where(t >= start, values, 0.0)


def sines(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Bursts of whole sines of rising amplitude with rests between them, as when friction is looked for."""
    bursts, y, start = 3, np.zeros_like(t), 0.1
    share = (t[-1] - start) / bursts
    for k in range(bursts):
        size = amplitude * (0.2, 0.5, 1.0)[k] * rng.uniform(0.8, 1.1)
        periods = rng.integers(1, 4)
        length = share * rng.uniform(0.75, 0.9)
        phase = (t - start) / length
        y += np.where((phase >= 0) & (phase < 1), size * np.sin(2 * np.pi * periods * phase), 0.0)
        start += share
    return y


def triangle(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """A slow triangle: every level and every reversal passed at a constant rate."""
    period = t[-1] * rng.uniform(0.45, 0.7)
    x = ((t - 0.1) / period) % 1.0
    return _after(t, 0.1, 0.45 * amplitude * np.interp(x, [0, 0.25, 0.75, 1], [0, 1, -1, 0]))


def stairs(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Up, down through zero and back, in steps of unequal height."""
    up = np.sort(rng.uniform(0.2, 1.0, 3))
    down = -np.sort(rng.uniform(0.2, 1.0, 3))[::-1]
    levels = amplitude * np.concatenate([up, up[:1], down[::-1], [0.0]])
    edges = 0.1 + np.arange(len(levels)) * (t[-1] - 0.1) / len(levels)
    index = np.searchsorted(edges, t, side="right") - 1
    return np.where(index >= 0, levels[np.maximum(index, 0)], 0.0)


def steps(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Random levels of random length, with some rests."""
    y, start = np.zeros_like(t), 0.1
    while start < t[-1]:
        length = t[-1] * rng.uniform(0.08, 0.18)
        level = 0.0 if rng.random() < 0.15 else amplitude * rng.uniform(0.25, 1.0) * rng.choice([-1, 1])
        y[(t >= start) & (t < start + length)] = level
        start += length
    return y


def chirp(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """A sine whose frequency rises, faded in."""
    low, high = rng.uniform(1.5, 2.5) / t[-1], rng.uniform(25, 45) / t[-1]
    x = np.maximum(t - 0.1, 0)
    phase = 2 * np.pi * low * t[-1] / np.log(high / low) * (np.exp(x / t[-1] * np.log(high / low)) - 1)
    return 0.6 * amplitude * np.clip(x / 0.3, 0, 1) * np.sin(phase)


def multisine(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Six incommensurate tones with random phases, faded in."""
    f = np.geomspace(1.5, 30, 6) / t[-1] * rng.uniform(0.9, 1.1, 6)
    y = sum(np.sin(2 * np.pi * fk * t + rng.uniform(0, 2 * np.pi)) / (1 + 0.15 * k) for k, fk in enumerate(f))
    return 0.75 * amplitude * np.clip((t - 0.1) / 0.2, 0, 1) * y / np.max(np.abs(y))


def one_way(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Up to one level and held: an experiment that never reverses, and cannot tell a friction from a load."""
    return amplitude * rng.uniform(0.55, 0.65) * np.clip((t - 0.1) / 0.4, 0, 1)


def ramp_bus(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """A supply voltage that rises slowly from zero, and falls faster."""
    end = t[-1]
    peak = rng.uniform(0.55, 0.65) * end
    return amplitude * np.interp(t, [0, 0.03 * end, peak, 0.9 * end, end], [0, 0, 1.0, 0, 0])


def stairs_bus(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Levels of the supply between half and full, zero at both ends."""
    levels = amplitude * rng.uniform(0.5, 1.0, 9)
    edges = np.linspace(0.025, 0.94, 10) * t[-1]
    index = np.searchsorted(edges, t, side="right") - 1
    return np.where((index >= 0) & (index < 9), levels[np.clip(index, 0, 8)], 0.0)


def sweep_bus(rng: np.random.Generator, t: np.ndarray, amplitude: float) -> np.ndarray:
    """A supply with a chirp on it."""
    end = t[-1]
    ripple = np.sin(2 * np.pi * (2 * t / end + 7 * (t / end) ** 2))
    level = amplitude * (0.7 + rng.uniform(0.15, 0.25) * ripple * (t > 0.12 * end))
    return np.where((t > 0.025 * end) & (t < 0.95 * end), level, 0.0)


def reversals(rng: np.random.Generator, t: np.ndarray) -> np.ndarray:
    """A commutation direction that changes four times."""
    edges = np.sort((np.arange(5) + rng.uniform(0.8, 1.2, 5)) / 6) * t[-1]
    return np.where(np.searchsorted(edges, t, side="right") % 2 == 0, 1.0, -1.0)


OPEN_LOOP: tuple[Wave, ...] = (sines, triangle, stairs, steps)
VALIDATION: tuple[Wave, ...] = (chirp, multisine, steps)
BUS: tuple[Wave, ...] = (stairs_bus, ramp_bus, stairs_bus)
