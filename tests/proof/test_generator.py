"""The cases: reproducible, complete, visible, and silent about what they conceal."""

from collections import Counter
import tomllib

import numpy as np
import pytest

from tests.proof import generate as generator
from tests.proof.benches import BENCHES
from tests.proof.case import noise_std
from tests.proof.generate import build, generate
from tests.proof.plan import ALWAYS, Plan, plan, quick, spread


def test_plan_has_what_the_proof_promises():
    cases = plan(2)
    kinds = Counter(p.kind for _, p, _ in cases)
    assert kinds["effect"] >= 60
    assert kinds["consistent"] + kinds["parameters"] >= 60
    assert kinds["two"] >= 8
    assert kinds["law"] >= 6
    assert len({e for _, p, _ in cases if p.kind == "effect" for e in p.effects}) >= 24
    assert {p.bench for _, p, _ in cases} == set(BENCHES)
    assert set(ALWAYS) <= {(e, p.bench) for _, p, _ in cases if p.kind == "effect" for e in p.effects}
    assert len({name for name, _, _ in cases}) == len(cases) == len({seed for _, _, seed in cases})


def test_quick_has_every_kind():
    assert {p.kind for _, p, _ in quick(plan(2))} == {p.kind for _, p, _ in plan(2)}


def test_a_beginning_has_of_each_kind_its_share():
    cases = spread(plan(2))
    assert {name for name, _, _ in cases} == {name for name, _, _ in plan(2)}
    third = Counter(p.kind for _, p, _ in cases[: len(cases) // 3])
    whole = Counter(p.kind for _, p, _ in cases)
    for kind in ("effect", "consistent", "parameters"):
        assert third[kind] == pytest.approx(whole[kind] / 3, abs=4)


def _texts(folder):
    return {f.name: f.read_text() for f in folder.iterdir()}


def test_same_seed_same_bytes_and_no_hint(tmp_path):
    item = Plan("effect", "DcServo", ("friction.coulomb",))
    generate(("x1", item, 5, tmp_path / "a"))
    generate(("x1", item, 5, tmp_path / "b"))
    first, second = (_texts(tmp_path / k / "cases" / "x1") for k in "ab")
    assert first == second
    assert "coulomb" not in "".join(first.values())
    case = tomllib.loads(first["case.toml"])
    truth = tomllib.loads((tmp_path / "a" / "truth" / "x1.toml").read_text())
    assert truth["verdict"] == "missing_physics"
    assert truth["effects"][0]["effect"] == "friction.coulomb"
    files = case["recordings"]["fit"] + case["recordings"]["validate"]
    assert sorted([*files, "case.toml"]) == sorted(first)
    header = first[files[0]].split("\n", 1)[0].split(",")
    assert header[0] == "time"
    assert set(header[1:]) == set(case["signals"])


@pytest.mark.parametrize(("bench", "effect"), [("DcServo", "torque.cogging"), ("Joint", "friction.coulomb")])
def test_misfit_is_of_the_planned_order(bench, effect):
    case = build("x", Plan("effect", bench, (effect,), gain=(2.0, 4.0)), 11)
    fit = case.refit["fit"]
    assert 1.5 < fit["refit_believed"] / fit["floor"] < 5.5


def test_experiments_are_drawn_again_where_a_refit_diverges(monkeypatch):
    """A controller with a delay near the edge of stability: a step of the refit may go beyond it."""
    drawn = []

    def sized(case, seed, target):
        drawn.append(case)
        case.refit = {"validate": {"refit_believed": 3.0, "floor": 1.0}}
        return 0.1

    def judge(case, seed, start):
        if case is drawn[0]:
            raise ArithmeticError("diverged")

    monkeypatch.setattr(generator, "_tune", sized)
    monkeypatch.setattr(generator, "judge", judge)
    case = build("x", Plan("effect", "Joint", ("friction.coulomb",), gain=(2.0, 4.0)), 11)
    assert case is drawn[1] and len(drawn) == 2
    assert not np.array_equal(drawn[0].inputs[0], drawn[1].inputs[0])


def test_nothing_concealed_leaves_the_floor():
    case = build("x", Plan("consistent", "DcServo"), 12)
    fit = case.refit["fit"]
    assert fit["refit_believed"] == pytest.approx(fit["floor"], rel=0.01)


def test_a_parameter_off_is_beyond_belief():
    case = build("x", Plan("parameters", "DcServo", off=("R",)), 13)
    off = abs(case.true["R"] / case.believed["R"] - 1)
    assert off > 4 * BENCHES["DcServo"].uncertainty["R"]
    found = case.refit["parameters"]["R"]
    assert found == pytest.approx(case.true["R"], rel=0.02)


def test_noise_is_as_stated():
    case = build("x", Plan("consistent", "DcServo"), 14)
    for j, name in enumerate(case.outputs):
        error = np.concatenate([m[:, j] - c[:, j] for m, c in zip(case.measured, case.clean, strict=True)])
        assert np.std(error) == pytest.approx(noise_std(case, name), rel=0.1)
