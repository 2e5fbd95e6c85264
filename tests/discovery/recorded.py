"""Recordings of cases that tests write: a simulated machine, read with errors; and that machine, or a tank."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.discovery.efforts.places.insertion import probe
from lacuna.discovery.efforts.places.sites import Site
from lacuna.runtime import Model, RecordedInput, simulate

TANK = """model Tank "A tank with an outlet"
  parameter Real A(unit="m2") = 0.01;
  parameter Real k(unit="m2/s", min=0) = 3e-4;
  input Real q(unit="m3/s");
  Real h(unit="m", start=0.2, fixed=true);
equation
  A*der(h) = q - {outflow};
end Tank;
"""


def truth(folder: Path, name: str, text: str, cls: str = "") -> Model:
    """The machine that is concealed: `text`, written where no case looks, and compiled; `cls` in it, if it has several.
    Nobody checks the units of a machine."""
    path = folder / "truth" / f"{name}.mo"
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    return Model(compile_model(f"{path}:{cls}" if cls else str(path), units="warn").path)


def concealed(
    folder: Path, name: str, machine: str, believed: str, case: str, cls: str = ""
) -> tuple[Path, Model]:  # fmt: skip
    """(folder of a case without recordings, the machine that is concealed): the texts of the file `name` as it is and
    as it is believed to be, and that of case.toml; `cls` as in `truth`."""
    there = folder / "case"
    there.mkdir()
    (there / f"{name}.mo").write_text(believed, encoding="utf-8")
    (there / "case.toml").write_text(case, encoding="utf-8")
    return there, truth(folder, name, machine, cls)


def record(
    path: Path, machine: Model, time: np.ndarray, inputs: Mapping[str, np.ndarray], outputs: Mapping[str, str],
    errors: Mapping[str, np.ndarray],
) -> None:  # fmt: skip
    """Write `path`: time (s), the `inputs` by their names, linear between samples, and of each column of `outputs` its
    variable with its `errors` added."""
    run = simulate(
        machine, solver="dopri5", rtol=1e-9, inputs={n: RecordedInput(time, v) for n, v in inputs.items()},
        start=0.0, stop=float(time[-1]), output_times=time, outputs=list(outputs.values()), events=False,
    )  # fmt: skip
    columns = {"time": time, **inputs} | {n: run[v] + errors[n] for n, v in outputs.items()}
    np.savetxt(path, np.column_stack(list(columns.values())), "%.8g", ",", header=",".join(columns), comments="")


def acted(
    source: Path, model: str, sites: Sequence[Site], effort: float, names: Sequence[str], times: np.ndarray,
    silent: Sequence[str] = (),
) -> list[np.ndarray]:  # fmt: skip
    """Variables at `times` of a `model`, which stands in the file or the folder `source`, with a constant effort at
    each of its sites; the inputs of its own, `silent`, are zero."""
    pairs = [probe(site, k) for k, site in enumerate(sites)]
    structure = structure_of(Library([str(source)]), model)
    amendment = Amendment(structure, attachments=[a for a, _ in pairs], inputs=tuple(n for _, n in pairs))
    file = (source if source.is_dir() else source.parent) / "Amended.mo"
    file.write_text(amendment.text("Amended"))
    machine = Model(compile_model(str(file), search_path=[str(source)]).path)
    inputs = {n: RecordedInput([0.0], [effort], "hold") for _, n in pairs}
    inputs |= {n: RecordedInput([0.0], [0.0], "hold") for n in silent}
    run = simulate(
        machine, solver="dopri5", rtol=1e-9, inputs=inputs, start=0.0, stop=float(times[-1]), output_times=times,
        outputs=list(names), events=False,
    )  # fmt: skip
    return [np.array(run[n]) for n in names]
