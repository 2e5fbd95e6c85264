"""Laws that no catalogue holds: sparse sums of terms in the variables at a place, fitted by the error of the outputs.

Every group of terms is screened to first order, as an effort along the fitted trajectory, and those are kept that
explain recordings (or parts of one) they were not fitted to. The best few become components of a model and are fitted
like any effect; groups are added while they pay for their parameters and for having been picked among many.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
import re

import numpy as np

from .amend import Amendment, Attachment
from .cases import Case
from .catalogue import Effect, EffectParameter
from .evidence import is_noise
from .fit import Fit, fit
from .law_terms import Group, Shape, Variable, groups
from .least_squares import Free
from .machine import Machine, try_machine
from .places import Device, Line, Shaft
from .response import respond
from .screen import Candidate, Screen

GROUPS = 3  # that a law may be the sum of
FITTED = 4  # groups that are fitted in each round
SHORTLIST = 24  # groups that are tried on what they were not fitted to
HATS = 128  # of effort in each recording, from which the answer to every term is put together
SIGNIFICANT = 3.0  # standard errors of a coefficient below which it is left out

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Site:
    """A place with the variables that a law there may use and the unit of the effort that it gives."""

    place: Shaft | Line | Device
    location: str
    unit: str
    variables: tuple[Variable, ...]

    @property
    def sizes(self) -> dict[str, float]:
        return {v.local: v.size for v in self.variables}


@dataclass(frozen=True)
class Law:
    """Groups of terms at a site; coefficients are c_1, c_2, ... in the order of the terms."""

    site: Site
    groups: tuple[Group, ...] = ()

    def numbered(self) -> list[tuple[str, Group, dict[str, str]]]:
        """(coefficient, group, names of its shapes) of every term's text, in order."""
        result, count = [], 0
        for n, group in enumerate(self.groups):
            shapes = {s.name: f"{s.name}_{n + 1}" for s in group.shapes}
            for text in group.texts:
                count += 1
                result.append((f"c_{count}", text, shapes))
        return result

    def shapes(self) -> dict[str, Shape]:
        return {f"{s.name}_{n + 1}": s for n, group in enumerate(self.groups) for s in group.shapes}

    def text(self) -> str:
        """The right-hand side in the names of the component."""
        return " + ".join(f"{c}*{text.format(**shapes)}" for c, text, shapes in self.numbered())

    def references(self) -> list[Variable]:
        return [v for v in self.site.variables if f"{v.local}_ref" in self.text()]

    def expression(self, values: dict[str, float]) -> str:
        """The law in variables of the model, with its numbers; `values` by the component's own names."""
        terms = []
        for c, text, shapes in self.numbered():
            text = text.format(**{s: f"{values[full]:.4g}" for s, full in shapes.items()})
            terms.append(f"{values[c]:.4g}*{text}")
        whole = " + ".join(terms).replace("+ -", "- ")
        for v in self.site.variables:
            whole = whole.replace(f"{v.local}_ref", f"{v.size:g}")
            whole = _renamed(whole, v.local, v.name)
        return whole


@dataclass
class Proposal:
    """A law with the values that its parameters start from, by its component's own names."""

    law: Law
    start: dict[str, float]
    candidate: Candidate | None = None


def find(case: Case, amendment: Amendment, base: Fit, progress: Progress = lambda text: None) -> Candidate | None:
    """The best law on top of `base`, the fit of `amendment`; None where no term pays. Its fit is in the candidate."""
    best: Proposal | None = None
    efforts = [Effort(case, base, site) for site in sites(case, base)]
    while best is None or (len(best.law.groups) < GROUPS and not is_noise(best.candidate.fit)):
        here, law = (base, None) if best is None else (best.candidate.fit, best.law)
        proposals = _screened(case, here, law, efforts, progress)
        for proposal in proposals[:FITTED]:
            proposal.candidate = _fitted(case, amendment, base, proposal.law, proposal.start)
        fitted = [p for p in proposals[:FITTED] if p.candidate is not None]
        if not fitted:
            break
        correlation = min((p.candidate.fit for p in fitted), key=lambda f: f.deviance()).correlation()
        chosen = min(fitted, key=lambda p: score(p.candidate, base, correlation))
        before = 0.0 if best is None else score(best.candidate, base, correlation)
        after = score(chosen.candidate, base, correlation)
        progress(f"law at {chosen.law.site.location}: {chosen.law.text()}: {after:.1f}")
        if after > before - 2 * np.log(len(proposals)):  # ln of the squared number of terms that were looked at
            break
        best = chosen
    return None if best is None else _simplified(case, amendment, base, best)


