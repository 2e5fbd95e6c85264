"""`make msl`: the examples of the Modelica Standard Library as they are, translated, simulated and compared.

Writes docs/msl.md. `python -m bench.msl NAME ...` runs examples whose name contains NAME and prints what came out.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
import os
from pathlib import Path

import numpy as np

from bench import isolated, msl_page
from bench.report import stamp
from bench.trajectories import deviation, read_reference
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import search_path
from lacuna.codegen.syntax import ast
from lacuna.runtime.errors import SimulationError
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import Session

ROOT = Path(__file__).parents[1]
PACKAGES = (
    "Blocks", "Electrical.Analog", "Electrical.Machines", "Mechanics.Rotational", "Mechanics.Translational",
    "Thermal.HeatTransfer", "Magnetic.FluxTubes", "StateGraph",
)  # fmt: skip
FURTHER = ("Electrical.Digital", "Electrical.Polyphase", "Electrical.PowerConverters", "Mechanics.MultiBody")
RIGHT = 1e-3  # of a signal's range
TIMEOUT = 300  # s of processor time for one example


def shared_folder() -> Path:
    """The folder of the library, beside this repository or in $LACUNA_SHARED. Raises FileNotFoundError."""
    folder = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared")) / "msl"
    if not folder.is_dir():
        raise FileNotFoundError(f"{folder} is not there: the Modelica Standard Library is no part of this repository")
    return folder


def examples(library: Library, package: str) -> list[str]:
    """Full names of what a package shows: complete models below Examples that say how to be simulated."""
    found = library.all_classes(library.find(f"Modelica.{package}.Examples"))
    return [c.path for c in found if c.kind in ("model", "block", "class") and not c.partial and _has_experiment(c)]


def _has_experiment(cls: ast.Class) -> bool:
    return cls.annotation is not None and any(a.name == "experiment" for a in cls.annotation.arguments)


def first_finding(error: Diagnostic) -> dict[str, object]:
    """What a refusal says first, without the paths of this machine."""
    place = f"{Path(error.span.file).name}:{error.span.line}" if error.span else ""
    return {"code": error.code, "place": place, "message": error.message}


def measure(name: str, folder: Path, units: str) -> dict[str, object]:
    """Translate, simulate and compare one example."""
    try:
        compiled = compile_model(name, search_path=search_path([folder]), units=units)
    except Diagnostic as error:
        return {"status": "refused", **first_finding(error), "text": str(error)}
    model = Model(compiled.path)
    path = folder / "reference" / f"{name}.csv"
    reference = read_reference(path) if path.is_file() else None
    missing = [n for n in reference.signals if n not in model.variables] if reference else []
    wanted = [n for n in reference.signals if n not in missing] if reference else None
    recorded = [n for n in wanted if model.variables[n].kind != "parameter"] if reference else []
    try:
        grid = reference.grid if reference else None
        session = Session(model, outputs=recorded, output_times=grid, events=False)
        result = session.run(stop=max(model.stop_time, reference.time[-1]) if reference else None)
    except SimulationError as error:
        return {"status": "failed", "message": str(error)}
    if not result.complete:
        return {"status": "failed", "message": str(result.failure), "time": result.failure.time}
    if reference is None:
        return {"status": "ran"}
    keep = np.append(np.diff(result.time) > 0, True)
    off = {n: deviation(reference, n, result.time[keep], result[n][keep]) for n in wanted}
    worst = max(off, key=off.__getitem__, default="")
    right = not missing and all(d <= RIGHT for d in off.values())
    return {"status": "right" if right else "wrong", "worst": worst, "deviation": off.get(worst), "missing": missing,
            "signals": len(reference.signals)}  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="parts of names of examples (default: all of the listed packages)")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "msl")
    parser.add_argument("--units", default="error")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=TIMEOUT)
    parser.add_argument("--further", action="store_true", help="the packages without a goal, too")
    parser.add_argument("--keep", action="store_true", help="keep results of an earlier generator")
    parser.add_argument("--page", action="store_true", help="write docs/msl.md")
    chosen = parser.parse_args(arguments)
    folder = shared_folder()
    library = Library(search_path([folder]))
    packages = PACKAGES + FURTHER if chosen.further or chosen.page else PACKAGES
    names = {p: [n for n in examples(library, p) if not chosen.names or any(part in n for part in chosen.names)]
             for p in packages}  # fmt: skip
    results = isolated.run_all(
        [n for listed in names.values() for n in listed],
        lambda n: measure(n, folder, chosen.units),
        chosen.out, timeout=chosen.timeout, workers=chosen.workers, keep=chosen.keep,
    )  # fmt: skip
    if chosen.page:
        goal, further = ({p: names[p] for p in part} for part in (PACKAGES, FURTHER))
        msl_page.write(ROOT / "docs" / "msl.md", goal, further, results)
        stamp(ROOT / "docs" / "msl.md", "make msl")
    if chosen.names:
        for name, outcome in results.items():
            print(name, *(f"  {k}: {v}" for k, v in outcome.items() if k != "generator"), sep="\n")
    print(dict(Counter(str(r["status"]) for r in results.values())))


if __name__ == "__main__":
    main()
