"""Errors of sensors with a memory against an unknown effort: two tanks whose noise is coloured and drifts, of no level
that anybody gave, alone and with a leak that goes as a square."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter

from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.efforts.clocks import with_clocks
from lacuna.discovery.efforts.instruments import _NOWHERE, _worst, colour_of, only_instruments
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation import verdict
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.steps import fitted

from .recorded import record, truth
from .test_efforts import BELIEVED, CASCADE, CASE

LEAKING = CASCADE.format(upper="k*upper", lower="(k*lower + c*lower^2)").replace(
    "  input", '  parameter Real c(unit="m/s") = 6e-4;\n  input'
)
SAMPLES, STEP = 400, 2.0  # s
LEVELS = ("lower", "upper")


def noise(random: np.random.Generator) -> np.ndarray:
    """White, with a memory of ten samples at three times that level, and a drift."""
    white, more, drift = random.normal(size=(3, SAMPLES))
    coloured = lfilter([np.sqrt(1 - 0.9**2)], [1, -0.9], more)
    return 1e-3 * (white + 3 * coloured + np.cumsum(drift) / np.sqrt(SAMPLES))


def written(folder: Path, concealed: str, size: float = 1.0) -> Path:
    """A case of the believed cascade whose recordings are of a `concealed` one, with noise of so many times the usual
    `size`."""
    machine = truth(folder, "Cascade", concealed)
    time, random = STEP * np.arange(SAMPLES), np.random.default_rng(3)
    for name in ("r1.csv", "r2.csv", "r3.csv"):
        q = 1e-4 * (1 + np.cumsum(random.normal(size=SAMPLES // 50))).clip(0.2, 3).repeat(50)
        errors = {v: size * noise(random) for v in ("lower", "upper")}
        record(folder / name, machine, time, {"q": q}, {v: v for v in errors}, errors)
    (folder / "Cascade.mo").write_text(BELIEVED, encoding="utf-8")
    (folder / "case.toml").write_text(CASE.replace("noise_std = 0.001\n", ""), encoding="utf-8")
    return folder


def test_such_noise_is_the_instruments_own(tmp_path: Path) -> None:
    case = load(written(tmp_path / "case", BELIEVED))
    base = fitted(case, lambda text: None)
    assert not is_noise(base.base)
    assert only_instruments(base.case, base.amendment, base.base)
    found = explain(case)
    assert found.verdict in ("consistent", "parameters")
    assert not found.findings


def test_what_no_instrument_is_off_by_is_not_theirs(tmp_path: Path) -> None:
    """Errors of half the levels' span, slow and of no given level: the worst class of instruments has a twentieth."""
    base = fitted(load(written(tmp_path / "case", BELIEVED, 60.0)), lambda text: None)
    case, free = base.case, [f.name for f in base.base.estimate.free]
    locator = Locator(case, opened(case, base.amendment, case.library(), free), base.base)
    colour = colour_of(locator)
    spans = [np.ptp(np.concatenate([r.columns[s.column] for r in case.fit])) for s in case.outputs]
    assert len(colour.sensor) and np.all(colour.size[0] <= 0.05 * np.array(spans)[colour.sensor])


def test_a_leak_in_such_noise_is_found(tmp_path: Path) -> None:
    case = load(written(tmp_path / "case", LEAKING))
    base = fitted(case, lambda text: None)
    assert not only_instruments(base.case, base.amendment, base.base)
    found = explain(case)
    assert found.verdict == "missing_physics"
    assert [f.ranked.attachment.location for f in found.findings] == ["lower"]


def test_beside_a_given_level_errors_with_a_memory_are_less_than_it(tmp_path: Path) -> None:
    folder = written(tmp_path / "case", BELIEVED)
    toml = (folder / "case.toml").read_text(encoding="utf-8")
    (folder / "case.toml").write_text(toml.replace('unit = "m"\n', 'unit = "m"\nnoise_std = 0.001\n'), encoding="utf-8")
    base = fitted(load(folder), lambda text: None)
    locator = Locator(base.case, opened(base.case, base.amendment, base.case.library(), []), base.base)
    np.testing.assert_allclose(_worst(locator), 0.8 * 0.001, rtol=0.01)


