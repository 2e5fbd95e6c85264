"""A long Monte Carlo of the filter's own model: bootstrap particles over every law, shape, noise, common error and
rate.

Slow and plain, and written from the model alone: growth in small steps, no derivative, no Gaussian.
"""

from __future__ import annotations

import numpy as np


def posterior(bank, use, value, sd, interval, *, count=200_000, steps=6, seed=0):
    """Particles (law row, x, ln r, wander^2, diffusion^2, common) after all tests, equally weighted."""
    random, settings = np.random.default_rng(seed), bank.settings
    s, k = bank.prior.shape[0], bank.prior.shape[2]
    pick = random.choice(s * k, count, p=bank.prior.ravel() / bank.prior.sum())
    law, place = np.divmod(pick, k)
    rates = np.repeat(bank.log_lives, bank.shape[1] * bank.shape[2])
    x = settings.first[0] + settings.first[1] * random.standard_normal(count)
    ln_r = np.log(bank.life[law, 0, 0]) - rates[place] - np.log(interval) + bank.spread * random.standard_normal(count)
    state = [law, place, x, ln_r]
    before = 0.0
    for n, y in zip(use, value, strict=True):
        law, place = state[:2]
        changed = random.random(count) < bank.change[law, 0, place]
        state[3] = state[3] + changed * settings.change_size * random.standard_normal(count)
        state = grow(bank, state, n - before, steps, random)
        before = n
        law, place, x, ln_r = state
        variance = (1 - bank.common[law, 0, place]) * sd**2
        weight = sum(
            share * np.exp(-0.5 * (y - x) ** 2 / v) / np.sqrt(2 * np.pi * v)
            for share, v in (
                (1 - settings.wide - settings.outlier, variance),
                (settings.wide, settings.wide_scale**2 * variance),
            )
        )
        weight = weight + settings.outlier / settings.outlier_range
        chosen = np.searchsorted(np.cumsum(weight / weight.sum()), (np.arange(count) + random.random()) / count)
        state = [a[np.minimum(chosen, count - 1)] for a in state]
    return state


def grow(bank, state, use, steps, random):
    law, place, x, ln_r = state
    wander2, diffusion2 = bank.wander2[law, 0, place], bank.diffusion2[law, 0, place]
    for _ in range(steps):
        moved = np.exp(ln_r) * use / steps
        new = np.empty_like(x)
        for s, table in enumerate(bank.tables):
            mine = law == s
            new[mine] = table.severity(table.age(x[mine]) + moved[mine])
        x = new + np.sqrt(diffusion2 * np.maximum(new - x, 0)) * random.standard_normal(len(x))
        ln_r = ln_r + np.sqrt(wander2 * np.minimum(moved / bank.life[law, 0, 0], 1)) * random.standard_normal(len(x))
    return [law, place, x, ln_r]


def remaining(bank, state, sd, ahead, seed=1):
    """Share of the particles whose limit (shifted by the common error) is reached within each of `ahead`, rising."""
    random = np.random.default_rng(seed)
    law, place, x, _ = state
    edge = 1 + np.sqrt(bank.common[law, 0, place]) * sd * random.standard_normal(len(x))
    reached, shares, before = x >= edge, [], 0.0
    for n in ahead:
        state = grow(bank, state, n - before, 4, random)
        reached |= state[2] >= edge
        shares.append(reached.mean())
        before = n
    return np.array(shares)
