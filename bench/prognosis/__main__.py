"""`make prognosis`: forecasts on a simulated fleet, scored beside rivals, written to docs/prognosis.md.

Fixed before the first full run: SEED, PARTS, the fleet (fleet.py, truth.py), scores (scores.py) and goals (page.py).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from bench.prognosis import page, study
from bench.prognosis.fleet import Part, Readings, part
from bench.prognosis.truth import KNOWN, UNKNOWN
import lacuna
from lacuna.analysis.files import load_arrays
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.prognosis.bank import Bank
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.preparation import prepare_assessment
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.robustness import Results, run_tests
from lacuna.codegen.compile import compile_model

SEED, PARTS, PROGPY_PARTS, PAIRS, TESTS = 20261123, 1000, 200, 60, 4096
RISK = 0.001  # the command's default


def readings(out: Path) -> Readings:
    """4096 simulated and assessed pre-flight tests, kept in out/readings.npz."""
    kept, names = out / "readings.npz", tuple(Results.__dataclass_fields__)
    if not kept.exists():
        settings = load_settings()
        finished = build_map(ModelPlant.of(compile_model(settings.model), settings), settings, out / "map", figures=False)
        plant = ModelPlant.of(compile_model(settings.disturbed_model), settings)
        prepare_assessment(plant, settings, finished)
        found = run_tests(plant, Prepared(finished.folder), out / "tests", TESTS)
        np.savez(kept, **{name: getattr(found, name) for name in names})
    return Readings(Results(**load_arrays(kept, names)))


def tell(what: str, share: float) -> None:
    print(f"{what}: {100 * share:.0f} %", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/prognosis"))
    parser.add_argument("--docs", type=Path, default=Path("docs"))
    parser.add_argument("--parts", type=int, default=PARTS)
    parser.add_argument("--seed", type=int, default=SEED)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    drawn = readings(arguments.out)
    parts = [part(k, arguments.seed, drawn) for k in range(arguments.parts)]
    text = measured(parts, arguments.seed)
    arguments.docs.mkdir(parents=True, exist_ok=True)
    (arguments.docs / "prognosis.md").write_text(text, encoding="utf-8")
    print(f"written: {arguments.docs / 'prognosis.md'}")


def measured(parts: list[Part], seed: int) -> str:
    laws = lacuna.degradation_laws()

    def bank() -> Bank:
        return Bank(laws)

    scores, verdicts = study.forecast_scores(parts, bank, True, tell)
    alone, _ = study.forecast_scores(parts, bank, False, tell)
    line = study.sample_scores(parts, study.line_samples(seed), lambda *_: None)
    known = np.array([k for k, p in enumerate(parts) if p.law in KNOWN][:PROGPY_PARTS])
    why = study.progpy_verdict()
    progpy = None
    if not why:
        progpy = study.sample_scores([parts[k] for k in known], study.progpy_samples(seed), lambda *_: None)
    removed = study.advised_removals(parts, bank(), RISK, tell)
    unknown = scores.rows(np.array([p.law in UNKNOWN for p in parts]))
    goals = page.goals(scores, line, scores.rows(known), progpy, unknown, removed)
    both = study.two_faults(parts[: 2 * PAIRS], bank, seed)
    return page.PAGE.format(
        seed=seed, version=lacuna.__version__, count=len(parts), outside=len(unknown.truth),
        goals="\n".join(row.line() for row in goals),
        shares=" | ".join(f"{100 * c:.0f} %" for c in page.CHECKPOINTS), dashes=" | ".join("---" for _ in page.CHECKPOINTS),
        table="\n".join(page.table(scores, alone, line, verdicts, progpy, known)),
        laws="\n".join(page.by_law(scores, [p.law for p in parts])),
        removals_text=f"A part is removed at the first test after which the risk of violet by the next exceeds {RISK:g}; "
        "by thresholds, at the first test that reads red (27 %).",
        removals="\n".join([
            page.removal_line("advised last test", removed),
            page.removal_line("severity reads red", study.threshold_removals(parts, lambda p: p.history.severity, study.RED)),
            page.removal_line("mean RMS reads red (the paper)", study.threshold_removals(parts, lambda p: p.mean_rms, study.RED)),
        ]),
        two_faults=_two(both),
        progpy=why or f"Version {study.progpy_version()}, particle filter of 500, told the law and its shape, on the first {len(known)} parts of "
        "a law of the catalogue's kind; its mean and spread follow the Kalman filter to 0.3 standard deviations first. Its default "
        "resampling (filterpy 2.0.0) does not, so that systematic resampling is used.",
    )  # fmt: skip


def _two(both: dict) -> str:
    rows = [f"| {100 * s:.0f} % | {100 * a:.1f} % | {100 * b:.1f} % | {n} |" for s, (a, b, n) in both.items()]
    head = "| share of the shorter life | eccentricity: 95 % holds | friction: 95 % holds | forecasts |\n| --- | --- | --- | --- |"
    return "\n".join([head, *rows])


if __name__ == "__main__":
    main()
