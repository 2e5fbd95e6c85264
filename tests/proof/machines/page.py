"""Every run that was ever made, and docs/proof-machines.md: all runs pooled, and what came out of the one just made."""

from __future__ import annotations

from collections.abc import Sequence
import csv
from dataclasses import astuple, dataclass, fields
import io
from pathlib import Path

import numpy as np

import lacuna
from lacuna.written import write_whole
from tests.proof.machines.plan import STRANGERS_FROM
from tests.proof.machines.score import NULL, PRESENT, Score, by_style, listing, share_of, table

RUNS = Path(__file__).with_name("runs.csv")


@dataclass(frozen=True)
class Run:
    """One run of one seed by one version of the tool, in counts.

    `plan` is whole or small; `present` and `nulls` are the cases that hide something and nothing, `judged` both;
    `version` is the hash of the tool, empty where nobody kept it.
    """

    seed: int
    version: str
    plan: str
    run: int
    planned: int
    right: int
    judged: int
    located: int
    present: int
    false: int
    nulls: int
    share: float  # of the gain, the median; nan where nothing was hidden
    note: str = ""

    @property
    def key(self) -> tuple[int, str, str]:
        return self.seed, self.version, self.plan


def counted(seed: int, version: str, small: bool, planned: int, scores: Sequence[Score]) -> Run:
    """A run's row."""
    present = [s for s in scores if s.kind in PRESENT]
    null = [s for s in scores if s.kind in NULL]
    shares = [s.share for s in present if s.share is not None]
    return Run(
        seed, version, "small" if small else "whole", len(scores), planned,
        sum(s.right for s in (*present, *null)), len(present) + len(null), sum(s.located for s in present),
        len(present), sum(s.false for s in null), len(null), float(np.median(shares)) if shares else float("nan"),
    )  # fmt: skip


def runs(file: Path = RUNS) -> list[Run]:
    """Every run that was kept, in the order in which they were made."""
    kinds = {"int": int, "float": float, "str": str}
    with file.open(newline="") as rows:
        return [Run(**{f.name: kinds[str(f.type)](row[f.name]) for f in fields(Run)}) for row in csv.DictReader(rows)]


def keep(run: Run, file: Path = RUNS) -> list[Run]:
    """All runs with this one: in the place of what was kept of the same seed, version and plan, its note with it."""
    known = runs(file)
    note = next((r.note for r in known if r.key == run.key), run.note)
    every = [*(r for r in known if r.key != run.key), Run(*astuple(run)[:-1], note)]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([f.name for f in fields(Run)])
    for r in every:
        *head, share, text = astuple(r)
        writer.writerow([*head, f"{share:.2f}", text])
    write_whole(file, out.getvalue())
    return every


def _pooled(every: Sequence[Run]) -> str:
    groups = (
        ("thirteen machines (seeds 101 to 200)", [r for r in every if r.seed < STRANGERS_FROM]),
        ("seven strangers (seeds from 201 on)", [r for r in every if r.seed >= STRANGERS_FROM]),
        ("all", every),
    )
    lines = ["| | runs | cases | verdict right | located | false findings |", "| --- " * 6 + "|"]
    for name, of in groups:
        right = share_of(sum(r.right for r in of), sum(r.judged for r in of))
        located = share_of(sum(r.located for r in of), sum(r.present for r in of))
        false = share_of(sum(r.false for r in of), sum(r.nulls for r in of))
        lines.append(f"| {name} | {len(of)} | {sum(r.run for r in of)} | {right} | {located} | {false} |")
    return "\n".join(lines) + "\n"


def _listed(every: Sequence[Run]) -> str:
    head = ("seed", "tool", "plan", "cases run", "verdict right", "located", "false findings", "median share", "")
    lines = ["| " + " | ".join(head) + " |", "| --- " * len(head) + "|"]
    for r in every:
        tool = f"`{r.version[:8]}`" if r.version else "not kept"
        lines.append(
            f"| {r.seed} | {tool} | {r.plan} | {r.run} of {r.planned} | {r.right} of {r.judged} "
            f"| {r.located} of {r.present} | {r.false} of {r.nulls} | {r.share:.2f} | {r.note} |"
        )
    return "\n".join(lines) + "\n"


def page(every: Sequence[Run], seed: int, version: str, scores: Sequence[Score]) -> str:
    """docs/proof-machines.md as text: `scores` are of the run of `seed` by `version`, the hash of the tool."""
    wrong = [s for s in scores if not s.right or s.false or (s.effects and not s.located)]
    return f"""---
command: make prove-machines
version: {lacuna.__version__}
state: {version}
---
# The proof on machines of others

Written by `python -m tests.proof.machines --seed {seed}` of the tool's version `{version}` (a hash of its code and
models). Physics is concealed in twenty machines that the tool has never met, thermal, hydraulic, pneumatic, sliding,
rotating and electrical, each with its model in a file of its user's: flat equations, own connectors, or parts of a
library. Truths are written in Python, with forms of their own, and integrated by Runge-Kutta at a fixed step; in every
case, nulls included, two instruments err by something else than white noise. Machines, seeds, scores and goals were
written down before the first run of each seed (`tests/proof/machines/README.md`).

## Seed {seed}: {len(scores)} cases

{table(list(scores))}
Balanced is the mean of the shares right where something is missing and where nothing is. Located: a finding, or a place
told as tied with it, is where the effect is. Intervals are 95 % (Wilson). The share of the gain is on the validation
recording, in logarithms. By how the model is written: {by_style(list(scores))}.

What was not entirely right:

{listing(wrong)}
## Every run of every seed, pooled

No run is left out, of whatever version: the tool was mended between them, so these shares are of its past as well.

{_pooled(every)}
{_listed(every)}"""
