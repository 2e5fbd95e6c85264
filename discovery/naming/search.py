"""The search for what is missing: effects are added one at a time, earlier ones reconsidered given the later ones.

Forward selection alone goes wrong where two effects are hidden: the first one found stands for both as well as it can
(play and dry friction together look like a Stribeck curve). So after each further effect every earlier one is taken
out, named anew given the others, and exchanged or dropped where that is better.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.catalogue import Effect
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.trace import left, looking
from lacuna.discovery.efforts.instruments import only_instruments
from lacuna.discovery.fit.evidence import astray, holds, nearly_noise, pays, settled
from lacuna.discovery.fit.fit import Fit, carried
from lacuna.discovery.fit.lead import Lead
from lacuna.discovery.fit.machine import try_machine
from lacuna.discovery.fit.objective import STAGES
from lacuna.discovery.naming.candidate_fit import without
from lacuna.discovery.naming.comparison import CLOSE, MIN_GAIN, TIE, Progress, Ranked, confidences, needed, price, score
from lacuna.discovery.naming.judge import Judgement, try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Contest, Finding, Naming, compete, screen_all
from lacuna.discovery.naming.screen import Candidate

MAX_FINDINGS = 3  # more are beyond what a few recordings can tell apart
CARRIED = 3  # times at most, that an accepted fit is begun again from where it stopped
ALIKE = 0.01  # share of the best gain, within which rivals are released with the best one,
RELEASED = 3  # at most so many of them
UNTOLD = "fits better but does not tell recordings left out"
RECONSIDERED = 4  # rivals of an earlier finding that are tried again


@dataclass
class Search:
    """How far the search has come: the amended model, its fit and judgement, what was found and what was tried."""

    case: Case
    effects: list[Effect]
    lead: Lead
    floor: dict[str, float]  # NRMSE that noise alone gives each output of the fit recordings
    amendment: Amendment
    fit: Fit
    judgement: Judgement
    findings: list[Finding] = field(default_factory=list)
    namings: list[Naming] = field(default_factory=list)
    reason: str = ""
    exhausted: bool = False
    restarts: bool = False  # whether a search that has lost its way is begun anew
    left: Contest | None = None  # where its most promising hypotheses had lost their way
    blameless: frozenset[str] = frozenset()  # variables whose sensors are none of the first findings
    near: frozenset[str] | None = None  # locations at which effects are looked for; None: at all

    def run(self, progress: Progress, most: int = MAX_FINDINGS) -> None:
        """Add findings, `most` of them, until what is left is noise, or nothing more pays."""
        while len(self.findings) < most and not self.exhausted and not self.settled():
            so_far = " and ".join(finding.ranked.attachment.label for finding in self.findings)
            known = f"; so far {so_far}" if so_far else ""
            looking(text := f"missing physics, round {len(self.findings) + 1}{known}")
            progress(f"looking for {text}")
            if not self.add(progress):
                self.exhausted = True
                return
            for k in range(len(self.findings) - 1):
                self._reconsider(k, progress)
            self.drop_needless(progress)

    def settled(self) -> bool:
        """Whether nothing is left to look for."""
        if not holds(left_out(self.case, self.fit), self.floor, self.fit.noise):
            return False
        if settled(self.fit, rough=not self.lead.direct):
            return True
        told = bool(self.findings) or nearly_noise(self.fit)  # by what was found, or nothing
        return told and self.lead.direct and only_instruments(self.case, self.amendment, self.fit)

    def lost(self) -> bool:
        """Whether fits that nothing has led leave so much that the search has to begin anew."""
        return self.restarts and self.lead.direct and (self.left is not None or astray(self.fit))

    def resume(self, progress: Progress) -> None:
        """Go on with a contest that was left."""
        self.exhausted = False
        self.run(progress, most=1)

    def add(self, progress: Progress) -> bool:
        contest = self.left or self._begun(progress)
        if self.left is None and self._astray(contest):
            self.left = contest
            return False
        self.left = None
        naming = contest.naming(final=self.lead.direct)
        self.namings.append(naming)
        best = naming.simplest
        if best is None or best.score > -MIN_GAIN:
            return False
        best, polished = self._best_released(best, naming, progress)
        if self._accept(best, polished, naming, progress):
            return True
        simpler = [r for r in naming.ranked if best.attachment.contains(r.attachment) and r.score < -MIN_GAIN]
        return any(self._accept(r, self.polished(r, self.fit), naming, progress) for r in simpler)

    def _begun(self, progress: Progress) -> Contest:
        """The contest of all hypotheses, its most promising ones fitted."""
        every = enumerate_attachments(self.case, self.amendment.structure, self.effects, self.amendment)
        blamed = [a for a in every if self.findings or a.variable not in self.blameless]
        attachments = [a for a in blamed if self.near is None or a.location in self.near]
        held = self.lead.hold(self.fit)
        contest = Contest(held.machine.case, held, self.amendment, attachments, progress)
        contest.lead()
        return contest

    def _astray(self, contest: Contest) -> bool:
        """Whether its most promising hypotheses lose their way, and the search may begin anew."""
        best = contest.best()
        return self.restarts and self.lead.direct and best is not None and astray(best.fit)

    def _accept(self, ranked: Ranked, polished: Fit | None, naming: Naming, progress: Progress) -> bool:
        """Go on with a hypothesis if it pays on recordings left out, alone or with a second one."""
        if polished is None:
            return False
        self.reason = f"{ranked.attachment.label} {UNTOLD}"
        after = try_judge(polished.machine, polished.point)
        if after is None:
            return False
        trial = replace(self, findings=[*self.findings, Finding(ranked, naming, self.judgement, after)])
        ranked.fit = polished
        trial.take([*self.amendment.attachments, ranked.attachment], polished, after)
        if not self._better(trial) and not (trial._add_another(progress) and self._better(trial)):
            left(ranked.attachment.label, "unseen", UNTOLD, cost=ranked.score)
            return False
        self.findings[:] = trial.findings
        self.take(trial.amendment.attachments, trial.fit, trial.judgement)
        self.reason = ""
        self._carry_on(progress)
        return True

    def _best_released(self, best: Ranked, naming: Naming, progress: Progress) -> tuple[Ranked, Fit | None]:
        """Of the best hypothesis, its rivals and the laws that it contains, all released, the one with the least
        deviance and price.

        While shafts are held, what a law has beyond a simpler one may only have stood for the hold, and what tells two
        hypotheses apart may be hidden by it.
        """
        if self.lead.direct:
            return best, best.fit
        gain = abs(best.score)
        rivals = [r for r in naming.ranked[:RELEASED] if r.score < best.score + ALIKE * gain]
        simpler = [r for r in naming.ranked if best.attachment.contains(r.attachment)]
        contenders = rivals + [r for r in simpler if r not in rivals and r.score < best.score + CLOSE * gain]
        released = []
        for ranked in contenders:
            progress(f"polishing {ranked.attachment.label}")
            polished = self.polished(ranked, self.fit)
            if polished is not None:
                released.append((ranked, polished))
            else:
                ranked.score = 0.0
        if not released:
            return best, None
        correlation = released[0][1].correlation()
        paid = [score(replace(r.candidate, fit=f), self.fit, correlation) for r, f in released]
        for (ranked, _), much in zip(released, paid, strict=True):
            ranked.score = much - min(paid) - gain
        naming.ranked.sort(key=lambda r: r.score)
        confidences(naming.ranked)
        return released[int(np.argmin(paid))]

    def _carry_on(self, progress: Progress) -> None:
        """Go on with an accepted fit that has not converged: a signal far more precise than the others makes a curved
        valley, where values are many of their errors away from the best while the sum of squares hardly shows it."""
        for _ in range(CARRIED):
            if not self.lead.direct or self.fit.estimate.converged:
                return
            progress("carrying the fit on")
            found = carried(self.fit, self.fit.machine)
            after = try_judge(found.machine, found.point) if found else None
            if after is None or found.deviance() > self.fit.deviance() - 1.0:
                return
            self.take(self.amendment.attachments, found, after)

    def _better(self, other: Search) -> bool:
        """Whether the fit of `other` tells recordings left out better than this one."""
        return pays(left_out(self.case, self.fit), left_out(self.case, other.fit), self.floor)

    def _tells_better_than(self, other: Fit) -> bool:
        return pays(left_out(self.case, other), left_out(self.case, self.fit), self.floor)

    def _add_another(self, progress: Progress) -> bool:
        """A second effect beside a first one that does not pay alone: hidden together, each may need the other."""
        if len(self.findings) > 1 or self.lost() or nearly_noise(self.fit) or not self.add(progress):
            return False
        self._reconsider(0, progress)
        return True

    def take(self, attachments: list[Attachment], found: Fit, judgement: Judgement) -> None:
        """Go on from this amendment; its judgement is that of the last finding, too."""
        self.amendment = replace(self.amendment, attachments=attachments)
        self.fit, self.judgement = found, judgement
        self.findings[-1] = replace(self.findings[-1], after=judgement)

    def polished(self, best: Ranked, base: Fit) -> Fit | None:
        """The hypothesis fitted to all, nothing held; None where that fails or is no better than the base."""
        if self.lead.direct:
            return best.fit
        candidate = best.candidate
        machine = self.fit.machine.amended(candidate.machine.amendment, self.case)
        found = self.lead.release(machine, self.case, base, [*base.estimate.free, *candidate.free], best.fit)
        if found is None or found.deviance(best.fit.correlation()) > base.deviance(best.fit.correlation()):
            return None
        return found

    def _reconsider(self, k: int, progress: Progress) -> None:
        """Name finding k anew, given the others: exchange it where a rival is better by more than a tie, or a simpler
        law of the same kind is no worse, unless the present one tells recordings left out better."""
        finding = self.findings[k]
        progress(f"reconsidering {finding.ranked.attachment.label}")
        others = [a for a in self.amendment.attachments if a is not finding.ranked.attachment]
        amended = replace(self.amendment, attachments=others)
        base = without(self.fit, finding.ranked, amended)
        if base is None:
            return
        held = self.lead.hold(base)
        candidates = self._rivals(finding, amended, held)
        naming = compete(held.machine.case, candidates, held, final=self.lead.direct, progress=progress)
        best, own = naming.best, naming.of(finding.ranked.identity)
        if best is None or own is None:
            return
        if best.score > own.score - (0.0 if finding.ranked.attachment.contains(best.attachment) else TIE):
            ranked = replace(finding.ranked, score=own.score, confidence=own.confidence)
            self.findings[k] = replace(finding, ranked=ranked, naming=naming)
            return
        polished = self.polished(best, base)
        if polished is None:
            return
        saved = price(len(own.candidate.free) - len(best.candidate.free), base, naming.correlation)
        if polished.deviance(naming.correlation) - saved > self.fit.deviance(naming.correlation) + TIE:
            return
        after = try_judge(polished.machine, polished.point)
        if after is not None and not self._tells_better_than(polished):
            progress(f"{best.attachment.label} instead of {finding.ranked.attachment.label}")
            better = f"{best.attachment.label} is better beside what was found"
            left(finding.ranked.attachment.label, "comparison", better)
            best.fit = polished
            self.findings[k] = replace(finding, ranked=best, naming=naming)
            self.take([*others, best.attachment], polished, after)

    def drop_needless(self, progress: Progress) -> None:
        """Drop what is not believed beside the others: it stood for all as well as it could, or for a sensor's zero."""
        for finding in list(self.findings):
            if len(self.findings) < 2:
                return
            attachments = [a for a in self.amendment.attachments if a is not finding.ranked.attachment]
            found = self._without(finding.ranked, replace(self.amendment, attachments=attachments))
            present = replace(finding.ranked.candidate, fit=self.fit)
            if found is None or needed(present, found, self.fit.correlation()):
                continue
            after = try_judge(found.machine, found.point)
            if after is not None and not self._tells_better_than(found):
                progress(f"{finding.ranked.attachment.label} is not needed")
                left(finding.ranked.attachment.said(self.fit.point), "needless", "the others do without it")
                self.findings.remove(finding)
                self.take(attachments, found, after)

    def _without(self, ranked: Ranked, amendment: Amendment) -> Fit | None:
        """The present model without one of its effects, fitted anew; or as it is where that leaves less: a fit of what
        sticks may end in a dip beside it."""
        fits = [without(self.fit, ranked, amendment, stages) for stages in (0, STAGES)]
        return min((f for f in fits if f is not None), key=lambda f: f.deviance(), default=None)

    def _rivals(self, finding: Finding, amended: Amendment, held: Fit) -> list[Candidate]:
        """The finding and the best of what was tried beside it, with the values they had, in the model without it.

        Laws that the finding contains are rivals too: what it had beyond them may have stood for a later finding.
        """
        own = finding.ranked.identity
        rivals = [r for r in finding.naming.ranked if r.identity != own][:RECONSIDERED]
        result = []
        for ranked in [finding.ranked, *rivals]:
            old = ranked.candidate
            amendment = replace(amended, attachments=[*amended.attachments, ranked.attachment])
            machine, _ = try_machine(held.machine.case, amendment, held.machine)
            point = self.fit.point if ranked is finding.ranked else ranked.fit.point
            if machine is not None:
                start = {f.name: point[f.name] for f in old.free}
                result.append(Candidate(ranked.attachment, machine, old.free, old.fixed, start, predicted=1.0))
        tried = {c.attachment.label for c in result}
        simpler = [
            a for a in enumerate_attachments(self.case, amended.structure, self.effects, amended)
            if finding.ranked.attachment.contains(a) and a.label not in tried
        ]  # fmt: skip
        return result + screen_all(held.machine.case, amended, simpler, held, lambda text: None)[0]
