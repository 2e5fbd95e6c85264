"""The proof as a page: docs/proof.md, written from the scores."""

from collections import Counter
from collections.abc import Sequence
import math

import numpy as np

import lacuna
from tests.proof.score import (
    CONCEALED,
    NULL,
    Score,
    confusion,
    coverage,
    median_error,
    median_share,
    share_right,
    wilson,
)

KINDS = {
    "effect": "one effect",
    "two": "two effects",
    "law": "a law outside the catalogue",
    "consistent": "nothing missing",
    "parameters": "only a parameter",
    "weak": "an effect at the noise's level",
    "one_way": "an experiment that never reverses",
    "rivals": "two explanations that the data cannot tell apart",
}


GOALS = {
    "effect right as first finding, one effect": "85 %",
    "false findings on nulls": "at most 5 %",
    "median share of the gain there was": "0.9",
    "95 % intervals that hold the truth": "90 to 98 %",
} | {f"verdict right: {text}": "90 %" for text in KINDS.values()}
VERDICTS = ("missing_physics", "parameters", "consistent", "undetermined")


def _share(hits: int, trials: int) -> str:
    if not trials:
        return "-"
    low, high = wilson(hits, trials)
    return f"{hits} of {trials} = {hits / trials:.0%} ({low:.0%} to {high:.0%})"


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"


def _summary_rows(scores: Sequence[Score]) -> dict[str, str]:
    singles = [s for s in scores if s.kind == "effect"]
    shares = [s.gain_share for s in scores if s.gain_share is not None]
    quartiles = f" (quartiles {np.percentile(shares, 25):.2f}, {np.percentile(shares, 75):.2f})" if shares else ""
    seconds = [s.seconds for s in scores if math.isfinite(s.seconds)]
    return {
        "effect right as first finding, one effect": _share(*share_right(scores, "first_right", ("effect",))),
        "and at the right place": _share(sum(s.first_right and s.location_right for s in singles), len(singles)),
        "another effect named instead": _share(sum(_misled(s) for s in singles), len(singles)),
        "one of two right as first finding": _share(*share_right(scores, "first_right", ("two",))),
        "both of two, and nothing else": _share(*share_right(scores, "all_right", ("two",))),
        "false findings on nulls": _share(*share_right(scores, "false_finding", NULL)),
        "median share of the gain there was": _number(median_share(scores), ".2f") + quartiles,
        "median relative error of parameters": _number(median_error(scores), ".2%"),
        "95 % intervals that hold the truth": _share(*coverage(scores)),
        "median time for a case": f"{np.median(seconds):.0f} s" if seconds else "-",
    } | {f"verdict right: {text}": _share(*share_right(scores, "verdict_right", (k,))) for k, text in KINDS.items()}


def _misled(s: Score) -> bool:
    """Whether an engineer would look for the wrong thing."""
    return s.verdict == "missing_physics" and not s.first_right


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def summary_table(tool: Sequence[Score], usual: Sequence[Score]) -> str:
    """Figures of the tool beside the goals and those of the usual alternative."""
    a, b = _summary_rows(tool), _summary_rows(usual)
    rows = [(name, GOALS.get(name, ""), a[name], b[name]) for name in a if a[name] != "-" or b[name] != "-"]
    return _table(("", "goal", "Lacuna", "usual alternative"), rows)


def verdict_table(scores: Sequence[Score]) -> str:
    """How often which verdict was given, by what would have been right; right ones bold."""
    rows = []
    for kind, text in KINDS.items():
        of = [s for s in scores if s.kind == kind]
        said = Counter(s.verdict if s.verdict in VERDICTS else "none" for s in of)
        right = {s.verdict for s in of if s.verdict_right}
        cells = [f"**{said[v]}**" if v in right else str(said[v]) for v in (*VERDICTS, "none")]
        rows.append((text, *cells))
    return _table(("truth", *VERDICTS, "no diagnosis in time"), rows)


