"""Case folders and truths as text, in the recordings' format."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tests.proof.case import Case


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(v) for v in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{k} = {_toml(v)}" for k, v in value.items()) + "}"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _table(name: str, values: Mapping[str, object]) -> str:
    return f"[{name}]\n" + "".join(f"{k} = {_toml(v)}\n" for k, v in values.items()) + "\n"


def _recording(case: "Case", path: Path, u: np.ndarray, y: np.ndarray) -> None:
    bench = case.bench
    decimals = [bench.instruments[name].decimals for name in case.outputs]
    header = ",".join(["time", *bench.machine.inputs, *case.outputs])
    period = len(f"{bench.period:g}".split(".")[1])
    lines = [header]
    for k, (inputs, outputs) in enumerate(zip(u, y, strict=True)):
        fields = [f"{k * bench.period:.{period}f}", *(f"{v:.8g}" for v in inputs)]
        fields += ["" if np.isnan(v) else f"{v:.{d}f}" for v, d in zip(outputs, decimals, strict=True)]
        lines.append(",".join(fields))
    path.write_text("\n".join(lines) + "\n")


def write_case(case: "Case", folder: Path, noise: Mapping[str, float]) -> None:
    """case.toml and the recordings; nothing in them tells what was concealed."""
    folder.mkdir(parents=True, exist_ok=True)
    bench = case.bench
    text = f'title = "{bench.title}, case {case.name}"\nmodel = "{bench.model}"\nsource = "synthetic"\n\n'
    text += _table("parameters", {**case.believed, **({"pp": 2} if "pp" in bench.uncertainty else {})})
    text += _table("uncertainty", bench.uncertainty)
    for name in bench.machine.inputs:
        held = {"interpolation": "hold"} if name in bench.hold else {}
        text += _table(f"signals.{name}", {"role": "input", "variable": name, "unit": bench.input_units[name], **held})
    for name in case.outputs:
        known = {} if case.unknown_noise else {"noise_std": noise[name]}
        text += _table(
            f"signals.{name}", {"role": "output", "variable": name, "unit": bench.instruments[name].unit, **known}
        )
    files = [f"r{k + 1}.csv" for k in range(len(case.inputs))]
    text += _table("recordings", {"fit": files[: case.fit], "validate": files[case.fit :]})
    (folder / "case.toml").write_text(text)
    for file, u, y in zip(files, case.inputs, case.measured, strict=True):
        _recording(case, folder / file, u, y)


VERDICTS = {
    "effect": ("missing_physics",),
    "two": ("missing_physics",),
    "law": ("missing_physics",),
    "consistent": ("consistent",),
    "parameters": ("parameters",),
    "weak": ("undetermined", "missing_physics", "consistent"),
    "one_way": ("missing_physics", "undetermined"),
    "rivals": ("undetermined",),
}


def write_truth(case: "Case", path: Path, seed: int) -> None:
    """What is in the case: verdict, effects with their places and values, and the errors of the two ends."""
    path.parent.mkdir(parents=True, exist_ok=True)
    verdicts = VERDICTS[case.plan.kind]
    text = f"kind = {_toml(case.plan.kind)}\nmodel = {_toml(case.bench.model)}\nverdict = {_toml(verdicts[0])}\n"
    text += f"accept_verdicts = {_toml(verdicts)}\nseed = {seed}\nparameters_off = {_toml(case.plan.off)}\n\n"
    for part in ("fit", "validate"):
        text += _table(f"nrmse.{part}", case.refit[part])
    text += _table("true_parameters", case.true) + _table("refitted_parameters", case.refit["parameters"])
    for c in case.concealed:
        text += "[[effects]]\n" + "".join(
            f"{k} = {_toml(v)}\n"
            for k, v in {
                "effect": c.effect,
                "location": c.location,
                "accept_locations": c.accept_locations or (c.location,),
                "accept_effects": (c.effect, *c.accept_effects),
                "outside_vocabulary": c.outside_vocabulary,
                "law": c.law,
            }.items()
        )
        for name, (value, unit, aliases) in c.parameters.items():
            text += f"parameters.{name} = " + _toml({"value": float(value), "unit": unit, "aliases": aliases}) + "\n"
        text += "\n"
    path.write_text(text)
