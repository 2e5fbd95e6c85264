"""`make real-machines`: explain recordings of real machines; writes the table and figures of docs/real-machines.md."""

from __future__ import annotations

from dataclasses import dataclass
import os
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from bench.report import stamp
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case import cases
from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.explain import Explanation, explain, write_amended
from lacuna.discovery.explanation import diagnosis, report

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "real-machines.md"
HEAD = """| recordings | found | parameters | NRMSE of the fit, before, after | of validation, before, after |
| --- | --- | --- | ---: | ---: |"""
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


@dataclass(frozen=True)
class Machine:
    """A case folder, the recordings to show, and the input against which the second is drawn ("" for time)."""

    case: str
    first: str
    second: str
    abscissa: str


MACHINES = (
    Machine("lab-dc-motor", "ramp_5.csv", "sine_1hz.csv", "u"),
    Machine("band-damper", "sine_0.5hz_25mm.csv", "sine_0.25hz_38mm.csv", "x"),
    Machine("servo-hsm150", "neg_0.04_3.csv", "pos_0.06_2.csv", ""),
)


def recordings_folder() -> Path:
    """The folder `real` of the recordings, beside this repository or in $LACUNA_SHARED. Raises FileNotFoundError."""
    folder = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared")) / "recordings" / "real"
    if not folder.is_dir():
        raise FileNotFoundError(f"{folder} is not there: recordings of real machines are no part of this repository")
    return folder


def explained(name: str, out: Path, library: Library) -> Explanation:
    """Explain one case and write its diagnosis, report and amended model into `out`/name."""
    case = cases.load(recordings_folder() / name)
    result = explain(case, progress=lambda text: print(f"{name}: {text}", file=sys.stderr), library=library)
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    amended = write_amended(result, folder)
    diagnosis.write(result, folder, amended)
    report.write(result, folder, amended)
    return result


def row(result: Explanation) -> str:
    """One line of the table."""
    return line(result.case.folder.name, diagnosis.build(result, None))


def line(name: str, found: dict) -> str:
    """The same from a diagnosis as written."""
    findings = [
        f"{f['effect']} at {f['location']}" + (f": `{f['law']}`" if f.get("law") else "") for f in found["findings"]
    ]
    values = [
        f"{n} {p['value']:.3g} ± {p['std']:.1g} {p['unit']}"
        for f in found["findings"]
        for n, p in f["parameters"].items()
        if not f.get("law")
    ]
    fit, validate = (found["nrmse"][k] for k in ("fit", "validate"))
    return (
        f"| {name} | {'; '.join(findings) or found['verdict']} | {', '.join(values)} | {fit['before']:.4f}, "
        f"{fit['after']:.4f} | {validate['before']:.4f}, {validate['after']:.4f} |"
    )


def table(results: list[Explanation]) -> str:
    return "\n".join([HEAD, *(row(r) for r in results)])


def draw(machine: Machine, result: Explanation, path: Path) -> None:
    """Measured, believed and amended output of two validation recordings."""
    case, signal = result.case, result.case.outputs[0]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    for axes, name, abscissa in ((left, machine.first, ""), (right, machine.second, machine.abscissa)):
        recording = next(r for r in case.validate if r.name == name)
        x, label = _abscissa(case, recording, abscissa)
        measured = recording.columns[signal.column]
        for judgement, text in ((result.before, "believed, refitted"), (result.after, "amended")):
            axes.plot(x, measured - judgement.residuals[name][signal.column], lw=1.0, label=text, zorder=2)
        axes.plot(x, measured, color="0.6", lw=0.6, label="measured", zorder=1)
        axes.set(xlabel=label, ylabel=f"{signal.variable}, {signal.si_unit}", title=name)
    left.legend()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _abscissa(case: Case, recording: Recording, column: str) -> tuple:
    if not column:
        return recording.time, "time, s"
    return recording.columns[column], f"{column}, {case.signals[column].si_unit}"


def main() -> None:
    try:
        recordings_folder()
    except FileNotFoundError as error:
        sys.exit(f"error: {error}")
    library = Library()
    results = []
    for machine in MACHINES:
        result = explained(machine.case, ROOT / "out" / "real", library)
        draw(machine, result, ROOT / "docs" / "figures" / f"real_{machine.case.replace('-', '_')}.png")
        results.append(result)
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n{table(results)}\n{END}{rest.split(END)[1]}", encoding="utf-8")
    stamp(PAGE, "make real-machines")
    print(f"written: {PAGE.relative_to(ROOT)} and its figures")


if __name__ == "__main__":
    main()
