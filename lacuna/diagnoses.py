"""Recordings that disagree with a model: what they know and it does not, in one call or step by step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lacuna.extras import names_missing_packages
from lacuna.notebook import page, paragraph, table
from lacuna.progress import Progress, spoken

if TYPE_CHECKING:
    from lacuna.discovery.case import cases
    from lacuna.discovery.explanation.explanation import Explanation as Found
    from lacuna.discovery.naming.judge import Judgement

Verdict = Literal["missing_physics", "parameters", "consistent", "undetermined"]
LIMIT = 600.0  # s, of a search


@dataclass(frozen=True)
class Explanation:
    """What recordings say of a model, as far as the step that gave it went; `report` is the page with its figures.

    `diagnosis` is what diagnosis.json holds: verdict, findings with effect, place, parameters and alternatives, NRMSE
    before and after, fitted parameters. `ranking` is that of the step: places, or hypotheses, best first. A step alone
    concludes nothing: it has no verdict, and its sentence says so.
    """

    diagnosis: dict[str, Any]
    report: Path
    amended: Path | None = None  # the amended model
    ranking: tuple[tuple[str, ...], ...] = ()
    ranked: tuple[str, ...] = ()  # what the columns of `ranking` are
    remark: str = ""
    written: tuple[Path, ...] = field(default=(), repr=False)
    problems: tuple[str, ...] = ()  # of the recordings: what was left out, or is doubtful

    @property
    def verdict(self) -> Verdict | None:
        return self.diagnosis.get("verdict")

    @property
    def sentence(self) -> str:
        """The verdict as an engineer would say it."""
        return str(self.diagnosis.get("sentence", "One step alone: nothing is concluded."))

    @property
    def findings(self) -> list[dict[str, Any]]:
        return list(self.diagnosis["findings"])

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """By name: believed, value, std (1 sigma), unit, outside_belief; SI units."""
        return dict(self.diagnosis.get("parameters", {}))

    @property
    def errors(self) -> dict[str, dict[str, float]]:
        """NRMSE on recordings that nothing was fitted to, of each signal: before, after, noise_floor."""
        return dict(self.diagnosis.get("per_signal", {}))

    @property
    def nrmse(self) -> dict[str, dict[str, float]]:
        """NRMSE of all signals together, "fit" and "validate", each "before" and "after"."""
        return dict(self.diagnosis.get("nrmse", {}))

    def half_width(self, parameter: str) -> str:
        """Of the 95 % interval of a believed parameter; of one that the data says nothing of, that it is not known."""
        std = self.parameters[parameter]["std"]
        return "not determined" if std is None else f"{2 * std:.2g}"

    def _repr_html_(self) -> str:
        fitted = [(n, p["believed"], p["value"], self.half_width(n), p["unit"]) for n, p in self.parameters.items()]
        parts = [paragraph(self.sentence)]
        parts += [table(self.ranked, self.ranking)] if self.ranking else []
        misfits = [
            (signal, *(value[k] for k in ("before", "after", "noise_floor"))) for signal, value in self.errors.items()
        ]
        parts += [table(("signal", "NRMSE as fitted", "amended", "noise alone"), misfits)] if misfits else []
        parts += [table(("parameter", "believed", "fitted", "± (95 %)", "unit"), fitted)] if fitted else []
        parts += [paragraph(f"report: {self.report}")]
        return page(str(self.diagnosis["case"]), *parts)


@dataclass(frozen=True)
class Judged:
    """NRMSE of each signal, and of all together (""), of a model file on the recordings of a case."""

    fit: dict[str, float]
    validate: dict[str, float]
    report: Path
    problems: tuple[str, ...] = ()  # of the recordings: what was left out, or is doubtful

    def _repr_html_(self) -> str:
        rows = [(signal or "all", value, self.fit[signal]) for signal, value in self.validate.items()]
        return page(f"judged: {self.report}", table(("signal", "NRMSE, unseen", "fitted"), rows))


def open_case(folder: str | Path, *, libraries: Iterable[str | Path] = ()) -> Case:
    """A recording case: a folder with case.toml and its recordings. Raises CaseError naming file and entry.

    `libraries` are looked up besides those that case.toml names. Needs the extra `explain`.
    """
    return Case(folder, libraries)


@names_missing_packages
def explain(
    case: str | Path,
    *,
    libraries: Iterable[str | Path] = (),
    out: str | Path | None = None,
    limit: float = LIMIT,
    progress: Progress | None = None,
) -> Explanation:
    """Say which physics the believed model of `case` lacks, or that it lacks none, or that the data cannot tell.

    Fits the believed model, locates the missing effort, ranks effects of the catalogue, writes the amended model and
    judges it on recordings that nothing was fitted to; writes diagnosis.json, trace.json (why each hypothesis was given
    up), report.html and, where there is one, the amended model into `out` (default: out/explain/CASE). After `limit`
    seconds no search goes on, and what was found stands. After an interruption the same call takes up the fits that
    were finished. Raises CaseError where model and case do not fit, Diagnostic where the model is wrong. Needs the
    extra `explain`.
    """
    return open_case(case, libraries=libraries).explain(out=out, limit=limit, progress=progress)


class Case:
    """A recording case, opened; each step of an explanation can be run and looked at alone.

    Every step takes `out`, the folder of its report (default: out/STEP/CASE).
    """

    @names_missing_packages
    def __init__(self, folder: str | Path, libraries: Iterable[str | Path] = ()) -> None:
        from lacuna.discovery.case.cases import load

        self.folder = Path(folder)
        self._case: cases.Case = load(self.folder, list(libraries))

    @property
    def title(self) -> str:
        return self._case.title

    @property
    def model(self) -> str:
        """What the machine is believed to be."""
        return self._case.model

    @names_missing_packages
    def explain(
        self, *, out: str | Path | None = None, limit: float = LIMIT, progress: Progress | None = None
    ) -> Explanation:
        """See `lacuna.explain`."""
        from lacuna.discovery.experiment.files import write_next
        from lacuna.discovery.explain import explain as explained
        from lacuna.discovery.explain import judge_written, write_amended
        from lacuna.discovery.explanation import diagnosis
        from lacuna.discovery.fit.kept.store import kept

        folder = self._out("explain", out)
        with kept(folder / ".unfinished"):
            found = explained(self._case, progress=spoken(progress), limit=limit)
        amended = write_amended(found, folder)
        if amended is not None:
            judge_written(found, amended)
        told = diagnosis.write(found, folder, amended)
        proposed = write_next(self._case, found.trial, folder)
        traced = found.trace.write(folder)
        return self._told(found, folder, amended, written=(told, traced, *proposed[:1]), concluded=True)

    @names_missing_packages
    def fit(self, *, out: str | Path | None = None, progress: Progress | None = None) -> Explanation:
        """Are the believed equations enough? All parameters that are not exact, fitted, with their intervals."""
        from lacuna.discovery.steps import fitted

        return self._told(fitted(self._case, spoken(progress)), self._out("fit", out))

    @names_missing_packages
    def locate(self, *, out: str | Path | None = None, progress: Progress | None = None) -> Explanation:
        """Which effort is missing, and where? Places of the model, ranked by what an effort there would explain."""
        from lacuna.discovery.steps import add_location, fitted

        found = fitted(self._case, spoken(progress))
        add_location(found, spoken(progress))
        assert found.located is not None
        places = tuple((p.location, f"{p.kind}, {p.unit}", f"{p.explained:.1%}") for p in found.located.places)
        remark = found.located.organiser.sentence if found.located.organiser else ""
        columns = ("place", "missing", "misfit explained")
        return self._told(found, self._out("locate", out), ranking=places, ranked=columns, remark=remark)

    @names_missing_packages
    def name(self, *, out: str | Path | None = None, progress: Progress | None = None) -> Explanation:
        """Which physics is it? The catalogue's effects attached, simulated and fitted again, ranked by the evidence."""
        from lacuna.discovery.steps import add_naming, fitted

        library = self._case.library()
        found = fitted(self._case, spoken(progress), library)
        add_naming(found, library, spoken(progress))
        ranked = found.namings[0].ranked
        rows = tuple((r.attachment.label, f"{-r.score:.1f}", f"{r.confidence:.3f}") for r in ranked)
        columns = ("hypothesis", "evidence against none", "confidence")
        return self._told(found, self._out("name", out), ranking=rows, ranked=columns)

    @names_missing_packages
    def amend(
        self, effect: str = "", *, out: str | Path | None = None, progress: Progress | None = None
    ) -> Explanation:
        """The model amended by one effect of the catalogue (default: the best), fitted, and judged as it is written."""
        from lacuna.discovery.explain import judge_written, write_amended
        from lacuna.discovery.steps import add_amendment, add_scatter, fitted

        library = self._case.library()
        found = fitted(self._case, spoken(progress), library)
        add_amendment(found, library, effect, spoken(progress))
        add_scatter(found, spoken(progress))
        folder = self._out("amend", out)
        path = write_amended(found, folder)
        assert path is not None  # add_amendment raises where nothing was found
        judge_written(found, path)
        return self._told(found, folder, path)

    @names_missing_packages
    def judge(self, model: str | Path, *, out: str | Path | None = None, progress: Progress | None = None) -> Judged:
        """How well does a model file, as written, simulate the recordings that nothing was fitted to? `model` is a
        file, or a class in one: `file.mo:Pkg.Class`."""
        from lacuna.codegen.library.search_path import split_name
        from lacuna.discovery.case.gaps import before_gaps
        from lacuna.discovery.case.problem import CaseError
        from lacuna.discovery.case.recordings_check import UNDRIVEN
        from lacuna.discovery.catalogue.amend import Amendment
        from lacuna.discovery.catalogue.searched import believed_structure
        from lacuna.discovery.explanation.report import write_judgement
        from lacuna.discovery.naming.judge import judge_file
        from lacuna.discovery.steps import prepared

        path, (file, _) = Path(model), split_name(str(model))
        (file or path).open().close()  # an unreadable file is said before anything is simulated
        usable = prepared(self._case, without=(UNDRIVEN,))
        case, left_out = before_gaps(usable.case)
        if usable.reason or not (case.fit and case.validate):
            raise CaseError(usable.reason or f"nothing is left to judge by before a gap: {usable.problems[0]}")
        spoken(progress)(f"simulating the recordings by {path.name}")
        found: Judgement = judge_file(case, Amendment(believed_structure(case, case.library())), path, {})
        report = write_judgement(case, found, self._out("judge", out), path)
        doubts = [str(p) for p in usable.problems] + [f"{r}: not judged, its states are unknown" for r in left_out]
        return Judged(found.fit, found.validate, report, tuple(doubts))

    def _out(self, step: str, out: str | Path | None) -> Path:
        folder = Path(out) if out else Path("out") / step / self.folder.resolve().name
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def _told(
        self, found: Found, folder: Path, amended: Path | None = None, *, ranking: tuple[tuple[str, ...], ...] = (),
        ranked: tuple[str, ...] = (), remark: str = "", written: tuple[Path, ...] = (), concluded: bool = False,
    ) -> Explanation:  # fmt: skip
        from lacuna.discovery.explanation import diagnosis, report

        page_of = report.write(found, folder, amended)
        files = (*written, page_of, *([amended] if amended else []))
        data = diagnosis.build(found, amended)
        data = data if concluded else {k: v for k, v in data.items() if k not in ("verdict", "sentence", "certainty")}
        problems = tuple(map(str, found.problems))
        return Explanation(data, page_of, amended, ranking, ranked, remark, files, problems)

    def __repr__(self) -> str:
        return f"<Case {self.title}: {self.model}, {len(self._case.fit)} + {len(self._case.validate)} recordings>"

    def _repr_html_(self) -> str:
        signals = [(s.column, s.role, s.variable, s.unit) for s in self._case.signals.values()]
        return page(f"{self.title}: {self.model}", table(("column", "role", "variable", "unit"), signals))
