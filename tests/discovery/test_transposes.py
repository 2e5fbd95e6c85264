"""Regressions on an effort without the columns of all that is tried: products by transposes, block by block."""

from dataclasses import replace

import numpy as np
import pytest

from lacuna.discovery.efforts.guide import Guided
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.smoother import Whitener
from lacuna.discovery.efforts.latent.thinned import thinned
from lacuna.discovery.efforts.laws.regression import BLOCK, DISCREPANCIES, Regression
from lacuna.discovery.efforts.places.sites import Site as Place
from lacuna.discovery.law.law import Site
from lacuna.discovery.law.terms.courses import evaluate
from lacuna.discovery.law.terms.law_terms import Group, Variable

from .test_efforts import DATA
from .test_latent import LATENT, TWO, piece


@pytest.mark.parametrize("latent", [LATENT, TWO], ids=["white", "beside another effort"])
@pytest.mark.parametrize("every", [1, 3])
def test_products_with_whitened_responses_are_those_with_the_courses(latent: Latent, every: int) -> None:
    """The transposes of the filter and of the response, on recordings with readings missing."""
    pieces = [piece(30, missing=7), piece(21)]
    thin = [thinned(p, every) for p in pieces]
    courses = [DATA.normal(size=(len(p.along.time), 4)) for p in pieces]
    white = Whitener(thin, latent)
    rows = white([p.along.response(1, c, every=every) for p, c in zip(pieces, courses, strict=True)])
    bases = DATA.normal(size=(len(rows), 3))
    turned = [p.along.response_transposed(1, r, every) for p, r in zip(pieces, white.transposed(bases), strict=True)]
    products = sum(t.T @ c for t, c in zip(turned, courses, strict=True))
    np.testing.assert_allclose(products, bases.T @ rows, rtol=1e-9, atol=1e-9)


def test_a_regression_equals_least_squares_on_all_columns_at_once() -> None:
    """More terms than a block has, alone and beside others, one of which is in both; and one that is zero."""
    pieces = [_moving(piece(40, missing=7)), _moving(piece(35))]
    groups = [Group(("1",)), Group(("x1", "x1^2")), Group(("0*x1",)), Group(("x1", "x1^3"))]
    groups += [Group((f"sin({k}*x1)", f"cos({k}*x1)")) for k in range(1, BLOCK)]
    site = Site(Place("equation", "x = 1"), "here", "1", (Variable("x1", "x", "1", "state", 1.0),), (1, 1))
    regression = Regression(Guided({}, pieces, [], np.zeros(2), LATENT), site, [1])
    every = regression.add(groups)
    several = [(0,), (1,), (9,)]
    found = regression._deviances(several, every)
    _strains_are_those_of_the_columns(regression, [(a, b) for (a,) in several for b in (0, 1, 3, 30) if a != b])
    for k, share in enumerate(DISCREPANCIES):
        white = Whitener(pieces, replace(LATENT, size=share * LATENT.size))
        data = white([p.data for p in pieces])
        belief = np.vstack([-data[:, 1:], np.eye(2)])
        target = np.concatenate([data[:, 0], np.zeros(2)])
        for number, chosen in enumerate([(), *several]):
            deviances = regression.alone[k] if number == 0 else found[number - 1, k]
            for other in (0, 1, 2, 3, 30, BLOCK):
                texts = [text for g in (*chosen, other) for text in groups[g].texts]
                columns = np.column_stack([white([_answer(p, text) for p in pieces]) for text in texts])
                columns = np.vstack([columns, np.zeros((2, len(texts)))])
                matrix = np.column_stack([belief, columns])
                left = target - matrix @ np.linalg.lstsq(matrix, target, rcond=1e-10)[0]
                assert deviances[other] == pytest.approx(left @ left + white.logdet, rel=1e-6)


def _strains_are_those_of_the_columns(regression: Regression, pairs: list[tuple[int, int]]) -> None:
    """In either order; where a pair was not looked at, its columns are found."""
    known = [regression.strain(pair) for pair in pairs] + [regression.strain(pair[::-1]) for pair in pairs]
    ones = [regression.strain((g,)) for g in (0, 2)]
    regression.forget()
    regression._strains.clear()
    assert known == pytest.approx([regression.strain(pair) for pair in pairs] * 2, rel=1e-6)
    assert ones == pytest.approx([regression.strain((g,)) for g in (0, 2)], rel=1e-6)


def _moving(p: Piece) -> Piece:
    return replace(p, along=replace(p.along, values={"x": DATA.uniform(-1, 1, len(p.along.time))}))


def _answer(p: Piece, text: str) -> np.ndarray:
    course = evaluate(text, {"x1": p.along.values["x"], "time": p.along.time}, {"x1": 1.0})
    return p.along.response(1, course[:, None])
