"""Maximum matching of equations to unknowns by augmenting paths, and what it says about singular systems.

I. Duff, On algorithms for obtaining a maximum transversal, ACM TOMS 7 (1981) 315-330;
A. Dulmage, N. Mendelsohn, Coverings of bipartite graphs, Canad. J. Math. 10 (1958) 517-534.
"""

from __future__ import annotations

from collections.abc import Sequence


class Matching:
    """`columns[row]` lists the columns (unknowns) that occur in a row (equation)."""

    def __init__(self, columns: Sequence[Sequence[int]], column_count: int):
        self.columns = list(columns)
        self.row_of: list[int] = [-1] * column_count
        self.column_of: list[int] = [-1] * len(columns)

    def match_all(self) -> list[int]:
        """Match every row that can be; returns those that cannot."""
        for row, columns in enumerate(self.columns):
            free = next((c for c in columns if self.row_of[c] < 0), None)
            if free is not None and self.column_of[row] < 0:
                self._assign(row, free)
        return [row for row in range(len(self.columns)) if self.column_of[row] < 0 and not self.augment(row)]

    def add_row(self, columns: Sequence[int]) -> bool:
        """Append a row if it can be matched without losing another."""
        self.columns.append(columns)
        self.column_of.append(-1)
        if self.augment(len(self.columns) - 1):
            return True
        self.columns.pop()
        self.column_of.pop()
        return False

    def _assign(self, row: int, column: int) -> None:
        self.row_of[column], self.column_of[row] = row, column

    def augment(self, start: int) -> bool:
        """Breadth-first search for an augmenting path from an unmatched row."""
        reached_from: dict[int, int] = {}
        queue = [start]
        for row in queue:
            for column in self.columns[row]:
                if column in reached_from:
                    continue
                reached_from[column] = row
                owner = self.row_of[column]
                if owner < 0:
                    self._flip(column, reached_from)
                    return True
                queue.append(owner)
        return False

    def _flip(self, column: int, reached_from: dict[int, int]) -> None:
        while column >= 0:
            row = reached_from[column]
            before = self.column_of[row]
            self._assign(row, column)
            column = before

    def overdetermined(self, unmatched_rows: Sequence[int]) -> tuple[list[int], list[int]]:
        """(rows, columns) reached by alternating paths from unmatched rows: more equations than unknowns."""
        rows, columns = dict.fromkeys(unmatched_rows), dict[int, None]()
        queue = list(rows)
        for row in queue:
            for column in self.columns[row]:
                owner = self.row_of[column]
                if column not in columns and owner >= 0 and owner not in rows:
                    rows[owner] = None
                    queue.append(owner)
                columns[column] = None
        return sorted(rows), sorted(columns)

    def underdetermined(self, unmatched_columns: Sequence[int]) -> tuple[list[int], list[int]]:
        """(rows, columns) reached by alternating paths from unmatched columns: more unknowns than equations."""
        users: dict[int, list[int]] = {}
        for row, columns in enumerate(self.columns):
            for column in columns:
                users.setdefault(column, []).append(row)
        rows, columns = dict[int, None](), dict.fromkeys(unmatched_columns)
        queue = list(columns)
        for column in queue:
            for row in users.get(column, ()):
                owned = self.column_of[row]
                if row not in rows and owned >= 0 and owned not in columns:
                    columns[owned] = None
                    queue.append(owned)
                rows[row] = None
        return sorted(rows), sorted(columns)
