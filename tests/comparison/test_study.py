"""A whole comparison of a servo that sticks and slips: what location of its events is worth."""

from __future__ import annotations

from dataclasses import replace
import hashlib
from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna import runtime
from lacuna.analysis.comparison.report import findings, order_text
from lacuna.analysis.comparison.scenarios import Scenario, load
from lacuna.analysis.comparison.study import Study, run
from lacuna.codegen.compile import compile_model

MODEL = Path(__file__).parents[1] / "models" / "SquareWaveServo.mo"


@pytest.fixture(scope="module")
def study() -> Study:
    scenario = Scenario(
        "servo", "Servo", str(MODEL), stop=0.5, interval=1e-3, steps=(1e-4, 5e-5, 2.5e-5), shown=(),
        reference_rtol=1e-10,
    )  # fmt: skip
    return run(scenario, runtime.Model(compile_model(str(MODEL)).path))


def test_located_events_keep_the_order_and_others_cost_it(study: Study) -> None:
    assert study.reference.events.matched > 0 and not study.off_course
    assert study.orders["rk4"] > 3.8
    assert study.orders["euler"] == pytest.approx(1.0, abs=0.1)
    assert study.orders["rk4, events not located"] < 2.0


def test_event_times_agree_within_ten_times_the_tolerance(study: Study) -> None:
    variable = [lane for lane in study.lanes if lane.lane.rtol]
    assert len(variable) == 9
    for lane in variable:
        assert lane.events.unmatched == 0
        assert lane.events.maximum <= 10 * lane.lane.rtol * study.scenario.stop


def test_the_reference_is_known_better_than_any_lane(study: Study) -> None:
    assert 0 < study.second.rms_error < min(lane.rms_error for lane in study.lanes if lane.lane.step)


def test_findings_say_the_orders(study: Study) -> None:
    text = "\n".join(findings([study]))
    assert f"rk4: order {study.orders['rk4']:.2f}" in text
    assert "6 of 6 variable-step runs" in text
    assert order_text(study, "rk4") == f"{study.orders['rk4']:.2f}"


def test_how_near_variable_steps_are_comes_first_and_a_run_that_failed_is_said(study: Study) -> None:
    assert findings([study])[0].startswith("variable steps at 1e-6 or tighter: signals within")
    fallen = replace(study, lanes=[replace(study.lanes[0], failure="stopped"), *study.lanes[1:]])
    assert "1 run failed: the tables say why" in findings([fallen])


def test_the_worst_signal_is_named_with_its_unit_and_its_scenario(study: Study) -> None:
    counted = [s for r in study.lanes if r.lane.rtol and r.lane.rtol <= 1e-6 for s in r.signals]
    worst = max(counted, key=lambda s: s.relative)
    assert f"relative ({worst.name})" in findings([study])[0]
    calm = replace(study, scenario=replace(study.scenario, title="Calm"), lanes=[
        replace(r, signals=[replace(s, maximum=0.01 * s.maximum) for s in r.signals]) for r in study.lanes
    ])  # fmt: skip
    assert f"({worst.name} in Servo; {0.01 * worst.relative:.1e} in all others)" in findings([calm, study])[0]
    assert {s.unit for s in counted} >= {"A", "rad/s"}


def test_a_run_on_another_course_is_starred(study: Study) -> None:
    lanes = [
        replace(lane, events=replace(lane.events, unmatched=int(lane.lane.family == "euler"))) for lane in study.lanes
    ]
    strayed = replace(study, lanes=lanes, orders=study.orders | {"lost": -0.3, "unknown": np.nan})
    assert order_text(strayed, "euler").endswith("*") and not order_text(strayed, "rk4").endswith("*")
    assert (order_text(strayed, "lost"), order_text(strayed, "unknown")) == ("none", "-")


def test_scenarios_of_the_project_halve_their_steps() -> None:
    for scenario in load():
        assert np.allclose(np.divide(scenario.steps[:-1], scenario.steps[1:]), 2.0), scenario.name


STOPS = "model Stops\n  discrete Real n(start=0, fixed=true);\nequation\n  when sample(0.1, 0.1) then\n" \
        "    n = pre(n) + 1;\n    if n > 4.5 then\n      terminate(\"enough\");\n    end if;\n  end when;\n" \
        "  annotation(experiment(StopTime=1));\nend Stops;\n"  # fmt: skip


def test_a_model_without_states_that_ends_itself_is_compared_up_to_there(tmp_path: Path) -> None:
    (tmp_path / "Stops.mo").write_text(STOPS, encoding="utf-8")
    done = lacuna.compare(tmp_path / "Stops.mo", out=tmp_path / "out")
    table = (tmp_path / "out" / "Stops_overlay.csv").read_text(encoding="utf-8").splitlines()
    drawn = [line for line in table if "reference (ida)" in line]
    assert done.folder == tmp_path / "out" and float(drawn[-1].split(",")[-2]) == pytest.approx(0.5)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    hashed = hashlib.sha256((tmp_path / "Stops.mo").read_bytes()).hexdigest()
    assert hashed in page and "deviations.csv" not in page.split("What it was made from")[1]


def test_a_model_in_which_nothing_changes_is_refused(tmp_path: Path) -> None:
    (tmp_path / "Still.mo").write_text("model Still\n  parameter Real p = 1;\nend Still;\n", encoding="utf-8")
    with pytest.raises(lacuna.UserError, match="nothing to compare"):
        lacuna.compare(tmp_path / "Still.mo", out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
