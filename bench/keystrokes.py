"""From a keystroke in an editor to what the language server finds, over the protocol, as an editor has it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import statistics
import time

from bench.editor import Editor, drive

MODEL = Path(__file__).parents[1] / "model" / "Actuators" / "FlightControlEma.mo"
GOAL = 0.150  # s
KEYSTROKES = 40
ADDITIONS = 1_000_000  # of the loop that says how fast Python is on this machine, at this hour
TYPED = '  assert(time < 1e9, "late");'
VALUE = "N(final min=1) = 160"  # a parameter of the actuator


def from_keystroke_to_findings(rounds: int) -> list[dict[str, object]]:
    """One row: median and longest of `rounds` times KEYSTROKES changes of the whole actuator's text, s, by the clock
    and of the server's processor time; and as multiples of a loop that runs beside them, which other work on the
    machine slows down as much."""
    seconds: list[float] = []
    busy: list[float] = []
    loops: list[float] = []

    async def script(editor: Editor) -> None:
        text = MODEL.read_text(encoding="utf-8")
        assert await editor.open(text) == []
        for changed in _typed(text, rounds):
            begin, used = time.perf_counter(), editor.busy()
            await editor.type(changed)
            seconds.append(time.perf_counter() - begin)
            busy.append(editor.busy() - used)
            loops.append(_loop())

    drive(MODEL, script)  # in memory: nothing is saved
    return [
        {
            "model": MODEL.stem, "median s": statistics.median(seconds), "longest s": max(seconds), "goal s": GOAL,
            "processor, median s": statistics.median(busy), "processor, longest s": max(busy),
            "a million additions, s": statistics.median(loops),
            "longest, in those": max(b / loop for b, loop in zip(busy, loops, strict=True)),
            "keystrokes": len(seconds),
        }
    ]  # fmt: skip


def _loop() -> float:
    """Processor time of a million additions, s."""
    begin, total = time.process_time(), 0
    for k in range(ADDITIONS):
        total += k
    return time.process_time() - begin


def _typed(text: str, rounds: int) -> Iterator[str]:
    """A comment grows at the end of the first line; an equation is written letter by letter, and then its number, and
    a parameter's, changes: that is all checked anew."""
    head, rest = text.split("\n", 1)
    before, equation, after = text.partition("equation\n")
    for _ in range(rounds):
        for k in range(KEYSTROKES // 4):
            yield f"{head} // {'a' * k}\n{rest}"
        for k in range(KEYSTROKES // 4):
            yield f"{before}{equation}{TYPED[: 2 * k + 3]}\n{after}"
        for k in range(KEYSTROKES // 4):
            yield f"{before}{equation}{TYPED.replace('9', str(k))}\n{after}"
        for k in range(KEYSTROKES // 4):
            yield text.replace(VALUE, f"{VALUE}.{k}")
