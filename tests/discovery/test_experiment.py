"""The experiment that decides: it keeps its limits, counts what a refitted rival leaves, and decides."""

from __future__ import annotations

from dataclasses import replace
import json
from pathlib import Path
import shutil

import numpy as np
import pytest

import lacuna
from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Limit, load
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.experiment.files import write_next
from lacuna.discovery.experiment.limits import Range, derivatives, ranges
from lacuna.discovery.experiment.proposal import propose
from lacuna.discovery.experiment.separation import Rival, refitted_distance, released
from lacuna.discovery.experiment.waveforms import as_recording, waveforms
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.runtime import Model, RecordedInput, simulate
from tests.discovery.conftest import BELIEVED, attachment, conceal, write_model


@pytest.fixture
def motor(consistent_case: Path) -> tuple:
    """(case, its fitted believed model)."""
    case = load(consistent_case)
    base, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    return case, base


def test_every_waveform_keeps_the_limits(consistent_case: Path) -> None:
    case = load(consistent_case)
    case.limits = {"u": Limit(-2.0, 9.0, 40.0)}
    of = ranges(case)
    found = waveforms(case, of, 1)
    assert len(found) == len({w.text for w in found}) > 8
    for one in found:
        u = one.columns["u"]
        assert u.min() >= -2.0 and u.max() <= 9.0
        assert np.max(np.abs(np.diff(u) / np.diff(one.time))) <= 40.0 * (1 + 1e-9)
    assert max(np.ptp(w.columns["u"]) for w in found) == pytest.approx(11.0, rel=0.05)


def test_what_no_limit_says_is_as_recorded(consistent_case: Path) -> None:
    case = load(consistent_case)
    (of,) = ranges(case).values()
    recorded = [r.columns["u"] for r in [*case.fit, *case.validate]]
    assert (of.low, of.high) == (min(u.min() for u in recorded), max(u.max() for u in recorded))
    assert of.rate == pytest.approx(max(np.max(np.abs(np.diff(u))) for u in recorded) / 1e-3)


def test_an_imposed_speed_follows_from_its_angle(consistent_case: Path) -> None:
    case = load(consistent_case)
    signal = case.signals["u"]
    case.signals = {"phi": signal.__class__(**{**signal.__dict__, "column": "phi"}), "w": signal, **case.signals}
    case.signals["w"] = signal.__class__(**{**signal.__dict__, "column": "w"})
    del case.signals["u"]
    for r in [*case.fit, *case.validate]:
        r.columns["phi"] = 0.5 * np.sin(9.0 * r.time)
        r.columns["w"] = 4.5 * np.cos(9.0 * r.time)
    assert derivatives(case) == {"w": "phi"}
    found = waveforms(case, ranges(case), 1)
    assert found
    for one in found:
        assert np.allclose(np.gradient(one.columns["phi"], one.time), one.columns["w"])
        assert np.abs(one.columns["w"]).max() <= 4.5 * (1 + 1e-9)


def test_what_a_refit_can_take_away_tells_nothing(motor: tuple) -> None:
    """Of a rival that is off by what the recordings leave open of its parameters, no more is left than what they know
    against that; one that lacks dry friction is still far off."""
    case, base = motor
    recording = as_recording(case, waveforms(case, ranges(case), 1)[0], "tried")
    sigma = {c: n.std for c, n in base.noise.items()}
    here = released("believed", base)
    values, directions = np.linalg.eigh(base.estimate.normal)
    away = 3.0 / np.sqrt(values[0]) * directions[:, 0]  # three sigmas where least is known
    point = base.point | {
        f.name: base.point[f.name] + f.scale * a for f, a in zip(base.estimate.free, away, strict=True)
    }
    moved = base.machine.simulate(point, recording)
    raw = np.hypot.reduce([np.linalg.norm((moved[c] - here.predicted(recording)[c]) / s) for c, s in sigma.items()])
    left = refitted_distance(moved, here, recording, sigma)
    assert left < 1.1 * min(3.0, raw)
    friction = attachment(case, "CoulombFriction")
    rubbing = base.machine.amended(Amendment(base.machine.amendment.structure, [friction]))
    truth = rubbing.simulate(base.point | {friction.full_name("tau_c"): 2e-3}, recording)
    assert refitted_distance(truth, here, recording, sigma) > 20.0


def test_no_experiment_tells_a_model_from_itself(motor: tuple) -> None:
    case, base = motor
    proposal = propose(case, [Rival("this", base), Rival("that", base)])
    assert proposal.sigmas == 0.0 and not proposal.decides
    assert "no waveform" in proposal.sentence()


def test_limits_of_what_is_no_input_are_refused(consistent_case: Path, tmp_path: Path) -> None:
    folder = tmp_path / "case"
    shutil.copytree(consistent_case, folder)
    file = folder / "case.toml"
    text = file.read_text()
    file.write_text(text + "[limits.theta]\nmax = 1\n")
    with pytest.raises(CaseError, match=r"\[limits\.theta\] is none of the inputs"):
        load(folder)
    file.write_text(text + "[limits.u]\nmin = 3\nmax = 1\n")
    with pytest.raises(CaseError, match="min = 3 is not below max = 1"):
        load(folder)


def test_recordings_of_one_name_are_refused(consistent_case: Path, tmp_path: Path) -> None:
    folder = tmp_path / "case"
    shutil.copytree(consistent_case, folder)
    (folder / "old").mkdir()
    shutil.copy(folder / "r1.csv", folder / "old")
    file = folder / "case.toml"
    file.write_text(file.read_text().replace('["r1.csv"', '["r1.csv", "old/r1.csv"'))
    with pytest.raises(CaseError, match="have the same name"):
        load(folder)


