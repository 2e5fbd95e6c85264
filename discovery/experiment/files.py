"""OUT/next/: the waveforms to be played, a case.toml that reads what is recorded of them, and what is expected.

The case refers to the model and the recordings where they are; nothing of a user's is copied, moved or removed.
"""

from __future__ import annotations

from collections.abc import Mapping
import os
from pathlib import Path
import tomllib
from typing import Any

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.draft.write import key, string
from lacuna.discovery.experiment.picture import picture
from lacuna.discovery.experiment.proposal import Proposal
from lacuna.discovery.experiment.waveforms import Waveform
from lacuna.drawn import save
from lacuna.written import whole_files

FOLDER = "next"
OWN = ("case.toml", "prediction.csv", "prediction.svg")


def recorded_as(case: Case) -> tuple[str, str]:
    """What the recordings of the two waveforms are to be called: names that the case does not have yet."""
    taken = {r.name for r in [*case.fit, *case.validate]}
    free = [name for k in range(1, len(taken) + 3) if (name := f"next{k}.csv") not in taken]
    return free[0], free[1]


def played(recording: str) -> str:
    """The file of the waveform that this recording answers to."""
    return recording.replace(".csv", ".inputs.csv")


def described(case: Case, proposal: Proposal) -> dict[str, Any]:
    """The proposal as data; files are relative to the folder of diagnosis.json."""
    fit, judge = recorded_as(case)
    return {
        "text": proposal.waveform.text,
        "decides": proposal.decides,
        "sigmas": proposal.sigmas,
        "column": proposal.column,
        "first": proposal.rivals[0].label,
        "rivals": [{"label": label, "sigmas": sigmas} for label, sigmas in proposal.apart.items()],
        "duration": float(proposal.waveform.time[-1]),
        "limits": {c: {"min": r.low, "max": r.high, "rate": r.rate} for c, r in proposal.ranges.items()},
        "case": f"{FOLDER}/case.toml",
        "play": [f"{FOLDER}/{played(name)}" for name in (fit, judge)],
        "record_as": [f"{FOLDER}/{name}" for name in (fit, judge)],
        "prediction": f"{FOLDER}/prediction.csv",
        "plot": f"{FOLDER}/prediction.svg",
    }


def write_next(case: Case, proposal: Proposal | None, out: Path) -> list[Path]:
    """Write OUT/next/, all files or none; without a proposal what an earlier run proposed there is taken away."""
    folder = out / FOLDER
    names = recorded_as(case)
    for stale in [*OWN, *map(played, names)]:
        (folder / stale).unlink(missing_ok=True)
    if proposal is None:
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()
        return []
    with whole_files(folder) as scratch:
        for name, waveform in zip(names, (proposal.waveform, proposal.judging), strict=True):
            _write_inputs(case, waveform, scratch / played(name))
        (scratch / "case.toml").write_text(_case_toml(case, proposal, folder, names), encoding="utf-8")
        _write_prediction(case, proposal, scratch / "prediction.csv")
        figure = picture(case, proposal)
        save(figure, scratch / "prediction.svg", "svg", bbox_inches="tight")
    return [folder / name for name in (*OWN, *map(played, names))]


def _write_inputs(case: Case, waveform: Waveform, path: Path) -> None:
    """The inputs in the units of the case's own columns."""
    columns = [(waveform.columns[s.column] - s.offset) / s.scale for s in case.inputs]
    _write(path, ["time", *(s.column for s in case.inputs)], [waveform.time, *columns])


def _write_prediction(case: Case, proposal: Proposal, path: Path) -> None:
    """Every output as the first explanation says and as its hardest rival says, in the case's units."""
    head, columns = ["time"], [proposal.waveform.time]
    for name, number in (("first", 0), ("rival", proposal.hardest)):
        for s in case.outputs:
            head.append(f"{s.column} {name}")
            columns.append((proposal.predictions[number][s.column] - s.offset) / s.scale)
    _write(path, head, columns)


def _write(path: Path, head: list[str], columns: list[np.ndarray]) -> None:
    np.savetxt(path, np.column_stack(columns), "%.9g", ",", header=",".join(head), comments="", encoding="utf-8")


def _case_toml(case: Case, proposal: Proposal, folder: Path, names: tuple[str, str]) -> str:
    """The case as it was, with the new recordings: the first may be fitted to, the second judges."""
    raw = tomllib.loads((case.folder / "case.toml").read_text(encoding="utf-8"))

    def seen(entry: str) -> str:
        return Path(os.path.relpath(case.folder.resolve() / entry, folder.resolve())).as_posix()

    file, colon, inner = raw["model"].partition(":")
    raw["model"] = f"{seen(file)}{colon}{inner}" if file.endswith(".mo") else raw["model"]
    raw |= {"libraries": [seen(entry) for entry in raw["libraries"]]} if "libraries" in raw else {}
    raw["recording"] = {seen(entry): table for entry, table in raw.get("recording", {}).items()}
    raw["recordings"] = {
        part: [*map(seen, raw["recordings"][part]), name]
        for part, name in zip(("fit", "validate"), names, strict=True)
    }  # fmt: skip
    raw["limits"] = raw.get("limits", {}) | {
        c: {"min": r.low, "max": r.high, "rate": r.rate} for c, r in proposal.ranges.items() if r.moves
    }
    lines = [
        "# The case with the experiment that decides. Play each *.inputs.csv and record all columns of [signals],",
        f"# as {names[0]} and {names[1]} beside this file; then `lacuna explain` this folder.",
    ]
    return "\n".join([*lines, "", *_toml(raw)]) + "\n"


def _toml(table: Mapping[str, Any], path: str = "") -> list[str]:
    """Lines of a table: its values, then its tables."""
    values = [f"{key(k)} = {_value(v)}" for k, v in table.items() if not isinstance(v, dict)]
    lines = [*([f"[{path}]"] if path and values else []), *values, *([""] if values else [])]
    for name, inner in table.items():
        if isinstance(inner, dict):
            lines += _toml(inner, f"{path}.{key(name)}" if path else key(name))
    return lines


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    return string(value) if isinstance(value, str) else repr(value)
