"""Channels whose samples are taken early or late, as instruments are read: to first order, beside the parameters.

A channel that a logger reads a little before or after the others errs by its slope. That is no physics of the machine,
but a law may say it as well: an input that comes late, where one output is read early.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.latent.chains import Piece
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.fit.evidence import INSTRUMENTS


def with_clocks(locator: Locator) -> list[Piece]:
    """The pieces of a locator with a further parameter for each output, the same one in all recordings: what its
    samples are late by, believed to move it by as much as instruments are off by (RMS, beside their noise)."""
    slopes = [_slopes(locator, k) for k in range(len(locator.pieces))]
    power = np.nanmean(np.concatenate(slopes) ** 2, axis=0)
    late = np.sqrt(INSTRUMENTS**2 - 1.0) * locator.noise / np.sqrt(np.where(power > 0, power, np.inf))  # s
    return [
        replace(p, data=np.concatenate([p.data, np.nan_to_num(s * late)[:, :, None] * np.eye(len(late))], axis=2))
        for p, s in zip(locator.pieces, slopes, strict=True)
    ]


def _slopes(locator: Locator, number: int) -> np.ndarray:
    """(n, outputs) what each output rises by in a second on a recording, as it is simulated; nan where none is."""
    piece, recording = locator.pieces[number], locator.case.fit[number]
    result = np.full(piece.data.shape[:2], np.nan)
    for k, signal in enumerate(locator.case.outputs):
        simulated = recording.columns[signal.column] - piece.data[:, k, 0]
        seen = np.flatnonzero(np.isfinite(simulated))
        if len(seen) > 1:
            result[seen, k] = np.gradient(simulated[seen], piece.along.time[seen])
    return result
