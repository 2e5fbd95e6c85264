"""Matching and strongly connected components on random graphs, against brute force."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.structure.sorting.matching import Matching


@st.composite
def graphs(draw: st.DrawFn, square: bool = False) -> tuple[list[list[int]], int]:
    rows = draw(st.integers(1, 12))
    columns = rows if square else draw(st.integers(1, 12))
    return draw(st.lists(st.lists(st.integers(0, columns - 1), unique=True, max_size=4).map(sorted),
                         min_size=rows, max_size=rows)), columns  # fmt: skip


def dense(graph: list[list[int]], columns: int) -> np.ndarray:
    matrix = np.zeros((len(graph), columns), dtype=int)
    for row, targets in enumerate(graph):
        matrix[row, targets] = 1
    return matrix


@given(graphs())
def test_matching_is_maximum(graph: tuple[list[list[int]], int]) -> None:
    rows, columns = graph
    matching = Matching(rows, columns)
    unmatched = matching.match_all()
    best = maximum_bipartite_matching(csr_matrix(dense(rows, columns)), perm_type="column")
    assert len(unmatched) == int(np.sum(best < 0))
    for row, column in enumerate(matching.column_of):
        assert column < 0 or (column in rows[row] and matching.row_of[column] == row)


@given(graphs())
def test_overdetermined_part_has_too_many_rows(graph: tuple[list[list[int]], int]) -> None:
    rows, columns = graph
    matching = Matching(rows, columns)
    unmatched = matching.match_all()
    over_rows, over_columns = matching.overdetermined(unmatched)
    assert len(over_rows) - len(over_columns) == len(unmatched)
    assert {c for r in over_rows for c in rows[r]} == set(over_columns)


@given(graphs(square=True))
def test_components_are_the_strong_ones_in_order(graph: tuple[list[list[int]], int]) -> None:
    needs, size = graph
    components = strong_components(needs)
    count, labels = connected_components(csr_matrix(dense(needs, size)), directed=True, connection="strong")
    assert len(components) == count
    assert all(len({labels[k] for k in component}) == 1 for component in components)
    position = {node: k for k, component in enumerate(components) for node in component}
    assert all(position[other] <= position[node] for node in range(size) for other in needs[node])
