"""What a command says when something happened that nobody foresaw."""

from __future__ import annotations

from pathlib import Path
import signal
import subprocess
import sys

import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.cli.main import app


def test_the_unexpected_is_a_fault_of_ours_with_a_file_of_details(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_args: object, **_kwargs: object) -> None:
        raise ZeroDivisionError("nobody foresaw this")

    monkeypatch.setattr(lacuna, "check", fail)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.delenv("LACUNA_DEBUG", raising=False)
    result = CliRunner().invoke(app, ["check", "Nothing.mo"])
    assert result.exit_code == 70
    assert "fault of Lacuna" in result.output and "Traceback" not in result.output
    (details,) = tmp_path.glob("lacuna-fault-*.txt")
    assert "nobody foresaw this" in details.read_text()


def test_rows_of_a_map_s_folder_that_are_not_ours_stay(tmp_path: Path) -> None:
    from lacuna.analysis.map.rows import RowStore

    (tmp_path / "rows").mkdir()
    mine = tmp_path / "rows" / "thesis.txt"
    mine.write_text("years of work")
    store = RowStore.__new__(RowStore)
    store._folder, store.key = tmp_path / "rows", "key"
    store.prune([])
    assert mine.exists()


def test_ctrl_c_while_the_commands_are_imported_is_one_word() -> None:
    heard = "import os, signal, time; signal.signal(signal.SIGINT, signal.default_int_handler)"  # unlike in background
    code = f"{heard}; import lacuna.cli; os.kill(os.getpid(), signal.SIGINT); time.sleep(9)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert (done.stderr, done.returncode) == ("interrupted\n", -signal.SIGINT)


def test_nothing_long_is_imported_before_ctrl_c_is_heard() -> None:
    """The reader of versions brings mail, sockets and archives: a tenth of a second in which Ctrl-C was a traceback."""
    code = "import sys, lacuna.cli; print(*{'importlib.metadata', 'email', 'socket', 'zipfile'} & {*sys.modules})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.split() == []


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("words", ["--version", "--help", "list -h", "check M.mo", "check M.mo --json"])
def test_an_output_that_takes_nothing_is_one_line_and_a_status(tmp_path: Path, words: str, closed: bool) -> None:
    (tmp_path / "M.mo").write_text("model M Real x = time; end M;")
    shell = f'exec "$@" {">&-" if closed else ">/dev/full"}'
    command = ["sh", "-c", shell, "sh", sys.executable, "-m", "lacuna.cli.main", *words.split()]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    said = "Bad file descriptor" if closed else "No space left on device"
    assert (done.returncode, done.stderr.count("\n")) == (1, 1) and said in done.stderr, done.stderr


def test_a_reader_that_leaves_is_no_error(tmp_path: Path) -> None:
    """As `lacuna ... | head -1`: nothing is said, the status is that of programs which a closed pipe ends."""
    (tmp_path / "M.mo").write_text("model M Real x = time; end M;")
    command = [sys.executable, "-m", "lacuna.cli.main", "check", "M.mo"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as begun:
        begun.stdout.close()
        said = begun.stderr.read()
        assert (begun.wait(timeout=60), said) == (128 + signal.SIGPIPE, "")
