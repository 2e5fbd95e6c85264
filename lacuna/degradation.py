"""The catalogue of degradation laws: models of `model/Degradation/`, and the user's own, translated and tabulated."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.filter.law import Law, severities
from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast
from lacuna.runtime import Model, Session

FIELDS = {"law", "rate", "shapes", "wander", "diffusion", "reference"}


def degradation_laws(folders: Sequence[Path | str] = ()) -> list[Law]:
    """Every law of `Lacuna.Degradation` and of the .mo files in `folders`, once for each of its shapes.

    Raises AnalysisError naming the file where an annotation is not understood or a law is not proportional to its rate,
    and the compiler's Diagnostic where a model is wrong.
    """
    library = Library()
    package = library.find("Lacuna.Degradation")
    members = [
        (cls, f"Lacuna.Degradation.{name}")
        for name in library.members(package)
        if (cls := library.member(package, name)) is not None
    ]
    for folder in map(Path, folders):
        given = [(cls, str(path)) for path in _files(folder) for cls in library.parse_file(path)]
        if not any(_annotation(cls) is not None for cls, _ in given):
            raise AnalysisError(
                f"{folder}: declares no degradation law: none has annotation(__Lacuna(law=..., rate=...))"
            )
        members += given
    found: dict[str, list[Law]] = {}
    for cls, name in members:
        fields = _annotation(cls)
        if fields is None or cls.partial:
            continue
        if fields["law"] in found:
            raise AnalysisError(f"{cls.span.file}: there is already a law {fields['law']!r}")
        found[fields["law"]] = _shapes(cls, name, fields)
    return [law for shapes in found.values() for law in shapes]


def _files(path: Path) -> list[Path]:
    if path.is_file():
        return [path]
    files = sorted(path.glob("*.mo"))
    if not files:
        raise AnalysisError(f"{path}: no .mo file of a degradation law there")
    return files


def _annotation(cls: ast.Class) -> dict[str, Any] | None:
    """The entries of __Lacuna(...), checked; None where the class is no law."""
    entries = [a.modification for a in (cls.annotation.arguments if cls.annotation else ()) if a.name == "__Lacuna"]
    if not entries:
        return None
    fields: dict[str, Any] = {"shapes": {}, "reference": "", "wander": 0.15, "diffusion": 0.02}
    for argument in entries[0].arguments:
        nested = argument.modification
        if nested.value is not None:
            fields[argument.name] = _plain(nested.value)
        else:
            fields[argument.name] = {a.name: _plain(a.modification.value) for a in nested.arguments}
    where = f"{cls.span.file}: {cls.name}"
    unknown = set(fields) - FIELDS
    if unknown or not {"law", "rate"} <= set(fields):
        wrong = f"does not know {', '.join(sorted(unknown))}" if unknown else "needs law and rate"
        raise AnalysisError(f"{where}: __Lacuna of a degradation law {wrong}")
    if not all(isinstance(values, list) and values for values in fields["shapes"].values()):
        raise AnalysisError(f"{where}: shapes(p={{...}}) gives each parameter a list of values")
    return fields


def _plain(value: ast.Expression | None) -> Any:
    if isinstance(value, ast.Literal):
        return value.value
    if isinstance(value, ast.Unary) and value.op == "-":
        return -_plain(value.operand)
    if isinstance(value, ast.ArrayLiteral):
        return [_plain(v) for v in value.elements]
    raise AnalysisError(f"{value.span if value else 'a law'}: an annotation holds numbers, texts and lists of them")


def _shapes(cls: ast.Class, name: str, fields: dict[str, Any]) -> list[Law]:
    compiled = compile_model(name)
    model = Model(compiled.path)
    where = f"{cls.span.file}: {cls.name}"
    if list(model.states) != ["severity"] or "growth" not in model.variables:
        states = ", ".join(model.states) or "none"
        raise AnalysisError(
            f"{where}: a degradation law extends PartialLaw and has one state, severity; here: {states}"
        )
    for parameter in (fields["rate"], *fields["shapes"]):
        model.variable(parameter, "parameter", model.parameters)
    names = list(fields["shapes"])
    laws = []
    for values in product(*fields["shapes"].values()):
        shape = tuple(zip(names, map(float, values), strict=True))
        growth = _growth(model, fields["rate"], dict(shape), 1.0)
        if not np.allclose(_growth(model, fields["rate"], dict(shape), 3.0), 3 * growth, rtol=1e-9, atol=0):
            raise AnalysisError(f"{where}: der(severity) is not proportional to its rate {fields['rate']}")
        laws.append(
            Law(fields["law"], shape, growth, fields["wander"], fields["diffusion"], cls.description or "",
                fields["reference"])
        )  # fmt: skip
    return laws


def _growth(model: Model, rate: str, shape: dict[str, float], value: float) -> np.ndarray:
    """The growth at `severities()`, from the generated code: each the first row of a run."""
    session = Session(model, solver="euler", step=1e-9, outputs=["growth"], output_times=np.zeros(1))
    growth = []
    for x in severities():
        result = session.run(shape | {rate: value}, initial={"severity": float(x)}, start=0.0, stop=1e-9)
        if not result.complete:
            raise AnalysisError(f"{model.name} at a severity of {x:.3g} of the limit: {result.failure}")
        growth.append(result["growth"][0])
    return np.array(growth)
