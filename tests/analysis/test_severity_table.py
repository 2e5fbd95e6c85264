"""The severity table: its file survives nothing but itself, and its estimate is the least-squares one."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.severity_table import SeverityTable, TableContents, table_bytes
from lacuna.analysis.spectra.chain import Chain, signature
from tests.analysis.reference import simulate

SIGMA = 0.01


@pytest.fixture(scope="module")
def features():
    record = simulate(0.1)
    return Chain(load_settings()).analyse(record[:3], record[4])


@pytest.fixture(scope="module")
def contents(features):
    """A map that is linear in severity and equally uncertain; the signature of `features` lies on it at 20 %."""
    severity = np.linspace(0, 0.5, 51)
    direction = np.linspace(-1, 1, 16)
    return TableContents(
        channels=3,
        sections=(100000, 25000, 8250, 131072),
        sampling_rate=1e5,
        peak_rule=(5.0, 0.1),
        speed_after=0.3,
        misfit_limit=30.0,
        severity=severity,
        rms_mean=features.rms_mean + (severity - 0.3),
        signature=(signature(features) + np.outer(severity - 0.2, direction))[None],
        covariance=np.tile(SIGMA**2 * np.eye(16), (1, 51, 1, 1)),
        bands=[("green", 0.0, 0.1), ("orange", 0.11, 0.26), ("red", 0.27, 0.5)],
    )


def table(tmp_path, contents) -> SeverityTable:
    (tmp_path / "table").write_bytes(table_bytes(contents))
    return SeverityTable(tmp_path / "table")


def test_estimate_is_where_the_signature_lies(tmp_path, contents, features):
    found = table(tmp_path, contents).estimate(features)
    information = (np.linspace(-1, 1, 16) ** 2).sum() / SIGMA**2
    assert found.severity == pytest.approx(0.2, abs=1e-9)
    assert found.high - found.severity == pytest.approx(1.959964 / np.sqrt(information), rel=1e-6)
    assert found.misfit == pytest.approx(0, abs=1e-6)
    assert found.band == 1 and found.covered
    assert found.paper == pytest.approx(0.3, abs=1e-9)


def test_estimate_is_the_weighted_least_squares_one(tmp_path, contents, features):
    random = np.random.default_rng(4)
    root = random.normal(size=(16, 16)) * SIGMA
    covariance = root @ root.T + SIGMA**2 * np.eye(16)
    offset = SIGMA * random.normal(size=16)
    moved = replace(contents, signature=contents.signature - offset, covariance=np.tile(covariance, (1, 51, 1, 1)))
    found = table(tmp_path, moved).estimate(features)
    direction, inverse = np.linspace(-1, 1, 16), np.linalg.inv(covariance)
    step = direction @ inverse @ offset / (direction @ inverse @ direction)
    rest = offset - step * direction
    assert found.severity == pytest.approx(0.2 + step, abs=1e-9)
    assert found.misfit == pytest.approx(rest @ inverse @ rest, rel=1e-6)


def test_conditions_are_weighted_by_their_likelihood(tmp_path, contents, features):
    """Two equally likely conditions that read 2 points apart: their mean, and an interval that spans both."""
    apart = 0.01 * np.linspace(-1, 1, 16)
    both = np.concatenate([contents.signature - apart, contents.signature + apart])
    two = replace(contents, signature=both, covariance=np.tile(contents.covariance, (2, 1, 1, 1)))
    found = table(tmp_path, two).estimate(features)
    within = SIGMA**2 / (np.linspace(-1, 1, 16) ** 2).sum()
    assert found.severity == pytest.approx(0.2, abs=1e-9)
    assert found.high - 0.2 == pytest.approx(1.959964 * np.sqrt(within + 0.01**2), rel=1e-6)
    far = replace(two, signature=np.concatenate([contents.signature, contents.signature + 1.0]))
    assert table(tmp_path, far).estimate(features).severity == pytest.approx(0.2, abs=1e-9)


def test_what_lies_off_the_map_is_not_covered(tmp_path, contents, features):
    off = np.zeros(16)
    off[7] = 10 * SIGMA
    found = table(tmp_path, replace(contents, signature=contents.signature + off)).estimate(features)
    assert found.misfit > 90 and not found.covered


def test_the_ends_of_the_map_are_not_passed(tmp_path, contents, features):
    beyond = contents.signature + 0.3 * np.linspace(-1, 1, 16)
    found = table(tmp_path, replace(contents, signature=beyond)).estimate(features)
    assert found.severity == 0.0 and found.low == 0.0


def test_mean_rms_is_read_back_monotonously(tmp_path, contents, features):
    """Near zero severity the curve first falls: what lies below its beginning is no severity."""
    dip = contents.rms_mean.copy()
    dip[:3] = dip[3], dip[3] - 0.01, dip[3] - 0.005
    found = table(tmp_path, replace(contents, rms_mean=dip + 0.28)).estimate(features)
    assert found.paper == 0.0


def test_a_singular_covariance_is_refused(contents):
    with pytest.raises(AnalysisError, match="singular"):
        table_bytes(replace(contents, covariance=np.zeros((1, 51, 16, 16))))


@given(data=st.data())
@hypothesis_settings(max_examples=200, deadline=None)
def test_a_harmed_file_is_refused(tmp_path_factory, contents, data):
    """Truncated, or any byte changed, or bytes added: an error, never another table."""
    good = table_bytes(contents)
    kind = data.draw(st.sampled_from(["cut", "change", "extend"]))
    place = data.draw(st.integers(0, len(good) - 1))
    if kind == "cut":
        harmed = good[:place]
    elif kind == "change":
        harmed = good[:place] + bytes([good[place] ^ data.draw(st.integers(1, 255))]) + good[place + 1 :]
    else:
        harmed = good + data.draw(st.binary(min_size=1, max_size=50))
    path = tmp_path_factory.getbasetemp() / "harmed.table"
    path.write_bytes(harmed)
    with pytest.raises(AnalysisError, match="severity table"):
        SeverityTable(path)


@pytest.mark.parametrize(
    "change",
    [
        {"severity": np.zeros(51)},
        {"rms_mean": np.full(51, np.nan)},
        {"sections": (100000, 200000, 8250, 131072)},
        {"sections": (100000, 25000, 0, 131072)},
        {"channels": 7},
        {"sampling_rate": -1.0},
    ],
)
def test_a_senseless_table_is_refused_even_with_a_right_checksum(tmp_path, contents, change):
    with pytest.raises(AnalysisError, match="severity table"):
        table(tmp_path, replace(contents, **change))


def test_a_missing_table_says_what_to_do(tmp_path):
    with pytest.raises(AnalysisError, match="not prepared"):
        SeverityTable(tmp_path / "none.table")
