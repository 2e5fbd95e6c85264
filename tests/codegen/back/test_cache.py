"""An unchanged model is neither translated nor compiled again; any change of what it was made from is noticed."""

from __future__ import annotations

from pathlib import Path
import threading

import pytest

from codegen import cache
from codegen.compile import compile_model, translate
from codegen.emit.source import generate
from tests.codegen.generated import write_model

MODEL = """model Decay
  parameter Real k = 2; parameter Integer n = 2; Real x[n](each start = 1); input Real u;
equation
  der(x) = fill(-k*u, n);
end Decay;
"""


@pytest.fixture
def model(tmp_path: Path) -> str:
    return write_model(tmp_path, MODEL)


def test_second_time_is_from_the_cache(model: str, tmp_path: Path) -> None:
    first = compile_model(model, cache_directory=str(tmp_path))
    again = compile_model(model, cache_directory=str(tmp_path))
    assert (first.report.cached, again.report.cached) == (False, True)
    assert (again.path, again.hash, again.name) == (first.path, first.hash, "Decay")
    assert [w.code for w in again.report.warnings] == [w.code for w in first.report.warnings] == ["S021", "S021"]
    assert set(first.report.seconds) >= {"flatten", "index reduction", "jacobian", "C", "compile"}
    assert again.report.seconds == {}


def test_changed_text_and_structure_give_another_library(model: str, tmp_path: Path) -> None:
    first = compile_model(model, cache_directory=str(tmp_path))
    larger = compile_model(model, cache_directory=str(tmp_path), modifications={"n": 3})
    Path(model).write_text(MODEL.replace("k = 2", "k = 3"))
    changed = compile_model(model, cache_directory=str(tmp_path))
    assert not larger.report.cached
    assert not changed.report.cached
    assert len({first.path, larger.path, changed.path}) == 3
    Path(model).write_text(MODEL)
    assert compile_model(model, cache_directory=str(tmp_path)).path == first.path


def test_a_new_generator_makes_models_new(model: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = compile_model(model, cache_directory=str(tmp_path))
    monkeypatch.setattr(cache, "generator_version", lambda: "another")
    again = compile_model(model, cache_directory=str(tmp_path))
    assert not again.report.cached
    assert again.path != first.path


def test_equal_input_gives_equal_bytes(model: str) -> None:
    assert generate(translate(model)[0]) == generate(translate(model)[0])


def test_spoilt_index_is_made_anew(model: str, tmp_path: Path) -> None:
    compile_model(model, cache_directory=str(tmp_path))
    for index in (tmp_path / "index").iterdir():
        index.write_text("{")
    assert not compile_model(model, cache_directory=str(tmp_path)).report.cached


def test_threads_share_the_cache(model: str, tmp_path: Path) -> None:
    paths: list[str] = []
    threads = [
        threading.Thread(target=lambda: paths.append(compile_model(model, cache_directory=str(tmp_path)).path))
        for _ in range(4)
    ]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(set(paths)) == 1
    assert len(paths) == 4
    assert not list(tmp_path.glob("*.tmp"))


def test_a_missing_compiler_is_named(model: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "COMPILER", ("no-such-compiler",))
    with pytest.raises(cache.CompilerError, match="install"):
        compile_model(model, cache_directory=str(tmp_path))
    assert not list(tmp_path.glob("*.so"))