def test_what_an_earlier_run_proposed_goes_and_what_was_recorded_stays(motor: tuple, tmp_path: Path) -> None:
    case, base = motor
    proposal = propose(case, [Rival("this", base), Rival("that", base)])
    written = write_next(case, proposal, tmp_path)
    assert all(p.exists() for p in written)
    (tmp_path / "next" / "next1.csv").write_text("recorded")
    assert write_next(case, None, tmp_path) == []
    assert [p.name for p in (tmp_path / "next").iterdir()] == ["next1.csv"]


def test_the_case_of_the_proposal_is_read_once_it_is_recorded(consistent_case: Path, tmp_path: Path) -> None:
    """With what holds in one recording only, and with an input that has always been held."""
    folder = tmp_path / "case"
    shutil.copytree(consistent_case, folder)
    with (folder / "case.toml").open("a") as file:
        file.write('[recording."r1.csv".parameters]\nR = 3.7\n')
    case = load(folder)
    base, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    proposal = propose(case, [Rival("this", base), Rival("that", base)])
    held = replace(proposal, ranges={"u": Range(2.0, 2.0, 0.0, 2.0)})
    for proposed, limits in ((proposal, {"u"}), (held, set())):
        write_next(case, proposed, tmp_path)
        for k in (1, 2):
            shutil.copy(folder / "r1.csv", tmp_path / "next" / f"next{k}.csv")
        then = load(tmp_path / "next")
        assert [r.name for r in then.fit] == ["r1.csv", "r2.csv", "next1.csv"]
        assert [r.name for r in then.validate] == ["r3.csv", "next2.csv"]
        assert then.own["r1.csv"].parameters == {"R": 3.7} and set(then.limits) == limits


def test_a_search_that_was_stopped_asks_for_time_not_for_a_recording(tmp_path: Path) -> None:
    folder = conceal(tmp_path / "case", BELIEVED, friction="CoulombFriction(tau_c=0.0015)")
    told = lacuna.explain(folder, out=tmp_path / "out", limit=1e-3).diagnosis
    assert told["verdict"] == "undetermined" and "stopped after" in told["reason"]
    assert "--limit" in told["experiment"] and told["next_experiment"] is None
    assert "These recordings cannot say" not in told["sentence"] and not (tmp_path / "out" / "next").exists()
    assert told["explained"] == 0.0 and told["ties"] == [] and told["places"]


ONE_WAY = """title = "one way"
model = "Benches.DcServo"
source = "synthetic"
[parameters]
R = 3.5
L = 3.3e-3
Ke = 0.03
J = 7e-6
b = 2e-5
[uncertainty]
R = 0.03
L = 0.1
Ke = 0.03
J = 0.1
b = 0.3
[signals.u]
role = "input"
variable = "u"
unit = "V"
[signals.w]
role = "output"
variable = "w"
unit = "rad/s"
noise_std = 0.3
[limits.u]
min = -10
max = 10
rate = 1e4
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def answer(machine: Model, time: np.ndarray, u: np.ndarray, seed: int) -> np.ndarray:
    """(n, 3): time, voltage, and the speed that the truth answers with, noise added."""
    result = simulate(
        machine, solver="dopri5", rtol=1e-8, parameters=BELIEVED, inputs={"u": RecordedInput(time, u)}, start=0.0,
        stop=float(time[-1]), output_times=time, outputs=["w"], events=False,
    )  # fmt: skip
    noise = np.random.default_rng(seed).normal(0.0, 0.3, len(time))
    return np.column_stack([time, u, np.array(result["w"]) + noise])


def save(path: Path, rows: np.ndarray) -> None:
    np.savetxt(path, rows, "%.8g", ",", header="time,u,w", comments="")


def test_the_proposed_experiment_decides(tmp_path: Path) -> None:
    """Dry friction and a lost voltage are one while the motor turns one way; the experiment tells which it is."""
    lines = ["model ConcealingServo", "  extends Lacuna.Benches.DcServo;"]
    lines += ["  Lacuna.Effects.CoulombFriction friction(tau_c=0.0015);", "equation"]
    lines += ["  connect(friction.flange, shaft.flange_b);", "end ConcealingServo;"]
    machine = Model(compile_model(write_model(tmp_path, lines)).path)
    folder, out = tmp_path / "case", tmp_path / "out"
    folder.mkdir()
    (folder / "case.toml").write_text(ONE_WAY)
    time = np.arange(800) * 2e-3
    for k, level in enumerate((3.0, 3.6, 3.3)):
        save(folder / f"r{k + 1}.csv", answer(machine, time, level * np.clip((time - 0.1) / 0.4, 0, 1), k))
    first = lacuna.explain(folder, out=out)
    proposed = first.diagnosis["next_experiment"]
    assert first.verdict == "undetermined" and proposed["decides"]
    for played, recorded in zip(proposed["play"], proposed["record_as"], strict=True):
        waveform = np.genfromtxt(out / played, delimiter=",", names=True)
        save(out / recorded, answer(machine, waveform["time"], waveform["u"], 9))
    then = lacuna.explain(out / "next", out=tmp_path / "decided")
    assert then.verdict == "missing_physics"
    assert [(f["effect"], f["location"]) for f in then.diagnosis["findings"]] == [("friction.coulomb", "shaft")]
    assert json.loads((out / "diagnosis.json").read_text())["next_experiment"] == proposed
