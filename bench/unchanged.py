"""`make unchanged`: the C of our own models, now and as it was when the library came; writes docs/unchanged.md.

Every complete model of `model/` is translated by the code of a commit, in a worktree of its own, and by the present
one; what differs is told by the functions and tables in which it does. Both translate the models as they are now.
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Callable
import json
from pathlib import Path
import re
import subprocess
import sys
import tempfile

from bench.report import stamp

ROOT = Path(__file__).parents[1]
BASE = "11b21f3"  # the last before whole packages of the library ran
ROUNDS = 3  # of translation by turns, for the times

# One process for one tree: its folders are the packages of `lacuna`, as an editable installation has them.
TRANSLATE = """
import importlib.util, json, sys, time
tree, models, out = sys.argv[1:]
sys.meta_path[:] = [f for f in sys.meta_path if "editable" not in type(f).__module__]
spec = importlib.util.spec_from_file_location("lacuna", tree + "/lacuna/__init__.py",
                                              submodule_search_locations=[tree + "/lacuna", tree])
sys.modules["lacuna"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sys.modules["lacuna"])
from lacuna.codegen.compile import translate
from lacuna.codegen.emit.source import generate
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.expr import own_table
library = Library([models])
found = {}
for c in library.all_classes(library.find("Lacuna")):
    if c.kind not in ("model", "block") or c.partial:
        continue
    start = time.process_time()
    with own_table():
        try:
            prepared, _ = translate(c.path, search_path=[models])
            prepared.hash = ""
            text = generate(prepared, False)
        except Diagnostic as error:
            text = "refused " + error.code
    found[c.path] = (text, time.process_time() - start)
with open(out, "w") as file:
    json.dump(found, file)
"""

# What differs, and why: a class is confined to some functions and tables of the C; the first that fits is told.
DESCRIPTOR = r"mdl_model|mdl_z_branches"
SIZES = DESCRIPTOR + r"|mdl_nominals(_\d+)?|mdl_rhs(_\d+)?|mdl_initial_system(_\d+)?"
CLASSES = (
    ("nothing", "", "Every byte is equal."),
    (
        "the descriptor",
        DESCRIPTOR,
        "It says of each algebraic unknown whether its equations have several branches: dynamic choices of states look "
        "there (decision 0013). No equation differs.",
    ),
    (
        "nominal values, too",
        SIZES,
        "A limit makes the nominal value of what it limits smaller, never larger: one that is switched off (1e60) "
        "loosened the tolerance. Blocks measure their unknowns in nominal values; no equation differs.",
    ),
    (
        "affine guards, too",
        SIZES + r"|mdl_affine_guards|mdl_guard_rates(_\d+)?",
        "Guards that are affine in the states are sought on the polynomial of a step (decision 0016): a table and a "
        "function more. No equation differs.",
    ),
    (
        "failures, too",
        SIZES,
        "A nonlinear block that fails is told as one, not as linear equations without a solution.",
    ),
    ("more", ".*", "Below, by the functions that differ."),
)


WHY = {
    "Lacuna.Components.Drives.DeadTime": "`change(u)` of its own input compared u with what the output had been. A "
    "variable keeps now what u was before the event.",
}  # of models that are in no class


def translations(tree: Path, models: Path) -> dict[str, tuple[str, float]]:
    """(C or refusal, processor seconds) of every complete model, by the code of `tree`."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([sys.executable, "-c", TRANSLATE, str(tree), str(models), out.name], check=True)
        return json.loads(Path(out.name).read_text(encoding="utf-8"))


def parts(source: str) -> dict[str, list[str]]:
    """The lines of a C file by the function or table that they stand in."""
    found: dict[str, list[str]] = defaultdict(list)
    name = "head"
    for line in source.splitlines():
        begun = re.match(
            r"(?:static |const |MDL_\w+ |unsigned |struct )*[\w ]+?\**(\w+)(?:\[\w*\])* ?(?:\(|= ?\{)", line
        )
        if begun and not line.startswith(" "):
            name = begun[1]
        if line.strip():
            found[name].append(line)
    return found


