"""Terms of empirical laws, screened to first order: what each would explain of recordings it is not fitted to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.attachment import values_of
from lacuna.discovery.catalogue.places import Device, Line, Shaft
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.time_limit import check
from lacuna.discovery.law.law import Law, Site, component_of
from lacuna.discovery.law.response import linear, respond
from lacuna.discovery.law.terms.courses import Courses
from lacuna.discovery.law.terms.law_terms import Group, Variable, groups
from lacuna.discovery.naming.screen import Candidate, Screen

SHORTLIST = 24  # groups that are tried on what they were not fitted to
HATS = (128, 512)  # of effort in each recording, simulated and of linear equations: faster terms are not seen

Progress = Callable[[str], None]


@dataclass
class Proposal:
    """A law with the values that its parameters start from, by its component's own names."""

    law: Law
    start: dict[str, float]
    candidate: Candidate | None = None
    point: dict[str, float] | None = None  # the believed parameters beside which it starts, if not those of the fit


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


def screened(case: Case, here: Fit, law: Law | None, efforts: list[Effort], progress: Progress) -> list[Proposal]:
    """Laws with one group more, by what that group explains of recordings it is not fitted to, best first."""
    screen = Screen(here)
    duration = max(float(r.time[-1] - r.time[0]) for r in case.fit)
    found: list[tuple[float, Proposal, list[np.ndarray]]] = []
    for effort in efforts:
        if law is not None and effort.site is not law.site:
            continue
        known = law.groups if law else ()
        for group in groups(list(effort.site.variables), duration):
            check()
            progress(f"screening terms at {effort.site.location}")
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
    start = {name: shape.start for name, shape in law.shapes().items()}
    start |= values_of(component_of(law), here.point)
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
            probed = base.machine.amended(amendment, case)
            self.response = linear(probed, base, 0, HATS[1]) or respond(probed, base, 0, HATS[0])

    def columns(self, group: Group, weights: list[np.ndarray]) -> list[np.ndarray]:
        """One column for each term: what a loss of one unit of it changes in the weighted residual."""
        terms = [group.values(Courses(path, self.site.sizes)) for path in self.paths]
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
    """Rows of the residual in parts that are left out in turn: recordings, whole if they are in pieces, or thirds of a
    single one."""
    files = list(dict.fromkeys(r.file for r in screen.recordings))
    rows = sum(len(r.time) for r in screen.recordings)
    label, before = [], 0
    for recording in screen.recordings:
        count = len(recording.time)
        one = np.full(count, files.index(recording.file)) if len(files) > 1 else (before + np.arange(count)) * 3 // rows
        label.append(np.tile(one, len(screen.noise)))
        before += count
    labels = np.concatenate(label)
    return [labels == k for k in np.unique(labels)]


def _held_out(screen: Screen, columns: list[np.ndarray], parts: list[np.ndarray]) -> float:
    """Share of the misfit explained in parts that neither parameters nor coefficients are fitted to."""
    check()
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
