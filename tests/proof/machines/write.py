"""A drawn case as a folder of the recordings' format, and its truth beside it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tests.proof.write import _table, _toml

if TYPE_CHECKING:
    from tests.proof.machines.generate import Drawn

VERDICTS = {
    "effect": ("missing_physics",),
    "two": ("missing_physics",),
    "consistent": ("consistent",),
    "parameters": ("parameters",),
    "weak": ("consistent", "undetermined", "missing_physics"),
    "half": ("missing_physics", "undetermined"),
}


def write_case(case: Drawn, measured: dict[str, np.ndarray], name: str, folder: Path) -> None:
    """The model in its own file, case.toml and the recordings; nothing in them tells what was concealed."""
    folder.mkdir(parents=True, exist_ok=True)
    machine = case.machine
    (folder / f"{machine.name}.mo").write_text(machine.text())
    file = f"{machine.name}.mo" + (f":{machine.inner}" if machine.inner else "")
    text = f'title = "{machine.name}, case {name}"\nmodel = "{file}"\nsource = "synthetic"\n\n'
    text += _table("parameters", case.believed)
    text += _table("uncertainty", {n: p.sigma for n, p in machine.parameters.items()})
    for n, i in machine.inputs.items():
        text += _table(f"signals.{n}", {"role": "input", "variable": n, "unit": i.unit})
    for n in case.outputs:
        o = machine.outputs[n]
        given = {"noise_std": case.noise[n]} if case.given else {}
        text += _table(f"signals.{n}", {"role": "output", "variable": o.variable, "unit": o.unit, **given})
    count = next(iter(case.drive.values())).shape[1]
    files = [f"r{k + 1}.csv" for k in range(count)]
    text += _table("recordings", {"fit": files[:-1], "validate": files[-1:]})
    (folder / "case.toml").write_text(text)
    for k, file in enumerate(files):
        lines = [",".join(["time", *machine.inputs, *case.outputs])]
        for j in range(machine.samples):
            fields = [f"{j * machine.period:.8g}", *(f"{case.drive[n][j, k]:.8g}" for n in machine.inputs)]
            lines.append(",".join([*fields, *(f"{measured[n][j, k]:.8g}" for n in case.outputs)]))
        (folder / file).write_text("\n".join(lines) + "\n")


def write_truth(case: Drawn, ends: dict, path: Path, seed: int) -> None:
    """What is in the case, where, and the errors of both ends."""
    path.parent.mkdir(parents=True, exist_ok=True)
    kind, machine = case.plan.kind, case.machine
    text = f"kind = {_toml(kind)}\nmodel = {_toml(machine.name)}\ndomain = {_toml(machine.domain)}\n"
    text += f"style = {_toml(machine.style)}\naccept_verdicts = {_toml(VERDICTS[kind])}\nseed = {seed}\n"
    text += f"off = {_toml(case.off)}\nnuisances = {_toml(case.nuisances)}\n\n"
    for part in ("fit", "validate"):
        text += _table(f"nrmse.{part}", ends[part])
    text += _table("true_parameters", {n: float(v) for n, v in case.true.items()})
    for h, q in case.hidden:
        text += "[[effects]]\n" + "".join(
            f"{k} = {_toml(v)}\n"
            for k, v in {
                "name": h.name,
                "law": h.text,
                "accept_locations": h.accept,
                "size": q,
                "state": h.rate is not None,
            }.items()
        )
    path.write_text(text)
