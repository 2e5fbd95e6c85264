"""What is known about a case, filled step by step; the verdict, diagnosis.json and the report are made of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
import time

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.recordings_check import Problem
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.trace import Trace
from lacuna.discovery.efforts.find import Found
from lacuna.discovery.experiment.proposal import Proposal
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.intervals import standard_errors
from lacuna.discovery.fit.lead import Lead
from lacuna.discovery.law.locate import Located, PlaceEffort
from lacuna.discovery.naming.judge import Judgement
from lacuna.discovery.naming.name import Finding, Naming


@dataclass
class Explanation:
    """Everything that is known about a case in the end; diagnosis.json and the report are written from it."""

    case: Case
    problems: list[Problem]
    verdict: str = "undetermined"
    reason: str = ""
    experiment: str = ""
    stopped: str = ""  # why the search ended before it was done: its time was up
    trial: Proposal | None = None  # the recording that would tell explanations apart
    base: Fit | None = None
    final: Fit | None = None
    amendment: Amendment | None = None
    findings: list[Finding] = field(default_factory=list)
    namings: list[Naming] = field(default_factory=list)
    located: Located | None = None
    effort: PlaceEffort | None = None  # what is missing where the first finding is, by the parameters fitted with it
    opened: Found | None = (
        None  # every place of the equations, where the catalogue's own did not explain the recordings
    )
    before: Judgement | None = None
    after: Judgement | None = None
    floor: dict[str, float] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    instead: tuple[str, ...] = ()  # parameters that would be outside belief without the sensor's error that was found
    lead: Lead = field(default_factory=Lead)  # of fits of this model
    scatter: dict[str, float] = field(default_factory=dict)  # of each parameter, from dip to dip on rough ground
    trace: Trace = field(default_factory=Trace)  # what left the search, and why
    _errors: dict[str, float] | None = None

    def rejudge(self, after: Judgement) -> None:
        """Take the judgement of all findings together anew."""
        self.after = after
        self.findings[-1] = replace(self.findings[-1], after=after)

    def errors(self) -> dict[str, float]:
        """1-sigma of each parameter of the final fit."""
        if self._errors is None:
            errors = standard_errors(self.final, self.lead) if self.final else {}
            self._errors = {n: float(np.hypot(e, self.scatter.get(n, 0.0))) for n, e in errors.items()}
        return self._errors


class Clock:
    """Seconds of each step."""

    def __init__(self, seconds: dict[str, float]):
        self.seconds, self.last = seconds, time.perf_counter()

    def done(self, step: str) -> None:
        now = time.perf_counter()
        self.seconds[step] = self.seconds.get(step, 0.0) + now - self.last
        self.last = now
