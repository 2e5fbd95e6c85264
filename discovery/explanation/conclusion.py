"""What is told in the end: the verdict, and parameters as they are beside the zeros of the sensors."""

from __future__ import annotations

from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.verdict import decide
from lacuna.discovery.fit.evidence import outside_belief
from lacuna.discovery.fit.zeros import without_zeros
from lacuna.discovery.naming.judge import try_judge


def conclude(result: Explanation) -> None:
    """The verdict, from the findings, the whiteness of what is left and the believed parameters: as they are beside the
    zeros of the sensors, which are what the diagnosis tells."""
    decide(result)
    if result.verdict == "undetermined":
        return
    if result.lead.direct:
        machine, result.final = result.final.machine, without_zeros(result.final)
        if not result.findings:
            result.base, result.after = result.final, try_judge(machine, result.final.point) or result.after
    if result.verdict == "consistent" and outside_belief(result.final):
        result.verdict = "parameters"
