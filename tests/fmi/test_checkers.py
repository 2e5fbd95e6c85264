"""FMUs under the FMI project's own tools, where they are installed: the Compliance Checker (FMI 2.0; modelica-tools,
`fmuCheck.linux64` on PATH or LACUNA_FMUCHECK) and fmusim (both versions; modelica, `fmusim` or LACUNA_FMUSIM)."""

from __future__ import annotations

import os
from pathlib import Path
import shutil
import subprocess

import pytest

from tests.fmi.fmus import LIBRARY, OTHERS, OWN, Fmus

FMUCHECK = os.environ.get("LACUNA_FMUCHECK") or shutil.which("fmuCheck.linux64") or ""
FMUSIM = os.environ.get("LACUNA_FMUSIM") or shutil.which("fmusim") or ""
NAMES = [*OWN, *OTHERS, *LIBRARY]
# The checker integrates with explicit Euler, which these would need millions of steps for.
STIFF = {"SwitchWithArc"}
# fmusim 0.8 sets one continuous state where there is none but event indicators are.
STATELESS = {"BooleanNetwork1"}


def export(fmus: Fmus, name: str, version: str, request: pytest.FixtureRequest) -> Path:
    more = {"libraries": [request.getfixturevalue("msl")]} if name in LIBRARY else {}
    return fmus.path(name, version, **more)


@pytest.mark.skipif(not FMUCHECK, reason="no FMU Compliance Checker (LACUNA_FMUCHECK names it)")
@pytest.mark.parametrize("kind", ["me", "cs"])
@pytest.mark.parametrize("name", NAMES)
def test_the_compliance_checker_says_nothing(
    fmus: Fmus, request: pytest.FixtureRequest, tmp_path: Path, name: str, kind: str
) -> None:
    if kind == "me" and name in STIFF:
        kind = "xml"
    path, log = export(fmus, name, "2.0", request), tmp_path / "log.txt"
    command = [FMUCHECK, "-l", "3", "-n", "20000", "-e", str(log), "-k", kind, "-o", str(tmp_path / "out.csv")]
    subprocess.run([*command, str(path)], capture_output=True, timeout=120, check=True)
    said = log.read_text(encoding="utf-8")
    assert "0 Warning(s)" in said and "0 Error(s)" in said, said
    assert not [line for line in said.splitlines() if line.startswith("[")], said


@pytest.mark.skipif(not FMUSIM, reason="no fmusim of the FMI project (LACUNA_FMUSIM names it)")
@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("name", NAMES)
def test_fmusim_validates_and_runs(
    fmus: Fmus, request: pytest.FixtureRequest, tmp_path: Path, name: str, version: str
) -> None:
    path = str(export(fmus, name, version, request))
    ways = [["--interface-type", "cs"], *([["--interface-type", "me"]] if name not in STATELESS else [])]
    if version == "3.0":
        ways.append(["--interface-type", "cs", "--event-mode-used", "--early-return-allowed"])
    for words in (["validate"], *(["simulate", *way, "--output-file", str(tmp_path / "out.csv")] for way in ways)):
        done = subprocess.run([FMUSIM, *words, path], capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode == 0, (words, done.stderr)
        assert not [line for line in (done.stdout + done.stderr).splitlines() if "rror" in line], (words, done.stderr)
