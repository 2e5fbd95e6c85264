"""New cases from recordings as they come, and recordings from one format into another."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from lacuna.errors import UserError
from lacuna.extras import names_missing_packages
from lacuna.notebook import page, paragraph, table
from lacuna.progress import Progress, spoken


@dataclass(frozen=True)
class Drafted:
    """A case folder that was written: what each column was taken for, and what a human should look at.

    `columns` holds (column, variable, unit, role), "" where nothing fits; `unsure` the sentences marked in case.toml.
    """

    folder: Path
    columns: tuple[tuple[str, str, str, str], ...]
    unsure: tuple[str, ...]

    def _repr_html_(self) -> str:
        rows = table(("column", "variable", "unit", "role"), self.columns)
        return page(f"case {self.folder}", rows, *(paragraph(sentence) for sentence in self.unsure))


@names_missing_packages
def new_case(
    model: str | Path,
    recordings: Iterable[str | Path],
    out: str | Path,
    *,
    libraries: Iterable[str | Path] = (),
    progress: Progress | None = None,
) -> Drafted:
    """Write a case for `explain` from a model and recordings as loggers wrote them.

    Columns are matched to variables by name and unit, units are proposed, noise is estimated, recordings are divided
    into those that are fitted and those that judge; `out`/case.toml says what was assumed. Raises a user error where
    the files are no recordings of this model; then nothing is written.
    """
    from lacuna.discovery.draft.case import new_case as draft

    spoken(progress)("matching columns to variables")
    made = draft(str(model), [Path(path) for path in recordings], Path(out), [Path(path) for path in libraries])
    columns = tuple(
        (m.head.text, m.target.name, m.head.unit or m.target.unit, "input" if m.target.is_input else "output")
        if m.target
        else (m.head.text, "", m.head.unit or "", "")
        for m in made.matches
    )
    return Drafted(made.path.parent, columns, made.unsure)


@names_missing_packages
def convert(recording: str | Path, out: str | Path, *, progress: Progress | None = None) -> tuple[str, ...]:
    """Write a recording in the format of `out`'s suffix, units kept; returns what was assumed in reading it.

    Raises UserError where `out` is there already or its format is only read.
    """
    from lacuna.analysis.recording.channel import not_rising
    from lacuna.analysis.recording.formats import read_recorded, write_recorded

    out = Path(out)
    if out.exists():
        raise UserError(f"{out} is there already")
    tell = spoken(progress)
    tell(f"reading {recording}")
    found = read_recorded(recording)
    tell(f"writing {out}")
    write_recorded(found, out)
    disorder = dict.fromkeys(at[1] for c in found.channels if (at := not_rising(c.time)))
    return (*found.notes, *disorder)
