"""Cases of `explain` in a history: each is explained once, and its diagnosis kept."""

from __future__ import annotations

from collections.abc import Callable
import hashlib
from importlib.metadata import version
import os
from pathlib import Path

from lacuna.errors import UserError
from lacuna.given import toml_of
from lacuna.progress import Progress, spoken


def explained(out: Path, progress: Progress | None) -> Callable[[Path], Path]:
    """Gives the folder with the diagnosis of a case: out/CASE-HASH, of the case's files and of this version.

    What was explained before of the same files is taken as it stands.
    """

    def explain(case: Path) -> Path:
        from lacuna.diagnoses import explain as explain_case

        folder = out / f"{case.name}-{_hash(case)}"
        if not (folder / "diagnosis.json").exists():
            spoken(progress)(f"explaining {case.name}")
            explain_case(case, out=folder, progress=progress)
        return folder

    return explain


def _hash(case: Path) -> str:
    """Of the files in the folder of the case, and of a model file elsewhere."""
    files = sorted(path for path in case.rglob("*") if path.is_file())
    try:
        model = str(toml_of(case / "case.toml", UserError).get("model", ""))
    except UserError:  # `explain` refuses it with its reason
        model = ""
    elsewhere = case / model.split(":")[0]
    digest = hashlib.sha256(version("lacuna").encode())
    for path in [*files, *([elsewhere] if elsewhere.is_file() else [])]:
        digest.update(f"{os.path.relpath(path, case)}\0".encode() + path.read_bytes())
    return digest.hexdigest()[:12]