def test_a_channel_that_is_read_early_is_told_by_how_much(tmp_path: Path) -> None:
    """White noise of 1 mm, and one level read 0.3 s before the other, which is about half of that noise."""
    folder, early = tmp_path / "case", 0.3
    folder.mkdir()
    machine, random, time = truth(folder, "Cascade", BELIEVED), np.random.default_rng(4), STEP * np.arange(SAMPLES)
    for name in ("r1.csv", "r2.csv", "r3.csv"):
        q = 1e-4 * (1 + np.cumsum(random.normal(size=SAMPLES // 50))).clip(0.2, 3).repeat(50)
        record(folder / name, machine, time, {"q": q}, {v: v for v in LEVELS}, dict.fromkeys(LEVELS, 0.0))
        table = np.genfromtxt(folder / name, delimiter=",", names=True)
        columns = {n: table[n] for n in table.dtype.names}
        columns["lower"] = np.interp(time + early, time, columns["lower"])
        for v in LEVELS:
            columns[v] = columns[v] + 1e-3 * random.normal(size=SAMPLES)
        rows = np.column_stack([*columns.values()])
        np.savetxt(folder / name, rows, delimiter=",", header=",".join(columns), comments="")
    (folder / "Cascade.mo").write_text(BELIEVED, encoding="utf-8")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    base = fitted(load(folder), lambda text: None)
    case, free = base.case, [f.name for f in base.base.estimate.free]
    locator = Locator(case, opened(case, base.amendment, case.library(), free), base.base)
    told, plain = (evidence(pieces, _NOWHERE) for pieces in (with_clocks(locator), locator.pieces))
    assert told.log[0] > plain.log[0] + 10
    simulated = [r.columns["lower"] - base.base.residuals[r.name]["lower"] for r in case.fit]
    slope = np.concatenate([np.gradient(s, STEP) for s in simulated])
    unit = 0.8 * 1e-3 / np.sqrt(np.mean(slope**2))  # s, of the belief
    error = np.sqrt(np.diag(np.linalg.inv(told.information[0])))
    names = [s.column for s in case.outputs]
    lower, upper = (len(told.mean[0]) - len(names) + names.index(v) for v in ("lower", "upper"))
    assert abs(-told.mean[0, lower] * unit - early) < 4 * error[lower] * unit < early
    assert abs(told.mean[0, upper]) < 4 * error[upper]


@pytest.mark.parametrize("level", [0.002, 0.001])
def test_a_given_level_is_not_exceeded(tmp_path: Path, level: float) -> None:
    folder = written(tmp_path / "case", BELIEVED)
    toml = (folder / "case.toml").read_text(encoding="utf-8")
    toml = toml.replace('unit = "m"\n', f'unit = "m"\nnoise_std = {level}\n')
    (folder / "case.toml").write_text(toml, encoding="utf-8")
    base = fitted(load(folder), lambda text: None)
    assert not only_instruments(base.case, base.amendment, base.base)


@pytest.mark.parametrize(("believed_fit", "colour"), [(1.05, True), (5.0, False)])
def test_colour_is_no_answer_where_only_parameters_far_from_belief_leave_it(
    monkeypatch: pytest.MonkeyPatch, believed_fit: float, colour: bool
) -> None:
    """To first order about such a fit, parameters may seem to come back at no price: 19 nats for the colour, when they
    alone speak against it by 800 (a dead time that five parameters stand for, all by tens of sigmas)."""
    free = [Free("J", 1.0, 0.1, sigma=0.1)]

    def fit(value: float) -> SimpleNamespace:
        return SimpleNamespace(estimate=SimpleNamespace(free=free, values=np.array([value])), level={"w": 1.2})

    finding = SimpleNamespace(ranked=SimpleNamespace(candidate=SimpleNamespace(pick=0.0)))
    result = SimpleNamespace(
        case=None, amendment=Amendment(None), base=fit(believed_fit), final=fit(1.0), findings=[finding],
        lead=SimpleNamespace(direct=True),
    )  # fmt: skip
    monkeypatch.setattr(verdict, "gained", lambda *models: -19.0)
    assert verdict._is_colour(result) == colour
