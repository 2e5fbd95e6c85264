"""A model that `--watch` follows, and how long a test waits for what is seen of it."""

from __future__ import annotations

from pathlib import Path

MODEL = """model Tank
  Real h(start=1, fixed=true);
equation
  der(h) = -h;
  annotation(experiment(StopTime=1));
end Tank;
"""
PATIENCE = 60  # s, of a machine with much to do


def written(folder: Path) -> Path:
    """The model in a file."""
    path = folder / "Tank.mo"
    path.write_text(MODEL, encoding="utf-8")
    return path
