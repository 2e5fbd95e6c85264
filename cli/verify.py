"""`lacuna verify`: is a result what its command makes?"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import AllowExternal
from lacuna.cli.progress import progress


@answered
def verify(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="Folder of results of simulate, maps, sweep, assess, "
                                           "forecast or explain")],
    allow_external: AllowExternal = False,
) -> Answer:  # fmt: skip
    """Make a result again from its recorded command and inputs, and say whether it is the same.

    Ends with status 0 where every file is equal byte for byte (pages and times of computing apart), else with 1. Run it
    in the folder where the command was given.
    """
    with progress() as tell:
        found = lacuna.verify(folder, progress=tell, allow_external=allow_external)
    said = f"{' '.join(('lacuna', *found.command))}: {len(found.checked)} files made again"
    failure = f"not the same: {', '.join(found.differs)}" if found.differs else ""
    return Answer(asdict(found), [said if failure else f"{said}, all the same"], failure=failure)
