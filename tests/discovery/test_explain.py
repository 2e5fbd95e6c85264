"""The steps alone and together on cases with a known answer."""

from __future__ import annotations

from dataclasses import replace
import json
from pathlib import Path
import shutil

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.noise import estimate, quantum
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.efforts.places.sites import Site
from lacuna.discovery.explain import explain, judge_written, write_amended
from lacuna.discovery.explanation import diagnosis, report
from lacuna.discovery.explanation.conclusion import conclude
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.fit.intervals import standard_errors
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Problem, solve
from lacuna.discovery.law.locate import locate
from lacuna.discovery.naming.comparison import confidences
from lacuna.discovery.naming.judge import judge_file
from lacuna.discovery.naming.name import Naming


def test_least_squares_finds_rosenbrock_within_bounds() -> None:
    def residual(p: dict[str, float], piece: int) -> np.ndarray:
        return np.array([10 * (p["y"] - p["x"] ** 2), 1 - p["x"]])

    free = [Free("x", -1.2, 1.0, -2, 2, step=1e-6), Free("y", 1.0, 1.0, -2, 2, step=1e-6)]
    found = solve(Problem(free, residual, 1), iterations=200, tolerance=1e-12)
    assert found["x"] == pytest.approx(1.0, abs=1e-4) and found["y"] == pytest.approx(1.0, abs=1e-4)
    bounded = solve(Problem([Free("x", -1.2, 1.0, -2, 0.5, step=1e-6), free[1]], residual, 1), iterations=200)
    assert bounded["x"] == pytest.approx(0.5) and bounded.at_bound("x")


def test_steps_that_a_noisy_jacobian_makes_short_are_lengthened() -> None:
    """Differences over small steps add their noise to the curvature: undoubled, steps go a tenth of the way."""
    count, offset = 0, np.linspace(0.0, 1.0, 50)

    def residual(p: dict[str, float], piece: int) -> np.ndarray:
        nonlocal count
        count += 1
        return (p["x"] - 3.0) * offset + 1e-5 * np.random.default_rng(count).normal(size=offset.size)

    found = solve(Problem([Free("x", 0.0, 1.0, step=5e-6)], residual, 1), iterations=2)
    assert found["x"] == pytest.approx(3.0, abs=0.5)


def test_noise_and_resolution_are_estimated() -> None:
    random = np.random.default_rng(3)
    t = np.arange(4000) * 1e-3
    smooth = np.sin(2 * np.pi * 2 * t)
    assert estimate([smooth + 0.02 * random.normal(size=t.size)]).std == pytest.approx(0.02, rel=0.1)
    steps = np.round(smooth / 0.01) * 0.01
    assert quantum(steps) == pytest.approx(0.01, rel=1e-3)
    assert quantum(smooth + 0.02 * random.normal(size=t.size)) == 0.0


def test_the_resolution_of_a_shaft_that_only_turns_on_is_found() -> None:
    """No two samples need be neighbours: the least difference of the angles is several steps of the encoder."""
    step = 2 * np.pi / 4096
    angle = np.concatenate([np.zeros(100), np.cumsum(np.linspace(0.006, 0.2, 3900))])
    recorded = np.round(np.floor(angle / step) * step, 6)
    least = np.diff(np.unique(recorded)).min()
    assert least > 2 * step
    assert quantum(recorded) == pytest.approx(step, rel=1e-3)


def test_places_are_read_from_the_model() -> None:
    screw = read(Library(), "Benches.ScrewEma")
    assert [s.location for s in screw.shafts] == ["shaft", "surface"]
    drive = read(Library(), "Benches.BldcDrive")
    assert [(line.source, line.load, line.phase) for line in drive.lines] == [("bridge", "winding", p) for p in "abc"]


def test_nothing_missing_is_said(consistent_case: Path) -> None:
    result = explain(load(consistent_case))
    assert result.verdict == "consistent" and not result.findings
    assert is_noise(result.final)


def test_the_missing_effort_is_located_on_the_shaft(friction_case: Path) -> None:
    case = load(friction_case)
    base, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    located = locate(case, base)
    assert (located.places[0].location, located.places[0].kind) == ("shaft", "torque")
    assert located.organiser.variable == "shaft.w"
    assert located.organiser.share > 0.5


@pytest.fixture(scope="module")
def explained(friction_case: Path) -> Explanation:
    return explain(load(friction_case))


def test_friction_is_named_with_its_level(explained: Explanation) -> None:
    assert explained.verdict == "missing_physics"
    first = explained.findings[0].ranked
    assert first.identity == ("friction.coulomb", "shaft")
    assert first.effect_values()["tau_c"] == pytest.approx(0.0015, rel=0.01)
    errors = standard_errors(explained.final)
    assert abs(first.effect_values()["tau_c"] - 0.0015) < 4 * errors[first.attachment.full_name("tau_c")]


def test_the_amended_file_gives_the_reported_numbers(explained: Explanation, tmp_path: Path) -> None:
    path = write_amended(explained, tmp_path)
    in_memory = explained.after.validate[""]
    judge_written(explained, path)
    judged = judge_file(explained.case, explained.amendment, path, {})
    data = json.loads(diagnosis.write(explained, tmp_path, path).read_text())
    assert judged.validate[""] == pytest.approx(data["nrmse"]["validate"]["after"], rel=1e-4)
    assert data["nrmse"]["validate"]["after"] == pytest.approx(in_memory, rel=1e-4)
    assert data["amended_model"] == path.name
    first = data["findings"][0]
    assert first["confidence"] <= 0.999
    assert all(r["confidence"] >= 0.001 for r in first["alternatives"])  # nothing is excluded more surely than claimed
    page = report.write(explained, tmp_path, path).read_text()
    assert "friction.coulomb" in page and 'src="http' not in page and 'href="http' not in page


