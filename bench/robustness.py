"""`make robustness`: thousands of simulated pre-flight tests over all nuisances, written to docs/robustness.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from bench.progress import progress_bar
from bench.report import stamp
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.report.robustness import write_study
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.preparation import prepare_assessment
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.robustness import run_tests
from lacuna.codegen.compile import compile_model

STRANGERS = 128  # tests of each actuator that is not the map's


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/robustness"), help="map and finished tests")
    parser.add_argument("--docs", type=Path, default=Path("docs"), help="where robustness.md goes")
    parser.add_argument("--tests", type=int, default=8192, help="a power of two")
    arguments = parser.parse_args()
    settings = load_settings()
    plant = ModelPlant.of(compile_model(settings.disturbed_model), settings)
    with progress_bar("map") as progress:
        mapped = ModelPlant.of(compile_model(settings.model), settings)
        finished = build_map(mapped, settings, arguments.out / "map", progress=progress, figures=False)
    prepare_assessment(plant, settings, finished)
    prepared, store = Prepared(finished.folder), arguments.out / "tests"
    with progress_bar("tests") as progress:
        results = run_tests(plant, prepared, store, arguments.tests, progress=progress)
    strangers = [
        (stranger["name"], run_tests(plant, prepared, store, STRANGERS, stranger=stranger))
        for stranger in settings.raw.get("strangers", [])
    ]
    write_study(settings, results, strangers, arguments.docs)
    stamp(arguments.docs / "robustness.md", "make robustness")
    print(f"written: {arguments.docs / 'robustness.md'}")


if __name__ == "__main__":
    main()
