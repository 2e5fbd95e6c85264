"""Slips that only a model shows: a reversed sign, a unit off by 1000 or in degrees, a signal shifted in time.

Each output is compared with the believed model's simulation: a slip leaves the shape and changes the scale, or leaves
the scale and moves the time. A machine that merely misbehaves changes both a little, so the thresholds are far from
what an effect does. Where the simulation runs out of step with the recording (commutated currents) the shape says
nothing; then the size from window to window is compared, and what the model's outputs always obey together.
"""

from __future__ import annotations

from dataclasses import replace
import math
from pathlib import Path

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.case.recordings_check import Problem, longest_run
from lacuna.discovery.fit.evidence import astray
from lacuna.discovery.fit.fit import believed, fit
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.tracking import filled

SCALES = {
    -1.0: "its sign is reversed", 1000.0: "it is 1000 times too large", 1e-3: "it is 1000 times too small",
    -1000.0: "it is 1000 times too large, with the sign reversed",
    -1e-3: "it is 1000 times too small, with the sign reversed",
    180 / math.pi: "it is in degrees where radians are stated",
    math.pi / 180: "it is in radians where degrees are stated",
    30 / math.pi: "it is in rpm where rad/s is stated", math.pi / 30: "it is in rad/s where rpm is stated",
}  # fmt: skip
SHAPE = 0.9  # least correlation with the simulation at which a scale is read
WITHIN, FAR = 0.25, 1.0  # relative distance from a listed scale; from one that no physics comes near to
LATE, EARLY = 50, 8  # samples: a signal may be somewhat late by a sensor or a drive, but not early
WINDOWS, STEADY = 40, 0.8  # of the recording, and the share of them in which a slipped unit shows
ALIKE = 0.3  # gain from which the lag of another signal is one
SURE = 0.9  # gain from which outputs that are early alike say that the drive is shifted: a faster machine is early too
STANDS = 0.1  # share of the recording in which a signal stands, and of the simulated range that it leaves out
OBEYED, BROKEN = 1e-6, 0.3  # residual of a relation between outputs over its largest term
AS_GOOD = 0.1  # part of what moving the signal takes away that the least of several moves may leave
TIME_CONSTANTS = np.linspace(0.5, 2.0, 16)  # of a sensor, in units of the lag that moving its signal takes for it
CHANGES = (10, 100)  # samples over which changes are compared when looking for a shift: fast ones, and beyond noise


def slips(machine: Machine) -> list[Problem]:
    """What contradicts the model: at its believed values and, of a shift in time, as fitted to the recordings, too.

    A machine that is faster or slower than believed looks shifted until its parameters are fitted; they cannot take a
    slip away."""
    case, (free, fixed) = machine.case, believed(machine.case, machine)
    found = check_against_model(machine, (free, fixed))
    if not found or any(p.kind != "shift" for p in found):
        return found
    fitted = fit(machine, case.fit, noise_of(case), free, fixed)
    if fitted is None or astray(fitted):
        return found
    there = [replace(f, centre=fitted.point[f.name]) for f in free]
    return [p for p in check_against_model(machine, (there, fixed)) if p.kind == "shift"]


def check_against_model(machine: Machine, start: tuple[list[Free], dict[str, float]]) -> list[Problem]:
    """Problems of the case's recordings (all fatal) by comparison with the believed model at its believed values."""
    free, fixed = start
    point = fixed | {f.name: f.centre for f in free}
    problems: list[Problem] = []
    for recording in machine.case.fit + machine.case.validate:
        simulated = machine.simulate(point, recording)
        found = _check(machine, point, recording, simulated) if simulated is not None else []
        if found and _answers(machine, point, recording, simulated):
            problems += found
    return problems


def _answers(machine: Machine, point: dict[str, float], recording: Recording, simulated: dict[str, np.ndarray]) -> bool:
    """Whether the inputs move the outputs more than they would move alone: from a start that nobody knows, with any
    sign and phase."""
    if not machine.uncertain_states(recording):
        return True
    held = {s.column: lambda values: np.full_like(values, values[0]) for s in machine.case.inputs}
    alone = machine.simulate(point, recording.redriven("undriven", held))
    if alone is None:
        return True
    return all(np.std(run - alone[c]) > np.std(alone[c]) for c, run in simulated.items())


