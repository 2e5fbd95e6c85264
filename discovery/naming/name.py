"""Naming: hypotheses as amended models, fitted by output error, ranked by evidence.

Every hypothesis is screened to first order; the promising ones are fitted for a few steps, the better half goes on
(successive halving), the last few are polished. They are compared by the deviance of the data with a price for each
parameter (Schwarz 1978), samples discounted for the colour of the best residual.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.trace import left, note_screened
from lacuna.discovery.fit.evidence import is_noise, nearly_noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.fit.solver.time_limit import TimeUp, check
from lacuna.discovery.naming.candidate_fit import fit_candidate, own_machine, shared
from lacuna.discovery.naming.comparison import (
    TIE,
    Progress,
    Ranked,
    best_correlation,
    beyond_zeros,
    confidences,
    cross_validated,
    note_losers,
    ranked_beside_zeros,
    score,
)
from lacuna.discovery.naming.judge import Judgement
from lacuna.discovery.naming.race import (
    HALF,
    ROUNDS,
    akin,
    at_first,
    beside_whole,
    best_starts,
    first_round,
    leading,
    outdone,
    relatives,
    run_round,
    stands_out,
    still_in,
    whole_of,
)
from lacuna.discovery.naming.restarts import begin_again
from lacuna.discovery.naming.screen import Candidate, Screen, prepare, telling_recordings
from lacuna.runtime import SimulationError

AS_LIKELY = 0.5  # of a finding's confidence, that rivals at other places have together where the data cannot tell
SEVERAL_STARTS = 1  # rounds after which only the best start of each hypothesis goes on


@dataclass
class Naming:
    """What one round of naming found, best first; what was screened out with the share it could have explained; and
    what could not be tried, with the reason."""

    ranked: list[Ranked]
    screened: list[tuple[str, float]]
    failures: list[tuple[str, str]] = field(default_factory=list)
    correlation: dict[str, float] = field(default_factory=dict)
    unneeded: list[str] = field(default_factory=list)  # what was not looked at, since the best leaves noise

    @property
    def best(self) -> Ranked | None:
        return self.ranked[0] if self.ranked else None

    @property
    def simplest(self) -> Ranked | None:
        """The best; or, of the laws that it contains, the best that the data does not tell from it."""
        best = self.best
        if best is None:
            return None
        contained = [r for r in self.ranked if best.attachment.contains(r.attachment) and r.score < best.score + TIE]
        return contained[0] if contained else best

    def of(self, identity: tuple[str, str]) -> Ranked | None:
        """The best hypothesis of this physics at this place."""
        return next((r for r in self.ranked if r.identity == identity), None)

    def rivals(self, ranked: Ranked) -> list[Ranked]:
        """Hypotheses of other physics or another place that the data does not tell from this one."""
        return [r for r in self.ranked if r.identity != ranked.identity and r.score - ranked.score < TIE]


@dataclass
class Finding:
    """An accepted effect: the round of naming that chose it, and the judgements without and with it."""

    ranked: Ranked
    naming: Naming
    before: Judgement
    after: Judgement
    instrument: str = ""  # the column of an input, of whose constant error it is not told
    moved: str = ""  # the column of an input that moves as the one does of which it is a law

    @property
    def elsewhere(self) -> list[Ranked]:
        """Rivals at other places: a tie at one place leaves no doubt that physics is missing there."""
        ranked = self.ranked
        return [r for r in self.naming.rivals(ranked) if r.identity[1] != ranked.identity[1]]

    @property
    def tied(self) -> bool:
        """Whether the data cannot tell at which place it is."""
        return sum(r.confidence for r in self.elsewhere) > AS_LIKELY * self.ranked.confidence


def screen_all(
    case: Case, amendment: Amendment, attachments: list[Attachment], base: Fit, progress: Progress
) -> tuple[list[Candidate], list[tuple[str, str]]]:
    """Candidates (one for each start), most promising first; and the hypotheses that do not fit this model."""
    screen = Screen(base, telling_recordings(base), coarsely=True)
    together = shared(case, amendment, attachments, base)

    def one(attachment: Attachment) -> tuple[list[Candidate], str]:
        check()
        machine, why = together.get(attachment.label), ""
        if machine is None:
            machine, why = own_machine(case, amendment, attachment, base)
        if machine is None:
            return [], why
        try:
            found = prepare(screen, attachment, machine)
        except SimulationError as error:
            return [], str(error)
        progress(f"screened {attachment.label}: " + (f"{found[0].predicted:.1%}" if found else "no use"))
        return [replace(c, machine=None) for c in found] if attachment.label in together else found, ""

    looked_at = list(zip(attachments, in_threads(one, attachments), strict=True))
    failures = [(attachment.label, why) for attachment, (_, why) in looked_at if why]
    for attachment, (found, why) in looked_at:
        if why or not found:
            left(attachment.label, "model" if why else "screen", why or "runs with none of it, or explains nothing new")
    return sorted((c for _, (found, _) in looked_at for c in found), key=lambda c: -c.predicted), failures


def rank(
    case: Case, amendment: Amendment, attachments: list[Attachment], base: Fit, *,
    final: bool = True, progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Screen, fit and rank hypotheses on top of `base`, the fit of the amendment so far; `final`: see `Contest`."""
    return Contest(case, base, amendment, attachments, progress).naming(final)


