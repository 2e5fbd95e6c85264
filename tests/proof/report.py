"""The proof as a page: docs/proof.md, written from the scores."""

from collections.abc import Sequence
import math

import numpy as np

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


def _share(hits: int, trials: int) -> str:
    if not trials:
        return "-"
    low, high = wilson(hits, trials)
    return f"{hits} of {trials} = {hits / trials:.0%} ({low:.0%} to {high:.0%})"


def _summary_rows(scores: Sequence[Score]) -> dict[str, str]:
    singles = [s for s in scores if s.kind == "effect"]
    shares = [s.gain_share for s in scores if s.gain_share is not None]
    quartiles = f" (quartiles {np.percentile(shares, 25):.2f}, {np.percentile(shares, 75):.2f})" if shares else ""
    seconds = [s.seconds for s in scores if math.isfinite(s.seconds)]
    false = sum(s.false_finding for s in scores)
    nulls = share_right(scores, "false_finding", NULL)[1]
    return {
        "effect right as first finding, one effect": _share(*share_right(scores, "first_right", ("effect",))),
        "and at the right place": _share(sum(s.first_right and s.location_right for s in singles), len(singles)),
        "one of two right as first finding": _share(*share_right(scores, "first_right", ("two",))),
        "both of two, and nothing else": _share(*share_right(scores, "all_right", ("two",))),
        "false findings on nulls": _share(false, nulls),
        "median share of the gain there was": f"{median_share(scores):.2f}{quartiles}",
        "median relative error of parameters": f"{median_error(scores):.2%}",
        "95 % intervals that hold the truth": _share(*coverage(scores)),
        "median time for a case": f"{np.median(seconds):.0f} s" if seconds else "-",
    } | {f"verdict right: {text}": _share(*share_right(scores, "verdict_right", (k,))) for k, text in KINDS.items()}


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def summary_table(tool: Sequence[Score], usual: Sequence[Score]) -> str:
    """Figures of the tool beside those of the usual alternative."""
    a, b = _summary_rows(tool), _summary_rows(usual)
    rows = [(name, a[name], b[name]) for name in a if a[name] != "-" or b[name] != "-"]
    return _table(("", "Lacuna", "usual alternative"), rows)


def confusion_table(scores: Sequence[Score]) -> str:
    """One row an effect: how often it was first, and what was named instead."""
    rows = []
    for effect, firsts in sorted(confusion(scores).items()):
        wrong = ", ".join(f"{name} {n}" for name, n in firsts.most_common() if name != effect)
        rows.append((effect, str(sum(firsts.values())), str(firsts[effect]), wrong or "-"))
    return _table(("concealed", "cases", "right", "named instead (verdict where nothing was named)"), rows)


def bench_table(scores: Sequence[Score]) -> str:
    """First findings and gain share by bench."""
    rows = []
    for model in sorted({s.model for s in scores}):
        of = [s for s in scores if s.model == model]
        concealed = [s for s in of if s.kind in CONCEALED]
        rows.append(
            (
                model,
                str(len(of)),
                _share(*share_right(of, "verdict_right")),
                _share(*share_right(of, "first_right", ("effect",))),
                f"{median_share(concealed):.2f}",
                str(sum(s.false_finding for s in of)),
            )
        )
    return _table(
        ("model", "cases", "verdict right", "effect right first", "median gain share", "false findings"), rows
    )


def misses_table(scores: Sequence[Score]) -> str:
    """Every case that was not entirely right."""
    rows = [
        (
            s.case,
            s.model.split(".")[-1],
            KINDS[s.kind],
            " + ".join(s.effects) or "-",
            s.verdict,
            s.first,
            "-" if s.gain_share is None else f"{s.gain_share:.2f}",
        )
        for s in scores
        if not s.verdict_right or s.false_finding or (s.kind in ("effect", "two") and not s.first_right)
    ]
    return _table(("case", "bench", "kind", "concealed", "verdict", "first finding", "gain share"), rows)


def page(tool: Sequence[Score], usual: Sequence[Score], seed: int, all_cases: int) -> str:
    """docs/proof.md as text."""
    effects = {e for s in tool for e in s.effects}
    part = "" if len(tool) == all_cases else f" (**{len(tool)} of {all_cases} cases: the run was not complete**)"
    counts = ", ".join(f"{sum(s.kind == k for s in tool)} with {text}" for k, text in KINDS.items())
    return f"""# The proof: cases that nobody tuned

Written by `make prove` (seed {seed}){part}. An independent simulator (`tests/proof/`, no code shared with the
generator of models or the runtime) conceals physics in recordings; the tool is given the recordings and the believed
model, and its diagnosis is compared with the truth, which it never sees. {len(tool)} cases, {len(effects)} different
effects and laws: {counts}.

Parameters differ from the believed ones as manufacture spreads them; signals carry noise, white or coloured, and
quantisation; signals are missing; sizes are such that the refitted believed model's error is 1.7 to 7 times the floor
that the noise sets.

The usual alternative, on the same cases, is equation-error regression with sparse selection as in PySINDy: smoothed
derivatives, every equation's residual regressed on a library of terms by sequentially thresholded least squares, and a
fit of the result on the outputs.

{summary_table(tool, usual)}
Intervals in brackets are 95 % (Wilson). The share of the gain is (log before - log after) / (log before - log floor)
on the validation recordings, from the refitted believed model to the error of the truth.

## By bench

{bench_table(tool)}
## What was named for what

{confusion_table(tool)}
## What went wrong

{misses_table(tool)}"""
