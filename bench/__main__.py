"""`make bench`: every measurement in turn, each printed as soon as it is there, all written at the end."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from bench import (
    campaign,
    diagnosis,
    growth,
    keystrokes,
    library,
    maps,
    onboard,
    race,
    report,
    scenarios,
    sensitivities,
    watching,
)

Section = Callable[[int], Sequence[report.Row]]


def races(rounds: int) -> list[report.Row]:
    return [_shown(entry) for name in race.PROBLEMS for entry in race.race(name, rounds)]


def _shown(entry: race.Entry) -> report.Row:
    counts = entry.counters
    return {
        "problem": entry.problem,
        "program": entry.rival,
        "time ratio": entry.ratio,
        "goal": entry.goal,
        "ms": 1e3 * entry.seconds,
        "spread": entry.spread,
        "error": entry.error,
        "steps": counts["steps"],
        "evaluations": counts["residuals"] + counts.get("rhs", 0),
        "Jacobians": counts["jacobians"],
    }


SECTIONS: dict[str, tuple[str, Section]] = {
    "races": ("T1 and T2 beside a program written by hand over IDA (time ratio 1)", races),
    "maps": ("The paper's map, 51 severities", maps.split),
    "scenarios": ("The whole actuator against the clock", scenarios.against_the_clock),
    "onboard": ("The on-board assessment chain against the clock", onboard.against_the_clock),
    "sensitivities": ("Runs with sensitivities, as multiples of the same run without", sensitivities.cost),
    "campaign": ("192 tests of the map's kind under nuisances, here and on Dask workers", campaign.scale),
    "growth": (
        "Ladders and chains of 100 to 10 000 states: translation, compiler, IDA beside a program by hand",
        growth.growth,
    ),
    "library": (
        "The Modelica Standard Library parsed and every class looked up, in fresh processes",
        library.read_whole,
    ),
    "watching": ("From the save of an equation to the new figure", watching.from_save_to_figure),
    "keystrokes": ("From a keystroke to the language server's findings", keystrokes.from_keystroke_to_findings),
    "diagnosis": ("Practice cases explained, seconds", diagnosis.split),
}


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/bench"), help="folder for the results")
    parser.add_argument("--rounds", type=int, default=9, help="interleaved rounds of each race")
    parser.add_argument("--only", choices=SECTIONS, action="append", help="measure only this; repeat for more")
    arguments = parser.parse_args()
    measured: dict[str, Sequence[report.Row]] = {}
    for name in arguments.only or SECTIONS:
        title, section = SECTIONS[name]
        measured[name] = section(arguments.rounds)
        if not measured[name]:
            print(f"{title}: skipped, its data are not at hand (see LACUNA_SHARED in docs/guide)")
            continue
        report.show(title, measured[name])
        report.write_csv(arguments.out / f"{name}.csv", measured[name])
    report.write_json(arguments.out / "bench.json", measured)
    print(f"written: {arguments.out}")


if __name__ == "__main__":
    main()
