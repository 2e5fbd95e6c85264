"""Choices of groups, each beside each of many others: what they leave, and their coefficients, from products alone.

To find the columns of a group takes a filter's run; thousands of pairs are looked at, and all that they ask for is in
the products of the one's basis with the other's columns.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from lacuna.discovery.efforts.laws.metric import Bases, Metric


class Beside:
    """`several` choices with `others`; of each metric the bases of the choices and their products (all, terms) with the
    columns of the others."""

    def __init__(
        self, metrics: Sequence[Metric], several: Sequence[tuple[int, ...]], others: Sequence[int],
        bases: Sequence[Bases], products: Sequence[np.ndarray],
    ) -> None:  # fmt: skip
        self.metrics, self.bases, self.products = metrics, bases, products
        self.several = {chosen: k for k, chosen in enumerate(several)}
        counts = [len(metrics[0].onto[g]) for g in others]
        self.others = {g: (k, int(at)) for k, (g, at) in enumerate(zip(others, np.cumsum([0, *counts]), strict=False))}

    @cached_property
    def deviances(self) -> np.ndarray:
        """(several, metrics, others) of each choice with each of the others."""
        numbers = list(self.others)
        found = [m.deviances(b, numbers, p) for m, b, p in zip(self.metrics, self.bases, self.products, strict=True)]
        return np.stack(found, axis=1)

    def holds(self, chosen: tuple[int, ...], other: int) -> bool:
        return chosen in self.several and other in self.others

    def solution(self, chosen: tuple[int, ...], other: int) -> tuple[int, np.ndarray, np.ndarray]:
        """(the metric in which they leave least, coefficients of the choice, those of the other beside it)."""
        n, (place, at) = self.several[chosen], self.others[other]
        k = int(np.argmin(self.deviances[n, :, place]))
        count = len(self.metrics[k].onto[other])
        return k, *self.metrics[k].together(self.bases[k], n, other, self.products[k][:, at : at + count])
