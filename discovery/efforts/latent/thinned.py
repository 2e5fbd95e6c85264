"""Recordings with fewer samples: what many hypotheses are weighed on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.latent.chains import Piece
from lacuna.discovery.fit.evidence import LEFT

SAMPLES = 1500, 6000  # of all recordings together, that hypotheses are weighed on: few, and most


def thinned_all(pieces: list[Piece], samples: tuple[int, int] = SAMPLES) -> list[Piece]:
    """The recordings with so few samples that a search over many hypotheses is quick; with more, up to the second
    number, where the misfit lives between those: a resonance, a commutation."""
    count = sum(len(p.along.time) for p in pieces)
    every, least = (-(-count // n) for n in samples)
    while every > least and not all(_follows(p, every) for p in pieces):
        every = max(every // 2, least)
    return [thinned(p, every) for p in pieces]


def _follows(piece: Piece, every: int) -> bool:
    """Whether the misfit is linear between every so many samples, but for noise, which leaves a power of 1.5 there."""
    left = piece.data[:, :, 0] / piece.noise
    if len(left) <= 2 * every:
        return True
    between = left[every:-every] - (left[: -2 * every] + left[2 * every :]) / 2
    seen = np.isfinite(between)
    power = np.sum(np.where(seen, between, 0.0) ** 2, axis=0) / np.maximum(seen.sum(axis=0), 1)
    return bool(np.all(power < 1.5 * LEFT**2))


def thinned(piece: Piece, every: int) -> Piece:
    """The same with one sample in `every`, efforts held in between; no more is lost than the readings left out."""
    if every <= 1:
        return piece
    along, n = piece.along, len(piece.along.time)
    kept = np.arange(0, n, every)
    begins = kept[:-1]
    step, drive = along.step[begins], along.drive[begins]
    for k in range(1, every):
        step, drive = along.step[begins + k] @ step, along.step[begins + k] @ drive + along.drive[begins + k]
    thin = replace(
        along, time=along.time[kept], step=step, drive=drive, read=along.read[kept], feed=along.feed[kept],
        direct=along.direct[kept],
    )  # fmt: skip
    return Piece(thin, piece.data[kept], piece.noise, piece.start)
