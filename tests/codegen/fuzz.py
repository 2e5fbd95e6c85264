"""Random and mutated models through parser and flattener: only a Diagnostic may come out, and soon.

    python -m tests.codegen.fuzz --seconds 180 [--seed 1]

A failing input is written to the current folder with its seed; the exit status is then 1.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
import os
from pathlib import Path
import random
import re
import sys
import tempfile
import time
import traceback

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from tests.codegen.grammar import random_model

ROOT = Path(__file__).parents[2]
STANDARD = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared")) / "msl"
PATHS = [ROOT / "model", *([STANDARD] if STANDARD.is_dir() else [])]
PATIENCE = 10.0  # processor seconds for one small model

_PIECE = re.compile(r'"[^"]*"|[A-Za-z_]\w*|[0-9.]+(?:[eE][+-]?\d+)?|<=|>=|==|<>|:=|\s+|.', re.DOTALL)
_SPICE = (
    "end", "if", "then", "else", "for", "loop", "when", "elsewhen", "model", "extends", "connect", "der", "pre", "(",
    ")", "[", "]", "{", "}", ",", ";", "=", ":=", ":", ".", "-", "+", "*", "/", "^", "0", "-1", "1e308", "99999",
    "time", "end", "each", "final", "redeclare", "replaceable", "flow", "input", "parameter", "constant", "discrete",
    "Real", "Integer", "Boolean", "String", "true", "not", "and", "size", "sum", "zeros", "fill", "sample", "reinit",
    "equation", "algorithm", "initial", "protected", "annotation", "import", "within", "break", "function", "record",
    "\"", "/*", "'", "\\", "\0", "é",
)  # fmt: skip


def corpus() -> list[str]:
    """Texts to start from: the rejected models, the smaller files of the model library and of the Modelica Standard
    Library (where it is there), the documentation's examples."""
    files = [*(ROOT / "tests").rglob("*.mo"), *(ROOT / "model").rglob("*.mo"), *(STANDARD / "Modelica").rglob("*.mo")]
    texts = [f.read_text(encoding="utf-8") for f in sorted(files)]
    return [t for t in texts if len(t) < 6000]


def mutate(text: str, dice: random.Random) -> str:
    """A few edits of tokens or characters."""
    pieces = _PIECE.findall(text)
    for _ in range(dice.choice((1, 1, 2, 3, 8))):
        if not pieces:
            break
        at = dice.randrange(len(pieces))
        action = dice.randrange(6)
        if action == 0:
            del pieces[at]
        elif action == 1:
            pieces.insert(at, dice.choice(_SPICE))
        elif action == 2:
            pieces[at] = dice.choice(_SPICE)
        elif action == 3:
            other = dice.randrange(len(pieces))
            pieces[at], pieces[other] = pieces[other], pieces[at]
        elif action == 4:
            length = dice.randrange(1, 30)
            pieces[at:at] = pieces[at : at + length]
        else:
            pieces[at] = dice.choice(pieces)
    return "".join(pieces)


def inputs(seed: int) -> Iterator[str]:
    """Endless models for one seed, half mutated, half grown from the grammar (and some of these mutated too)."""
    dice = random.Random(seed)
    texts = corpus()
    while True:
        text = dice.choice(texts) if dice.random() < 0.5 else random_model(dice)
        yield mutate(text, dice) if dice.random() < 0.7 else text


def try_model(text: str, path: Path) -> str:
    """What came out: "accepted", or the code of the Diagnostic. Raises for anything else."""
    path.write_text(text, encoding="utf-8", newline="\n")
    start = time.process_time()
    try:
        flatten(Library(PATHS), str(path))
        outcome = "accepted"
    except Diagnostic as refused:
        outcome = refused.code
        assert str(refused)
        for finding in (refused, *refused.others):
            assert finding.hint, f"no hint in {finding}"
    if time.process_time() - start > PATIENCE:
        raise TimeoutError(f"took {time.process_time() - start:.1f} s")
    return outcome


def run(seed: int, seconds: float, count: int | None = None) -> dict[str, int]:
    """Outcomes with their frequency; the first failure is kept as a file and raised."""
    outcomes: dict[str, int] = {}
    end = time.perf_counter() + seconds
    with tempfile.TemporaryDirectory() as folder:
        for number, text in enumerate(inputs(seed)):
            if (count is not None and number >= count) or time.perf_counter() > end:
                break
            try:
                outcome = try_model(text, Path(folder) / f"fuzz_{number}.mo")
            except BaseException:
                kept = Path(f"fuzz_failure_{seed}_{number}.mo")
                kept.write_text(text, encoding="utf-8", newline="\n")
                print(f"seed {seed}, input {number}: kept as {kept}", file=sys.stderr)
                raise
            outcomes[outcome] = outcomes.get(outcome, 0) + 1
            (Path(folder) / f"fuzz_{number}.mo").unlink()
    return outcomes


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    try:
        outcomes = run(options.seed, options.seconds)
    except Exception:
        traceback.print_exc(limit=-15)
        return 1
    total = sum(outcomes.values())
    print(f"{total} models, {outcomes.get('accepted', 0)} accepted, {len(outcomes) - 1} different codes, no traceback")
    return 0


if __name__ == "__main__":
    sys.exit(main())
