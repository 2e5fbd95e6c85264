"""The experiment that decides: of all candidate waveforms the one that sets the first explanation and its rivals
farthest apart, the wrong one refitted, whichever of the two is wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.experiment.limits import Range, ranges
from lacuna.discovery.experiment.separation import (
    Outputs,
    Rival,
    distance,
    refitted_distance,
    spread,
)
from lacuna.discovery.experiment.waveforms import Waveform, as_recording, waveforms
from lacuna.discovery.fit.solver.side_by_side import side_by_side
from lacuna.discovery.naming.comparison import COLOUR

CLOSER = 4  # candidates whose rivals are refitted: those that differ most before
DECIDES = 5.0  # sigmas from which an experiment decides: a likelihood ratio of 25 in deviance, above every threshold
SEEDS = (1, 2)  # of the waveform to fit, and of the one that judges

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Proposal:
    """A waveform to be recorded, a second of its kind that judges, and what is expected of the first."""

    rivals: list[Rival]  # the first explanation first
    waveform: Waveform
    judging: Waveform
    ranges: dict[str, Range]
    predictions: list[Outputs]  # of each rival, SI
    sigma: dict[str, float]  # of each output, SI
    column: str  # the output that differs most
    apart: dict[str, float]  # of each rival from the first: sigmas that are left when the wrong one has been refitted

    @property
    def sigmas(self) -> float:
        """From the rival that is hardest to tell."""
        return min(self.apart.values())

    @property
    def hardest(self) -> int:
        """The number of that rival."""
        return 1 + min(range(len(self.apart)), key=list(self.apart.values()).__getitem__)

    @property
    def decides(self) -> bool:
        return self.sigmas >= DECIDES

    def sentence(self) -> str:
        first, rival = self.rivals[0].label, self.rivals[self.hardest].label
        span = ", ".join(f"{c} from {v.min():.3g} to {v.max():.3g}" for c, v in self.waveform.columns.items())
        if not self.decides:
            return (
                f"no waveform of the inputs within their limits would tell {first} from {rival}: the best, "
                f"{self.waveform.text}, leaves them {self.sigmas:.2g} sigma apart; widen the limits or record a "
                "further quantity"
            )
        return (
            f"record {self.waveform.text} ({span}): {first} and {rival} then are {self.sigmas:.3g} sigma apart, most "
            f"of it in {self.column}, the wrong one refitted"
        )


def propose(case: Case, rivals: Sequence[Rival], progress: Progress = lambda text: None) -> Proposal | None:
    """The experiment that tells the first of these explanations from the others; None where none can be simulated."""
    if len(rivals) < 2 or not case.inputs:
        return None
    progress("looking for the experiment that decides")
    of = ranges(case)
    candidates = waveforms(case, of, SEEDS[0])
    sigma = spread(rivals[0].fit, {c: min(t, COLOUR) for c, t in rivals[0].fit.correlation().items()})
    tried = side_by_side(lambda k: _predictions(case, rivals, candidates[k], k), range(len(candidates)))
    able = [(w, p) for w, p in zip(candidates, tried, strict=True) if p is not None]
    able.sort(key=lambda item: -_before(item[1], sigma))
    found = [_proposal(case, rivals, w, p, of, sigma) for w, p in able[:CLOSER]]
    return max(found, key=_worth, default=None)


def _worth(proposal: Proposal) -> tuple[float, float]:
    """Rivals that are told, as far as that decides; of equals, how well the hardest one is."""
    return sum(min(s, DECIDES) for s in proposal.apart.values()), proposal.sigmas


def _predictions(case: Case, rivals: Sequence[Rival], waveform: Waveform, number: int) -> list[Outputs] | None:
    recording = as_recording(case, waveform, f"candidate {number}")
    found = [r.predicted(recording) for r in rivals]
    return None if any(p is None for p in found) else found


def _before(predictions: list[Outputs], sigma: Mapping[str, float]) -> float:
    """Of the rival that is nearest to the first, nothing refitted."""
    return min(float(np.hypot.reduce(list(distance(predictions[0], p, sigma).values()))) for p in predictions[1:])


def _proposal(
    case: Case, rivals: Sequence[Rival], waveform: Waveform, predictions: list[Outputs], of: dict[str, Range],
    sigma: dict[str, float],
) -> Proposal:  # fmt: skip
    recording = as_recording(case, waveform, f"refitted to {waveform.text}")
    apart = {}
    for rival, predicted in zip(rivals[1:], predictions[1:], strict=True):
        ways = ((predictions[0], rival), (predicted, rivals[0]))
        apart[rival.label] = min(refitted_distance(truth, wrong, recording, sigma) for truth, wrong in ways)
    nearest = 1 + int(np.argmin(list(apart.values())))
    size = distance(predictions[0], predictions[nearest], sigma)
    judging = next((w for w in waveforms(case, of, SEEDS[1]) if w.text == waveform.text), waveform)
    return Proposal(
        list(rivals), waveform, judging, of, predictions, sigma, max(size, key=lambda c: size[c]), apart
    )  # fmt: skip
