"""Completion in the shell (`lacuna --install-completion`): names of models, parameters, inputs and variables."""

from __future__ import annotations

from collections.abc import Iterable

import typer

import lacuna


def models(incomplete: str) -> list[tuple[str, str]]:
    """Models of the package Lacuna, with and without its name; files complete themselves."""
    try:
        found = [(entry.name, entry.description) for entry in lacuna.list_models()]
    except Exception:  # whatever is wrong is said when the command is run
        return []
    short = [(name.removeprefix("Lacuna."), said) for name, said in found]
    return [(name, said) for name, said in [*short, *found] if name.startswith(incomplete)]


def parameters_of(ctx: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    return _of_model(ctx, incomplete, lambda model: model.parameters.items(), "=")


def inputs_of(ctx: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    return _of_model(ctx, incomplete, lambda model: model.inputs.items(), "=")


def variables_of(ctx: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    return _of_model(ctx, incomplete, lambda model: model.variables.items(), "")


def _of_model(ctx: typer.Context, incomplete: str, names, ending: str) -> list[tuple[str, str]]:
    given = ctx.params
    named = given.get("model") or next(iter(ctx.args), "")  # an option still waits for its value
    try:
        model = lacuna.load(named, class_name=given.get("class_name") or "", libraries=given.get("library") or [])
    except Exception:  # as above
        return []
    found: Iterable = names(model)
    return [(name + ending, variable.description) for name, variable in found if name.startswith(incomplete)]