def confusion_table(scores: Sequence[Score], usual: Sequence[Score]) -> str:
    """One row an effect: how often it was first, and what was named instead."""
    rows, other = [], confusion(usual)
    for effect, firsts in sorted(confusion(scores).items()):
        wrong = ", ".join(f"{name} {n}" for name, n in firsts.most_common() if name != effect)
        of = [s for s in scores if s.kind == "effect" and s.effects == (effect,)]
        cells = (str(len(of)), str(firsts[effect]), wrong or "-", _number(median_share(of), ".2f"))
        rows.append((effect, *cells, str(other[effect][effect])))
    header = ("concealed", "cases", "right", "named instead, or the verdict", "median gain share", "usual: right")
    return _table(header, rows)


def bench_table(scores: Sequence[Score], usual: Sequence[Score]) -> str:
    """First findings and gain share by bench."""
    rows = []
    for model in sorted({s.model for s in scores}):
        of, other = ([s for s in each if s.model == model] for each in (scores, usual))
        rows.append(
            (
                model.removeprefix("Benches."),
                str(len(of)),
                _share(*share_right(of, "verdict_right")),
                _share(*share_right(of, "first_right", ("effect",))),
                _share(*share_right(other, "first_right", ("effect",))),
                _number(median_share([s for s in of if s.kind in CONCEALED]), ".2f"),
                "{} of {}".format(*share_right(of, "false_finding", NULL)),
            )
        )
    header = ("bench", "cases", "verdict right", "effect right first", "usual: effect right first")
    return _table((*header, "median gain share", "false findings on nulls"), rows)


def misses_table(scores: Sequence[Score]) -> str:
    """Every case that was not entirely right."""
    rows = [
        (
            s.case,
            s.model.split(".")[-1],
            KINDS[s.kind],
            " + ".join(s.effects) or "-",
            s.verdict,
            s.first if s.first != s.verdict else "-",
            "-" if s.gain_share is None else f"{s.gain_share:.2f}",
        )
        for s in scores
        if not s.verdict_right or s.false_finding or (s.kind in ("effect", "two") and not s.first_right)
    ]
    return _table(("case", "bench", "kind", "concealed", "verdict", "first finding", "gain share"), rows)


def _part(done: int, all_cases: int) -> str:
    if done == all_cases:
        return ""
    return f"""
**The run is not complete: {done} of {all_cases} cases.** Which of a kind were run first does not hang on their outcome:
their order is spread over the benches.
"""


def page(tool: Sequence[Score], usual: Sequence[Score], seed: int, all_cases: int, version: str) -> str:
    """docs/proof.md as text; `version` is the hash of the tool's code and models that made the diagnoses."""
    effects = {e for s in tool if s.kind in ("effect", "two") for e in s.effects}
    counts = _table(("cases", "with"), [(str(sum(s.kind == k for s in tool)), text) for k, text in KINDS.items()])
    return f"""---
command: make prove
version: {lacuna.__version__}
state: {version}
---
# The proof: cases that nobody tuned

Written by `python -m tests.proof --seed {seed}` of the tool's version `{version}` (a hash of its code and models): what
has changed since is not in these figures. An independent simulator (`tests/proof/`, no code shared with the generator
of models or the runtime) conceals physics in recordings; the tool is given the recordings and the believed model, and
its diagnosis is compared with the truth, which it never sees.
{_part(len(tool), all_cases)}
{len(tool)} cases with {len(effects)} different effects:

{counts}
Parameters differ from the believed ones as manufacture spreads them; signals carry noise, white or coloured, and
quantisation; signals are missing; two of the benches are closed loops that hide the effect from the position. Sizes are
such that the refitted believed model's error is 1.7 to 7 times the floor that the noise sets.

The usual alternative, on the same cases, is equation-error regression with sparse selection by PySINDy: smoothed
derivatives, every equation's residual regressed on a library of terms by sequentially thresholded least squares (the
sparsest of a path of thresholds that leaves little more than the best), and a fit of the result on the outputs. It
reports no intervals, and never says that it cannot tell.

{summary_table(tool, usual)}
Intervals in brackets are 95 % (Wilson). The share of the gain is (log before - log after) / (log before - log floor)
on the validation recordings, from the refitted believed model to the error of the truth; a diagnosis that names nothing
has none. Parameters and intervals are counted where the finding is right. Cases ran side by side, one for each core; a
case out of time has no diagnosis, and is wrong.

## Verdicts

{verdict_table(tool)}
## By bench

{bench_table(tool, usual)}
## What was named for what

{confusion_table(tool, usual)}
## What went wrong

{misses_table(tool)}"""