def compete(
    case: Case, candidates: list[Candidate], base: Fit, *, final: bool = True, progress: Progress = lambda text: None,
) -> Naming:  # fmt: skip
    """Fit and rank candidates (most promising first) on top of `base`; `final`: see `Contest`."""
    contest = Contest(case, base, base.machine.amendment, [], progress)
    contest.candidates = candidates
    return contest.naming(final)


class Contest:
    """Hypotheses that compete on top of `base`, the fit of `amendment`.

    The most promising go first: where one of them leaves noise, others can but tie with it, and those that promise much
    less do not. Nor are errors of sensors and richer forms of dry friction then looked at, but for those of its kin.
    """

    def __init__(
        self, case: Case, base: Fit, amendment: Amendment, attachments: list[Attachment], progress: Progress
    ) -> None:  # fmt: skip
        self.case, self.base, self.amendment, self.progress = case, base, amendment, progress
        self.screening, self.waiting = at_first(attachments)
        self.candidates: list[Candidate] = []
        self.failures: list[tuple[str, str]] = []
        self.fitted: dict[str, Candidate] = {}
        self._tried: set[str] = set()

    def best(self) -> Candidate | None:
        return _ranked(self.fitted, self.base)[0][0].candidate if self.fitted else None

    def lead(self) -> None:
        """Screen, and fit the most promising few; again, where that is done, nothing."""
        while True:
            if self.screening:
                found, failures = screen_all(self.case, self.amendment, self.screening, self.base, self.progress)
                self.candidates = sorted([*self.candidates, *found], key=lambda c: -c.predicted)
                self.failures += failures
            if self.waiting and not self._won() and not stands_out(self.candidates):
                self.screening, self.waiting = self.waiting, []
                continue
            self._fit(self._untried(leading(first_round(self.candidates))[0]))
            best, won = self.best(), self._won()
            self.screening = [a for a in self.waiting if not won or akin(a, best.attachment)]
            self.waiting = [a for a in self.waiting if won and not akin(a, best.attachment)]
            if not self.screening:
                return

    def naming(self, final: bool = True) -> Naming:
        """What all of them say.

        A `final` ranking is cross-validated; not one of fits that are held, which is decided when they are released.
        Where the time is up, those that have been fitted are ranked if the best leaves noise; else TimeUp is raised.
        """
        try:
            self.lead()
            self._follow()
            ranked, correlation = _ranked(self.fitted, self.base) if self.fitted else ([], {})
            if final and ranked:
                ranked = cross_validated(self.base, ranked, correlation, self.progress)
        except TimeUp:
            if not any(nearly_noise(c.fit) for c in self.fitted.values()):
                raise
            ranked, correlation = _ranked(self.fitted, self.base)
        if ranked := beyond_zeros(ranked, self.base, correlation):
            confidences(ranked)
        screened = [(c.attachment.label, c.predicted) for c in best_starts(self.candidates)]
        note_screened(screened, [*self.fitted, *(label for label, _ in self.failures)])
        note_losers(ranked)
        for attachment in self.waiting:
            left(attachment.label, "screen", "waits for a simpler law, which leaves noise")
        return Naming(ranked, screened, self.failures, correlation, [a.label for a in self.waiting])

    def _won(self) -> bool:
        """Whether the best leaves noise: what still waits is not needed."""
        best = self.best()
        return best is not None and is_noise(best.fit)

    def _untried(self, pool: list[Candidate]) -> list[Candidate]:
        return [c for c in pool if c.attachment.label not in self._tried]

    def _fit(self, pool: list[Candidate]) -> None:
        """Fit a pool, each hypothesis in a model of its own."""
        self._tried |= {c.attachment.label for c in pool}
        machines = {c.attachment.label: c.machine for c in pool}
        for candidate in best_starts([c for c in pool if c.machine is None]):
            own, _ = own_machine(self.case, self.amendment, candidate.attachment, self.base)
            machines[candidate.attachment.label] = own
        pool = [replace(c, machine=machines[c.attachment.label]) for c in pool]
        _halve(self.case, self.base, [c for c in pool if c.machine is not None], self.fitted, self.progress)
        failed = [label for label in machines if label not in self.fitted]
        self.failures += [(label, "no simulation succeeded from its start values") for label in failed]
        for label in failed:
            left(label, "race", "no simulation succeeded from its start values")

    def _follow(self) -> None:
        """Fit what may do as well as the leaders, and what is related to the best."""
        first = first_round(self.candidates)
        best = self.best()
        least = HALF * first[0].predicted if best is not None and nearly_noise(best.fit) else -float("inf")
        self._fit(self._untried([c for c in first if c.predicted > least]))
        if self.fitted:
            self._fit(outdone(self.candidates, self.fitted))
            self._fit(relatives(self.candidates, self.fitted, self.best()))
            self._step_whole()
            begin_again(self.case, self.base, list(self.fitted.values()), self.progress)

    def _step_whole(self) -> None:
        """The best hypothesis with other whole numbers, as far as each step fits better."""
        tried: list[dict[str, float]] = []
        while not is_noise((best := self.best()).fit):
            tried.append(whole_of(best))
            near = [c for c in beside_whole(best) if whole_of(c) not in tried]
            found = run_round(near, partial(fit_candidate, self.case, self.base, *ROUNDS[-1][:2], self.progress))
            better = min(found, key=lambda c: c.fit.deviance(), default=best)
            if better.fit.deviance() >= best.fit.deviance():
                return
            tried += [whole_of(c) for c in near if c is not better]
            self.fitted[best.attachment.label] = better


