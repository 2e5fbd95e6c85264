"""How the diagnosis degrades: `python -m tests.proof.degrade --out DIR`, which writes docs/degradation.md.

The same concealed effects with more noise, with recordings cut short and without the current. What is asked for is
not that the effect is still named, but that nothing wrong is.
"""

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import sys

from tests.proof.case import Case, noise_std
from tests.proof.generate import build, judge
from tests.proof.plan import Plan
from tests.proof.runner import ROOT, diagnose, run_all, tool_hash
from tests.proof.score import Score, score_folder
from tests.proof.write import write_case, write_truth

DC, EMA = ("i", "w", "theta"), ("u", "i", "thm", "ths")
SOURCES = (
    Plan("effect", "DcServo", ("friction.coulomb",), gain=(3.0, 5.0), outputs=DC),
    Plan("effect", "DcServo", ("torque.cogging",), gain=(3.0, 5.0), outputs=DC),
    Plan("effect", "DcServo", ("drive.dead_time",), gain=(3.0, 5.0), outputs=DC),
    Plan("effect", "ScrewEma", ("backlash",), gain=(3.0, 5.0), outputs=EMA),
    Plan("effect", "ScrewEma", ("friction.stribeck",), gain=(3.0, 5.0), outputs=EMA),
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


def _write(out: Path, seed: int) -> dict[str, tuple[str, str]]:
    """Writes every case under every variant; returns what each is: (effect and bench, variant)."""
    names: dict[str, tuple[str, str]] = {}
    for k, planned in enumerate(SOURCES):
        case = build("base", planned, 1000 * seed + k)
        for j, (label, change) in enumerate(VARIANTS.items()):
            if label == "without the current" and "i" not in case.outputs:
                continue
            name = f"d{k}{j}"
            names[name] = (f"{planned.effects[0]} on {planned.bench}", label)
            if (out / "truth" / f"{name}.toml").exists():
                continue
            changed = replace(change(case), name=name)
            judge(changed, 1000 * seed + k, case.true)
            write_case(changed, out / "cases" / name, {n: noise_std(changed, n) for n in changed.outputs})
            write_truth(changed, out / "truth" / f"{name}.toml", seed)
    return names


def _word(score: Score) -> str:
    if score.first_right:
        return "right"
    if score.verdict == "undetermined":
        return "undetermined"
    if score.verdict in ("consistent", "parameters"):
        return "not seen" if score.misfit < SEEN else f"**{score.verdict}**"
    return f"**{score.first}**"


def _page(words: dict[tuple[str, str], str], seed: int) -> str:
    rows = list(dict.fromkeys(effect for effect, _ in words))
    lines = ["| concealed | " + " | ".join(VARIANTS) + " |", "|" + " --- |" * (len(VARIANTS) + 1)]
    lines += [f"| {r} | " + " | ".join(words.get((r, v), "-") for v in VARIANTS) + " |" for r in rows]
    wrong = sum("**" in w for w in words.values())
    return (
        f"""# How the diagnosis degrades

Written by `python -m tests.proof.degrade` (seed {seed}). The same recordings with more noise, cut short, and without
the current. *right*: the effect is the first finding; *undetermined*: it says that the data cannot tell; *not seen*:
it says that nothing is missing, and the misfit of the refitted believed model is below {SEEN} times the floor, so that
there is nothing to see; **bold**: something else, which is wrong: {wrong} of {len(words)}.

"""
        + "\n".join(lines)
        + "\n"
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "degrade")
    parser.add_argument("--seed", type=int, default=3)
    arguments = parser.parse_args()
    out = arguments.out / f"seed{arguments.seed}"
    names, version = _write(out, arguments.seed), tool_hash()
    command = [str(Path(sys.executable).with_name("lacuna")), "explain"]
    run_all(
        list(names),
        lambda name: diagnose(command, out / "cases" / name, out / "lacuna" / name, version, 900.0),
        1,
        lambda name, status: print(name, *names[name], status, flush=True),
    )
    scores = score_folder(out / "lacuna", out / "truth", names)
    words = {names[s.case]: _word(s) for s in scores}
    (ROOT / "docs" / "degradation.md").write_text(_page(words, arguments.seed))
    print("written: docs/degradation.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
