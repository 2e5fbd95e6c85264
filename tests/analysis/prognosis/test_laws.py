"""Degradation laws: the models of the catalogue against their closed forms, and a user's own."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.filter.law import Law, LawTable, prior, severities
from lacuna.degradation import degradation_laws

X = severities()
CLOSED = {
    "linear": 1 + 0 * X,
    "exponential": X,
    "crack, m = 2": X**2,
    "archard, load = 4": 1 + 4 * X,
    "friction, level = 1.2": np.maximum(1 - X / 1.2, 0),
    "winding, rise = 20": np.exp(11600 / 373.15 - 11600 / (373.15 + 20 * X)),
}
AGES = {
    "linear": lambda a, b: b - a,
    "exponential": lambda a, b: np.log(b / a),
    "crack, m = 2": lambda a, b: 1 / a - 1 / b,
    "archard, load = 4": lambda a, b: np.log((1 + 4 * b) / (1 + 4 * a)) / 4,
    "friction, level = 1.2": lambda a, b: 1.2 * np.log((1.2 - a) / (1.2 - b)),
}


@pytest.fixture(scope="module")
def catalogue():
    return {law.label: law for law in degradation_laws()}


@pytest.mark.parametrize("label", CLOSED)
def test_the_models_are_their_closed_forms(catalogue, label):
    assert catalogue[label].growth == pytest.approx(CLOSED[label], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("label", AGES)
def test_ages_are_integrals_of_the_equation(catalogue, label):
    """The table's error is that of powers between points 2 % apart, and of linear interpolation in between."""
    found = LawTable(catalogue[label])
    for a, b in ((0.02, 0.2), (0.1, 1.0), (0.33, 0.34)):
        assert found.age(b) - found.age(a) == pytest.approx(AGES[label](a, b), rel=5e-3 if b - a < 0.05 else 1e-3)


def test_age_and_severity_are_inverse_everywhere(catalogue):
    at = np.array([-0.3, 0.0, 5e-4, 0.01, 0.3, 1.0, 1.9, 2.5])
    for law in catalogue.values():
        found = LawTable(law)
        assert found.severity(found.age(at)) == pytest.approx(at, abs=1e-7)
        assert found.life > 0


def test_every_law_weighs_alike_before_the_first_test(catalogue):
    laws = list(catalogue.values())
    weights = prior(laws)
    by_name = {
        n: sum(w for law, w in zip(laws, weights, strict=True) if law.name == n) for n in {law.name for law in laws}
    }
    assert sum(weights) == pytest.approx(1) and list(by_name.values()) == pytest.approx(
        [1 / len(by_name)] * len(by_name)
    )
    assert all(law.reference and law.title for law in laws)


OWN = """model Corrosion "Pitting that slows as its products cover it"
  extends Lacuna.Interfaces.PartialLaw;
  parameter Lacuna.Types.RateOfUse k = 0.01;
  parameter Real n = 0.5;
equation
  der(severity) = {equation};
  annotation(__Lacuna({annotation}));
end Corrosion;
"""
ANNOTATION = 'law="corrosion", rate="k", shapes(n={0.5, 1}), wander=0.2'


def own(tmp_path, equation="k/(0.1 + severity)^n", annotation=ANNOTATION):
    path = tmp_path / "Corrosion.mo"
    path.write_text(OWN.replace("{equation}", equation).replace("{annotation}", annotation))
    return path


def test_a_users_law_is_one_more_file(tmp_path):
    laws = {law.label: law for law in degradation_laws([own(tmp_path)])}
    assert laws["corrosion, n = 0.5"].growth == pytest.approx((0.1 + X) ** -0.5, rel=1e-9)
    assert laws["corrosion, n = 1"].wander == 0.2
    assert len(laws) == len(degradation_laws()) + 2


@pytest.mark.parametrize(
    ("equation", "annotation", "message"),
    [
        ("k*severity + 0.001", ANNOTATION, "not proportional to its rate k"),
        ("-k*severity", ANNOTATION, "not negative"),
        ("k", 'law="corrosion"', "needs law and rate"),
        ("k", 'law="corrosion", rate="k", colour="red"', "does not know colour"),
        ("k", 'law="linear", rate="k"', "already a law"),
        ("k", 'law="corrosion", rate="k", wander=-1', "standard deviations"),
    ],
)
def test_what_is_no_law_is_refused(tmp_path, equation, annotation, message):
    with pytest.raises(AnalysisError, match=message):
        degradation_laws([own(tmp_path, equation, annotation)])


def test_a_folder_without_laws_is_refused(tmp_path):
    with pytest.raises(AnalysisError, match=r"no \.mo file"):
        degradation_laws([tmp_path])


def test_a_model_that_is_no_law_is_refused(tmp_path):
    (tmp_path / "Decay.mo").write_text("model Decay\n  Real x(start=1);\nequation\n  der(x) = -x;\nend Decay;\n")
    for given in (tmp_path, tmp_path / "Decay.mo"):
        with pytest.raises(AnalysisError, match="declares no degradation law"):
            degradation_laws([given])


def test_a_law_that_is_no_growth_is_refused():
    for growth in (lambda x: -x, lambda x: 0 * x, lambda x: x / 0.0):
        with pytest.raises(AnalysisError, match="growth must be finite"), np.errstate(divide="ignore"):
            Law.of("wrong", growth)
