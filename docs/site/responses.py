"""A simulated response of each component: it is built into the smallest machine that its connectors allow.

One flange is moved as sin(w t), or a voltage or the input signals are; the other flange is fixed, free, or has an
inertia: the first of these machines that can be simulated is drawn, over two periods. Amplitudes are 1 rad, 1 m, 1 V,
1; so what a parameter of an effect is relative to has about that size, too. The period is 2 pi s or, where the
component has times of its own, twelve times the longest.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import hashlib
import io
from pathlib import Path
import tempfile

import matplotlib
import numpy as np

import lacuna

matplotlib.use("svg")
from matplotlib import pyplot

PERIODS, TIMES = 2, 12
MODEL_FOLDER = Path(__file__).resolve().parents[2] / "model"
FLANGES = ("Flange_a", "Flange_b", "TranslationalFlange_a", "TranslationalFlange_b")
PINS = ("PositivePin", "NegativePin")
SIGNALS = {
    "RealInput": "sin(w*time)",
    "BooleanInput": "sin(w*time) > 0",
    "IntegerInput": "if sin(w*time) > 0 then 1 else 0",
}
OUTPUTS = ("RealOutput", "IntegerOutput", "BooleanOutput")
OTHERS = {
    "Fixed": ", the other flange fixed",
    "": ", the other flange free",
    "Inertia": ", an inertia of 1 at the other flange",
    "sprung": " through a spring of 100 N.m/rad, with an inertia of 1 kg.m2",
}
MOVERS = """
  model Turn
    Lacuna.Interfaces.Flange_b flange;
  equation
    flange.phi = sin(w*time);
  end Turn;
  model Sprung
    Lacuna.Interfaces.Flange_b flange;
    Turn turn;
    Lacuna.Components.Mechanics.SpringDamper spring(c=100, d=2);
    Lacuna.Components.Mechanics.Inertia body(J=1, phi(start=0, fixed=true), w(start=0, fixed=true));
  equation
    connect(turn.flange, spring.flange_a);
    connect(spring.flange_b, body.flange_a);
    connect(body.flange_b, flange);
  end Sprung;
  model Slide
    Lacuna.Interfaces.TranslationalFlange_b flange;
  equation
    flange.s = sin(w*time);
  end Slide;"""


@dataclass(frozen=True)
class Part:
    """What must be known of a component: its class, its connectors as (name, type), values of its parameters."""

    path: str
    connectors: tuple[tuple[str, str], ...]
    values: tuple[tuple[str, float], ...] = ()
    slowest: float = 0.0  # s, the longest of its own times; 0 where it has none

    def of(self, *kinds: str) -> list[str]:
        return [name for kind in kinds for name, k in self.connectors if k == kind]


@dataclass(frozen=True)
class Response:
    svg: str
    caption: str


@dataclass(frozen=True)
class Machine:
    text: str
    response: str  # the variable that is drawn
    caption: str
    driven: bool


class Drawer:
    """Draws responses and keeps them in `cache`; at most `limit` of them where that is given."""

    def __init__(self, cache: Path, limit: int | None = None) -> None:
        self._cache, self._left = cache, limit
        self._sources = hashlib.sha256(Path(__file__).read_bytes())
        for file in sorted(MODEL_FOLDER.rglob("*.mo")):
            self._sources.update(file.read_bytes())

    def response(self, part: Part) -> Response | None:
        """None where no machine that its connectors allow can be simulated, and beyond the limit."""
        if self._left is not None:
            self._left -= 1
            if self._left < 0:
                return None
        key = hashlib.sha256(self._sources.digest() + repr(part).encode()).hexdigest()[:24]
        kept = self._cache / f"{key}.svg"
        if not kept.exists():
            drawn = next((r for machine in machines(part) if (r := _drawn(part, machine))), Response("", ""))
            self._cache.mkdir(parents=True, exist_ok=True)
            beside = kept.with_suffix(".part")
            beside.write_text(f"{drawn.caption}\n{drawn.svg}", encoding="utf-8")
            beside.replace(kept)
        caption, _, svg = kept.read_text(encoding="utf-8").partition("\n")
        return Response(svg, caption) if svg else None


def frequency(part: Part) -> float:
    """rad/s."""
    return 2 * np.pi / (TIMES * part.slowest) if part.slowest else 1.0


def machines(part: Part) -> Iterator[Machine]:
    flanges, pins = part.of(*FLANGES), part.of(*PINS)
    for other in OTHERS if len(flanges) > 1 else ["", "sprung"] if flanges else [""]:
        built = [_flanges(part, other), _pins(part), _signals(part)]
        shown = [*part.of(*OUTPUTS), *(f"{n}.{_effort(part, n)}" for n in flanges[:1]), *(f"{n}.i" for n in pins[:1])]
        if not shown:
            return
        values = ", ".join(f"{name}={value!r}" for name, value in part.values)
        text = "\n".join([
            "model Response", MOVERS, f'  constant Real w(unit="rad/s") = {frequency(part)!r};',
            f"  {part.path} part({values});", *(f"  {line}" for declared, _, _ in built for line in declared),
            "equation", *(f"  {line}" for _, equations, _ in built for line in equations), "end Response;", "",
        ])  # fmt: skip
        words = [word for _, _, word in built if word]
        yield Machine(text, f"part.{shown[0]}", "; ".join(words) or "by itself", bool(words))


def _effort(part: Part, name: str) -> str:
    return "f" if dict(part.connectors)[name].startswith("Translational") else "tau"


def _flanges(part: Part, other: str) -> tuple[list[str], list[str], str]:
    """Declarations, equations, words: the first flange is moved, all others are as `other` says."""
    names = part.of(*FLANGES)
    if not names:
        return [], [], ""
    declared, equations = [], []
    for n, name in enumerate(names if other in ("Fixed", "Inertia") else names[:1]):
        declared.append(f"{_beyond(_effort(part, name) == 'f', other, moved=n == 0)};".replace("NAME", f"beyond_{n}"))
        equations.append(f"connect(beyond_{n}.{'flange_a' if n and other == 'Inertia' else 'flange'}, part.{name});")
    return declared, equations, f"{names[0]} moved as sin(w t)" + (OTHERS[other] if len(names) > 1 or other else "")


def _beyond(slides: bool, other: str, moved: bool) -> str:
    """The declaration, of NAME, of what is at a flange."""
    if moved:
        return f"{'Sprung' if other == 'sprung' else 'Slide' if slides else 'Turn'} NAME"
    kind = {"Fixed": "TranslationalFixed", "Inertia": "Mass"}[other] if slides else other
    return f"Lacuna.Components.Mechanics.{kind} NAME" + (
        "(m=1)" if kind == "Mass" else "(J=1)" if kind == "Inertia" else ""
    )


def _pins(part: Part) -> tuple[list[str], list[str], str]:
    """A voltage over the first two pins, or a resistor where something else drives; further ones are not connected."""
    names = part.of(*PINS)
    if len(names) < 2:
        return [], [], ""
    driven = bool(part.of("RealInput", *FLANGES)) or "Electrical.ConstantVoltage" in part.path
    kind, word = ("Resistor", "1 Ohm over the pins") if driven else ("SignalVoltage", "sin(w t) V over the pins")
    declared = [f"Lacuna.Components.Electrical.{kind} over{'(R=1)' if driven else ''};",
                "Lacuna.Components.Electrical.Ground ground;"]  # fmt: skip
    equations = [
        f"connect(over.p, part.{names[0]});",
        f"connect(over.n, part.{names[1]});",
        "connect(over.n, ground.p);",
    ]
    return declared, equations + ([] if driven else ["over.u = sin(w*time);"]), word


def _signals(part: Part) -> tuple[list[str], list[str], str]:
    inputs = [(name, kind) for name, kind in part.connectors if kind in SIGNALS]
    names = ", ".join(name for name, _ in inputs if name != "J")
    if {"s", "v"} <= {name for name, _ in inputs}:
        return [], ["part.s = sin(w*time);", "part.v = w*cos(w*time);"], "s as sin(w t), v its derivative"
    return (
        [],
        [f"part.{name} = {_signal(name, kind)};" for name, kind in inputs],
        f"{names} as sin(w t)" if names else "",
    )


def _signal(name: str, kind: str) -> str:
    return "1" if name == "J" else SIGNALS[kind]  # an inertia is none that swings


def _drawn(part: Part, machine: Machine) -> Response | None:
    """None where the machine is none: refused by the translator, or its run ends early."""
    w = frequency(part)
    stop = PERIODS * 2 * np.pi / w
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "Response.mo"
        file.write_text(machine.text, encoding="utf-8")
        try:
            model = lacuna.load(file, units="warn")
            result = model.simulate(stop=stop, interval=stop / 800, rtol=1e-7)
        except Exception as error:
            if lacuna.is_user_error(error):
                return None
            raise
    y = result[machine.response]
    if not np.ptp(y) > 1e-9 * np.max(np.abs(y)):
        return None  # nothing to see
    unit = result.units.get(machine.response, "")
    label = machine.response.removeprefix("part.") + (f", {unit}" if unit and unit != "1" else "")
    caption = f"{machine.response.removeprefix('part.')} with {machine.caption}, w = {w:.4g} rad/s"
    if part.values:
        caption += "; " + ", ".join(f"{name} = {value:g}" for name, value in part.values)
    return Response(_svg(result.time, np.sin(w * result.time), y, label, machine.driven), caption)


def _svg(time: np.ndarray, moved: np.ndarray, y: np.ndarray, label: str, driven: bool) -> str:
    """Over time, and over what moves where something does."""
    with matplotlib.rc_context({"svg.hashsalt": "lacuna", "font.size": 8, "svg.fonttype": "none"}):
        figure, axes = pyplot.subplots(1, 1 + driven, figsize=(6.4, 2.1), sharey=True, squeeze=False)
        for axis, x, what in zip(axes[0], (time, moved), ("time, s", "sin(w t)"), strict=False):
            axis.plot(x, y, color="#0b5394", linewidth=1.1)
            axis.set_xlabel(what)
            axis.grid(alpha=0.3)
            axis.spines[["top", "right"]].set_visible(False)
        axes[0, 0].set_ylabel(label)
        figure.tight_layout()
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
        pyplot.close(figure)
    return buffer.getvalue()
