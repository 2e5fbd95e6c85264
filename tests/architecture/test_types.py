"""The public face is typed: mypy --strict finds nothing in it, what it takes from the stages included."""

from __future__ import annotations

import os
from pathlib import Path
import subprocess
import sys

from tests.architecture.sources import ROOT

STAGES = ("codegen", "runtime", "analysis", "discovery", "fmi", "lsp")


def test_the_public_face_passes_mypy_strict(tmp_path: Path) -> None:
    package = tmp_path / "lacuna"  # as an installed wheel has it: the stages are folders of the package
    package.mkdir()
    face = sorted(p for p in (ROOT / "lacuna").iterdir() if p.suffix == ".py" or p.name == "py.typed")
    for path in [*face, *(ROOT / stage for stage in STAGES)]:
        (package / path.name).symlink_to(path)
    sources = [f"lacuna/{path.name}" for path in face if path.suffix == ".py"]
    options = ["--strict", "--follow-imports=silent", "--ignore-missing-imports", f"--cache-dir={tmp_path}/cache"]
    command = [sys.executable, "-m", "mypy", *options, *sources]
    environment = {**os.environ, "MYPYPATH": str(tmp_path)}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
