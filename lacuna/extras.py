"""A package that an optional part of Lacuna needs and that is not installed is named in one line, with its extra."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import functools
from importlib.metadata import requires
import re
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

_REQUIREMENT = re.compile(r"""^(?P<package>[A-Za-z0-9._-]+)[^;]*;\s*extra\s*==\s*["'](?P<extra>[\w-]+)["']""")
# Extras for those who develop Lacuna, and the sum of all: never what a user is told to install.
_NOT_FOR_USERS = {"all", "test"}


class MissingPackage(ImportError):
    """A package of an extra is missing; the message says which and how to install it."""

    user_error = True


def extra_of(module: str, requirements: Iterable[str] | None = None) -> str | None:
    """The first extra of pyproject.toml that brings `module`, or None where it belongs to none."""
    for requirement in requires("lacuna") or [] if requirements is None else requirements:
        match = _REQUIREMENT.match(requirement)
        if match and match["extra"] not in _NOT_FOR_USERS and _module(match["package"]) == _module(module):
            return match["extra"]
    return None


def _module(package: str) -> str:
    return package.split(".")[0].replace("-", "_").lower()


def named(error: ModuleNotFoundError) -> MissingPackage | None:
    """What to say where the import of an extra's package failed; None where the module belongs to no extra."""
    name = (error.name or "").split(".")[0]
    extra = extra_of(name)
    if extra is None:
        return None
    return MissingPackage(f"this needs the package {name}, which is not installed: pip install 'lacuna[{extra}]'")


def names_missing_packages(function: Callable[P, T]) -> Callable[P, T]:
    """`function`, raising MissingPackage where an import fails for a package that an extra brings."""

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return function(*args, **kwargs)
        except ModuleNotFoundError as error:
            if message := named(error):
                raise message from None
            raise

    return call
