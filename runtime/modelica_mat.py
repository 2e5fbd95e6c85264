"""Results as MAT files in the layout of Modelica tools, which their readers, MATLAB, Octave and scipy open.

The layout ("trajectory file, version 1.1, binTrans") is that of Dymola and OpenModelica: `name` and `description` are
character matrices with one name a column; `dataInfo` [4, names] says for each in which matrix it lies (1: constant, 2:
over time), in which row, negative where it is an alias of the other sign, how to interpolate (0: linear), and that
nothing is known outside the run (-1). The first row of `data_1` [rows, 2] and of `data_2` [rows, points] is time. What
equals another variable takes no room. Units stand in brackets at the end of a description.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lacuna.runtime.files import with_metadata
from lacuna.runtime.result import Result

_HEADER = ("Atrajectory", "1.1", "", "binTrans")
_CONSTANT, _VARYING = 1, 2


def write_mat(result: Result, path: str | Path, names: Sequence[str] | None = None) -> Path:
    """Write `path` (MATLAB 4, `names` over time, by default what was recorded, and all parameters) and .meta.json."""
    from scipy.io import savemat

    path = Path(path)
    names = result.columns if names is None else list(names)
    table = _Table(result)
    for name in dict.fromkeys([*names, *result.parameters]):
        table.add(name)
    content = {
        "Aclass": _characters(_HEADER),
        "name": np.ascontiguousarray(_characters(table.names).T),  # scipy writes the characters as they lie in memory
        "description": np.ascontiguousarray(_characters(table.descriptions).T),
        "dataInfo": np.array(table.info, dtype=np.int32).T,
        "data_1": np.array(table.constant, dtype=float),
        "data_2": np.array(table.varying, dtype=float),
    }
    with with_metadata(result, path, names) as place:
        savemat(place, content, appendmat=False, format="4")
    return path


class _Table:
    """Names and the rows that they share."""

    def __init__(self, result: Result) -> None:
        self._result = result
        ends = result.time[[0, -1]] if len(result) else np.zeros(2)
        self.names, self.descriptions, self.info = ["time"], ["time [s]"], [[0, 1, 0, -1]]
        self.constant, self.varying = [ends], [result.time]
        self._rows: dict[tuple[str, int], tuple[int, int]] = {}  # storage -> row of data_2, sign of its first name

    def add(self, name: str) -> None:
        v = self._result.model.variables[name]
        self.names.append(name)
        self.descriptions.append(f"{v.description} [{v.shown_unit}]".strip() if v.shown_unit else v.description)
        if v.kind == "parameter":
            self.constant.append(np.full(2, self._result.parameters[name]))
            self.info.append([_CONSTANT, len(self.constant), 0, 0])
            return
        if (v.kind, v.index) not in self._rows:
            self.varying.append(self._result[name])
            self._rows[v.kind, v.index] = len(self.varying), v.sign
        row, sign = self._rows[v.kind, v.index]
        self.info.append([_VARYING, row * sign * v.sign, 0, -1])


def _characters(texts: Sequence[str]) -> np.ndarray:
    """[texts, characters], padded by blanks; beyond ASCII the bytes of UTF-8, one a character."""
    encoded = [text.encode("utf-8").decode("latin-1") for text in texts]
    width = max(1, *map(len, encoded))
    return np.array([list(text.ljust(width)) for text in encoded], dtype="U1")
