"""`make prognosis`: forecasts on a simulated fleet, scored beside rivals, written to docs/prognosis.md.

Fixed before the first full run: SEED, PARTS, the fleet (fleet.py, truth.py), scores (scores.py) and goals (page.py).
"""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path

import numpy as np

from bench.prognosis import page, study
from bench.prognosis.fleet import Part, Readings, part
from bench.prognosis.oracle import Oracle, oracle
from bench.prognosis.rivals import PARTICLES
from bench.prognosis.scores import Scores
from bench.prognosis.truth import KNOWN, UNKNOWN
from bench.report import stamp
import lacuna
from lacuna.analysis.files import load_arrays
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.forecast import fleet_prior
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.preparation import prepare_assessment
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.robustness import Results, run_tests
from lacuna.codegen.compile import compile_model

SEED, PARTS, PROGPY_PARTS, ORACLE_PARTS, PAIRS, TESTS = 20261125, 1000, 200, 100, 60, 4096
PAST, PAST_PARTS = 1_000_000, 300  # parts of the same fleet whose lives have ended
RISK = 0.001  # the command's default


def simulated(out: Path) -> Results:
    """4096 simulated and assessed pre-flight tests, kept in out/readings.npz."""
    kept, names = out / "readings.npz", tuple(Results.__dataclass_fields__)
    if not kept.exists():
        settings = load_settings()
        finished = build_map(
            ModelPlant.of(compile_model(settings.model), settings), settings, out / "map", figures=False
        )
        plant = ModelPlant.of(compile_model(settings.disturbed_model), settings)
        prepare_assessment(plant, settings, finished)
        found = run_tests(plant, Prepared(finished.folder), out / "tests", TESTS)
        np.savez(kept, **{name: getattr(found, name) for name in names})
    return Results(**load_arrays(kept, names))


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
    tests = simulated(arguments.out)
    drawn = Readings(tests)
    parts = [part(k, arguments.seed, drawn) for k in range(arguments.parts)]
    past = [part(PAST + k, arguments.seed, drawn) for k in range(min(PAST_PARTS, arguments.parts))]
    text = measured(parts, past, tests, arguments.seed)
    arguments.docs.mkdir(parents=True, exist_ok=True)
    (arguments.docs / "prognosis.md").write_text(text, encoding="utf-8")
    stamp(arguments.docs / "prognosis.md", "make prognosis")
    print(f"written: {arguments.docs / 'prognosis.md'}")


def measured(parts: list[Part], past: list[Part], tests: Results, seed: int) -> str:
    taught = Bank(lacuna.degradation_laws())
    fleet_prior([p.history for p in past], taught, lambda _: study.LIMITS)

    def bank() -> Bank:
        """With the prior of the fleet's past."""
        own = Bank(taught.laws)
        own.prior = taught.prior
        return own

    ours, alone = (study.arm(parts, own, RISK, tell) for own in (taught, Bank(taught.laws)))
    why = study.progpy_verdict()
    rivals = beside(parts, tests, seed, progpy=not why)
    is_unknown = np.array([p.law in UNKNOWN for p in parts])
    late, early = page.LATE, ~page.LATE
    return page.PAGE.format(
        seed=seed,
        version=lacuna.__version__,
        count=len(parts),
        planned=PARTS,
        outside=int(is_unknown.sum()),
        past=len(past),
        goals="\n".join(page.goals([ours, alone], rivals, is_unknown)),
        shares=" | ".join(f"{100 * c:.0f} %" for c in page.CHECKPOINTS),
        dashes=" | ".join("---" for _ in page.CHECKPOINTS),
        table="\n".join(page.table(ours, alone.scores, rivals)),
        oracle=len(rivals.watched),
        best=page.spread(rivals.population.best.mean(axis=0)[late]),
        best_early=page.spread(rivals.population.best.mean(axis=0)[early]),
        reach=page.reach(rivals.population.best.mean(axis=0)),
        best_law=page.spread(rivals.law.best.mean(axis=0)[late]),
        best_shape=page.spread(rivals.shape.best.mean(axis=0)[late]),
        oracle95=page.spread(rivals.population.scores.coverage(0, 4)),
        horizon=100 * ours.scores.horizon(),
        laws="\n".join(page.by_law(ours.scores, [p.law for p in parts])),
        removals_text=REMOVALS,
        removals="\n".join(_removals(parts, ours.removals, alone.removals)),
        two_faults=_two(study.two_faults(parts[: 2 * PAIRS], bank, seed)),
        progpy=why or PROGPY.format(version=study.progpy_version(), count=len(rivals.known), particles=PARTICLES),
    )


def beside(parts: list[Part], tests: Results, seed: int, *, progpy: bool) -> page.Rivals:
    """The rivals: those that know nothing, and those that are told."""
    kind = np.array([p.law in KNOWN for p in parts])
    known = np.flatnonzero(kind)[:PROGPY_PARTS]
    watched = np.arange(min(ORACLE_PARTS, len(parts)))
    watched_known = watched[kind[watched]]

    def told(rows: np.ndarray, what: str) -> Oracle:
        tell(f"oracle told the {what}", 0.0)
        return oracle([parts[k] for k in rows], tests, what, seed)

    def by_progpy(shape: bool) -> Scores | None:
        tell("progpy", 0.5 * shape)
        samples = partial(study.progpy_samples, seed, shape)
        return study.sample_scores([parts[k] for k in known], samples) if progpy else None

    line = study.sample_scores(parts, partial(study.line_samples, seed))
    oracles = (told(watched_known, "law"), told(watched_known, "shape"))
    return page.Rivals(
        line, watched, told(watched, "population"), watched_known, *oracles, known, by_progpy(False), by_progpy(True)
    )


REMOVALS = f"""A part is removed at the first test after which the risk of violet by the next exceeds {RISK:g};
by thresholds, at the first test that reads red (27 %)."""
PROGPY = """Version {version}, its particle filter of {particles}, on the first {count} parts of a law of the
catalogue's kind. *Told the law*: the equation; its rate and its shape are unknown constants among the states, the shape
drawn from where the fleet draws it. *Told law and shape*: the part's own exponent or level besides, which nobody knows
of a part in service. First its mean and spread must follow the Kalman filter to 0.3 standard deviations on our test;
with its default resampling (of filterpy 2.0.0) they do not, so that systematic resampling is used."""


def _removals(parts: list[Part], removed: study.Removals, alone: study.Removals) -> list[str]:
    return [
        page.removal_line("advised last test", removed),
        page.removal_line("advised last test, alone", alone),
        page.removal_line(
            "severity reads red", study.threshold_removals(parts, lambda p: p.history.severity, study.RED)
        ),
        page.removal_line(
            "mean RMS reads red (the paper)", study.threshold_removals(parts, lambda p: p.mean_rms, study.RED)
        ),
    ]


def _two(both: dict) -> str:
    rows = [f"| {100 * s:.0f} % | {100 * a:.1f} % | {100 * b:.1f} % | {n} |" for s, (a, b, n) in both.items()]
    head = "| share of the shorter life | eccentricity: 95 % holds | friction: 95 % holds | forecasts |"
    return "\n".join([head, "| --- | --- | --- | --- |", *rows])


if __name__ == "__main__":
    main()
