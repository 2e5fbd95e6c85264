"""The reference of the Python API: every public name, from its docstring."""

from __future__ import annotations

import inspect

import lacuna

INTRODUCTION = """# Python: every public name

`import lacuna` brings these; [the page of the API](../python.md) shows them at work. Numbers are in SI units.

"""


def page() -> str:
    """Markdown with one directive of mkdocstrings a name: functions first, then what they return or raise."""
    public = {name: getattr(lacuna, name) for name in lacuna.__all__}
    functions = [name for name, what in public.items() if inspect.isfunction(what)]
    others = [name for name in public if name not in functions]
    homes = {name: f"lacuna.{lacuna._HOME_OF[name]}.{name}" for name in public}
    return INTRODUCTION + "".join(f"::: {homes[name]}\n\n" for name in [*functions, *others])
