"""`make robustness`: thousands of simulated pre-flight tests over all nuisances, written to docs/robustness.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from analysis.maps import build_map
from analysis.plant import ModelPlant
from analysis.preparation import TABLE_FILE, prepare_assessment
from analysis.progress import progress_bar
from analysis.robustness import run_tests
from analysis.robustness_report import write_study
from analysis.settings import load_settings
from codegen.compile import compile_model


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/robustness"), help="map and finished tests")
    parser.add_argument("--docs", type=Path, default=Path("docs"), help="where robustness.md goes")
    parser.add_argument("--tests", type=int, default=8192, help="a power of two")
    arguments = parser.parse_args()
    settings = load_settings()
    compiled = compile_model(settings.model)
    plant = ModelPlant(compiled.name, compiled.path, compiled.hash, settings, compiled.report.seconds)
    with progress_bar("map") as progress:
        finished = build_map(plant, settings, arguments.out / "map", progress=progress, figures=False)
    prepare_assessment(plant, settings, finished)
    with progress_bar("tests") as progress:
        table, store = arguments.out / "map" / TABLE_FILE, arguments.out / "tests"
        results = run_tests(plant, settings, table, store, arguments.tests, progress=progress)
    write_study(settings, results, arguments.docs)
    print(f"written: {arguments.docs / 'robustness.md'}")


if __name__ == "__main__":
    main()
