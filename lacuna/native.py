"""Where the compiled libraries are: inside an installed package, or in the build folder of a checkout."""

from __future__ import annotations

import os
from pathlib import Path

import lacuna


def native_library(name: str) -> Path:
    """The path of lib`name`.so: below $LACUNA_BUILD if that is set, else the package's own, else build/ of a checkout.

    The path is that of the checkout's build where there is none, so that a message can name it.
    """
    file = f"lib{name}.so"
    if build := os.environ.get("LACUNA_BUILD"):
        return Path(build) / "lib" / file
    homes = [Path(folder) for folder in lacuna.__path__]
    checkout = Path(__file__).resolve().parent.parent / "build" / "lib" / file
    installed = (home / "lib" / file for home in homes)
    return next((path for path in (checkout, *installed) if path.exists()), checkout)
