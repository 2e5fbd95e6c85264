"""`make combined`: maps over two faults, how well both are read, and where not; written to docs/combined.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from bench.progress import progress_bar
from bench.report import stamp
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.combined.grid import build_grid, other_fault
from lacuna.analysis.severity.combined.report import write_studies
from lacuna.analysis.severity.combined.study import run_study
from lacuna.analysis.severity.preparation import TABLE_FILE, prepare_assessment
from lacuna.analysis.severity.severity_table import SeverityTable
from lacuna.codegen.compile import compile_model


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/combined"), help="maps")
    parser.add_argument("--docs", type=Path, default=Path("docs"), help="where combined.md goes")
    parser.add_argument("--tests", type=int, default=512, help="for each pair of faults, a power of two")
    arguments = parser.parse_args()
    settings = load_settings()
    plant = ModelPlant.of(compile_model(settings.disturbed_model), settings)
    with progress_bar("map of one fault") as progress:
        mapped = ModelPlant.of(compile_model(settings.model), settings)
        finished = build_map(mapped, settings, arguments.out / "alone", progress=progress, figures=False)
    prepare_assessment(plant, settings, finished)
    alone, studies = SeverityTable(finished.folder / TABLE_FILE), []
    for entry in settings.raw["combined"]:
        other = other_fault(settings, entry["symbol"])
        with progress_bar(f"map with {other.name}") as progress:
            grid = build_grid(plant, settings, other, arguments.out / other.symbol, progress=progress)
        with progress_bar(f"tests with {other.name}") as progress:
            studies.append(run_study(plant, grid, alone, arguments.tests, progress))
    write_studies(studies, arguments.docs)
    stamp(arguments.docs / "combined.md", "make combined")
    print(f"written: {arguments.docs / 'combined.md'}")


if __name__ == "__main__":
    main()
