"""An unchanged model is neither translated nor compiled again; any change of what it was made from is noticed."""

from __future__ import annotations

import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import threading
import time

import pytest

from lacuna.codegen import cache
from lacuna.codegen.compile import compile_model, translate
from lacuna.codegen.emit.source import generate
from tests.codegen.generated import write_model

ROOT = Path(__file__).parents[3]
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


def _checkout(folder: Path, gain: int) -> Path:
    """A copy of the generator with a library of its own, in which Decay has this gain."""
    package = folder / "lacuna"
    shutil.copytree(ROOT / "codegen", package / "codegen", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(ROOT / "runtime" / "include", package / "runtime" / "include")
    (package / "__init__.py").touch()
    for needed in ("units.py", "texts.py", "children.py", "suggest.py", "written.py", "rows.py", "given.py"):
        shutil.copy(ROOT / "lacuna" / needed, package)
    (package / "model").mkdir()
    (package / "model" / "package.mo").write_text("package Lacuna\nend Lacuna;\n")
    (package / "model" / "Decay.mo").write_text(f"within Lacuna;\n{MODEL.replace('k = 2', f'k = {gain}')}")
    return folder


def _compiled_in(checkout: Path, cache_directory: Path) -> str:
    """Path of the library that this checkout gets for its model Decay."""
    call = "compile_model('Decay', cache_directory=sys.argv[1]).path"
    code = f"import sys; from lacuna.codegen.compile import compile_model; print({call})"
    command = [sys.executable, "-S", "-c", code, str(cache_directory)]  # -S: not the installed package
    return subprocess.run(command, cwd=checkout, check=True, capture_output=True, text=True).stdout.strip()


def test_checkouts_share_a_cache_and_what_is_equal_in_it(tmp_path: Path) -> None:
    one, two, like_one = (
        _checkout(tmp_path / "one", 2),
        _checkout(tmp_path / "two", 3),
        _checkout(tmp_path / "three", 2),
    )
    shared = tmp_path / "cache"
    paths = [_compiled_in(checkout, shared) for checkout in (one, two, one, two, like_one)]
    assert paths[:2] == paths[2:4]
    assert paths[0] != paths[1]
    assert paths[4] == paths[0]
    for path, gain in zip(paths[:2], ("2.0", "3.0"), strict=True):
        text = Path(path).with_suffix(".c").read_text()
        assert '"model/Decay.mo"' in text
        assert str(tmp_path) not in text
        assert f'"k", "", "", "model/Decay.mo", 3, MDL_REAL, MDL_PARAMETER, 0, 1, 1, 0, {gain}' in text


def test_a_file_that_now_wins_a_look_up_makes_the_model_new(tmp_path: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    for folder in (first, second):
        folder.mkdir()
    (second / "Gain.mo").write_text("model Gain constant Real k = 2; end Gain;")
    model = write_model(tmp_path, "model Uses extends Gain; Real y = k*time; end Uses;")
    search, store = [str(first), str(second)], str(tmp_path / "cache")

    def compiled() -> tuple[bool, str]:
        found = compile_model(model, cache_directory=store, search_path=search)
        return found.report.cached, Path(found.path).with_suffix(".c").read_text()

    assert [compiled()[0], compiled()[0]] == [False, True]
    (first / "Gain.mo").write_text("model Gain constant Real k = 7; end Gain;")
    cached, text = compiled()
    assert not cached
    assert "7" in text[text.index("static int mdl_rhs") : text.index("static int mdl_initial_system")]
    assert compiled()[0]


def test_another_compiler_makes_libraries_new(model: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = compile_model(model, cache_directory=str(tmp_path))
    monkeypatch.setattr(cache, "compiler", lambda: "another")
    again = compile_model(model, cache_directory=str(tmp_path))
    assert not again.report.cached
    assert again.path != first.path
    assert again.hash == first.hash  # the C is the same


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


def test_a_library_that_was_cut_or_exchanged_is_made_anew(model: str, tmp_path: Path) -> None:
    first = compile_model(model, cache_directory=str(tmp_path))
    whole = Path(first.path).read_bytes()
    for spoilt in (b"", whole[: len(whole) // 2], whole + b"x"):
        Path(first.path).write_bytes(spoilt)
        again = compile_model(model, cache_directory=str(tmp_path))
        assert not again.report.cached
        assert Path(again.path).read_bytes() == whole


def test_a_folder_that_others_can_write_to_is_refused(model: str, tmp_path: Path) -> None:
    shared = tmp_path / "shared"
    shared.mkdir()
    shared.chmod(0o777)
    with pytest.raises(cache.CompilerError, match="others can write"):
        compile_model(model, cache_directory=str(shared))


def index_of(folder: Path) -> Path:
    (index,) = (folder / "index").iterdir()
    return index


@pytest.mark.parametrize("spoilt", ["null", "[]", "{}", '{"generator": 1}', "\udcff"])
def test_an_index_that_is_none_of_ours_is_made_anew(model: str, tmp_path: Path, spoilt: str) -> None:
    compile_model(model, cache_directory=str(tmp_path))
    index_of(tmp_path).write_text(spoilt, encoding="utf-8", errors="surrogateescape")
    assert not compile_model(model, cache_directory=str(tmp_path)).report.cached


def test_an_index_does_not_lead_to_a_library_elsewhere(model: str, tmp_path: Path) -> None:
    """Whoever can write one small file must not be able to have code loaded from a place of his own."""
    store, elsewhere = tmp_path / "store", tmp_path / "elsewhere"
    found = compile_model(model, cache_directory=str(store))
    elsewhere.mkdir()
    for path in store.glob(f"{Path(found.path).stem}.*"):
        shutil.copy(path, elsewhere)
    for there in (str(elsewhere / Path(found.path).name), f"../elsewhere/{Path(found.path).name}"):
        entry = json.loads(index_of(store).read_text())
        index_of(store).write_text(json.dumps(entry | {"library": there}))
        again = compile_model(model, cache_directory=str(store))
        assert (again.report.cached, again.path) == (False, found.path)


def test_what_is_found_in_a_folder_that_others_can_write_to_is_not_loaded(model: str, tmp_path: Path) -> None:
    store = tmp_path / "store"
    compile_model(model, cache_directory=str(store))
    store.chmod(0o777)
    with pytest.raises(cache.CompilerError, match="others can write"):
        compile_model(model, cache_directory=str(store))


def test_a_model_compiled_quickly_is_a_library_of_its_own_from_the_same_source(model: str, tmp_path: Path) -> None:
    whole, quick = (compile_model(model, cache_directory=str(tmp_path / "store"), quick=q) for q in (False, True))
    sources = [Path(m.path).with_suffix(".c").read_text() for m in (whole, quick)]
    assert whole.path != quick.path and whole.hash == quick.hash and sources[0] == sources[1]
    assert Path(whole.path).read_bytes() != Path(quick.path).read_bytes()


def test_the_folder_is_bounded_and_what_was_used_last_stays(tmp_path: Path) -> None:
    day = 86400
    for k in range(10):
        for suffix in (".so", ".c", ".sha256"):
            path = tmp_path / f"{k:032x}{suffix}"
            path.write_bytes(bytes(1000))
            os.utime(path, (0, time.time() - (10 - k) * day))
    os.utime(tmp_path / f"{0:032x}.sha256")  # used just now
    cache.trim(tmp_path, largest=10_000)
    assert {int(path.stem, 16) for path in tmp_path.iterdir()} == {0, 8, 9}
    assert len(list(tmp_path.iterdir())) == 9
    cache.trim(tmp_path, largest=0)
    assert {int(path.stem, 16) for path in tmp_path.iterdir()} == {0}
