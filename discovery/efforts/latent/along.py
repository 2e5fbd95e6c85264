"""The linear model along one recording, and how its outputs answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lacuna.analysis.spectra.library import INTEGERS, CLinearModel, library, pointer


@dataclass
class Along:
    """The linear model along one recording, n samples, x states, y outputs, b columns (inputs, then parameters).

    From sample k to the next, x -> step[k] x + drive[k] q with q held; y = read[k] x + feed[k] q.
    """

    time: np.ndarray  # (n,)
    step: np.ndarray  # (n - 1, x, x)
    drive: np.ndarray  # (n - 1, x, b)
    read: np.ndarray  # (n, y, x)
    feed: np.ndarray  # (n, y, b)
    direct: np.ndarray  # (n, x, inputs): rates of the states to inputs, at once
    answering: np.ndarray  # (u, inputs): whether an unknown, the derivatives first, ever answers to an input at once
    values: dict[str, np.ndarray]  # of every variable, and time, (n,); of parameters a number

    def __post_init__(self) -> None:
        for name in ("time", "step", "drive", "read", "feed"):  # as the library reads them
            setattr(self, name, np.ascontiguousarray(getattr(self, name), dtype=float))

    def with_sums(self, sums: Sequence[Sequence[int]]) -> Along:
        """The same with further columns, each of which acts in several inputs at once."""
        if not sums:
            return self
        drive, feed = (
            np.concatenate([a, *(a[:, :, list(own)].sum(axis=2, keepdims=True) for own in sums)], axis=2)
            for a in (self.drive, self.feed)
        )
        return replace(self, drive=drive, feed=feed)

    def model(self, *statistics: np.ndarray) -> CLinearModel:
        """The same for the library's filters, with the standard deviations of noise (y,) and first states (x,) where
        they are wanted. It borrows these arrays."""
        samples, outputs, states = self.read.shape
        arrays = (self.time, self.step, self.drive, self.read, self.feed, *statistics)
        return CLinearModel(samples, states, outputs, self.feed.shape[2], *map(pointer, arrays))

    def response(
        self, columns: np.ndarray | int, courses: np.ndarray, hold: bool = False, every: int = 1
    ) -> np.ndarray:
        """(n/every, y, j): outputs, at one sample in `every`, to each of j courses (n, j), course i acting in column
        columns[i], or all in one; from rest.

        Courses are linear between samples, or held. A response that runs away is no number from there on.
        """
        columns = np.broadcast_to(columns, courses.shape[1:]).astype(np.intc)
        courses = np.ascontiguousarray(courses, dtype=float)
        result = np.empty((-(-len(self.time) // every), self.read.shape[1], len(columns)))
        library().lacuna_linear_response(
            self.model(), columns.ctypes.data_as(INTEGERS), pointer(courses), len(columns), hold, every, pointer(result)
        )
        return result

    def response_transposed(self, column: int, outputs: np.ndarray, every: int = 1) -> np.ndarray:
        """(n, j): courses in a column whose products with any other course there are those of outputs (n/every, y, j)
        with the response to that."""
        outputs = np.ascontiguousarray(outputs, dtype=float)
        result = np.empty((len(self.time), outputs.shape[2]))
        library().lacuna_linear_response_transposed(
            self.model(), column, pointer(outputs), outputs.shape[2], every, pointer(result)
        )
        return result

    def from_start(self, states: list[int]) -> np.ndarray:
        """(n, y, j): outputs to each of j states being one at the first sample, nothing acting."""
        course = np.zeros((len(self.time), self.read.shape[2], len(states)))
        course[0, states, np.arange(len(states))] = 1.0
        with np.errstate(over="ignore", invalid="ignore"):  # what runs away is no number from there on
            for k, step in enumerate(self.step):
                course[k + 1] = step @ course[k]
        return self.read @ course
