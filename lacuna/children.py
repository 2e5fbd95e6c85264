"""Programs that we start: they end with us, whatever ends us, and so does what they have started."""

from __future__ import annotations

from collections.abc import Sequence
import os
from pathlib import Path
import shutil
import subprocess

# $@ runs in a process group of its own. Standard input is a pipe that we hold open and never write to: where it ends
# although $@ has not, we are gone, and the whole group goes, too.
_GUARD = """exec 3<&0
"$@" </dev/null 3<&- & work=$!
{ read -r _ <&3; kill -9 0; } >/dev/null 2>&1 & watch=$!
wait $work
status=$?
kill $watch
exit $status"""


def run(command: Sequence[str | Path], folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run a program to its end. Raises FileNotFoundError where there is none of this name."""
    words = [str(word) for word in command]
    if shutil.which(words[0]) is None:
        raise FileNotFoundError(words[0])
    ours, held = os.pipe()
    try:
        with subprocess.Popen(
            ["sh", "-c", _GUARD, "sh", *words], cwd=folder, stdin=ours, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, encoding="utf-8", errors="replace", process_group=0,
        ) as process:  # fmt: skip
            try:
                output, errors = process.communicate()
            except BaseException:
                os.close(held)
                held = -1
                raise
        return subprocess.CompletedProcess(words, process.returncode, output, errors)
    finally:
        os.close(ours)
        if held >= 0:
            os.close(held)
