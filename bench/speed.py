"""`make speed`: measure what README says of speed, and write docs/speed.md, from which it has its numbers."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

from bench import report
from bench.__main__ import SECTIONS

PAGE = Path(__file__).parents[1] / "docs" / "speed.md"
WRITTEN = {  # of each section what it is about, and the columns that are shown
    "races": (
        "T1 is a DC servo that sticks and slips for 10 s, T2 a three-phase motor with 582 commutations in 1 s; "
        "relative tolerance 1e-6. Times are processor times over that of a program by hand over IDA with a dense "
        "analytic Jacobian, the median of interleaved rounds; errors the largest on the output grid against a tight "
        "reference.",
        ("problem", "program", "time ratio", "ms", "error", "steps"),
    ),
    "scenarios": (
        "The flight control actuator, 24 unknowns with continuous control: a step, a slow sine that sticks and slips, "
        "reversals through play. Errors are of speed and position, over their largest magnitude.",
        ("scenario", "lane", "times real time", "error", "steps", "events"),
    ),
    "growth": (
        "Processor time of translation and compiler; the exponent is that of the whole from one size to the next. "
        "IDA ratio: time of IDA with KLU over that of a program by hand over the same solvers.",
        ("model", "states", "translation s", "compiler s", "exponent", "IDA ratio"),
    ),
    "keystrokes": (
        "The whole text of `FlightControlEma` is changed, and the language server's findings come back over the "
        "protocol: comments, an equation written letter by letter, changed numbers.",
        ("median s", "longest s", "processor, median s", "processor, longest s", "keystrokes"),
    ),
    "watching": (
        "An equation is saved, and the browser has the new figure.",
        ("figure", "median s", "longest s", "saves"),
    ),
}  # fmt: skip


def page(measured: Mapping[str, Sequence[report.Row]]) -> str:
    """docs/speed.md."""
    lines = ["# How fast", "", "Written by `make speed`, on one machine; ratios say more than seconds.", ""]
    for name, (about, columns) in WRITTEN.items():
        lines += [f"## {SECTIONS[name][0]}", "", about, "", *_table(measured[name], columns), ""]
    return "\n".join(lines)


def _table(rows: Sequence[report.Row], columns: Sequence[str]) -> list[str]:
    cells = [[_text(row[column]) for column in columns] for row in rows]
    return [f"| {' | '.join(line)} |" for line in (columns, ["---"] * len(columns), *cells)]


def _text(value: object) -> str:
    """Times and errors by two digits: more are noise."""
    if not isinstance(value, float):
        return "" if value is None else str(value)
    if abs(value) >= 100:
        return f"{value:.0f}"
    digits, _, power = f"{value:.2g}".partition("e")
    return f"{digits}e{int(power)}" if power else digits


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m bench.speed", description=__doc__)
    parser.add_argument("--rounds", type=int, default=9, help="interleaved rounds of each race")
    rounds = parser.parse_args().rounds
    measured = {name: SECTIONS[name][1](rounds) for name in WRITTEN}
    PAGE.write_text(page(measured), encoding="utf-8")
    report.stamp(PAGE, "make speed")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