def _check(
    machine: Machine, point: dict[str, float], recording: Recording, simulated: dict[str, np.ndarray]
) -> list[Problem]:
    outputs = machine.case.outputs
    scales = {s.column: _scale(recording.columns[s.column], simulated[s.column]) for s in outputs}
    factors = {c: factor for c, scale in scales.items() if scale and (factor := _slip(scale)) is not None}
    slips = {c: SCALES[f] for c, f in factors.items() if _mends(machine, point, recording, simulated, c, f)}
    slips = slips or _broken_relation([s.column for s in outputs], recording.columns, simulated)
    begin = float(recording.time[0])
    if slips and len(slips) == len(outputs) and len(outputs) > 1 and len(set(slips.values())) == 1:
        column = machine.case.inputs[0].column
        slip = next(iter(slips.values())).replace("it is", "the input were")
        text = f"all outputs answer as if {slip}: input or outputs slipped"
        return [Problem("scale", recording.name, column, begin, text, True)]
    found = [
        Problem("scale", recording.name, c, begin, f"{text}, against the model driven by {_driven(machine)}", True)
        for c, text in slips.items()
    ]
    found += [p for s in outputs if (p := _still(machine, recording, simulated, s.column)) is not None]
    return found or _shifts(machine, recording, simulated)


def _mends(
    machine: Machine, point: dict[str, float], recording: Recording, simulated: dict[str, np.ndarray], column: str,
    factor: float,
) -> bool:  # fmt: skip
    """Whether an output comes nearer to the model's when it is put right, or an input is: what settles the other way
    than a model that lacks something has the opposite shape too, but not about zero, nor with another drive."""
    measured = recording.columns[column]

    def misses(values: np.ndarray, run: dict[str, np.ndarray] | None) -> float:
        return math.inf if run is None else float(np.nansum((values - run[column]) ** 2))

    def put_right(drive: str) -> dict[str, np.ndarray] | None:
        return machine.simulate(
            point, recording.redriven(f"{drive}/{factor:g}", {drive: lambda values: values / factor})
        )

    before = misses(measured, simulated)
    if misses(measured / factor, simulated) < before:
        return True
    return any(misses(measured, put_right(s.column)) < before for s in machine.case.inputs if not s.counts)


def _driven(machine: Machine) -> str:
    return " and ".join(f"`{s.column}`" for s in machine.case.inputs)


def _scale(measured: np.ndarray, simulated: np.ndarray) -> float | None:
    """Slope of measured over simulated where their shapes agree, or a factor of 1000 in size throughout; else None."""
    good = np.isfinite(measured)
    m, s = measured[good] - measured[good].mean(), simulated[good] - simulated[good].mean()
    power = math.sqrt(float(m @ m) * float(s @ s))
    if power <= 0 or abs(float(m @ s)) / power < SHAPE:
        return _size(m, s)
    return float(m @ s) / float(s @ s)


def _size(measured: np.ndarray, simulated: np.ndarray) -> float | None:
    """1000 or 1/1000 where nearly every window of the recording is that much larger or smaller, else None."""
    pairs = zip(np.array_split(measured, WINDOWS), np.array_split(simulated, WINDOWS), strict=True)
    sizes = np.array([(np.sqrt(np.mean(m**2)), np.sqrt(np.mean(s**2))) for m, s in pairs])
    ratios = sizes[:, 0] / np.maximum(sizes[:, 1], 1e-300)
    for factor in (1000.0, 1e-3):
        if np.mean((ratios > factor / 2) & (ratios < factor * 2)) >= STEADY:
            return factor
    return None


