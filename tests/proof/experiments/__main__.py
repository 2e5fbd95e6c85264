"""The proof of the proposed experiments: `python -m tests.proof.experiments [--seed 901] [--only NAME ...] [--report]`.

Every case is explained. Where the answer is undetermined, or a finding is tied, the waveforms of `next/` are played on
the truth, recorded with its noise, and the case in `next/` is explained. Resumes; writes OUT/seed.../VERSION.md.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
import shutil
import subprocess
import sys
import tomllib
from types import ModuleType

import numpy as np

from tests.proof.experiments import one_way, quiet
from tests.proof.runner import ROOT, tool_hash
from tests.proof.score import wilson

EXPLAIN = (sys.executable, "-m", "lacuna.cli.main", "explain", "--limit", "300")
LIMIT = 900.0  # seconds of wall clock of an explanation, on a machine that others use too
GOAL = 30  # cases that came out open, after which the run ends


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "prove-experiments")
    parser.add_argument("--seed", type=int, default=901)
    parser.add_argument("--only", nargs="*", default=())
    parser.add_argument("--report", action="store_true", help="write up what is finished")
    return parser.parse_args()


def _explain(case: Path, out: Path) -> dict:
    """The diagnosis of a case. Exits where there is none: a case that was not explained is neither open nor decided."""
    run = subprocess.run([*EXPLAIN, str(case), "--out", str(out)], capture_output=True, text=True, timeout=LIMIT)
    if run.returncode:
        raise SystemExit(f"explain {case} ended with {run.returncode}: {run.stderr[-600:]}")
    return json.loads((out / "diagnosis.json").read_text())


def is_open(diagnosis: dict) -> bool:
    """Whether the recordings did not decide."""
    return diagnosis["verdict"] == "undetermined" or bool(diagnosis.get("ties"))


def right(diagnosis: dict, truth: dict) -> tuple[bool, bool]:
    """(something is said to be missing, it is where something is; of a catalogued effect, by its name too)."""
    missing = diagnosis["verdict"] == "missing_physics"
    found = [(f["effect"], f["location"]) for f in diagnosis.get("findings", [])] if missing else []
    named = any(
        place in e["accept_locations"] and effect in e.get("accept_effects", [effect])
        for effect, place in found for e in truth["effects"]
    )  # fmt: skip
    return missing, named


def _perform(source: ModuleType, item: tuple, proposed: Path) -> None:
    """Play the waveforms of `proposed` on the truth and record them beside."""
    case = tomllib.loads((proposed / "case.toml").read_text())
    records = [case["recordings"][part][-1] for part in ("fit", "validate")]
    played = [np.genfromtxt(proposed / r.replace(".csv", ".inputs.csv"), delimiter=",", names=True) for r in records]
    period, answers, columns = source.answers(item, played)
    for name, values in zip(records, answers, strict=True):
        time = np.arange(len(values)) * period
        head = ",".join(["time", *columns])
        np.savetxt(proposed / name, np.column_stack([time, values]), "%.9g", ",", header=head, comments="")


def work(source: ModuleType, item: tuple, out: Path, version: str) -> dict:
    """What became of one case, kept in OUT/VERSION/NAME.json."""
    name = item[0]
    kept = out / version / f"{name}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    if not (out / "truth" / f"{name}.toml").exists():
        source.generate(item, out)
    truth = tomllib.loads((out / "truth" / f"{name}.toml").read_text())
    folder = out / version / name
    shutil.rmtree(folder, ignore_errors=True)
    first = _explain(out / "cases" / name, folder)
    result = {
        "case": name, "machine": truth["model"],
        "concealed": ", ".join(e.get("name") or e["effect"] for e in truth["effects"]),
        "before": first["verdict"], "open": is_open(first), "right before": right(first, truth),
    }  # fmt: skip
    proposal = first.get("next_experiment")
    if result["open"] and proposal:
        _perform(source, item, folder / "next")
        then = _explain(folder / "next", folder / "decided")
        result |= {
            "waveform": proposal["text"], "sigmas": proposal["sigmas"], "after": then["verdict"],
            "tied after": bool(then.get("ties")), "right": right(then, truth),
            "said": [f"{f['effect']} at {f['location']}" for f in then.get("findings", [])],
        }  # fmt: skip
    kept.write_text(json.dumps(result))
    return result


def page(results: list[dict], seed: int, version: str) -> str:
    """Every case in a line, and the counts."""
    of = [r for r in results if r["open"]]
    proposed = [r for r in of if "after" in r]
    verdict, named = (sum(r["right"][k] for r in proposed) for k in (0, 1))

    def share(hits: int) -> str:
        low, high = wilson(hits, len(of))
        return f"{hits} of {len(of)} ({low:.0%} to {high:.0%})"

    lines = [
        f"Seed {seed}, tool `{version}`: {len(results)} cases run, {len(of)} came out undetermined or tied, "
        f"{len(proposed)} of them with an experiment. After it: right verdict {share(verdict)}, goal 90 %; "
        f"right verdict and place {share(named)}.", "",
        "| case | machine | concealed | before | experiment | sigmas | after | said | verdict | place |",
        "| --- " * 10 + "|",
    ]  # fmt: skip
    for r in sorted(of, key=lambda r: r["case"]):
        end = [r.get("waveform", "none"), f"{r.get('sigmas', 0):.3g}", r.get("after", ""), "; ".join(r.get("said", []))]
        end += ["yes" if ok else "no" for ok in r.get("right", [False, False])]
        lines.append("| " + " | ".join([r["case"], r["machine"], r["concealed"], r["before"], *end]) + " |")
    other = [f"{r['case']} {r['concealed']} on {r['machine']}: {r['before']}" for r in results if not r["open"]]
    return "\n".join([*lines, "", "Decided by the first recordings: " + "; ".join(other) + "."]) + "\n"


def main() -> int:
    arguments = _arguments()
    version, seed = tool_hash(), arguments.seed
    out = arguments.out / f"seed{seed}"
    (out / version).mkdir(parents=True, exist_ok=True)
    pairs = [(one_way, i) for i in one_way.plan(seed)] + [(quiet, i) for i in quiet.plan(seed)]
    results = []
    for source, item in pairs:
        if arguments.only and item[0] not in arguments.only:
            continue
        if arguments.report and not (out / version / f"{item[0]}.json").exists():
            continue
        if sum(r["open"] for r in results) >= GOAL:
            break
        results.append(work(source, item, out, version))
        print(json.dumps(results[-1]), flush=True)
    (out / f"{version}.md").write_text(page(results, seed, version))
    print(page(results, seed, version))
    return 0


if __name__ == "__main__":
    sys.exit(main())
