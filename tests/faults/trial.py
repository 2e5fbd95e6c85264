"""One command under every fault: right or one line and a status, nothing half-written, and the next run is as ever."""

from __future__ import annotations

import errno
import importlib
import os
from pathlib import Path
import shutil
import sys
import tempfile

from lacuna.analysis.settings import PAPER
from lacuna.cli.main import app
from lacuna.verification import MADE_BY, _content, _results_in
from tests.faults.preload import Fault, Outcome, run_with
from tests.faults.scenarios import Scenario, lay_out

# A disk that is full, and stays so; one bad write; one that turned read-only; one that is full for a moment; a folder
# that is no longer there.
KINDS = (
    (errno.ENOSPC, True), (errno.EIO, False), (errno.EROFS, True), (errno.ENOSPC, False), (errno.ENOENT, True),
)  # fmt: skip
NONE = Fault(0, 0, False)
Files = dict[str, object]


class Trial:
    """A command in a place of its own, once as it should be, and then with faults."""

    def __init__(self, name: str, scenario: Scenario, place: Path):
        self.name, self.scenario, self.place = name, scenario, place
        coarse = PAPER.read_text(encoding="utf-8").replace("step = 0.01", "step = 0.25")
        lay_out(place, coarse)
        for words in (*scenario.before, *([] if scenario.cold else [scenario.words])):
            assert self._run(NONE, words).status == 0, words
        if not scenario.cold and scenario.out != "place":
            shutil.rmtree(place / scenario.out)
        lay_out(place, coarse)
        self.old = self._files()
        self._keep()
        self.good = self._run(NONE)
        assert self.good.status == 0, self.good.said
        self.new = self._files()
        assert self.new != self.old, "it writes nothing"
        assert not self.good.unsynced, f"{self.good.unsynced}: a power cut leaves names without content"

    def run(self, every: int) -> int:
        """How many trials fell, which are told; what was written before is there in every other round."""
        fell, numbers = 0, range(1, self.good.calls + 1, every)
        for k, number in enumerate(numbers):
            error, lasting = KINDS[k % len(KINDS)]
            fault = Fault(number, error, lasting)
            for why in self._try(fault, stale=bool(k // len(KINDS) % 2) and not self.scenario.fresh):
                fell += 1
                print(f"{self.name}: {fault}: {why}", flush=True)
        print(f"{self.name}: {self.good.calls} calls, {len(numbers)} failed, {fell} fell", flush=True)
        return fell

    def _try(self, fault: Fault, stale: bool) -> list[str]:
        self._reset()
        before = self.old
        if stale:
            before = {name: self._spoil(name) for name in self.new}
        outcome = self._run(fault)
        found = [*_faults_of(outcome), *self._half_written(before, outcome.status, fault.lasting)]
        if outcome.status == 0 and self.scenario.fresh:
            return found
        again = self._run(NONE)
        if again.status or self._files() != self.new:
            found.append(f"the next run differs: {again.status} {again.said[-300:]}")
        return [f"{why} [{outcome.status}: {outcome.said[-300:]!r}]" for why in found]

    def _half_written(self, before: Files, status: int, lasting: bool) -> list[str]:
        files = self._files()
        if status == 0:
            return [] if files == self.new else [f"status 0, but {_differing(files, self.new)} are not as ever"]
        mixed = [n for n in files if files[n] not in (before.get(n), self.new.get(n))]
        lost = [n for n in before if n not in files]
        parts = [n for n in files if files[n] != before.get(n)]
        # A disk that refuses everything from between two renames on refuses to take back the first one, too.
        some = self.scenario.together and not lasting and parts and files != self.new
        said = {"half-written": mixed, "lost": lost, "only some are new": parts if some else []}
        return [f"{what}: {names}" for what, names in said.items() if names]

    def _run(self, fault: Fault, words: tuple[str, ...] = ()) -> Outcome:
        def command() -> int:
            os.chdir(self.place)
            tempfile.tempdir = str(self.place / "tmp")
            os.environ["LACUNA_CACHE"] = str(self.place / "cache")
            sys.argv = ["lacuna", *(words or self.scenario.words)]
            try:
                app(sys.argv[1:])
            except SystemExit as ended:
                return int(ended.code or 0)
            return 0

        return run_with(fault, self.place, command, self.place.with_name(f"{self.name}.log"))

    def _files(self) -> Files:
        """What stands in `out` for a user to read; how it was made is compared by `lacuna verify`."""
        out = self.place / self.scenario.out
        found = [p for p in (_results_in(out) if out.exists() else []) if p.name != MADE_BY]
        return {p.relative_to(out).as_posix(): b"" if self._varies(p.name) else _content(p) for p in found}

    def _varies(self, name: str) -> bool:
        timed = self.scenario.timed
        return name.endswith(".html") or bool(timed and timed in name)

    def _spoil(self, name: str) -> object:
        path = self.place / self.scenario.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"of another run")
        return b"" if path.suffix == ".json" or self._varies(name) else b"of another run"

    def _keep(self) -> None:
        shutil.copytree(self.place, self.place.with_name(f"{self.name}-kept"))

    def _reset(self) -> None:
        shutil.rmtree(self.place)
        shutil.copytree(self.place.with_name(f"{self.name}-kept"), self.place)


def _faults_of(outcome: Outcome) -> list[str]:
    if outcome.status == 0:
        return []
    said = [line for line in outcome.said.splitlines() if line.startswith("error")]
    wrong = outcome.status != 1 or len(said) != 1 or "Traceback" in outcome.said
    return ["no line and status 1"] if wrong else []


def _differing(files: Files, others: Files) -> list[str]:
    return sorted(n for n in {*files, *others} if files.get(n) != others.get(n))


def imported() -> None:
    """Import once what every child would import for itself."""
    for name in ("models", "results", "runtime", "codegen.compile", "faults", "figures", "prognosis", "drafts"):
        importlib.import_module(f"lacuna.{name}")
    for name in ("matplotlib.figure", "pyarrow.parquet", "scipy.io", "scipy.signal"):
        importlib.import_module(name)