def _broken_relation(
    columns: list[str], measured: dict[str, np.ndarray], simulated: dict[str, np.ndarray]
) -> dict[str, str]:
    """The one slip after whose correction the recording obeys what the simulated outputs obey, such as currents that
    add up to zero; empty where there is no such relation, it is not broken, or no single slip explains that."""
    good = np.all([np.isfinite(measured[c]) for c in columns], axis=0)
    if not good.any():
        return {}
    s, m = (np.array([v[c][good] - v[c][good].mean() for c in columns]) for v in (simulated, measured))
    size = np.sqrt(np.mean(s**2, axis=1))
    if len(columns) < 2 or not np.all(size > 0):
        return {}
    left, singular, _ = np.linalg.svd(s / size[:, None], full_matrices=False)
    if singular[-1] > OBEYED * singular[0]:
        return {}
    terms = (left[:, -1] / size)[:, None] * m
    if _violation(terms) < BROKEN:
        return {}
    found = {}
    for k, column in enumerate(columns):
        for factor, text in SCALES.items():
            corrected = terms.copy()
            corrected[k] /= factor
            if abs(left[k, -1]) > 0.1 and _violation(corrected) < BROKEN:
                found[column] = text
    return found if len(found) == 1 else {}


def _violation(terms: np.ndarray) -> float:
    """RMS of the sum of the terms (k, n) over that of the largest."""
    return float(np.std(terms.sum(axis=0)) / max(np.std(terms, axis=1).max(), 1e-300))


def _still(machine: Machine, recording: Recording, simulated: dict[str, np.ndarray], column: str) -> Problem | None:
    """An output that stands while the model moves it and the others move as the model does: a machine that truly stood
    would show in them."""
    start, length = longest_run(np.diff(recording.columns[column]) == 0)
    window = slice(start, start + length + 1)
    moved = np.ptp(simulated[column][window]) > STANDS * np.ptp(simulated[column]) > 0
    if length < STANDS * len(recording.time) or not moved:
        return None
    others = [s.column for s in machine.case.outputs if s.column != column]
    scales = [_scale(recording.columns[c][window], simulated[c][window]) for c in others]
    if not others or not all(scale and abs(scale - 1.0) < WITHIN for scale in scales):
        return None
    begin, end = recording.time[start], recording.time[start + length]
    text = f"stands for {end - begin:.4g} s where the model moves it and the other signals agree with the model"
    return Problem("constant", recording.name, column, float(begin), text, True)


def _slip(scale: float) -> float | None:
    """The listed factor that a scale comes near to."""
    for factor in SCALES:
        within = FAR if factor < 0 or abs(math.log10(factor)) == 3 else WITHIN
        if abs(math.log(scale / factor) if scale / factor > 0 else math.inf) < within:
            return factor
    return None


def _shifts(machine: Machine, recording: Recording, simulated: dict[str, np.ndarray]) -> list[Problem]:
    lags = {s.column: _lag(recording.columns[s.column], simulated[s.column]) for s in machine.case.outputs}
    found: list[Problem] = []
    if len(machine.case.signals) == 1:  # there is nothing that it could be shifted against
        return found
    together = len(lags) > 1 and np.ptp([lag for lag, _ in lags.values()]) <= 4  # that is the drive, or a delay
    if together and all(lag <= -EARLY and gain > SURE for lag, gain in lags.values()):
        seconds = -max(lag for lag, _ in lags.values()) * recording.interval
        text = f"shifted in time by {seconds:+.4g} s: every output answers before it"
        return [Problem("shift", recording.name, machine.case.inputs[0].column, float(recording.time[0]), text, True)]
    for column, (lag, gain) in lags.items():
        late, early = lag >= LATE and gain > 0.8, lag <= -EARLY and gain > (0.8 if lag <= -LATE else 0.97)
        others = [other for c, (other, found) in lags.items() if c != column and found > ALIKE]
        slower, faster = any(other > lag - LATE for other in others), any(other < lag + EARLY for other in others)
        if (late and slower) or (early and faster):  # a machine that is not as fast as believed shifts them all
            continue
        pair = recording.columns[column], simulated[column], lag
        if (late or early) and not together and _agrees(*pair) and not (late and _is_smoothed(*pair)):
            seconds = lag * recording.interval
            text = f"shifted in time by {seconds:+.4g} s against the other signals"
            found.append(Problem("shift", recording.name, column, float(recording.time[0]), text, True))
    return found


