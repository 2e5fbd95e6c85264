"""Scores of hypotheses: what the recordings say of one without what is believed of the parameters."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.discovery.naming.comparison import score, told_by_data

SAMPLES = 1000


def fitted(data: float, pull: float) -> SimpleNamespace:
    """A fit of so much deviance of the data, and of the beliefs that its parameters have left."""
    return SimpleNamespace(
        deviance=lambda correlation: data + pull, counts=lambda: {"y": SAMPLES},
        estimate=SimpleNamespace(cost=data + pull, data_cost=data),
    )  # fmt: skip


def test_a_law_that_only_gives_a_parameter_back_its_belief_is_told_by_nothing_in_the_data() -> None:
    """A damper six sigmas from its belief, and a law that does what the damper does: the data is as before."""
    base, law = fitted(1200.0, 36.0), SimpleNamespace(fit=fitted(1199.0, 0.0), free=[1], pick=2.0)
    independent = {"y": 1.0}
    price = np.log(SAMPLES) + 2 * 2.0
    assert score(law, base, independent) == pytest.approx(-1.0 - 36.0 + price)
    assert told_by_data(law, base, independent) == pytest.approx(-1.0 + price)