@pytest.mark.parametrize(
    ("behind", "place", "verdict"),
    [
        (0.5, "drive", "undetermined"), (6.0, "drive", "missing_physics"), (0.5, "shaft", "missing_physics"),
        (0.5, "gear", "missing_physics"),
    ],
)  # fmt: skip
def test_a_rival_elsewhere_that_is_as_likely_leaves_it_undetermined(
    explained: Explanation, behind: float, place: str, verdict: str
) -> None:
    finding = explained.findings[0]
    own = finding.ranked
    other = next(r for r in finding.naming.ranked if r.identity[0] != own.identity[0])
    there = replace(other.candidate, attachment=replace(other.attachment, location=place))
    here = own.candidate
    if place == "gear":  # which the shaft is joined to
        on, past = Site("node", "shaft", ("shaft.b", "gear.a")), Site("parameter", "gear.d", instance="gear")
        here = replace(here, attachment=replace(here.attachment, site=on))
        there = replace(there, attachment=replace(there.attachment, site=past))
    ranked = [replace(own, candidate=here), replace(other, candidate=there, fit=own.fit, score=own.score + behind)]
    confidences(ranked)
    tied = replace(finding, ranked=ranked[0], naming=Naming(ranked, []))
    result = replace(explained, findings=[tied], trial=None, reason="", experiment="")
    conclude(result)
    assert result.verdict == verdict
    assert ("explain the data equally well" in result.reason) == (verdict == "undetermined")


def test_a_finding_that_is_certain_makes_the_verdict_though_another_is_tied(explained: Explanation) -> None:
    finding = explained.findings[0]
    other = next(r for r in finding.naming.ranked if r.identity[0] != finding.ranked.identity[0])
    there = replace(other.candidate, attachment=replace(other.attachment, location="drive"))
    ranked = [replace(finding.ranked), replace(other, candidate=there, fit=finding.ranked.fit)]
    ranked[1].score = ranked[0].score + 0.5
    confidences(ranked)
    tied = replace(finding, ranked=ranked[0], naming=Naming(ranked, []))
    result = replace(explained, findings=[tied, finding], trial=None, reason="", experiment="")
    conclude(result)
    assert tied.tied and not finding.tied and result.verdict == "missing_physics"
    assert diagnosis.sentence(result).count(": the data does not tell)") == 1


def test_what_unseen_recordings_refute_leaves_the_verdict_of_a_model_that_tells_them(explained: Explanation) -> None:
    """The findings take nothing away: from a model that leaves noise, or from one that does not."""
    tells = replace(explained, base=explained.final, before=explained.after, reason="", experiment="")
    conclude(tells)
    assert not tells.findings and tells.verdict in ("consistent", "parameters")
    fails = replace(explained, final=explained.base, after=explained.before, reason="", experiment="")
    conclude(fails)
    assert fails.findings and fails.verdict == "undetermined" and "does not hold" in fails.reason


@pytest.mark.parametrize(
    ("left", "noise", "verdict"),
    [(0.9, 0.01, "undetermined"), (0.7, 0.01, "missing_physics"), (0.9, 0.85, "missing_physics"),
     (0.9, 1.1, "missing_physics"), (0.98, 1.1, "undetermined")],
)  # fmt: skip
def test_a_finding_that_leaves_nearly_all_that_is_above_noise_is_no_diagnosis(
    explained: Explanation, left: float, noise: float, verdict: str
) -> None:
    before, told = explained.before.validate, explained.before.residuals
    less = {r: {c: left * e for c, e in columns.items()} for r, columns in told.items()}
    after = replace(explained.after, validate={n: left * v for n, v in before.items()}, residuals=less)
    floor = dict.fromkeys(explained.floor, noise * before[""])
    result = replace(explained, after=after, floor=floor, reason="", experiment="")
    conclude(result)
    assert result.verdict == verdict
    assert ("of the error on unseen" in result.reason) == (verdict == "undetermined")
    assert bool(result.experiment) == (verdict == "undetermined")


CUBIC_DRAG = """within Lacuna.Effects;
model CubicDrag "Loss growing with the cube of speed"
  extends Interfaces.FlangeEffect;
  parameter Real c3(unit="N.m.s3/rad3") = 0 "Torque over the cube of speed";
equation
  tau = c3*w*w*w;
  annotation(__Lacuna(effect="drag.cubic", attaches="flange", neutral(c3=0)));
end CubicDrag;
"""


def test_a_user_added_effect_is_picked_up(tmp_path: Path) -> None:
    source = Path(__file__).parents[2] / "model"
    package = tmp_path / "Lacuna"
    shutil.copytree(source, package)
    (package / "Effects" / "CubicDrag.mo").write_text(CUBIC_DRAG)
    effects = {e.identifier: e for e in catalogue.read(Library([package]))}
    assert effects["drag.cubic"].parameter("c3").unit == "N.m.s3/rad3"
