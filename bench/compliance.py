"""The Modelica Association's compliance library: every case passes or is refused, as its annotation says it should.

`python -m bench.compliance [NAME ...]` runs the cases whose name contains NAME and prints a table by chapter, and with
a NAME what became of each.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
import os
from pathlib import Path
import re
import tomllib

from bench import isolated
from bench.msl import first_finding
from bench.report import stamp
from lacuna.codegen import cache
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.access import Access
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.errors import SimulationError
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import Session

ROOT = Path(__file__).parents[1]
STOP = 0.01  # s, what nearly all cases ask for
LONGEST = 20.0  # s
TIMEOUT = 60  # s for one case
LEFT = Path(__file__).parent / "compliance_left.toml"
PREFIX = "ModelicaCompliance."
Outcomes = dict[str, dict[str, object]]
_VERDICT = re.compile(r"shouldPass\s*=\s*(true|false)")


def shared_folder() -> Path:
    """The folder of the cases, beside this repository or in $LACUNA_SHARED. Raises FileNotFoundError."""
    folder = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared")) / "compliance"
    if not folder.is_dir():
        raise FileNotFoundError(f"{folder} is not there: the compliance library is no part of this repository")
    return folder


def cases(folder: Path) -> dict[str, bool]:
    """Full name of every case, and whether it should pass; one case a file."""
    found = {}
    for path in sorted((folder / "ModelicaCompliance").rglob("*.mo")):
        verdict = _VERDICT.search(path.read_text(encoding="utf-8-sig"))
        if verdict:
            found[".".join(path.relative_to(folder).with_suffix("").parts)] = verdict.group(1) == "true"
    return found


def judge(name: str, folder: Path) -> dict[str, object]:
    """Translate and run one case: passed, refused (with code and place) or violated (an assertion of its own)."""
    try:
        compiled = compile_model(name, search_path=search_path([folder]), access=Access(external=True))
        model = Model(compiled.path)
        result = Session(model, events=False).run(stop=model.stop_time if 0 < model.stop_time <= LONGEST else STOP)
    except Diagnostic as error:
        return {"status": "refused", **first_finding(error)}
    except SimulationError as error:
        return {"status": "violated", "message": str(error)}
    return {"status": "passed"} if result.complete else {"status": "violated", "message": str(result.failure)}


def table(verdicts: dict[str, bool], results: dict[str, dict[str, object]]) -> str:
    """Counts by chapter of the specification's subjects."""
    chapters: dict[str, Counter[str]] = {}
    for name, should in verdicts.items():
        count = chapters.setdefault(name.split(".")[1], Counter())
        count[f"{should} of"] += 1
        count[f"{should} right"] += right(should, results[name])
        count["crash"] += results[name]["status"] in ("crash", "timeout")
    total = sum(chapters.values(), Counter())
    lines = ["| chapter | should pass: do | should fail: refused | crashes |", "| --- | ---: | ---: | ---: |"]
    for chapter, c in [*chapters.items(), ("all", total)]:
        pairs = (f"{c[f'{kind} right']}/{c[f'{kind} of']}" for kind in (True, False))
        lines.append(f"| {chapter} | {' | '.join(pairs)} | {c['crash']} |")
    return "\n".join(lines)


HEAD = """# The Modelica Association's compliance library

Written by `make compliance`: every case translated at default settings, but with external C allowed, and run to its
stop time. One that should fail counts where it is refused with code and place, or stopped by its own assertion. Below
is what is left, and why; a test fails where any other case goes wrong.

"""


def right(should: bool, outcome: dict[str, object]) -> bool:
    """Did a case come out as it should?"""
    return outcome["status"] == "passed" if should else outcome["status"] in ("refused", "violated")


def wrong(verdicts: dict[str, bool], results: Outcomes) -> list[str]:
    """Short names of the cases that did not come out as they should."""
    return [n.removeprefix(PREFIX) for n, should in verdicts.items() if not right(should, results[n])]


def left() -> dict[str, dict[str, str]]:
    """Why each case known not to come out as it should does not, by name, under `should_pass`, `should_fail`."""
    return tomllib.loads(LEFT.read_text(encoding="utf-8"))


def page(verdicts: dict[str, bool], results: Outcomes) -> str:
    """The table, and each case that came out otherwise with the reason and what was said of it."""
    text = HEAD + table(verdicts, results) + "\n"
    reasons = left()
    for key, should, title in (
        ("should_pass", True, "Should pass and do not"),
        ("should_fail", False, "Should fail and pass"),
    ):
        text += f"\n## {title}\n\n"
        for name in wrong({n: v for n, v in verdicts.items() if v == should}, results):
            r = results[f"{PREFIX}{name}"]
            said = " ".join(" ".join(str(r.get(k, "")) for k in ("code", "message")).split())[:160]
            reason = reasons[key].get(name, "not looked into")
            text += f"- {name}: {reason}" + (f" ({said})\n" if said else "\n")
    return text


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="parts of names of cases (default: all)")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "compliance")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--keep", action="store_true", help="keep results of an earlier generator")
    parser.add_argument("--page", action="store_true", help="write docs/compliance.md")
    parser.add_argument("--wrong", action="store_true", help="print only what came out otherwise than it should")
    chosen = parser.parse_args(arguments)
    folder = shared_folder()
    cache.COMPILER = tuple(o for o in cache.COMPILER if o != "-O2")
    Library(search_path([folder])).all_classes()  # parsed once, before the processes part
    verdicts = {n: s for n, s in cases(folder).items() if not chosen.names or any(part in n for part in chosen.names)}
    results = isolated.run_all(
        verdicts, lambda n: judge(n, folder), chosen.out, timeout=TIMEOUT, workers=chosen.workers, keep=chosen.keep,
        progress=False,
    )  # fmt: skip
    for name, should in verdicts.items():
        status = str(results[name]["status"])
        if (chosen.wrong and not right(should, results[name])) or (chosen.names and not chosen.wrong):
            r = results[name]
            what = " ".join(str(r.get(k, "")) for k in ("code", "place", "message"))[-300:]
            print(f"{'should pass' if should else 'should fail'} {status:8s} {name.split('.', 1)[1]}: {what}")
    print(table(verdicts, results))
    if chosen.page:
        (ROOT / "docs" / "compliance.md").write_text(page(verdicts, results))
        stamp(ROOT / "docs" / "compliance.md", "make compliance")


if __name__ == "__main__":
    main()
