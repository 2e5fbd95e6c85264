"""Results as `lacuna simulate` writes them, read back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.rows import rows_of


def read_result(path: Path | str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Columns by name, `time` first, and what the .meta.json beside the file says."""
    (_, names), *rows = rows_of(Path(path).read_text(encoding="utf-8"))
    table = np.array([[float(cell) for cell in row] for _, row in rows]).reshape(-1, len(names))
    meta = json.loads(Path(path).with_suffix(".meta.json").read_text(encoding="utf-8"))
    return dict(zip(names, table.T, strict=True)), meta
