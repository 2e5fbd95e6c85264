"""Dry friction in a balance of any model: it truly sticks in the amended one, and its level is the right one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain, write_amended
from lacuna.discovery.explanation import diagnosis
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.runtime import Model, RecordedInput, simulate

from .recorded import record

NOISE = {"s": 2e-5, "v": 1e-3}
LEVEL = 28.0
SLIDER = """model Slider "A slider on a spring, without any component"
  parameter Real m(unit="kg") = 4 "Mass";
  parameter Real k(unit="N/m") = 900 "Stiffness";
  parameter Real b(unit="N.s/m") = 12 "Damping";
  input Real F(unit="N") "Force";
  output Real s(unit="m", start=0, fixed=true) "Position";
  output Real v(unit="m/s", start=0, fixed=true) "Speed";
equation
  der(s) = v;
  m*der(v) = F - k*s - b*v;
end Slider;
"""


def truth(level: str = str(LEVEL), most: float = LEVEL) -> str:
    """The slider with dry friction of this level, of `most` at rest."""
    return SLIDER.replace("model Slider ", "model Sliding ").replace("end Slider;", "end Sliding;").replace(
        "equation\n",
        f"""  Integer mode(start=0, fixed=true);
  Real f(unit="N");
protected
  Real hold(unit="N");
  Real stuck(unit="m/s");
  Real along(unit="m/s");
equation
  0 = if mode == 0 then m*der(v) else f - mode*({level});
  hold = if mode == 0 then f else 0;
  stuck = if mode == 0 then v else 0;
  along = if mode == 0 then 1 else mode*v;
  mode = if pre(mode) == 0 then (if stuck > 1e-10 then 1 elseif stuck < -1e-10 then -1
    elseif hold > {most} then 1 elseif hold < -{most} then -1 else 0) elseif along < 0 then 0 else pre(mode);
  when mode == 0 then
    reinit(v, 0);
  end when;
""",
    ).replace("F - k*s - b*v", "F - k*s - b*v - f")  # fmt: skip


def write(folder: Path, sliding: str, pauses: bool = False) -> Path:
    (folder / "Slider.mo").write_text(SLIDER, encoding="utf-8")
    (folder / "Sliding.mo").write_text(sliding, encoding="utf-8")
    machine, random = Model(compile_model(str(folder / "Sliding.mo"), units="warn").path), np.random.default_rng(4)
    time = np.arange(0.0, 6.0, 4e-3)
    for n, (size, pace) in enumerate(((60.0, 0.6), (90.0, 1.1), (75.0, 0.8)), 1):
        force = size * np.sin(2 * np.pi * pace * time) * (1 + 0.4 * np.sin(2.1 * time))
        if pauses:  # a sixth of a period in which nothing moves
            force *= np.maximum(0.0, np.sign(np.abs(np.sin(2 * np.pi * pace * time)) - 0.5))
        errors = {c: s * random.normal(size=len(time)) for c, s in NOISE.items()}
        record(folder / f"r{n}.csv", machine, time, {"F": force}, {"s": "s", "v": "v"}, errors)
    signals = "\n".join(
        f'[signals.{c}]\nrole = "output"\nvariable = "{c}"\nunit = "{u}"\nnoise_std = {NOISE[c]}'
        for c, u in (("s", "m"), ("v", "m/s"))
    )
    (folder / "case.toml").write_text(
        f"""title = "slider"
model = "Slider.mo"
source = "synthetic"
[uncertainty]
m = 0.03
k = 0.05
b = 0.3
[signals.F]
role = "input"
variable = "F"
unit = "N"
{signals}
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
""",
        encoding="utf-8",
    )
    return folder


@pytest.fixture(scope="module")
def explained(tmp_path_factory: pytest.TempPathFactory) -> Explanation:
    return explain(load(write(tmp_path_factory.mktemp("slider"), truth())))


def test_dry_friction_of_plain_equations_has_its_own_name_and_level(explained: Explanation) -> None:
    told = diagnosis.build(explained, None)
    assert told["verdict"] == "missing_physics"
    (finding,) = told["findings"]
    assert (finding["location"], finding["form"]) == ("v", "friction.coulomb")
    assert "sign(v)" in finding["law"]
    level = finding["parameters"]["c_1"]
    assert abs(abs(level["value"]) - LEVEL) < 4 * level["std"] < 0.05 * LEVEL
    assert told["explained"] > 0.99


def test_the_amended_model_sticks_and_does_not_creep(explained: Explanation, tmp_path: Path) -> None:
    """Pushed with half the level for ten seconds it stays exactly where it is; a smooth law creeps."""
    path = write_amended(explained, tmp_path)
    machine = Model(compile_model(str(path), search_path=[str(tmp_path)]).path)
    time = np.linspace(0.0, 10.0, 11)
    push = RecordedInput(time, np.full(11, 0.5 * LEVEL))
    run = simulate(machine, solver="dopri5", inputs={"F": push}, start=0.0, stop=10.0, output_times=time, outputs=["s"])
    assert np.all(run["s"] == 0.0)


def test_dry_friction_that_falls_from_rest_on_is_told_where_it_starts_and_stops(tmp_path: Path) -> None:
    """Where it sticks between strokes the effort there is whatever holds it, which no course tells."""
    sliding = truth(f"{LEVEL} + 16*exp(-(abs(v)/0.04)^2)", LEVEL + 16)
    told = diagnosis.build(explain(load(write(tmp_path, sliding, pauses=True))), None)
    assert told["verdict"] == "missing_physics"
    (finding,) = told["findings"]
    assert (finding["location"], finding["form"]) == ("v", "friction.stribeck")
    values = {n: abs(p["value"]) for n, p in finding["parameters"].items()}
    assert values["c_1"] == pytest.approx(LEVEL, rel=0.05)
    assert values["c_1"] + values["c_2"] == pytest.approx(LEVEL + 16, rel=0.05)
    assert told["explained"] > 0.99
