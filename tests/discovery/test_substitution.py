"""Equations solved block by block are those solved whole; what cancels, or stands nowhere, is exactly zero."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.codegen.symbolic.expr import Expr, var
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.latent.substitution import Substitution

SAMPLES = 5


def sparse(rng: np.random.Generator, size: int) -> tuple[list[dict[int, Expr]], dict[Expr, np.ndarray], np.ndarray]:
    """(rows, course of each coefficient, (samples, size, size) the same matrix): loops of up to three unknowns, each
    fed by some of those before it, rows and unknowns in any order."""
    whole = np.zeros((SAMPLES, size, size))
    for k in range(size):
        start = 3 * (k // 3)
        for j in [*rng.integers(0, max(start, 1), 2), *range(start, min(start + 3, size))]:
            whole[:, k, j] = rng.standard_normal(SAMPLES)
        whole[:, k, k] += 4.0
    whole = whole[:, rng.permutation(size)][:, :, rng.permutation(size)]
    rows: list[dict[int, Expr]] = [{} for _ in range(size)]
    courses = {}
    for r, c in zip(*np.nonzero(np.any(whole != 0, axis=0)), strict=True):
        rows[r][int(c)] = entry = var(f"a_{r}_{c}")
        courses[entry] = whole[:, r, c]
    return rows, courses, whole


@pytest.mark.parametrize("seed", range(20))
def test_block_by_block_is_as_a_whole(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows, courses, whole = sparse(rng, 14)
    right = np.where(rng.random((14, 6)) < 0.2, 1.0, 0.0) * rng.standard_normal((SAMPLES, 14, 6))
    known = [{c: right[:, r, c] for c in range(6) if np.any(right[:, r, c])} for r in range(14)]
    answers = Substitution(rows).solve(courses.__getitem__, known, SAMPLES, range(2, 6))
    told = np.zeros((SAMPLES, 14, 6))
    for u, answer in enumerate(answers):
        told[:, u, answer.columns] = answer.values.T
    assert told == pytest.approx(-np.linalg.solve(whole, right), rel=1e-9, abs=1e-12)


def test_what_cancels_is_zero_where_that_is_wanted() -> None:
    """u0 = 0.1 q, u1 = 0.3 q, u2 = 3 u0 - u1, which rounding keeps from zero."""
    names = {n: var(n) for n in ("one", "minus_three")}
    courses = {names["one"]: np.ones(SAMPLES), names["minus_three"]: np.full(SAMPLES, -3.0)}
    rows = [{0: names["one"]}, {1: names["one"]}, {0: names["minus_three"], 1: names["one"], 2: names["one"]}]
    known = [{0: np.full(SAMPLES, -0.1)}, {0: np.full(SAMPLES, -0.3)}, {}]
    assert len(Substitution(rows).solve(courses.__getitem__, known, SAMPLES, range(1))[2].columns) == 0
    rounded = Substitution(rows).solve(courses.__getitem__, known, SAMPLES)[2]
    assert np.abs(rounded.values).max() < 1e-15


def test_singular_equations_are_refused() -> None:
    a = var("a")
    with pytest.raises(NotNumeric, match="cannot be assigned"):
        Substitution([{0: a}, {0: a}])
    with pytest.raises(np.linalg.LinAlgError):
        Substitution([{0: a}]).solve({a: np.array([1.0, 0.0])}.__getitem__, [{0: np.ones(2)}], 2)
