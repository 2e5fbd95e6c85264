"""Play in a shaft for which a fit without it makes the shaft soft."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.catalogue import read as read_catalogue
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.fit.evidence import nearly_noise, outside_belief
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.naming.candidate_fit import fit_candidate
from lacuna.discovery.naming.screen import Screen, prepare
from lacuna.discovery.steps import fitted

from .recorded import record, truth

DRIVE = """model Drive "A motor that turns a load by a shaft"
  input Real u(unit="N.m");
  Lacuna.Components.Mechanics.TorqueSource source;
  Lacuna.Components.Mechanics.Inertia motor(J=0.08, phi(start=0, fixed=true), w(start=0, fixed=true));
  Lacuna.Components.Mechanics.%s;
  Lacuna.Components.Mechanics.Inertia surface(J=0.1, phi(start=0, fixed=true), w(start=0, fixed=true));
  Lacuna.Components.Mechanics.Damper damper(d=0.6);
  Lacuna.Components.Mechanics.Fixed ground;
equation
  source.u = u;
  connect(source.flange, motor.flange_a);
  connect(motor.flange_b, shaft.flange_a);
  connect(shaft.flange_b, surface.flange_a);
  connect(surface.flange_b, damper.flange_a);
  connect(damper.flange_b, ground.flange);
end Drive;
"""
CASE = """model = "Drive.mo"
uncertainty = {"motor.J" = 0.05, "shaft.c" = 0.1, "shaft.d" = 0.3, "surface.J" = 0.05, "damper.d" = 0.1}
signals.u = {role = "input", unit = "N.m"}
signals.w = {role = "output", variable = "motor.w", unit = "rad/s", noise_std = 0.025}
recordings = {fit = ["r1.csv"], validate = ["r2.csv"]}
"""
PLAY = 0.04  # rad


def test_play_is_looked_for_at_sizes_of_its_own_where_parameters_stand_for_it(tmp_path: Path) -> None:
    """A little play beside a shaft of a tenth of its stiffness explains nothing; the whole of it beside the believed
    one does."""
    machine = truth(tmp_path, "Drive", DRIVE % f"Backlash shaft(c=2000, d=4, b={PLAY})")
    (tmp_path / "Drive.mo").write_text(DRIVE % "SpringDamper shaft(c=2000, d=4)", encoding="utf-8")
    random, time = np.random.default_rng(3), np.arange(1000) * 2e-3
    for n in (1, 2):
        course = np.repeat(random.uniform(-10, 10, 20), 50)
        error = {"w": 0.025 * random.normal(size=1000)}
        record(tmp_path / f"r{n}.csv", machine, time, {"u": course}, {"w": "motor.w"}, error)
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    case = load(tmp_path)
    result = fitted(case, lambda text: None)
    assert outside_belief(result.base)
    every = enumerate_attachments(case, result.amendment.structure, read_catalogue(case.library()), result.amendment)
    backlash = next(a for a in every if a.effect.name == "Backlash")
    found = prepare(Screen(result.base), backlash, Machine(case, Amendment(result.amendment.structure, [backlash])))
    assert 0.5 * PLAY < found[0].start[backlash.full_name("play")] < 2 * PLAY
    ended = fit_candidate(case, result.base, 3, 6, lambda text: None, found[0])
    assert ended is not None and nearly_noise(ended)
    assert ended.point[backlash.full_name("play")] == pytest.approx(PLAY, rel=0.05)