def _agrees(measured: np.ndarray, simulated: np.ndarray, lag: int) -> bool:
    """Whether the shapes agree when `measured` is moved forward by `lag` samples: what is out of step is not late."""
    moved, still = (measured[lag:], simulated[:-lag]) if lag > 0 else (measured[:lag], simulated[-lag:])
    return bool(np.corrcoef(filled(moved), still)[0, 1] > SHAPE)


def _is_smoothed(measured: np.ndarray, simulated: np.ndarray, lag: int) -> bool:
    """Whether a first-order lag of its sensor does better than that `measured` is `lag` samples late."""
    from scipy.signal import lfilter  # a second to import, and seldom needed

    span = _spans(measured)[-1]
    changes, model = filled(measured)[span:] - filled(measured)[:-span], simulated[span:] - simulated[:-span]
    pole = [np.exp(-1.0 / (share * lag)) for share in TIME_CONSTANTS]
    smoothed = [lfilter([1.0 - p], [1.0, -p], model, zi=[p * model[0]])[0] for p in pole]
    left = min(float(np.sum((changes - s)[lag:] ** 2)) for s in smoothed)
    return left < float(np.sum((changes[lag:] - model[:-lag]) ** 2))


def _lag(measured: np.ndarray, simulated: np.ndarray) -> tuple[int, float]:
    """(lag, gain) of the span of changes in which a shift shows most."""
    return max((_lag_of_changes(measured, simulated, span) for span in _spans(measured)), key=lambda found: found[1])


def _spans(measured: np.ndarray) -> list[int]:
    """Those over which there are at least as many changes as samples in one."""
    return [span for span in CHANGES if len(measured) >= 2 * span]


def _lag_of_changes(measured: np.ndarray, simulated: np.ndarray, span: int, reach: int = 400) -> tuple[int, float]:
    """(samples by which `measured` is late, share that moving it takes away of the squared difference from the
    simulation on a scale of its own: what swings further than the model and dies out is not what came earlier).

    Changes over `span` samples are compared, not values: a wrong parameter lets an angle drift, which is no shift.
    """
    measured, simulated = (v[span:] - v[:-span] for v in (filled(measured), simulated))
    outlying = np.abs(measured) > 8 * np.quantile(np.abs(measured), 0.99)
    measured = filled(np.where(outlying, np.nan, measured))
    reach = min(reach, len(measured) // 4) // 2 * 2  # so that no shift is among those tried
    inner = slice(reach, len(measured) - reach)
    here, there = measured[inner], simulated[inner]
    base = float(here @ here - (here @ there) ** 2 / max(there @ there, 1e-300))
    lags = np.arange(-reach, reach + 1, 2)
    errors = np.array([np.sum((measured[inner.start + k : inner.stop + k] - simulated[inner]) ** 2) for k in lags])
    good = np.flatnonzero(errors <= errors.min() + AS_GOOD * max(base - errors.min(), 0.0))
    best = int(good[np.argmin(np.abs(lags[good]))])  # of a periodic signal, not a period later
    while (lower := max(best - 1, 0) + int(np.argmin(errors[max(best - 1, 0) : best + 2]))) != best:
        best = lower
    return int(lags[best]), 1.0 - errors[best] / base if base > 0 else 0.0


def strict_elsewhere(machine: Machine) -> list[Problem]:
    """What would be an error of the believed model elsewhere, and hinders nothing here: its units, components of it
    that are not balanced by themselves."""
    found = [w for w in machine.compiled.report.warnings if w.code[0] in "UR" and w.span is not None]
    said = "{} (it hinders nothing here; lacuna check says what to write)"
    pairs = [(f"{Path(w.span.file).name}, line {w.span.line}", w.message.partition("\n")[0]) for w in found]
    return [Problem("model", place, "", None, said.format(text), False) for place, text in pairs]
