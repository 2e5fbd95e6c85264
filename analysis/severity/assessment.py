"""From a recorded pre-flight test to a severity: with its interval, its band, and a sentence for the technician."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lacuna.analysis.recording.recordings import Recording, read_recording
from lacuna.analysis.settings import Band, Settings
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.severity_table import Estimate
from lacuna.analysis.spectra.chain import Chain, Features
from lacuna.drawn import save
from lacuna.written import whole_files

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Assessment:
    recording: str
    estimate: Estimate
    band: Band
    sentence: str
    warnings: tuple[str, ...]
    features: dict[str, Any]


def assess(
    recording: Path | str,
    map_folder: Path | str,
    out: Path | str | None = None,
    *,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
) -> Assessment:
    """Severity of one recorded test by the map in `map_folder`; with `out`, also its files there.

    `columns` name the phase currents in the map's order. `unfiltered`: they were recorded before the filters that the
    map's currents passed, which are then applied here. Raises Refusal (an AnalysisError) where the map does not cover
    the recording, with the reason; then nothing is written.
    """
    folder = Path(map_folder)
    prepared = Prepared(folder)
    settings = prepared.settings
    found = filtered(read_recording(recording, settings, columns), settings, unfiltered)
    prepared.check_start(found)
    features = chain_at(settings, found.sampling_rate).analyse(found.currents)
    estimate = prepared.table.estimate(features)
    warnings = (*found.notes, *prepared.check_estimate(features, estimate))
    band = settings.bands[estimate.band]
    text = sentence(settings, estimate, band)
    done = Assessment(str(recording), estimate, band, text, warnings, features_of(features))
    if out is not None:
        _write(done, settings, folder, features, Path(out))
    return done


def chain_at(settings: Settings, sampling_rate: float) -> Chain:
    """The settings' chain at another sampling rate: sections are shares of the record, so only the rate changes."""
    return Chain(replace(settings, sampling_rate=sampling_rate))


def filtered(recording: Recording, settings: Settings, unfiltered: bool) -> Recording:
    """Behind the map's current filter, which is applied where the recording is `unfiltered`."""
    if not unfiltered:
        return recording
    rate = recording.sampling_rate
    return replace(recording, currents=low_pass(recording.currents, rate, settings))


def features_of(features: Features) -> dict[str, Any]:
    """What assessment.json says of the recording itself, SI units."""
    return {
        "rms": features.rms.tolist(),
        "rms_mean": features.rms_mean,
        "peak_hz": features.peak_hz.tolist(),
        "frequency": features.frequency.tolist(),
        "harmonic": features.harmonic.tolist(),
    }


def low_pass(currents: np.ndarray, sampling_rate: float, settings: Settings) -> np.ndarray:
    """The map's current filter, equal first-order sections in cascade, from rest (bilinear, matched at the corner)."""
    from scipy.signal import bilinear, lfilter

    corner = 2 * np.pi * settings.table("filter")["corner"]
    warped = 2 * sampling_rate * np.tan(corner / (2 * sampling_rate))
    b, a = bilinear([warped], [1, warped], sampling_rate)
    for _ in range(settings.table("filter")["sections"]):
        currents = lfilter(b, a, currents, axis=1)
    return currents


def sentence(settings: Settings, estimate, band: Band) -> str:
    """What a technician needs to know; `estimate` has severity, low and high."""
    fault = settings.fault
    interval = f"{fault.shown(estimate.low):.1f} to {fault.shown(estimate.high):.1f} {fault.unit}"
    value = f"{fault.shown(estimate.severity):.1f} {fault.unit}"
    name = fault.name[0].upper() + fault.name[1:]
    reading = f"{name} is {value} (95 % sure: {interval})"
    return f"{reading}: {band.name}, {band.mode.lower()} mode. {band.action}".strip()


def _write(done: Assessment, settings: Settings, folder: Path, features: Features, out: Path) -> None:
    from lacuna.analysis.report.figures.assessment import CAPTION, draw
    from lacuna.analysis.report.figures.style import in_style

    content = asdict(done) | {"map": str(folder), "model": settings.model}
    with whole_files(out) as scratch:
        (scratch / "assessment.json").write_text(
            json.dumps(content, indent=2, ensure_ascii=False) + "\n", encoding="utf-8"
        )
        with in_style():
            figure = draw(settings, folder / "map.csv", features, done.estimate)
        write_drawn(done, figure, scratch, [folder / "settings.toml", folder / "map.csv"], CAPTION)


def write_drawn(done: Any, figure: Figure, out: Path, inputs: list[Path], caption: str) -> None:
    """The figure of an assessment, and the page that shows it; `inputs` decided it, beside the recording."""
    from lacuna.analysis.report.assessment import report_html
    from lacuna.analysis.report.figures.data import drawn_data
    from lacuna.analysis.report.figures.style import in_style

    with in_style():
        for kind in ("svg", "png"):
            save(figure, out / f"assessment.{kind}", kind)
    svg = (out / "assessment.svg").read_text(encoding="utf-8")
    page = report_html(done, svg, drawn_data(figure), inputs, caption)
    (out / "report.html").write_text(page, encoding="utf-8")
