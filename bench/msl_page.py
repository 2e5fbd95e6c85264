"""The page of `make msl`: a table of packages, and what became of every example."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
import re
import tomllib

LEFT = Path(__file__).parent / "msl_left.toml"
HEAD = """# The Modelica Standard Library, as it is

Written by `make msl`: every example of these packages of version 4.1.0, unmodified, at default settings. *Right* means:
every signal that the library's own list of comparison signals names is within 1e-3 of its range of the trajectory that
the library's maintainers publish, outside a band of one output interval round the times at which that signal jumps, the
rounding of times written with eight digits aside.
About half of the examples have such a trajectory here; the others can only be seen to run.

| package | examples | translated | simulated | with a reference | right |
| --- | ---: | ---: | ---: | ---: | ---: |
"""
FURTHER = """
## Packages without a goal

No trajectories of these are here.

| package | examples | translated | simulated |
| --- | ---: | ---: | ---: |
"""
MOST = 3  # kinds of refusal that are named
_OWN = re.compile(r"'[^']*'|\S*[._\d\[]\S*")  # what a finding names of one model
_TRANSLATED = ("ran", "right", "wrong", "failed", "timeout")
_RAN = ("ran", "right", "wrong")


def write(
    path: Path, names: dict[str, list[str]], further: dict[str, list[str]], results: dict[str, dict[str, object]]
) -> None:
    """Write the page for the examples of each package, `further` being those without a goal."""
    lines = [_row(package, [results[n] for n in listed]) for package, listed in names.items()]
    lines.append(_row("all", [results[n] for listed in names.values() for n in listed]))
    text = HEAD + "\n".join(lines) + "\n"
    for package, listed in names.items():
        text += f"\n## {package}\n\n| example | outcome |\n| --- | --- |\n"
        for name in listed:
            short = name.removeprefix(f"Modelica.{package}.Examples.")
            text += f"| {short} | {_outcome(results[name])} |\n"
    path.write_text(text + _further(further, results) + _left({**names, **further}, results))


def _left(names: dict[str, list[str]], results: dict[str, dict[str, object]]) -> str:
    """Every example that does not come out as it should, with its cause."""
    causes = tomllib.loads(LEFT.read_text(encoding="utf-8"))
    text = "\n## What is left, and why\n\n"
    for name in (n for listed in names.values() for n in listed):
        if results[name]["status"] not in ("ran", "right"):
            short = name.removeprefix("Modelica.")
            text += f"- {short}: {causes.get(short, 'not traced further than what is said of it above')}\n"
    return text


def _further(names: dict[str, list[str]], results: dict[str, dict[str, object]]) -> str:
    text = FURTHER
    for package, listed in names.items():
        status = [str(results[n]["status"]) for n in listed]
        done, ran = (sum(s in which for s in status) for which in (_TRANSLATED, _RAN))
        text += f"| {package} | {len(listed)} | {done} | {ran} |\n"
    refused = [results[n] for listed in names.values() for n in listed if results[n]["status"] == "refused"]
    text += "\nWhat stands in the way of most:\n\n"
    kinds = Counter(map(_kind, refused))
    for kind, count in kinds.most_common(MOST):
        first = next(o for o in refused if _kind(o) == kind)
        code = first["code"]
        text += f"- {count} examples: [{code}] {' '.join(str(first['message']).split())[:200]} ({first['place']})\n"
    text += "\n| example that does not run | outcome |\n| --- | --- |\n"
    for name in (n for listed in names.values() for n in listed):
        if results[name]["status"] not in _RAN:
            text += f"| {name.removeprefix('Modelica.')} | {_outcome(results[name])} |\n"
    return text


def _row(package: str, outcomes: list[dict[str, object]]) -> str:
    status = [str(o["status"]) for o in outcomes]
    compared = sum(s in ("right", "wrong") for s in status)
    cells = [len(status), sum(s in _TRANSLATED for s in status), sum(s in _RAN for s in status), compared]
    return f"| {package} | {' | '.join(map(str, cells))} | {status.count('right')} |"


def _outcome(o: dict[str, object]) -> str:
    message = " ".join(str(o.get("message", "")).split()).replace("|", "/")
    match o["status"]:
        case "ran":
            return "simulated; no reference here"
        case "right":
            return f"right, {o['deviation']:.1e}" if o.get("deviation") is not None else "right"
        case "wrong":
            missing = f"; not found: {', '.join(o['missing'])}" if o["missing"] else ""
            return f"**wrong**: {o['worst']} by {o['deviation'] or 0:.1e}{missing}"
        case "refused":
            return f"refused [{o['code']}] {o['place']}: {message[:160]}"
        case status:
            return f"{status}: {message[-160:] if status == 'crash' else message[:160]}"


def _kind(o: dict[str, object]) -> tuple[str, str]:
    """Code and message of a refusal, what is of one model left out."""
    return str(o["code"]), " ".join(_OWN.sub("...", str(o["message"])).split())
