"""The severity and its rate at every test, given all tests: Rauch, Tung, Striebel 1965, hypothesis by hypothesis.

The smoothed Gaussians are weighed as the last test weighs their hypotheses. The linearisation is the filter's own.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lacuna.analysis.prognosis.filter.bank import Bank, Beliefs, in_use
from lacuna.analysis.prognosis.filter.filter import Step


def smooth(bank: Bank, steps: Sequence[Step]) -> tuple[np.ndarray, np.ndarray]:
    """(means, covariances) [n, S, B, K, 2] and [n, S, B, K, 2, 2] of (x, ln r) after each test."""
    means = [_mean(steps[-1].filtered)]
    covariances = [_covariance(steps[-1].filtered)]
    for step, following in zip(reversed(steps[:-1]), reversed(steps[1:]), strict=True):
        along, turn = following.slope
        one = np.ones_like(along)
        slope = np.stack([np.stack([along, turn], -1), np.stack([0 * one, one], -1)], -2)
        p, predicted = _covariance(step.filtered), _covariance(following.predicted)
        gain = p @ slope.swapaxes(-1, -2) @ _inverse(predicted)
        means.append(_mean(step.filtered) + (gain @ (means[-1] - _mean(following.predicted))[..., None])[..., 0])
        covariances.append(p + gain @ (covariances[-1] - predicted) @ gain.swapaxes(-1, -2))
    return np.array(means[::-1]), np.array(covariances[::-1])


def tracked(bank: Bank, steps: Sequence[Step]) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation [n, B] of the severity (share of the limit) at each test, over all hypotheses."""
    means, covariances = smooth(bank, steps)
    w = in_use(steps[-1].filtered.w)
    mean = (w * means[..., 0]).sum(axis=(1, 3))
    spread = covariances[..., 0, 0] + (means[..., 0] - mean[:, None, :, None]) ** 2
    return mean, np.sqrt(np.maximum((w * spread).sum(axis=(1, 3)), 0))


def _mean(b: Beliefs) -> np.ndarray:
    return np.stack([b.x, b.l], axis=-1)


def _covariance(b: Beliefs) -> np.ndarray:
    return np.stack([np.stack([b.xx, b.xl], -1), np.stack([b.xl, b.ll], -1)], -2)


def _inverse(p: np.ndarray) -> np.ndarray:
    """Of 2 x 2 matrices; a direction without variance gets none back."""
    determinant = p[..., 0, 0] * p[..., 1, 1] - p[..., 0, 1] ** 2
    adjugate = np.stack(
        [np.stack([p[..., 1, 1], -p[..., 0, 1]], -1), np.stack([-p[..., 0, 1], p[..., 0, 0]], -1)], -2
    )  # fmt: skip
    floor = 1e-14 * p[..., 0, 0] * p[..., 1, 1] + 1e-300
    return adjugate / np.maximum(determinant, floor)[..., None, None]
