"""A small case with a known answer: the laboratory motor, simulated with what the tests conceal in it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.places import read
from lacuna.runtime import Model, RecordedInput, simulate

BELIEVED = {"R": 3.5, "L": 3.3e-3, "Ke": 0.03, "J": 7e-6, "b": 2e-5}
NOISE = {"i": 0.01, "theta": 5e-4}


def write_case(folder: Path, model: str, truth: dict[str, float], seed: int = 1) -> Path:
    """Write a case of three short recordings of `model` (a class with input u and outputs i, theta) into `folder`."""
    machine = Model(compile_model(model).path)
    random = np.random.default_rng(seed)
    time = np.arange(1500) * 1e-3
    folder.mkdir(parents=True, exist_ok=True)
    for k, frequency in enumerate((1.0, 2.3, 3.1)):
        u = (3.0 + k) * np.sin(2 * np.pi * frequency * time) * np.minimum(1.0, time / 0.1)
        result = simulate(
            machine, solver="dopri5", rtol=1e-8, parameters=truth, inputs={"u": RecordedInput(time, u)}, start=0.0,
            stop=float(time[-1]), output_times=time, outputs=["i", "theta"], events=False,
        )  # fmt: skip
        columns = [time, u] + [result[n] + s * random.normal(size=len(time)) for n, s in NOISE.items()]
        np.savetxt(
            folder / f"r{k + 1}.csv", np.column_stack(columns), "%.7g", ",", header="time,u,i,theta", comments=""
        )
    (folder / "case.toml").write_text(_toml(), encoding="utf-8")
    return folder


def _toml() -> str:
    lines = ['title = "motor"', 'model = "Benches.DcServo"', 'source = "synthetic"', "[parameters]"]
    lines += [f"{n} = {v}" for n, v in BELIEVED.items()]
    lines += ["[uncertainty]", "R = 0.03", "L = 0.1", "Ke = 0.03", "J = 0.1", "b = 0.3"]
    lines += ["[signals.u]", 'role = "input"', 'variable = "u"', 'unit = "V"']
    for name, unit in (("i", "A"), ("theta", "rad")):
        lines += [
            f"[signals.{name}]",
            'role = "output"',
            f'variable = "{name}"',
            f'unit = "{unit}"',
            f"noise_std = {NOISE[name]}",
        ]
    lines += ["[recordings]", 'fit = ["r1.csv", "r2.csv"]', 'validate = ["r3.csv"]']
    return "\n".join(lines) + "\n"


def attachment(case: Case, name: str) -> Attachment:
    """The first place of the case's model that suits an effect of the catalogue."""
    library = Library()
    structure = read(library, case.model)
    found = enumerate_attachments(case, structure, catalogue.read(library), Amendment(structure))
    return next(a for a in found if a.effect.name == name)


def conceal(folder: Path, truth: dict[str, float], **effects: str) -> Path:
    """Write a case of the motor with these effects on its shaft: component name = "Effect(parameters)"."""
    lines = ["model ConcealingServo", "  extends Lacuna.Benches.DcServo;"]
    for name, effect in effects.items():
        kind, _, values = effect.partition("(")
        lines.append(f"  Lacuna.Effects.{kind} {name}({values};")
    lines += ["equation", *(f"  connect({name}.flange, shaft.flange_b);" for name in effects), "end ConcealingServo;"]
    return write_case(folder, write_model(folder, lines), truth)


def write_model(folder: Path, lines: list[str]) -> str:
    """The path of a file with the class ConcealingServo."""
    path = folder / "ConcealingServo.mo"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(path)


@pytest.fixture(scope="session")
def consistent_case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("consistent")
    return write_case(folder, "Benches.DcServo", BELIEVED | {"R": 3.57, "J": 7.4e-6})


@pytest.fixture(scope="session")
def friction_case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    truth = BELIEVED | {"R": 3.45}
    return conceal(tmp_path_factory.mktemp("friction"), truth, friction="CoulombFriction(tau_c=0.0015)")
