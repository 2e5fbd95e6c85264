"""Where a model comes from, and what its translation may reach."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from lacuna.codegen.compile import CompiledModel, compile_model
from lacuna.codegen.library.access import NONE, Access
from lacuna.codegen.library.search_path import search_path
from lacuna.errors import UserError

Units = Literal["error", "warn", "all"]  # "all": an error also inside the files of libraries


@dataclass(frozen=True)
class Source:
    """Where a model comes from: `name` as `load` takes it, where classes are looked up, what unit errors are."""

    name: str
    path: tuple[str, ...]
    units: Units = "error"
    access: Access = NONE

    @classmethod
    def of(
        cls, model: str | Path, class_name: str, libraries: Iterable[str | Path], units: Units = "error",
        data: Iterable[str | Path] = (), allow_external: bool = False,
    ) -> Source:  # fmt: skip
        if not isinstance(model, str | Path):
            name = f"; write {model.name!r}" if isinstance(getattr(model, "name", None), str) else ""
            raise UserError(f"a model is given here by its name or file, not as {type(model).__name__}{name}")
        if units not in get_args(Units):
            raise UserError(f"units may be {' or '.join(get_args(Units))}, not {units!r}")
        name = f"{model}:{class_name}" if class_name else str(model)
        return cls(name, tuple(search_path(libraries)), units, Access.of(data, allow_external))

    def compiled(
        self, modifications: Mapping[str, float] | None = None, sensitivities: bool = False, quick: bool = False
    ) -> CompiledModel:
        return compile_model(
            self.name, search_path=list(self.path), modifications=dict(modifications or {}), units=self.units,
            sensitivities=sensitivities, access=self.access, quick=quick,
        )  # fmt: skip
