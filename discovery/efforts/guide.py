"""The model led along the data by the effort at a place: Gauss-Newton on its course, damped where it goes too far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.smoother import acting, courses
from lacuna.discovery.efforts.latent.thinned import thinned_all
from lacuna.discovery.efforts.located import Locator, Site, response
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.side_by_side import side_by_side
from lacuna.runtime import SimulationError

Efforts = list[list[tuple[int, np.ndarray]]]  # of each recording: column of the drive, course

RUNS = 20  # of the model at most: those of a step to a thousandth and back to a whole one


@dataclass
class Guided:
    """The model led along the data by an effort at one place: where laws are screened."""

    point: dict[str, float]
    pieces: list[Piece]
    efforts: list[np.ndarray]  # (n,) on each recording
    mean: np.ndarray
    latent: Latent

    @cached_property
    def thin(self) -> list[Piece]:
        """The pieces for a search over many laws."""
        return thinned_all(self.pieces)


def guide(locator: Locator, site: Site) -> Guided:
    """The model led along the data by the effort at a place, linearised anew about the run that it gives.

    The effort alone leads it, from parameters as they are. Led by both, parameters go where no machine has them, since
    an effort that jumps costs by its prior what an inertia that jumps with it does not; what is then left for a law is
    the effort beside a wrong machine. They follow while the evidence about the runs so led rises.
    """
    latent = locator.latent(site)
    point, pieces, mean = _followed(locator, latent, _nearer(locator, latent))
    efforts = courses(pieces, latent, mean)
    site.effort = {r.name: (r.time, e, s) for r, (e, s) in zip(locator.case.fit, efforts, strict=True)}
    return Guided(point, pieces, [e for e, _ in efforts], mean, latent)


def _nearer(locator: Locator, latent: Latent) -> list[Piece]:
    """The linear models about runs that the effort leads ever nearer to the data: noise is taken for as large as the
    misfit, then for the geometric mean of both, which leaves the rest to the last estimate. A step is halved where the
    run ends further from the data, and doubled where it does not, until a whole one is taken: an effort that is right
    to first order may starve a culture, or stall a rotor, when it acts."""
    held = np.array([locator.point[f.name] - f.centre for f in locator.free]) / locator.sigma
    pieces, level, power, step = locator.pieces, _level(locator), 1.0, 1.0
    missed, efforts = _missed(locator, pieces, [[] for _ in pieces]), None
    for _ in range(RUNS):
        coarse = [replace(p, noise=locator.noise * level**power) for p in pieces]
        trial = _towards(efforts, acting(coarse, latent, held), step)
        try:
            led = _led(locator, locator.point, trial)
            now = _missed(locator, led, trial)
        except (SimulationError, np.linalg.LinAlgError):
            now = np.inf
        if now > missed:
            step /= 2
            continue
        done = step == 1.0 and power < 1.0 and now > 0.5 * missed  # a whole step that does not halve it is the last
        pieces, missed, efforts = led, now, trial
        if done:
            break
        power, step = 0.5 if step == 1.0 else power, min(1.0, 2 * step)
    return pieces


def _towards(efforts: Efforts | None, aim: Efforts, step: float) -> Efforts:
    """A part of the way from efforts, at first none, to others."""
    if efforts is None:
        return [[(column, step * end) for column, end in own] for own in aim]
    pairs = zip(efforts, aim, strict=True)
    return [
        [(column, start + step * (end - start)) for (_, start), (column, end) in zip(before, after, strict=True)]
        for before, after in pairs
    ]


def _followed(
    locator: Locator, latent: Latent, pieces: list[Piece]
) -> tuple[dict[str, float], list[Piece], np.ndarray]:  # fmt: skip
    """(parameters, linear models, estimate of the parameters in units of belief) once these have followed."""
    told, point = evidence(thinned_all(pieces), latent), locator.point
    while True:
        trial = locator.point | _values(locator.free, locator.sigma, told.mean[0])
        try:
            led = _led(locator, trial, acting(pieces, latent, told.mean[0]))
        except SimulationError:
            return point, pieces, told.mean[0]
        now = evidence(thinned_all(led), latent)
        if not now.log[0] > told.log[0] + 1.0:  # nat: less is nothing
            return point, pieces, told.mean[0]
        told, point, pieces = now, trial, led


def _led(locator: Locator, point: dict[str, float], efforts: Efforts) -> list[Piece]:
    """The linear model about the runs from `point` with these efforts on each recording."""
    return side_by_side(lambda one: locator.piece(point, *one), list(zip(locator.case.fit, efforts, strict=True)))


def _missed(locator: Locator, led: Sequence[Piece], efforts: Efforts) -> float:
    """What runs that efforts lead leave of the data, in units of noise, once parameters have taken what is theirs to
    first order: a winder that drifts from where it was says nothing of its rope."""
    left = np.concatenate([p.data[:, :, 0] - response(p.along, e) for p, e in zip(led, efforts, strict=True)])
    slopes = np.concatenate([p.data[:, :, 1:] for p in led])
    known = np.isfinite(left)
    noise = np.broadcast_to(locator.noise, left.shape)[known]
    rows = np.vstack([slopes[known] / noise[:, None], np.eye(slopes.shape[2])])
    aim = np.concatenate([left[known] / noise, np.zeros(slopes.shape[2])])
    return float(np.linalg.norm(aim - rows @ np.linalg.lstsq(rows, aim, rcond=None)[0]) / np.sqrt(known.sum()))


def _level(locator: Locator) -> np.ndarray:
    """RMS of each output over all samples, in units of its noise, at least one."""
    left = np.concatenate([p.data[:, :, 0] for p in locator.pieces]) / locator.noise
    return np.maximum(1.0, np.sqrt(np.nanmean(left**2, axis=0)))


def _values(free: list[Free], sigma: np.ndarray, mean: np.ndarray) -> dict[str, float]:
    return {f.name: f.clip(f.centre + s * m) for f, s, m in zip(free, sigma, mean, strict=True)}