def score(candidate: Candidate, base: Fit, correlation: dict[str, float]) -> float:
    """Deviance less the base's, with ln n for each parameter, n independent samples (Schwarz 1978)."""
    informative = sum(count / correlation[c] for c, count in base.counts().items())
    price = len(candidate.free) * float(np.log(max(informative, 2.0)))
    return candidate.fit.deviance(correlation) + price - base.deviance(correlation)


def sites(case: Case, base: Fit) -> list[Site]:
    """Shafts, lines of one phase and devices of the fitted model, with the variables there."""
    structure = base.machine.amendment.structure
    single = [lines[0] for lines in structure.phases() if len(lines) == 1]
    names: list[tuple[Shaft | Line | Device, str, str, list[tuple[str, str, str, str]]]] = []
    for shaft in structure.shafts:
        owners = {m.split(".")[0] for m in shaft.members}
        currents = [("i", f"{line.load}.i", "A", "current") for line in single if line.load in owners]
        names.append((shaft, shaft.location, "N.m", [*_motion(shaft, "angle"), *currents[:1]]))
    for line in single:
        shaft = next((s for s in structure.shafts if any(m.split(".")[0] == line.load for m in s.members)), None)
        motion = _motion(shaft, "angle") if shaft else []
        names.append((line, line.load, "V", [("i", f"{line.load}.i", "A", "current"), *motion]))
    for device in structure.devices:
        motion = [("v", f"{device.part}.v", "m/s", "speed"), ("s", f"{device.part}.s", "m", "position")]
        names.append((device, device.part, "N", motion))
    return [_site(case, base, *entry) for entry in names]


def _motion(shaft: Shaft, angle: str) -> list[tuple[str, str, str, str]]:
    return [("w", f"{shaft.location}.w", "rad/s", "speed"), (angle, f"{shaft.location}.phi", "rad", "position")]


def _site(
    case: Case, base: Fit, place: Shaft | Line | Device, location: str, unit: str,
    names: list[tuple[str, str, str, str]],
) -> Site:  # fmt: skip
    known = [n for n in names if n[1] in base.machine.model.variables]
    paths = [base.machine.trajectory(base.point, r, [n[1] for n in known]) for r in case.fit]
    largest = [max(float(np.max(np.abs(p[n[1]]))) for p in paths) for n in known]
    variables = [Variable(*n, float(f"{size:.2g}")) for n, size in zip(known, largest, strict=True) if size > 0]
    return Site(place, location, unit, tuple(variables))


def _screened(case: Case, here: Fit, law: Law | None, efforts: list[Effort], progress: Progress) -> list[Proposal]:
    """Laws with one group more, by what that group explains of recordings it is not fitted to, best first."""
    screen = Screen(here)
    duration = max(float(r.time[-1] - r.time[0]) for r in case.fit)
    found: list[tuple[float, Proposal, list[np.ndarray]]] = []
    for effort in efforts:
        if law is not None and effort.site is not law.site:
            continue
        known = law.groups if law else ()
        for group in groups(list(effort.site.variables), duration):
            columns = effort.columns(group, screen.weights)
            share, coefficients = screen.explained(columns)
            found.append((share, _proposal(Law(effort.site, (*known, group)), here, coefficients), columns))
    found.sort(key=lambda f: -f[0])
    split = _parts(screen)
    tested = [(_held_out(screen, columns, split), proposal) for _, proposal, columns in found[:SHORTLIST]]
    tested.sort(key=lambda t: -t[0])
    progress(f"{len(found)} terms screened" + (f", best {tested[0][0]:.1%}" if tested else ""))
    different: dict[tuple[str, ...], Proposal] = {}
    for share, proposal in tested:
        if share > 0:
            different.setdefault(proposal.law.groups[-1].texts, proposal)
    return list(different.values())


