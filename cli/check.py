"""`lacuna check`: the front end alone."""

from __future__ import annotations

from dataclasses import asdict

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import AllowExternal, ClassName, Data, Libraries, Model, Units


@answered
def check(
    model: Model, class_name: ClassName = "", library: Libraries = None, units: Units = "error", data: Data = None,
    allow_external: AllowExternal = False,
) -> Answer:  # fmt: skip
    """Parse, resolve, flatten and check the units of MODEL; print every finding with file, line and a hint."""
    found = lacuna.check(
        model, class_name=class_name, libraries=library or [], units=units, data=data or [],
        allow_external=allow_external,
    )  # fmt: skip
    said = (
        f"{found.name}: {found.variables} variables ({found.states} continuous), {found.equations} equations, "
        f"{len(found.warnings)} warnings; no errors"
    )
    return Answer(asdict(found), [said], warnings=list(found.warnings))
