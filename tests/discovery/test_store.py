"""What was computed before an interruption is taken up again, and only for the same question."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.store import kept, remembered


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