def _proposal(law: Law, here: Fit, coefficients: np.ndarray) -> Proposal:
    """Values as they stand in the fit so far, the new group's coefficients from the screening."""
    prefix = f"{_component(law)}."
    start = {name: shape.start for name, shape in law.shapes().items()}
    start |= {n.removeprefix(prefix): v for n, v in here.point.items() if n.startswith(prefix)}
    names = [c for c, _, _ in law.numbered()]
    return Proposal(law, start | dict(zip(names[-len(coefficients) :], map(float, coefficients), strict=True)))


class Effort:
    """Columns of the residual for efforts along the trajectory of a fit, at one site. Units of noise, not weighted."""

    def __init__(self, case: Case, base: Fit, site: Site):
        self.case, self.base, self.site = case, base, site
        names = [v.name for v in site.variables]
        self.paths = []
        for recording in case.fit:
            path = base.machine.trajectory(base.point, recording, names)
            self.paths.append({v.local: path[v.name] for v in site.variables} | {"time": recording.time})
        if not isinstance(site.place, Device):
            amendment = replace(base.machine.amendment, probes=(site.place,))
            self.response = respond(Machine(case, amendment, base.machine.solver), base, 0, HATS)

    def columns(self, group: Group, weights: list[np.ndarray]) -> list[np.ndarray]:
        """One column for each term: what a loss of one unit of it changes in the weighted residual."""
        terms = [group.values(path, self.site.sizes) for path in self.paths]
        return [self._column([t[k] for t in terms], weights) for k in range(len(group.texts))]

    def _column(self, effort: list[np.ndarray], weights: list[np.ndarray]) -> np.ndarray:
        if isinstance(self.site.place, Device):
            parts = self._imposed(effort)
        else:  # a loss is a torque against the shaft, a voltage drop in the line
            sign = -1.0 if isinstance(self.site.place, Shaft) else 1.0
            parts = self.response.to([sign * e for e in effort], [r.time for r in self.case.fit])
        return np.concatenate([p * w for p, w in zip(parts, weights, strict=True)])

    def _imposed(self, effort: list[np.ndarray]) -> list[np.ndarray]:
        """A force beside an imposed motion adds to the recorded one."""
        own = [s.column for s in self.case.outputs if s.variable == self.site.place.variable]
        parts = []
        for recording, e in zip(self.case.fit, effort, strict=True):
            samples, noise = self.base.weights[recording.name], self.base.noise
            parts.append(
                np.concatenate([-e * samples[c] / noise[c].std if c in own else np.zeros(len(e)) for c in noise])
            )
        return parts


def _parts(screen: Screen) -> list[np.ndarray]:
    """Rows of the residual in parts that are left out in turn: recordings, or thirds of a single one."""
    signals = len(screen.noise)
    lengths = [len(r.time) for r in screen.recordings]
    label = []
    for n, length in enumerate(lengths):
        one = np.full(length, n) if len(lengths) > 1 else np.arange(length) * 3 // length
        label.append(np.tile(one, signals))
    labels = np.concatenate(label)
    return [labels == k for k in np.unique(labels)]


def _held_out(screen: Screen, columns: list[np.ndarray], parts: list[np.ndarray]) -> float:
    """Share of the misfit explained in parts that neither parameters nor coefficients are fitted to."""
    rows = len(screen.residual)
    base = screen.jacobian[:rows]
    pulls = screen.jacobian[rows:]
    before = after = 0.0
    for part in parts:
        for stack, with_columns in ((base, False), (np.column_stack([base, *columns]), True)):
            beliefs = np.column_stack([pulls, np.zeros((len(pulls), stack.shape[1] - pulls.shape[1]))])
            matrix = np.vstack([stack[~part], beliefs])
            target = np.concatenate([screen.residual[~part], screen.load[rows:]])
            scale = np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)
            solution = np.linalg.lstsq(matrix / scale, -target, rcond=1e-8)[0] / scale
            left = screen.residual[part] + stack[part] @ solution
            if with_columns:
                after += float(left @ left)
            else:
                before += float(left @ left)
    return 1.0 - after / before if before > 0 else 0.0


