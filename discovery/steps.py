"""The steps of an explanation one at a time, each giving an explanation that is filled so far: fit, locate, name."""

from __future__ import annotations

from codegen.library import Library

from . import catalogue, places
from .cases import Case, CaseError
from .explain import Explanation, Progress, _believed_machine, fit_believed
from .fit import believed
from .hypotheses import enumerate_attachments
from .judge import judge, noise_floor
from .locate import locate
from .name import rank
from .recordings_check import check_case
from .search import tracked
from .semantic_check import check_against_model


def fitted(case: Case, progress: Progress, library: Library | None = None) -> tuple[Explanation, tuple[float, ...]]:
    """The believed model fitted and judged, and the bandwidths that led the fit. Raises CaseError on bad recordings."""
    result = Explanation(case, check_case(case))
    machine = _believed_machine(case, places.read(library or Library(), case.model))
    result.problems += check_against_model(machine, believed(case, machine))
    fatal = [str(problem) for problem in result.problems if problem.fatal]
    if fatal:
        raise CaseError("the recordings cannot be used: " + "; ".join(fatal))
    progress("fitting the believed model")
    result.base, bandwidths = fit_believed(case, machine)
    result.amendment, result.final = machine.amendment, result.base
    result.before = result.after = judge(machine, result.base.point)
    result.floor = noise_floor(case, case.validate, result.base.noise)
    return result, bandwidths


def located(case: Case, progress: Progress) -> Explanation:
    """What effort is missing, where, in the fitted believed model."""
    result, bandwidths = fitted(case, progress)
    progress("locating the missing effort")
    result.located = locate(case, tracked(result.base, bandwidths))
    return result


def named(case: Case, progress: Progress) -> Explanation:
    """The catalogue's effects that could be missing from the fitted believed model, ranked: one round of naming."""
    library = Library()
    result, bandwidths = fitted(case, progress, library)
    effects = catalogue.read(library)
    attachments = enumerate_attachments(case, result.amendment.structure, effects, result.amendment)
    progress(f"ranking {len(attachments)} hypotheses")
    naming = rank(case, result.amendment, attachments, tracked(result.base, bandwidths), progress=progress)
    result.namings.append(naming)
    return result
