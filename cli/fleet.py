"""`lacuna fleet`: very many histories at a glance."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.progress import progress

FIRST = 10  # actuators that are printed


@answered
def fleet(
    histories: Annotated[str, typer.Argument(help="Parquet or CSV table of histories, a folder with one, or a store")],
    map: Annotated[Path | None, typer.Option(help="Folder of the actuators' map, for its bands")] = None,
    laws: Annotated[list[Path] | None, typer.Option(help="More degradation laws: a .mo file or a folder")] = None,
    risk: Annotated[float, typer.Option(help="Greatest probability of the last limit at an advised test")] = 0.001,
    horizon: Annotated[float | None, typer.Option(help="How far ahead to look")] = None,
    scheduler: Annotated[str | None, typer.Option(help="Address of a Dask scheduler; default: this machine")] = None,
    out: Annotated[Path, typer.Option(help="Folder of the results")] = Path("out/fleet"),
) -> Answer:
    """Forecast a whole fleet: one row an actuator, those at greatest risk first, and a page for the wall.

    Writes fleet.parquet and fleet.html. A run that was killed goes on where it stopped.
    """
    with progress() as tell:
        table = lacuna.fleet(
            histories, map, out, laws=laws or (), risk=risk, horizon=horizon, scheduler=scheduler, progress=tell
        )
    counts = {v: table["verdict"].to_pylist().count(v) for v in ("forecast", "too_early", "steady")}
    text = f"{len(table)} actuators: " + ", ".join(f"{n} {v.replace('_', ' ')}" for v, n in counts.items())
    first = table.slice(0, FIRST).to_pylist()
    lines = [f"{r['actuator']} {r['fault']}".rstrip() + f": {r['median']:.4g} {r['unit']} remain"
             for r in first if r["verdict"] == "forecast" and r["median"] is not None]  # fmt: skip
    return Answer({"counts": counts, "first": first}, [text, *lines], [out / "fleet.html", out / "fleet.parquet"])
