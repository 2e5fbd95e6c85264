"""Each machine's equations in Python and its model as text are the same machine: two integrators agree on them."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.recorded_units import ZERO_CELSIUS, to_si
from lacuna.runtime import Model, RecordedInput, simulate
from tests.proof.machines import machine as truth
from tests.proof.machines import page, plan, strangers
from tests.proof.machines import truth as truths
from tests.proof.machines.score import Score

MACHINES = (*plan.MACHINES, *strangers.MACHINES)
SAMPLES = 60


@pytest.mark.parametrize("machine", MACHINES, ids=lambda m: m.name)
def test_the_believed_model_is_the_truth_without_what_is_concealed(machine: truth.Machine, tmp_path: Path) -> None:
    file = tmp_path / f"{machine.name}.mo"
    file.write_text(machine.text())
    model = Model(compile_model(f"{file}:{machine.inner}" if machine.inner else str(file)).path)
    time = machine.period * np.arange(SAMPLES)
    course = 0.5 + 0.3 * np.sin(np.linspace(0, 9, SAMPLES))
    drive = {n: i.low + (i.high - i.low) * course for n, i in machine.inputs.items()}
    values = {n: np.array([p.value]) for n, p in machine.parameters.items()}
    expected = truth.simulate(machine, values, {n: v[:, None].repeat(1, axis=1) for n, v in drive.items()})
    run = simulate(
        model, solver="ida", rtol=1e-8, stop=float(time[-1]), output_times=time, events=False,
        inputs={n: RecordedInput(time, _si(drive[n], i.unit)) for n, i in machine.inputs.items()},
        outputs=[o.variable for o in machine.outputs.values()],
    )  # fmt: skip
    for name, output in machine.outputs.items():
        told = _si(expected[name][:SAMPLES, 0], output.unit)
        np.testing.assert_allclose(run[output.variable], told, rtol=0, atol=2e-3 * np.ptp(told), err_msg=name)


def _si(values: np.ndarray, unit: str) -> np.ndarray:
    return values * to_si(unit)[0] + (ZERO_CELSIUS if unit == "degC" else 0.0)


@pytest.mark.parametrize("seed", [101, 201])
def test_the_plans_have_every_effect_once_and_a_null_of_each_kind(seed: int) -> None:
    machines = strangers.MACHINES if seed >= plan.STRANGERS_FROM else plan.MACHINES
    cases = [p for _, p, _ in plan.plan(seed)]
    effects = [(p.machine.name, *p.hidden) for p in cases if p.kind == "effect"]
    assert sorted(effects) == sorted((m.name, k) for m in machines for k in range(len(m.hidden)))
    for kind in ("consistent", "parameters"):
        assert sorted(p.machine.name for p in cases if p.kind == kind) == sorted(m.name for m in machines)


def test_of_two_effects_none_is_what_a_believed_parameter_stands_in_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """y = k u with a term in u that k takes up, and one in u^3 that it does not."""
    drive = {"u": np.linspace(-1, 1, 50)[:, None]}

    def run(_: object, values: dict, drive: dict, hidden: tuple) -> dict:
        return {"y": values["k"] * drive["u"] + sum(q * drive["u"] ** power for power, q in hidden)}

    def case(*hidden: tuple[int, float]) -> SimpleNamespace:
        machine = truth.Machine("", "", "", "", {"k": truth.Parameter(2.0, "1", 0.1)}, {}, {}, {}, None, (), 1.0)
        return SimpleNamespace(machine=machine, substeps=1, recordings=1, true={"k": 2.0}, drive=drive, hidden=hidden,
                               outputs=("y",), noise={"y": 0.01})  # fmt: skip

    monkeypatch.setattr(truths, "simulate", run)
    assert truths.each_shows(case((3, 0.3), (5, 0.3)), slice(0, 1))
    assert not truths.each_shows(case((1, 0.3), (3, 0.3)), slice(0, 1))


def _score(case: str, kind: str, right: bool, located: bool = False, false: bool = False) -> Score:
    effects = ("leak",) if kind in ("effect", "two") else ()
    verdict = "missing_physics" if false or located else "consistent"
    return Score(
        case=case, kind=kind, machine="Tank", style="flat", effects=effects, verdict=verdict, said=(), right=right,
        located=located, all_located=located, false=false, share=0.5 if effects else None, misfit=2.0, seconds=3.0,
    )  # fmt: skip


def test_a_run_is_counted_kept_once_and_told_beside_all_others(tmp_path: Path) -> None:
    scores = [
        _score("m001", "effect", right=True, located=True),
        _score("m002", "effect", right=False),
        _score("m003", "consistent", right=True),
        _score("m004", "parameters", right=False, false=True),
        _score("m005", "weak", right=False),
    ]
    made = page.counted(207, "abc", False, 44, scores)
    counts = (made.run, made.right, made.judged, made.located, made.present, made.false, made.nulls)
    assert counts == (5, 2, 4, 1, 2, 1, 2)
    file = tmp_path / "runs.csv"
    file.write_text(page.RUNS.read_text())
    before = page.runs(file)
    assert page.keep(made, file) == page.keep(made, file) == [*before, made]
    text = page.page(page.runs(file), 207, "abc", scores)
    assert f"| all | {len(before) + 1} | {sum(r.run for r in before) + 5} |" in text
    assert "| m002 | Tank | leak |" in text
    assert "| m003 |" not in text


def test_the_runs_that_are_kept_are_whole_rows() -> None:
    for run in page.runs():
        assert run.right <= run.judged == run.present + run.nulls <= run.run <= run.planned
        assert run.located <= run.present and run.false <= run.nulls
