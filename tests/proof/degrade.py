"""How the diagnosis degrades: `python -m tests.proof.degrade --out DIR`, which writes docs/degradation.md.

The same concealed effects with more noise, with recordings cut short and without the current. What is asked for is
not that the effect is still named, but that nothing wrong is.
"""

import argparse
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
import os
from pathlib import Path

import lacuna
from tests.proof.__main__ import EXPLAIN
from tests.proof.case import Case, noise_std
from tests.proof.generate import build, judge
from tests.proof.plan import Plan
from tests.proof.runner import ROOT, diagnose, run_all, tool_hash
from tests.proof.score import Score, score_folder
from tests.proof.write import write_case, write_truth

DC = ("i", "w", "theta")
SOURCES = (
    *(
        Plan("effect", "DcServo", (effect,), gain=(3.0, 5.0), outputs=DC)
        for effect in ("friction.coulomb", "friction.stribeck", "torque.cogging", "drive.dead_time", "sensor.lag")
    ),
    Plan("effect", "Joint", ("load.gravity",), gain=(3.0, 5.0), outputs=("w", "theta")),
)


def _noisier(factor: float) -> Callable[[Case], Case]:
    return lambda case: replace(case, noise_scale=case.noise_scale * factor)


def _shorter(share: float) -> Callable[[Case], Case]:
    return lambda case: replace(case, inputs=[u[: int(share * len(u))] for u in case.inputs])


def _without(signal: str) -> Callable[[Case], Case]:
    return lambda case: replace(case, outputs=tuple(n for n in case.outputs if n != signal))


VARIANTS: dict[str, Callable[[Case], Case]] = {
    "as it is": lambda case: case,
    "noise x 3": _noisier(3.0),
    "noise x 10": _noisier(10.0),
    "cut to a third": _shorter(1 / 3),
    "cut to a tenth": _shorter(0.1),
    "without the current": _without("i"),
}
SEEN = 1.05  # a misfit below this many floors is not in the data


def _applies(planned: Plan, label: str) -> bool:
    return label != "without the current" or "i" in planned.outputs


def _write(k: int, out: Path, seed: int) -> dict[str, tuple[str, str]]:
    """Writes a case under every variant, unless it is there; returns what each is: (effect and bench, variant)."""
    planned, own = SOURCES[k], 1000 * seed + k
    labels = {f"d{k}{j}": label for j, label in enumerate(VARIANTS) if _applies(planned, label)}
    if not all((out / "truth" / f"{name}.toml").exists() for name in labels):
        case = build("base", planned, own)
        for name, label in labels.items():
            changed = replace(VARIANTS[label](case), name=name)
            judge(changed, own, case.true)
            write_case(changed, out / "cases" / name, {n: noise_std(changed, n) for n in changed.outputs})
            write_truth(changed, out / "truth" / f"{name}.toml", own)
    return {name: (f"{planned.effects[0]} on {planned.bench}", label) for name, label in labels.items()}


def _word(score: Score) -> str:
    if score.first_right:
        return "right"
    if score.verdict == "undetermined":
        return "undetermined"
    if score.verdict in ("consistent", "parameters"):
        return "not seen" if score.misfit < SEEN else f"**{score.verdict}**"
    if score.verdict == "out of time":
        return score.verdict
    return f"**{score.first}**"


def _page(words: dict[tuple[str, str], str], seed: int, version: str) -> str:
    rows = list(dict.fromkeys(effect for effect, _ in words))
    lines = ["| concealed | " + " | ".join(VARIANTS) + " |", "|" + " --- |" * (len(VARIANTS) + 1)]
    lines += [f"| {r} | " + " | ".join(words.get((r, v), "-") for v in VARIANTS) + " |" for r in rows]
    count = Counter(words.values())
    wrong = sum("**" in w for w in words.values())
    return (
        f"""---
command: make degrade
version: {lacuna.__version__}
state: {version}
---
# How the diagnosis degrades

Written by `make degrade` (seed {seed}) of the tool's version `{version}` (a hash of its code and models). The same
recordings with more noise, cut short, and without the current.

* right, {count["right"]} of {len(words)}: the effect is the first finding.
* undetermined, {count["undetermined"]}: it says that the data cannot tell.
* not seen, {count["not seen"]}: it says that no physics is missing, and the misfit of the refitted believed model is
  below {SEEN} times the floor, so that there is nothing to see.
* wrong, {wrong}: **something else**, in bold.
* out of time, {count["out of time"]}.

"""
        + "\n".join(lines)
        + "\n"
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "degrade")
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases side by side")
    arguments = parser.parse_args()
    out = arguments.out / f"seed{arguments.seed}"
    with ProcessPoolExecutor(arguments.jobs) as pool:
        every = range(len(SOURCES))
        written = pool.map(_write, every, [out] * len(every), [arguments.seed] * len(every))
        names = {name: what for part in written for name, what in part.items()}
    version = tool_hash()
    run_all(
        list(names),
        lambda name: diagnose(EXPLAIN, out / "cases" / name, out / "lacuna" / name, version, 300.0),
        arguments.jobs,
    )
    scores = score_folder(out / "lacuna", out / "truth", names)
    words = {names[s.case]: _word(s) for s in scores}
    (ROOT / "docs" / "degradation.md").write_text(_page(words, arguments.seed, version))
    print("written: docs/degradation.md")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