def _fitted(
    case: Case,
    amendment: Amendment,
    base: Fit,
    law: Law,
    start: dict[str, float],
    believed: dict[str, float] | None = None,
) -> Candidate | None:
    """The law as a component of the amended model, fitted together with the believed parameters."""
    attachment = attach(law)
    machine, _ = try_machine(
        case, replace(amendment, attachments=[*amendment.attachments, attachment]), base.machine
    )
    if machine is None:
        return None
    free = _free(law, attachment, start)
    first = (believed or base.point) | {attachment.full_name(n): v for n, v in start.items()}
    found = fit(machine, case.fit, base.noise, [*base.estimate.free, *free], base.fixed, start=first)
    return None if found is None else Candidate(attachment, machine, free, start=first, fit=found)


def _free(law: Law, attachment: Attachment, start: dict[str, float]) -> list[Free]:
    """Coefficients of any sign, scaled by the largest of all; shapes within their bounds."""
    scale = max(abs(start[c]) for c, _, _ in law.numbered()) or 1.0
    free = [Free(attachment.full_name(c), start[c], max(abs(start[c]), 0.1 * scale)) for c, _, _ in law.numbered()]
    for name, shape in law.shapes().items():
        step = 1e-3 if shape.name == "omega" else 1e-2
        free.append(Free(attachment.full_name(name), start[name], 0.3 * abs(shape.start), shape.lower, shape.upper,
                         step=step))  # fmt: skip
    return free


def _simplified(case: Case, amendment: Amendment, base: Fit, best: Proposal) -> Candidate:
    """The law without coefficients that may be zero, and with whole exponents and orders where the data allows them."""
    for simpler in _simpler(best):
        candidate = _fitted(case, amendment, base, simpler.law, simpler.start, best.candidate.fit.point)
        if candidate is None:
            continue
        correlation = best.candidate.fit.correlation()
        if score(candidate, base, correlation) < score(best.candidate, base, correlation):
            simpler.candidate = candidate
            return _simplified(case, amendment, base, simpler)
    return best.candidate


def _simpler(proposal: Proposal) -> list[Proposal]:
    """The law with one thing less that is not needed by its own standard error."""
    law, fitted = proposal.law, proposal.candidate.fit
    covariance = fitted.estimate.covariance(fitted.inflation())
    errors = {f.name: float(np.sqrt(max(covariance[k, k], 0.0))) for k, f in enumerate(fitted.estimate.free)}
    prefix = f"{_component(law)}."
    values = {n.removeprefix(prefix): v for n, v in fitted.point.items() if n.startswith(prefix)}
    found = []
    for name, shape in law.shapes().items():
        near = [s for s in shape.simple if abs(s - values[name]) < SIGNIFICANT * errors[prefix + name] + 0.02 * s]
        if near:
            nearest = min(near, key=lambda s: abs(s - values[name]))
            found.append(_with_fixed(law, values, name, nearest))
    numbered = law.numbered()
    for k, (c, _, _) in enumerate(numbered):
        if len(numbered) > 1 and abs(values[c]) < SIGNIFICANT * errors[prefix + c]:
            found.append(_without(law, values, k))
    return found


def _with_fixed(law: Law, values: dict[str, float], name: str, value: float) -> Proposal:
    """The law with a number in place of a shape parameter."""
    groups = list(law.groups)
    k = int(name.rsplit("_", 1)[1]) - 1
    shape = name.rsplit("_", 1)[0]
    texts = tuple(text.replace(f"{{{shape}}}", f"{value:.4g}") for text in groups[k].texts)
    texts = tuple(text.replace("(1*", "(") for text in texts)
    groups[k] = Group(texts, tuple(s for s in groups[k].shapes if s.name != shape))
    return Proposal(Law(law.site, tuple(groups)), {n: v for n, v in values.items() if n != name})


