"""python -m tests.fuzz.editor [--seconds 180] [--seed 1]: texts of an editor, mutated, with every question of one.

Each text is a file of the package Lacuna with changed tokens, lines or encodings, as half of an edit leaves it; the
questions stand anywhere, also where the text has no place. What must come out is an answer, within PATIENCE.
"""

from __future__ import annotations

import argparse
from contextlib import suppress
from pathlib import Path
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.search_path import MODEL_FOLDER
from lacuna.lsp import features
from lacuna.lsp.format import format_text
from tests.fuzz.files import PATIENCE, mutate, out_of_time

FAR = 10**9  # a line, or a column, that no text has


def ask_everything(workspace: features.Workspace, path: Path, text: str, dice: random.Random) -> None:
    """Everything that a client may ask about `text`, at three places. Raises what an answer must not."""
    workspace.change(path, text)
    view = workspace.view(path)
    list(features.in_file(view.findings, path))
    if view.document:
        features.outline(view.document)
    lines = text.split("\n")
    for _ in range(3):
        line = dice.choice((dice.randrange(len(lines)), dice.randrange(len(lines)), len(lines), FAR))
        column = dice.choice((dice.randrange(1 + len(lines[line % len(lines)])), 0, FAR))
        features.hover(view, line, column)
        features.declaration(view, line, column)
        features.occurrences(workspace, path, line, column)
        features.completions(workspace, path, line, column)
    with suppress(Diagnostic):
        format_text(text, str(path))


def try_seed(seed: int, library: Path) -> None:
    dice = random.Random(seed)
    files = sorted(library.rglob("*.mo"))
    path = dice.choice(files).resolve()
    workspace = features.Workspace([str(library.parent)])
    good = path.read_bytes()
    signal.alarm(PATIENCE)
    try:
        for _ in range(3):
            ask_everything(workspace, path, mutate(good, dice).decode("utf-8", "replace"), dice)
    finally:
        signal.alarm(0)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    signal.signal(signal.SIGALRM, out_of_time)
    seed, fell, end = options.seed, 0, time.monotonic() + options.seconds
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder).resolve() / "Lacuna"
        shutil.copytree(MODEL_FOLDER, library)
        while time.monotonic() < end:
            try:
                try_seed(seed, library)
            except Exception:
                fell += 1
                print(f"seed {seed}: {traceback.format_exc(limit=-5)}"[-1200:], file=sys.stderr, flush=True)
            seed += 1
    print(f"{seed - options.seed} seeds of three texts, {fell} fell")
    return 1 if fell else 0


if __name__ == "__main__":
    sys.exit(main())
