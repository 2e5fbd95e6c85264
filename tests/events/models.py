"""Small models written in a test: translated, compiled and run."""

from __future__ import annotations

from pathlib import Path

from lacuna import runtime
from lacuna.codegen.compile import compile_model


def compiled(folder: Path, text: str, **options: bool) -> runtime.Model:
    name = text.split()[1]
    path = folder / f"{name}.mo"
    path.write_text(text)
    return runtime.Model(compile_model(str(path), **options).path)


def simulated(folder: Path, text: str, **settings: object) -> runtime.Result:
    return runtime.simulate(compiled(folder, text), **{"interval": 0.0, **settings})