def _ranked(fitted: dict[str, Candidate], base: Fit) -> tuple[list[Ranked], dict[str, float]]:
    """What was fitted, best first, and the samples of each signal that count as one."""
    correlation = best_correlation(list(fitted.values()))
    ranked = [Ranked(c, c.fit, score(c, base, correlation)) for c in fitted.values()]
    return ranked_beside_zeros(ranked, base, correlation), correlation


def _halve(
    case: Case, base: Fit, pool: list[Candidate], fitted: dict[str, Candidate], progress: Progress
) -> None:  # fmt: skip
    """Fit a pool by successive halving; the best start of each hypothesis ends in `fitted`."""
    before: dict[int, float] = {}
    for k, (stages, iterations, keep) in enumerate(ROUNDS):
        pool = (pool if k <= SEVERAL_STARTS else best_starts(pool))[:keep]
        pool = run_round(pool, partial(fit_candidate, case, base, stages, iterations, progress))
        if not pool:
            return
        correlation = best_correlation([*fitted.values(), *pool])
        scores = {id(c): score(c, base, correlation) for c in pool}
        pool.sort(key=lambda c: scores[id(c)])
        for c in best_starts(pool):
            progress(f"fitted {c.attachment.label}: {scores[id(c)]:.1f}")
        fitted |= {c.attachment.label: c for c in best_starts(pool)}
        leader = min(fitted.values(), key=lambda c: score(c, base, correlation))
        pool = still_in(pool, scores, before, leader.fit, score(leader, base, correlation), base, correlation)
        before = scores
