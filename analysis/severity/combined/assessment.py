"""From a recorded test to the severities of two faults."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
import json
from pathlib import Path
from typing import Any

from lacuna.analysis.recording.recordings import Refusal, check_phases, read_recording
from lacuna.analysis.settings import Band
from lacuna.analysis.severity.assessment import chain_at, features_of, filtered, sentence, write_drawn
from lacuna.analysis.severity.combined.estimate import JointEstimate, JointEstimator
from lacuna.analysis.severity.combined.grid import load_grid
from lacuna.analysis.severity.preparation import START_RATE
from lacuna.analysis.spectra.chain import signature
from lacuna.written import whole_files


@dataclass(frozen=True)
class JointAssessment:
    recording: str
    estimate: JointEstimate
    band: Band
    sentence: str
    warnings: tuple[str, ...]
    features: dict[str, Any]


def assess_both(
    recording: Path | str,
    map_folder: Path | str,
    out: Path | str | None = None,
    *,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
) -> JointAssessment:
    """As `severity.assessment.assess`, with a map over two faults. Raises Refusal where it does not cover the test."""
    folder = Path(map_folder)
    grid = load_grid(folder)
    settings, other = grid.settings, grid.other
    found = filtered(read_recording(recording, settings, columns), settings, unfiltered)
    check_phases(found, grid.starts, START_RATE)
    features = chain_at(settings, found.sampling_rate).analyse(found.currents)
    vector = signature(features)
    if vector is None:
        raise Refusal("no peak in the spectrum of a current: the motor did not turn as in this test")
    estimator = JointEstimator(grid)
    estimate = estimator.estimate(vector)
    if not estimate.covered:
        raise Refusal(
            f"no severities of {settings.fault.name} and {other.name} together explain this recording (misfit "
            f"{estimate.misfit:.0f}): another actuator, another command, or a fault that the map does not know"
        )
    band, second = settings.band_of(estimate.first.severity), estimate.second
    low, high = other.shown(second.low), other.shown(second.high)
    also = f"{other.name} {other.shown(second.severity):.2f} {other.unit} (95 % sure: {low:.2f} to {high:.2f})"
    text = f"{sentence(settings, estimate.first, band)} Together with {also}."
    unread = () if second.readable else (f"{other.name} cannot be read from this recording",)
    warnings = (*found.notes, *unread)
    done = JointAssessment(str(recording), estimate, band, text, warnings, features_of(features))
    if out is not None:
        _write(done, estimator, folder, Path(out))
    return done


def _write(done: JointAssessment, estimator: JointEstimator, folder: Path, out: Path) -> None:
    from lacuna.analysis.report.figures.style import in_style
    from lacuna.analysis.severity.combined.figures import CAPTION, draw_estimate

    content = asdict(done) | {"map": str(folder), "model": estimator.grid.settings.model}
    del content["estimate"]["density"]
    content["faults"] = [estimator.grid.settings.fault.name, estimator.grid.other.name]
    with whole_files(out) as scratch:
        text = json.dumps(content, indent=2, ensure_ascii=False)
        (scratch / "assessment.json").write_text(text + "\n", encoding="utf-8")
        with in_style():
            figure = draw_estimate(estimator, done.estimate)
        write_drawn(done, figure, scratch, [folder / "settings.toml"], CAPTION)
