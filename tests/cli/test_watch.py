"""`--watch`: the page follows the source, answers to this machine and the secret only, and ends cleanly."""

from __future__ import annotations

from collections.abc import Iterator
import json
from pathlib import Path
import re
import signal
import subprocess
import sys
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

import pytest

from tests.watched import MODEL, PATIENCE, written


@pytest.fixture
def tank(tmp_path: Path) -> Path:
    return written(tmp_path)


@pytest.fixture
def running(tank: Path) -> Iterator[subprocess.Popen[str]]:
    command = [sys.executable, "-c", "from lacuna.cli.main import app; app()", "simulate", str(tank), "--watch"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1) as process:
        yield process
        process.kill()


@pytest.fixture
def address(running: subprocess.Popen[str]) -> str:
    return running.stdout.readline().split()[-1]


def state(address: str, after: int) -> dict:
    """The first state beyond number `after`."""
    found = {"number": 0}
    while found["number"] <= after:
        with urlopen(f"{address}{after}", timeout=PATIENCE) as answer:
            found = json.load(answer)
    return found


@pytest.mark.timeout(4 * PATIENCE)
def test_a_saved_equation_is_a_new_figure_and_a_slip_is_said_above_the_old_one(
    running: subprocess.Popen[str], address: str, tank: Path, tmp_path: Path
) -> None:
    with urlopen(address, timeout=PATIENCE) as answer:
        assert "Tank.mo" in answer.read().decode()
    first = state(address, 0)
    assert first["svg"].startswith("<svg") and first["message"] == ""
    tank.write_text(MODEL.replace("-h;", "-2*h;"), encoding="utf-8")
    second = state(address, first["number"])
    assert second["svg"] != first["svg"]
    tank.write_text(MODEL.replace("-h;", "-hh;"), encoding="utf-8")
    third = state(address, second["number"])
    assert "did you mean h?" in third["message"] and third["svg"] == second["svg"]
    running.send_signal(signal.SIGINT)
    said, _ = running.communicate(timeout=PATIENCE)
    assert running.returncode == 0
    assert said.endswith("ended\n") and "Traceback" not in said
    assert re.search(r"drawn \d+\.\d s after the save", said)


def test_of_several_figures_each_takes_the_place_of_the_one_before_until_a_source_changes(tank: Path) -> None:
    import threading

    from matplotlib.figure import Figure

    import lacuna

    drawn, stop, told = [], threading.Event(), []

    def draw() -> Iterator[Figure]:
        drawn.append(0)
        for _ in range(3):
            yield Figure()
            drawn[-1] += 1
            if len(drawn) == 1 and drawn[-1] == 1:
                tank.write_text(MODEL.replace("-h;", "-3*h;"), encoding="utf-8")
            if drawn[-1] == 3:
                stop.set()

    lacuna.watch(draw, [tank], opened=told.append, told=told.append, stop=stop)
    assert drawn == [1, 3]  # the second figure of the first round is the last one of it
    assert told[1:3] == ["drawn", "drawn"]


def test_a_save_is_read_when_it_is_over(tank: Path) -> None:
    import threading

    from matplotlib.figure import Figure

    import lacuna

    stop, told, read = threading.Event(), [], []

    def draw() -> Figure:
        read.append(lacuna.load(tank).name)
        if len(read) == 1:  # as an editor saves: the file is empty for a moment, shorter than between two looks
            tank.write_text("", encoding="utf-8")
            threading.Timer(0.07, tank.write_text, (MODEL.replace("-h;", "-3*h;"),), {"encoding": "utf-8"}).start()
        else:
            stop.set()
        return Figure()

    lacuna.watch(draw, [tank], opened=told.append, told=told.append, stop=stop)
    assert len(told) == 3 and not any("P019" in line for line in told)


def test_an_error_of_sources_that_have_changed_since_is_not_told(tank: Path) -> None:
    import threading

    from matplotlib.figure import Figure

    import lacuna

    stop, told, times = threading.Event(), [], []

    def draw() -> Figure:
        times.append(0)
        if len(times) == 1:
            tank.write_text("", encoding="utf-8")
            try:
                lacuna.load(tank)
            finally:
                tank.write_text(MODEL.replace("-h;", "-3*h;"), encoding="utf-8")
        stop.set()
        return Figure()

    lacuna.watch(draw, [tank], opened=told.append, told=told.append, stop=stop)
    assert len(times) == 2 and told[1].startswith("drawn")


def test_only_who_knows_the_secret_at_this_machine_s_own_name_is_answered(address: str) -> None:
    place = urlsplit(address)
    assert place.hostname == "127.0.0.1"
    assert len(place.path) > 20
    root = f"http://{place.netloc}"
    wrong = [
        Request(f"{root}/"), Request(f"{root}/0"), Request(f"{root}/guess/"), Request(f"{address}../Tank.mo"),
        Request(address, headers={"Host": "elsewhere.example"}), Request(f"{address}etc/passwd"),
    ]  # fmt: skip
    for request in wrong:
        with pytest.raises(HTTPError) as refused:
            urlopen(request, timeout=PATIENCE)
        assert refused.value.code == 404