def equations(lines: list[str], keep: Callable[[str], bool]) -> list[str]:
    """What is computed: without sizes of unknowns, what only these read, and the numbers of helpers."""
    text = [line for line in lines if keep(line) and not re.search(r"_nominal|m->shift", line)]
    while True:
        used = Counter(word for line in text for word in re.findall(r"\b[A-Za-z_]\w*\b", line))
        fewer = [line for line in text if not _only_declares(line, used)]
        if len(fewer) == len(text):
            break
        text = fewer
    named: dict[str, str] = {}
    return [re.sub(r"\btmp\d+\b", lambda m: named.setdefault(m[0], f"tmp{len(named)}"), line) for line in text]


def _only_declares(line: str, used: Counter[str]) -> bool:
    """Whether a line gives a local value that nothing reads any more."""
    found = re.match(r" *const (?:double|int) (\w+) = ", line)
    return found is not None and used[found[1]] == 1


def differences(before: str, now: str) -> list[str]:
    """Functions and tables that differ."""
    old, new = parts(before), parts(now)
    return sorted(k for k in old.keys() | new.keys() if old.get(k) != new.get(k))


def class_of(before: str, now: str) -> str:
    found = differences(before, now)
    if not found:
        return CLASSES[0][0]
    old, new = parts(before), parts(now)
    computed = [k for k in found if re.match("mdl_rhs|mdl_initial", k)]
    for (name, allowed, _), keep in zip(CLASSES[1:5], (_every, _every, _every, _no_failure), strict=True):
        same = all(equations(old.get(k, []), keep) == equations(new.get(k, []), keep) for k in computed)
        if same and all(re.fullmatch(allowed, k) for k in found):
            return name
    return "more"


def _every(line: str) -> bool:
    return True


def _no_failure(line: str) -> bool:
    return "MDL_FAILURE_NEWTON" not in line


def page(pairs: dict[str, tuple[str, str]], seconds: tuple[float, float]) -> str:
    members: dict[str, list[str]] = defaultdict(list)
    for name, (before, now) in pairs.items():
        members[class_of(before, now)].append(name)
    rows = [
        f"| {name} | {len(members[name])} | {why} |"
        for name, _, why in CLASSES
        if members[name] or not why.startswith("Below")
    ]
    more = [
        f"- {name}: {', '.join(differences(*pairs[name]))}. {WHY.get(name, '')}".rstrip() for name in members["more"]
    ]
    text = [
        "# Our own models, unchanged", "",
        f"Written by `make unchanged`: the C of the {len(pairs)} models of `model/` that translate alone, by the code "
        f"of commit {BASE} and by the present one. The models are the present ones for both.", "",
        "| what differs | models | why |", "| --- | ---: | --- |", *rows, *(["", *more] if more else []), "",
        f"To translate all of them takes {seconds[1]:.1f} s of processor time, and took {seconds[0]:.1f} s (the least "
        f"of {ROUNDS} rounds by turns).",
    ]  # fmt: skip
    return "\n".join(text) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write docs/unchanged.md")
    chosen = parser.parse_args()
    runs: tuple[list, list] = ([], [])
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "base"
        subprocess.run(["git", "-C", str(ROOT), "worktree", "add", "--quiet", "--detach", str(tree), BASE], check=True)
        try:
            for _ in range(ROUNDS):
                for code, found in zip((tree, ROOT), runs, strict=True):
                    found.append(translations(code, ROOT / "model"))
        finally:
            subprocess.run(["git", "-C", str(ROOT), "worktree", "remove", "--force", str(tree)], check=True)
    before, now = runs[0][0], runs[1][0]
    pairs = {n: (before[n][0], now[n][0]) for n in now if not now[n][0].startswith("refused")}
    least = tuple(min(sum(run[n][1] for n in pairs) for run in found) for found in runs)
    text = page(pairs, (least[0], least[1]))
    print(text)
    if chosen.page:
        (ROOT / "docs" / "unchanged.md").write_text(text, encoding="utf-8")
        stamp(ROOT / "docs" / "unchanged.md", "make unchanged")


if __name__ == "__main__":
    main()
