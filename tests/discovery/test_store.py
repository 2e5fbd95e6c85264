"""What was computed before an interruption is taken up again, and only for the same question."""

from __future__ import annotations

from pathlib import Path
import pickle

import numpy as np
import pytest

from lacuna.discovery.fit.kept.plain_values import load, save
from lacuna.discovery.fit.kept.store import kept, remembered
from lacuna.discovery.fit.solver.free import Free


def test_an_interrupted_run_computes_nothing_twice(tmp_path: Path) -> None:
    folder, computed = tmp_path / "kept", []

    def answer(question: float) -> float:
        return remembered(lambda: (question, np.arange(3.0)), lambda: computed.append(question) or 2 * question)

    with pytest.raises(KeyboardInterrupt), kept(folder):
        assert answer(1.0) == 2.0
        raise KeyboardInterrupt
    with kept(folder):
        assert (answer(1.0), answer(3.0)) == (2.0, 6.0)
    assert computed == [1.0, 3.0] and not folder.exists()
    assert answer(1.0) == 2.0 and computed == [1.0, 3.0, 1.0]


def test_every_plain_value_comes_back_as_it_was(tmp_path: Path) -> None:
    free = Free("R", 1.0, 0.1, sigma=None, upper=np.inf)
    value = (free, {"a": [1, 2.5, True, None, "x"], "b": np.arange(6.0).reshape(2, 3)}, float("nan"), -0.0, 1e-310)
    with (tmp_path / "v.npz").open("wb") as file:
        save(file, value)
    again = load(tmp_path / "v.npz")
    assert again[0] == free and again[1]["a"] == value[1]["a"]
    assert np.array_equal(again[1]["b"], value[1]["b"])
    assert np.isnan(again[2]) and str(again[3]) == "-0.0" and again[4] == 1e-310


def test_a_damaged_or_foreign_result_is_computed_again(tmp_path: Path) -> None:
    """A folder of results received from somebody: whatever lies there, nothing of it runs."""
    folder = tmp_path / "kept"

    class Trap:
        def __reduce__(self) -> tuple:
            return (Path.touch, (tmp_path / "ran",))

    def answer() -> float:
        return remembered(lambda: ("q",), lambda: 7.0)

    with pytest.raises(KeyboardInterrupt), kept(folder):
        answer()
        raise KeyboardInterrupt
    (file,) = folder.glob("*.npz")
    whole = file.read_bytes()
    for damaged in (whole[:40], b"", pickle.dumps(Trap()), whole.replace(b"float", b"class")):
        file.write_bytes(damaged)
        with pytest.raises(KeyboardInterrupt), kept(folder):
            assert answer() == 7.0
            raise KeyboardInterrupt
    assert not (tmp_path / "ran").exists()
