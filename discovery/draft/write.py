"""The text of a drafted case.toml: what was found, what was assumed, and what to look at, each where it belongs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
import json
import re

from lacuna.discovery.draft.match import Match

LOOK = "# ?"  # marks what the draft was unsure of


@dataclass(frozen=True)
class Column:
    """`level`: standard deviation of the noise, in the column's unit; `steps`: few values occur, as of a command."""

    match: Match
    level: float
    steps: bool


@dataclass(frozen=True)
class Draft:
    model: str
    libraries: tuple[str, ...]
    recordings: tuple[str, ...]
    columns: tuple[Column, ...]
    initial: Mapping[str, str]
    parameters: Mapping[str, tuple[float, str, str]]  # believed value, unit, description
    fit: tuple[str, ...]
    validate: tuple[str, ...]
    notes: tuple[str, ...]
    missing: tuple[str, ...]  # inputs that no column drives
    parted: bool


class _Text:
    """Lines of the file; what is unsure is marked in it and listed."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.unsure: list[str] = []

    def __call__(self, *lines: str) -> None:
        self.lines += lines

    def look(self, sentence: str) -> None:
        self.lines.append(f"{LOOK} {_one_line(sentence)}")
        self.unsure.append(_one_line(sentence))


def case_toml(draft: Draft) -> tuple[str, tuple[str, ...]]:
    """The file's text, and the sentences about what somebody who knows the machine should look at."""
    text = _Text()
    text(
        f"# A case drafted from {', '.join(map(_one_line, draft.recordings))}.",
        f"# Lines that begin with `{LOOK}` want a look.",
    )
    text("", f"model = {string(draft.model)}")
    if draft.libraries:
        text(f"libraries = [{', '.join(map(string, draft.libraries))}]")
    text("")
    for note in draft.notes:
        text.look(note)
    for name in draft.missing:
        text.look(
            f"no column drives the model's input `{name}`: name one below, or give the input a value in the model"
        )
    _signals(text, draft)
    _initial(text, draft)
    _parameters(text, draft)
    text("[recordings]")
    if draft.parted:
        text.look(
            "there is one recording: its first stretch is fitted, its last one judges; a second recording is better"
        )
    else:
        text.look(
            "the last recordings judge what was fitted to the others: they should show motions that the others do not"
        )
    text(f"fit = [{', '.join(map(string, draft.fit))}]", f"validate = [{', '.join(map(string, draft.validate))}]", "")
    return "\n".join(text.lines), tuple(text.unsure)


def _signals(text: _Text, draft: Draft) -> None:
    for column in draft.columns:
        match = column.match
        if match.target is None:
            turns = " (Hz is no rad/s: turns a second are rev/s)" if (match.head.unit or "").endswith("Hz") else ""
            text.look(f"column `{match.head.text}` fits no variable of the model and was left out{turns}")
            text("")
            continue
        text(f"[signals.{key(match.head.name)}]" + _origin(match.head.text, match.head.name))
        if not match.sure:
            text.look(_doubt(match))
        role = "input" if match.target.is_input else "output"
        text(f'role = "{role}"', f"variable = {string(match.target.name)}" + _said(match.target.description))
        text(f"unit = {string(_unit(match))}")
        if role == "input" and (column.steps or match.target.discrete):
            if not match.target.discrete:
                text.look(f"`{match.head.name}` takes few values: it was taken to hold between samples, like a command")
            text('interpolation = "hold"')
        if role == "output" and column.level > 0:
            text(f"# noise_std = {column.level:.3g}  # estimated from the recordings; as good as leaving it out")
        text("")


def _unit(match: Match) -> str:
    assert match.target
    return match.head.unit or match.target.unit or "1"


def _doubt(match: Match) -> str:
    assert match.target
    head, target = match.head, match.target
    others = f"; it could also be {', '.join(t.name for t in match.others)}" if match.others else ""
    if head.unit is None:
        return f"column `{head.text}` says no unit: that of `{target.name}`, {target.unit or '1'}, was assumed{others}"
    if not head.sure:
        return f"the end of `{head.text}` was taken for its unit, {head.unit}{others}"
    return f"column `{head.text}` was taken for `{target.name}`{others}"


def _initial(text: _Text, draft: Draft) -> None:
    text("[initial]  # of states, at each recording's first sample; where nothing is said, what the model starts from")
    unknown = [name for name, value in draft.initial.items() if value == "unknown"]
    if unknown:
        text.look(f"the machine does not begin at rest: where {', '.join(unknown)} begins is fitted")
    text(*(f"{key(name)} = {string(value)}" for name, value in draft.initial.items()), "")


def _parameters(text: _Text, draft: Draft) -> None:
    text("[parameters]  # what is believed, SI; the model's own values where nothing is said")
    for name, (value, unit, description) in draft.parameters.items():
        text(f"# {key(name)} = {value!r}  # {_one_line(f'{unit}  {description}'.strip())}")
    text("", "[uncertainty]  # relative standard deviation of a belief; 0 is exact")
    text("# 0.05 where nothing is said, and 0 for what only a component's class says", "")


def key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else string(name)


def string(text: str) -> str:
    """A TOML basic string; TOML's escapes are JSON's."""
    return json.dumps(text, ensure_ascii=False)


def _one_line(text: str) -> str:
    """Fit for a comment: no control characters, which would end it or be refused."""
    return re.sub(r"[\x00-\x1f\x7f]+", " ", text)


def _origin(text: str, name: str) -> str:
    return f"  # {_one_line(text)}" if text != name else ""


def _said(description: str) -> str:
    return f"  # {_one_line(description)}" if description else ""
