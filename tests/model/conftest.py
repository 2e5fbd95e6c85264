"""A small model as text, or one of the library by name, simulated through the whole pipeline."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

Run = Callable[..., runtime.Result]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """run(model, **options of runtime.simulate): `model` is a qualified name, or the source of a model named Test."""

    def simulate(model: str, **options: object) -> runtime.Result:
        if model.lstrip().startswith("model Test"):
            file = tmp_path / "Test.mo"
            file.write_text(model, encoding="utf-8")
            model = str(file)
        options.setdefault("rtol", 1e-9)
        result = runtime.simulate(runtime.Model(compile_model(model).path), **options)
        assert result.complete, result.failure
        return result

    return simulate
