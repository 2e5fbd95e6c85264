"""A prepared map as an assessment uses it: the severity table, and what it does not cover."""

from __future__ import annotations

from pathlib import Path
from string import ascii_uppercase

import numpy as np
from scipy.stats import chi2

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.files import load_arrays
from lacuna.analysis.recording.recordings import Recording, Refusal, check_phases
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.preparation import MODEL_FILE, START_RATE, TABLE_FILE, fingerprint
from lacuna.analysis.severity.severity_table import Estimate, SeverityTable
from lacuna.analysis.spectra.chain import Features, signature

FEATURES = ("RMS", "fundamental", "direct component", "second harmonic", "third harmonic")  # signature.hpp


class Prepared:
    """The map in `folder`. Raises AnalysisError where it was not prepared, or drawn anew since."""

    def __init__(self, folder: Path):
        self.settings = load_settings(folder / "settings.toml")
        self.table = SeverityTable(folder / TABLE_FILE)
        model = load_arrays(folder / MODEL_FILE, ("map", "starts", "mean", "covariance"))
        if str(model["map"]) != fingerprint(folder):
            raise AnalysisError(f"{folder}: the map was drawn anew since it was prepared; prepare it again")
        self._starts, self._mean, self._covariance = model["starts"], model["mean"], model["covariance"]
        self.key = (folder / TABLE_FILE).read_bytes()  # changes with everything that may change an estimate
        freedom = self._mean.shape[-1] - 1
        self._doubtful = float(chi2.isf(self.settings.table("assessment")["doubtful"], freedom))

    def check_start(self, recording: Recording) -> None:
        """Raises Refusal where phases are swapped or the first instants are not those of this test."""
        check_phases(recording, self._starts, START_RATE)

    def check_estimate(self, features: Features, estimate: Estimate | None) -> tuple[str, ...]:
        """Warnings. Raises Refusal where no severity of the map explains the features."""
        if estimate is None:
            raise Refusal("no peak in the spectrum of a current: the motor did not turn as in this test")
        if not estimate.covered:
            raise Refusal(
                f"no severity of the map explains this recording (misfit {estimate.misfit:.0f}; "
                f"{self._oddest(features, estimate)}): another actuator, another command, or a fault that the map "
                "does not know"
            )
        if estimate.misfit > self._doubtful:
            return (f"unlike most tests of this actuator: {self._oddest(features, estimate)}; repeat the test",)
        return ()

    def _oddest(self, features: Features, estimate: Estimate) -> str:
        """The feature farthest from the map at the estimated severity, in its own standard deviations."""
        row = int(np.abs(np.array(self.settings.fault.severities) - estimate.severity).argmin())
        apart = signature(features) - self._mean[:, row]
        distances = [d @ np.linalg.solve(c, d) for d, c in zip(apart, self._covariance[:, row], strict=True)]
        best = int(np.argmin(distances))
        deviations = apart[best] / np.sqrt(np.diagonal(self._covariance[best, row]))
        k = int(np.abs(deviations).argmax())
        channel, feature = divmod(k, len(FEATURES))
        frequency = k == len(deviations) - 1
        name = "frequency" if frequency else f"{FEATURES[feature]} of phase {ascii_uppercase[channel]}"
        side = "above" if deviations[k] > 0 else "below"
        return f"most of all its {name}, {abs(deviations[k]):.1f} standard deviations {side} the map"
