"""The filter and smoother of unknown efforts, against one dense solve by the definition."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import block_diag

from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.chains import Colour, Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.smoother import Whitener, courses
from lacuna.discovery.efforts.latent.thinned import thinned


def piece(n: int, missing: int = 0, scale: float = 1.0) -> Piece:
    """A random stable linear model of two states, two outputs and two columns; `missing` readings are left out."""
    random = np.random.default_rng(11 + n)
    along = Along(
        np.cumsum(random.uniform(0.5, 1.5, n)),
        0.8 * np.eye(2) + 0.1 * random.normal(size=(n - 1, 2, 2)),
        random.normal(size=(n - 1, 2, 2)),
        scale * random.normal(size=(n, 2, 2)),
        scale * random.normal(size=(n, 2, 2)),
        *(np.zeros((n, 2, 2)), np.zeros((2, 2), dtype=bool)),
        {},
    )
    data = scale * random.normal(size=(n, 2, 3))
    for k in random.choice(n, missing, replace=False):
        data[k, k % 2] = np.nan
    return Piece(along, data, scale * np.array([0.3, 0.7]), np.array([0.2, 0.0]))


def dense(p: Piece, latent: Latent) -> tuple[np.ndarray, np.ndarray]:
    """(covariance of the readings seen, that of the effort with them) by the definition, without any recursion."""
    apart = np.abs(np.subtract.outer(p.along.time, p.along.time))
    effort = latent.size[0] ** 2 * np.exp(-apart / latent.time[0])
    start, free = np.zeros((len(apart), 2, 2)), np.eye(2)
    for k in range(len(apart)):
        start[k] = p.along.read[k] @ free
        free = p.along.step[k] @ free if k < len(apart) - 1 else free
    seen = np.isfinite(p.data).all(axis=2)
    every, s = [answers(p, c)[seen] for c in latent.column[0]], start[seen]
    g = every[0]
    noise = np.broadcast_to(p.noise, seen.shape)[seen]
    cover = sum(g @ effort @ g.T for g in every) + s @ np.diag(p.start**2) @ s.T + np.diag(noise**2)
    when, output = np.nonzero(seen)
    apart = np.abs(np.subtract.outer(p.along.time[when], p.along.time[when]))
    own = latent.colour
    for sensor, size, time in zip(own.sensor, own.size[0], own.time[0], strict=True) if own else ():
        both = np.outer(output == sensor, output == sensor)
        cover += both * size**2 * np.exp(-apart / time)
    for j, column in enumerate(own.column if own and own.column is not None else ()):
        if column >= 0:
            other = answers(p, column)[seen]
            between = np.abs(np.subtract.outer(p.along.time, p.along.time))
            cover += own.size[0, j] ** 2 * other @ np.exp(-between / own.time[0, j]) @ other.T
    return cover, effort @ g.T


def answers(p: Piece, column: int) -> np.ndarray:
    """(n, y, n): readings to an effort in a column that is one at a single sample."""
    n = len(p.along.time)
    answer, state = np.zeros((n, 2, n)), np.zeros((2, n))
    for k in range(n):
        unit = np.eye(n)[k]
        answer[k] = p.along.read[k] @ state + np.outer(p.along.feed[k][:, column], unit)
        if k < n - 1:
            state = p.along.step[k] @ state + np.outer(p.along.drive[k][:, column], unit)
    return answer


LATENT = Latent(np.array([[1]]), np.array([-1]), np.array([0.8]), np.array([3.0]))
COLOUR = Colour(np.array([1, 0, 1]), np.array([[0.5, 0.2, 1.1]]), np.array([[2.0, 0.7, 40.0]]))
BOTH = replace(LATENT, column=np.array([[1, 0]]), colour=COLOUR)
TWO = replace(LATENT, colour=COLOUR.beside(Latent(np.array([[0]]), np.array([-1]), np.array([0.6]), np.array([5.0]))))


@pytest.mark.parametrize(
    "latent",
    [LATENT, replace(LATENT, colour=COLOUR), TWO, BOTH],
    ids=["white", "coloured", "beside another effort", "at two places, coloured"],
)
def test_the_smoother_equals_one_dense_solve(latent: Latent) -> None:
    pieces = [piece(30, missing=7), piece(21)]
    parts = [dense(p, latent) for p in pieces]
    rows = np.concatenate([p.data[np.isfinite(p.data).all(axis=2)] for p in pieces])
    noise = np.concatenate(
        [np.broadcast_to(p.noise, p.data.shape[:2])[np.isfinite(p.data).all(axis=2)] for p in pieces]
    )
    cover, residual, answers = block_diag(*(c for c, _ in parts)), rows[:, 0], -rows[:, 1:]
    whole = cover + answers @ answers.T
    log = -0.5 * (residual @ np.linalg.solve(whole, residual) + np.linalg.slogdet(whole)[1] - 2 * np.log(noise).sum())
    found = evidence(pieces, latent)
    assert found.log[0] == pytest.approx(log, rel=1e-9)
    mean = answers.T @ np.linalg.solve(whole, residual)
    np.testing.assert_allclose(found.mean[0], mean, rtol=1e-9)
    at = 0
    for (effort, error), (c, crossed) in zip(courses(pieces, latent, mean), parts, strict=True):
        left = (residual - answers @ mean)[at : at + len(c)]
        np.testing.assert_allclose(effort, crossed @ np.linalg.solve(c, left), rtol=1e-8, atol=1e-10)
        variance = latent.size[0] ** 2 - np.sum(crossed * np.linalg.solve(c, crossed.T).T, axis=1)
        np.testing.assert_allclose(error**2, variance, rtol=1e-7)
        at += len(c)


def test_hypotheses_of_several_widths_side_by_side_are_each_by_itself() -> None:
    none = Latent(np.array([[-1]]), np.array([1]), np.array([0.4]), np.array([2.0]))
    alone = [LATENT, BOTH.of([0]), none]
    alone = [replace(x, colour=COLOUR) for x in alone]
    column = np.array([[1, -1], [1, 0], [-1, -1]])
    fields = (np.concatenate([getattr(x, f) for x in alone]) for f in ("sensor", "size", "time"))
    beside = Latent(column, *fields, COLOUR.of([0, 0, 0]))
    pieces = [piece(30, missing=7), piece(21)]
    np.testing.assert_allclose(evidence(pieces, beside).log, [evidence(pieces, x).log[0] for x in alone], rtol=1e-12)


def test_whitened_columns_make_the_dense_gram_matrix() -> None:
    p = piece(25, missing=5)
    cover, _ = dense(p, LATENT)
    rows = p.data[np.isfinite(p.data).all(axis=2)]
    white = Whitener([p], LATENT)([p.data])
    np.testing.assert_allclose(white.T @ white, rows.T @ np.linalg.solve(cover, rows), rtol=1e-9)


def test_other_units_and_readings_at_other_rates_change_nothing() -> None:
    """Outputs in thousandths; and an output that is read at every third sample only, with or without its empty rows."""
    assert evidence([piece(30, 4, 1e3)], LATENT).log == pytest.approx(evidence([piece(30, 4)], LATENT).log, rel=1e-9)
    sparse = piece(30)
    sparse.data[np.arange(30) % 3 != 0, 1] = np.nan
    cover, _ = dense(sparse, LATENT)
    assert len(cover) == 40
    rows = sparse.data[np.isfinite(sparse.data).all(axis=2)]
    white = Whitener([sparse], LATENT)([sparse.data])
    np.testing.assert_allclose(white.T @ white, rows.T @ np.linalg.solve(cover, rows), rtol=1e-9)


def test_a_model_without_states_is_thinned_too() -> None:
    """As a device whose motion is imposed: its readings follow the effort at once."""
    p, none = piece(7), np.zeros((7, 0, 0))
    still = replace(p.along, step=none, drive=np.zeros((7, 0, 2)), read=np.zeros((7, 2, 0)))
    thin = thinned(replace(p, along=still, start=np.zeros(0)), 3)
    np.testing.assert_array_equal(thin.data, p.data[::3])
    assert thin.along.step.shape == (2, 0, 0)


def test_an_effort_of_no_size_is_none() -> None:
    none = Latent(np.array([[-1]]), np.array([-1]), np.array([0.0]), np.array([1.0]))
    p = piece(12)
    p.start[:] = 0.0
    p.data = p.data[:, :, :1]
    assert evidence([p], none).log[0] == pytest.approx(-0.5 * np.sum((p.data[:, :, 0] / p.noise) ** 2), rel=1e-12)
