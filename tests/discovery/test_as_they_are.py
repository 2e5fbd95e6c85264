"""Recordings as machines give them: other rates, missing stretches, unknown starts, rest, colour, drift, feedback.

Each is the motor of `conftest` with dry friction concealed in it, spoiled as its test says; the diagnosis is to be the
same.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import shutil

import numpy as np
import pytest
from scipy.signal import lfilter

import lacuna
from lacuna.codegen.compile import compile_model
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.recordings_check import check_case
from lacuna.runtime import Model, RecordedInput, simulate

from .conftest import BELIEVED, NOISE

Table = dict[str, np.ndarray]
FILES = ("r1.csv", "r2.csv", "r3.csv")


def read(path: Path) -> Table:
    header = path.read_text(encoding="utf-8").partition("\n")[0].split(",")
    return dict(zip(header, np.loadtxt(path, delimiter=",", skiprows=1).T, strict=True))


def write(path: Path, table: Table) -> None:
    rows = zip(*table.values(), strict=True)
    lines = [",".join("" if np.isnan(v) else f"{v:.7g}" for v in row) for row in rows]
    path.write_text("\n".join([",".join(table), *lines]) + "\n", encoding="utf-8")


def spoiled(source: Path, folder: Path, change: Callable[[str, Table], Table], toml: str = "") -> Path:
    """A copy of a case whose recordings are changed, with more in its case.toml."""
    shutil.copytree(source, folder)
    for name in FILES:
        write(folder / name, change(name, read(folder / name)))
    with (folder / "case.toml").open("a", encoding="utf-8") as file:
        file.write(toml)
    return folder


def assert_finds_friction(case: Path, out: Path) -> dict:
    found = lacuna.explain(case, out=out).diagnosis
    assert found["verdict"] == "missing_physics", found["sentence"]
    assert [(f["effect"], f["location"]) for f in found["findings"]] == [("friction.coulomb", "shaft")]
    level = found["findings"][0]["parameters"]["tau_c"]
    assert level["value"] == pytest.approx(0.0015, abs=max(5 * level["std"], 3e-5))
    return found


def slower(name: str, table: Table) -> Table:
    rows = np.arange(len(table["time"]))
    return table | {"theta": np.where(rows % 10 == 3, table["theta"], np.nan),
                    "i": np.where(rows % 2 == 0, table["i"], np.nan)}  # fmt: skip


def test_signals_have_rates_of_their_own(friction_case: Path, tmp_path: Path) -> None:
    found = assert_finds_friction(spoiled(friction_case, tmp_path / "case", slower), tmp_path / "out")
    assert "recordings" not in found


def holed(name: str, table: Table) -> Table:
    table["theta"][400:800] = np.nan
    table["i"][500:700] = np.nan
    if name == "r1.csv":
        table["u"][900:960] = np.nan
    rows = np.ones(1500, dtype=bool)
    rows[1000:1100] = name != "r2.csv"
    return {column: v[rows] for column, v in table.items()}


def test_stretches_may_be_missing(friction_case: Path, tmp_path: Path) -> None:
    """Of outputs, of an input, and of everything: after the last two a recording goes on with states nobody knows."""
    found = assert_finds_friction(spoiled(friction_case, tmp_path / "case", holed), tmp_path / "out")
    assert {(p["kind"], p["column"]) for p in found["recordings"]} >= {("gap", "u"), ("gap", "time")}


@pytest.mark.parametrize(
    ("column", "first", "end", "kind"), [("u", 300, 340, "gap"), ("i", 300, 700, "missing_samples")]
)
def test_stretches_without_samples_are_said(
    consistent_case: Path, column: str, first: int, end: int, kind: str
) -> None:
    case = load(consistent_case)
    case.fit[1].columns[column][first:end] = np.nan
    (found,) = check_case(case)
    assert (found.kind, found.column, found.recording, found.fatal) == (kind, column, "r2.csv", False)
    assert found.time == pytest.approx(case.fit[1].time[first - 1])


def late(name: str, table: Table) -> Table:
    """What is recorded begins in the middle of a motion."""
    return {column: v[300:] for column, v in table.items()}


def test_states_at_the_first_sample_may_be_unknown_in_every_recording(friction_case: Path, tmp_path: Path) -> None:
    toml = '[initial]\ni = "unknown"\nw = "unknown"\ntheta = "unknown"\n'
    assert_finds_friction(spoiled(friction_case, tmp_path / "case", late, toml), tmp_path / "out")


def coloured(name: str, table: Table) -> Table:
    """Noise of three times the level beside that which is there, with a memory of ten samples, and a drift of the size
    of the old one."""
    random = np.random.default_rng(int(name[1]))
    for column, std in NOISE.items():
        table[column] += 3 * std * lfilter([np.sqrt(1 - 0.9**2)], [1, -0.9], random.normal(size=1500))
        table[column] += std * np.cumsum(random.normal(size=1500)) / np.sqrt(1500)
    return table


def without_levels(case: Path) -> Path:
    """The case without what it says of its noise."""
    lines = (case / "case.toml").read_text(encoding="utf-8").splitlines(keepends=True)
    (case / "case.toml").write_text("".join(x for x in lines if "noise_std" not in x), encoding="utf-8")
    return case


def test_noise_may_have_a_colour_and_drift(friction_case: Path, tmp_path: Path) -> None:
    assert_finds_friction(without_levels(spoiled(friction_case, tmp_path / "case", coloured)), tmp_path / "out")


def run(case: Path, inputs: dict[str, RecordedInput], time: np.ndarray, outputs: list[str]) -> Table:
    """The motor of a case with its friction."""
    model = Model(compile_model(str(case / "ConcealingServo.mo")).path)
    result = simulate(
        model, solver="dopri5", rtol=1e-8, parameters=BELIEVED | {"R": 3.45}, inputs=inputs, start=0.0,
        stop=float(time[-1]), output_times=time, outputs=outputs, events=False,
    )  # fmt: skip
    return {name: np.array(result[name]) for name in outputs}


def test_a_motor_at_rest_reads_exactly_zero(friction_case: Path, tmp_path: Path) -> None:
    """A tachometer has no noise where nothing turns; one recording does not get the motor to move at all."""

    def measured(name: str, table: Table) -> Table:
        time, random = table["time"], np.random.default_rng(int(name[1]))
        wave = np.sin(2 * np.pi * (0.7 + 0.5 * int(name[1])) * time)
        u = 0.1 * wave if name == "r2.csv" else 3.0 * wave * (time > 0.3) * (time < 1.2)
        speed = run(friction_case, {"u": RecordedInput(time, u)}, time, ["w"])["w"]
        turning = np.abs(speed) > 1e-3
        return {"time": time, "u": u, "w": np.where(turning, speed + 0.2 * random.normal(size=1500), 0.0)}

    case = spoiled(friction_case, tmp_path / "case", measured)
    text = (case / "case.toml").read_text(encoding="utf-8")
    before, _, after = text.partition("[signals.i]")
    w = '[signals.w]\nrole = "output"\nvariable = "w"\nunit = "rad/s"\n[recordings]'
    (case / "case.toml").write_text(before + w + after.partition("[recordings]")[2], encoding="utf-8")
    assert_finds_friction(case, tmp_path / "out")


def test_a_loop_may_be_closed_by_a_controller_that_is_not_in_the_model(friction_case: Path, tmp_path: Path) -> None:
    """What it commands is recorded and drives the model, noise of its sensor and all."""

    def measured(name: str, table: Table) -> Table:
        random, step = np.random.default_rng(int(name[1])), 1e-3
        time, wanted = table["time"], 4.0 * np.sin(2 * np.pi * (0.5 + 0.4 * int(name[1])) * table["time"])
        u, i, w, theta = (np.zeros(1500) for _ in range(4))
        for k in range(1499):  # Euler with 40 steps a sample, sticking where the voltage does not get it to move
            u[k] = np.clip(2.0 * (wanted[k] - theta[k] - NOISE["theta"] * random.normal()) - 0.02 * w[k], -12, 12)
            state = i[k], w[k], theta[k]
            for _ in range(40):
                state = _step(*state, u[k], step / 40)
            i[k + 1], w[k + 1], theta[k + 1] = state
        u[-1] = u[-2]
        noisy = {n: v + NOISE[n] * random.normal(size=1500) for n, v in (("i", i), ("theta", theta))}
        return {"time": time, "u": u} | noisy

    case = spoiled(friction_case, tmp_path / "case", measured)
    text = (case / "case.toml").read_text(encoding="utf-8")
    held = text.replace('variable = "u"\n', 'variable = "u"\ninterpolation = "hold"\n')
    (case / "case.toml").write_text(held, encoding="utf-8")
    assert_finds_friction(case, tmp_path / "out")


def _step(i: float, w: float, theta: float, u: float, h: float) -> tuple[float, float, float]:
    truth = BELIEVED | {"R": 3.45}
    current = i + h * (u - truth["R"] * i - truth["Ke"] * w) / truth["L"]
    free = w + h * (truth["Ke"] * i - truth["b"] * w) / truth["J"]
    slowed = np.sign(free) * max(abs(free) - h * 0.0015 / truth["J"], 0.0)
    return current, slowed, theta + h * slowed


def test_a_parameter_may_have_a_value_of_its_own_in_one_recording(friction_case: Path, tmp_path: Path) -> None:
    def heavier(name: str, table: Table) -> Table:
        if name != "r2.csv":
            return table
        random, time = np.random.default_rng(7), table["time"]
        model = Model(compile_model(str(friction_case / "ConcealingServo.mo")).path)
        result = simulate(
            model, solver="dopri5", rtol=1e-8, parameters=BELIEVED | {"R": 3.45, "J": 2.1e-5},
            inputs={"u": RecordedInput(time, table["u"])}, start=0.0, stop=float(time[-1]), output_times=time,
            outputs=["i", "theta"], events=False,
        )  # fmt: skip
        noisy = {n: np.array(result[n]) + s * random.normal(size=1500) for n, s in NOISE.items()}
        return table | noisy

    toml = '[recording."r2.csv"]\nparameters = {J = 2e-5}\nuncertainty = {J = 0.2}\n'
    found = assert_finds_friction(spoiled(friction_case, tmp_path / "case", heavier, toml), tmp_path / "out")
    own = found["parameters"]["J@r2.csv"]
    assert own["value"] == pytest.approx(2.1e-5, rel=0.02)