def _without(law: Law, values: dict[str, float], k: int) -> Proposal:
    """The law without its term k; groups that lose all terms go too."""
    groups, start, count, kept = [], {}, 0, 0
    for n, group in enumerate(law.groups):
        texts = []
        for text in group.texts:
            count += 1
            if count - 1 != k:
                kept += 1
                texts.append(text)
                start[f"c_{kept}"] = values[f"c_{count}"]
        if texts:
            groups.append(Group(tuple(texts), group.shapes))
            start |= {f"{s.name}_{len(groups)}": values[f"{s.name}_{n + 1}"] for s in group.shapes}
    return Proposal(Law(law.site, tuple(groups)), start)


def _component(law: Law) -> str:
    return f"law_{law.site.location.replace('.', '_').replace(':', '_')}"


def attach(law: Law) -> Attachment:
    """The law as an effect of identifier `unknown`, its component's source carried along."""
    site = law.site
    parameters = [EffectParameter(c, site.unit, "Coefficient", -1e30, 1e30, 0.0) for c, _, _ in law.numbered()]
    parameters += [EffectParameter(n, s.unit, "Shape", s.lower, s.upper, s.start) for n, s in law.shapes().items()]
    component, place = _component(law), site.place
    effect = Effect(
        "unknown", class_name(law), "Empirical law", _ATTACHES[type(place)], tuple(parameters),
        signature=f"no effect of the catalogue; {site.unit} as {law.text()}",
    )  # fmt: skip
    own = _OWN[type(place)]
    signals = tuple((v.local, v.name) for v in law.references() if v.local not in own)
    return Attachment(
        effect, component, site.location,
        shaft=place if isinstance(place, Shaft) else None,
        lines=(place,) if isinstance(place, Line) else (),
        device=place if isinstance(place, Device) else None,
        signals=signals, definition=_source(law, signals), expression=law.expression,
    )  # fmt: skip


_ATTACHES = {Shaft: "flange", Line: "line", Device: "imposed"}
_OWN = {Shaft: ("angle", "w"), Line: ("i",), Device: ("s", "v")}
_BASE = {
    Shaft: ("Lacuna.Effects.Interfaces.FlangeEffect", "tau"),
    Line: ("Lacuna.Interfaces.TwoPin", "v"),
    Device: ("Lacuna.Interfaces.ImposedMotion", "f"),
}


def class_name(law: Law) -> str:
    return "Law" + "".join(part.capitalize() for part in law.site.location.replace(".", "_").split("_"))


def _source(law: Law, signals: tuple[tuple[str, str], ...]) -> str:
    """The component's class, to be nested in the amended model."""
    base, effort = _BASE[type(law.site.place)]
    lines = [f'model {class_name(law)} "Empirical law"', f"  extends {base};"]
    units = {v.local: v.unit for v in law.site.variables}
    for name, _ in signals:
        lines.append(f'  Lacuna.Interfaces.RealInput {name}(unit="{units[name]}") "Variable of the law";')
    for c, _, _ in law.numbered():
        lines.append(f'  parameter Real {c}(unit="{law.site.unit}") = 0 "Coefficient";')
    for name, shape in law.shapes().items():
        lines.append(f'  parameter Real {name}(unit="{shape.unit}") = {shape.start:.6g} "Shape";')
    for v in law.references():
        lines.append(f'  parameter Real {v.local}_ref(unit="{v.unit}") = {v.size:.6g} "Largest value recorded";')
    lines += ["equation", f"  {effort} = noEvent({law.text()});", f"end {class_name(law)};"]
    return "\n".join(lines)


def _renamed(text: str, local: str, name: str) -> str:
    return re.sub(rf"(?<![\w.]){local}(?![\w.(])", name, text)
