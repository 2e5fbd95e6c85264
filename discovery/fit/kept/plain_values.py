"""Results as data: a tree of JSON beside arrays of numbers in one .npz file. Nothing in such a file is ever run."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
import json
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Estimate

_CLASSES = {cls.__name__: cls for cls in (Estimate, Free)}  # what may be made again from a file
_NUMBERS = "biuf"


def to_tree(value: Any, arrays: list[np.ndarray], any_class: bool = False) -> Any:
    """`value` with its arrays moved into `arrays`. Raises TypeError for what is no plain value.

    `any_class`: dataclasses that cannot be made again are taken, too, as for a digest.
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return {"float": value.hex()}
    if isinstance(value, np.generic):
        return to_tree(value.item(), arrays, any_class)
    if isinstance(value, np.ndarray) and value.dtype.kind in _NUMBERS:
        arrays.append(value)
        return {"array": len(arrays) - 1}
    if isinstance(value, list | tuple):
        kind = "tuple" if isinstance(value, tuple) else "list"
        return {kind: [to_tree(item, arrays, any_class) for item in value]}
    if isinstance(value, dict) and all(isinstance(key, str) for key in value):
        return {"dict": {key: to_tree(item, arrays, any_class) for key, item in value.items()}}
    name = type(value).__name__
    if is_dataclass(value) and not isinstance(value, type) and (any_class or name in _CLASSES):
        content = {f.name: to_tree(getattr(value, f.name), arrays, any_class) for f in fields(value)}
        return {"class": name, "fields": content}
    raise TypeError(f"{name} is no plain value")


def from_tree(tree: Any, arrays: list[np.ndarray]) -> Any:
    """The value of a tree. Raises ValueError, KeyError or TypeError where the tree is none of ours."""
    if not isinstance(tree, dict):
        return tree
    if "class" in tree:
        content = {name: from_tree(item, arrays) for name, item in tree["fields"].items()}
        return _CLASSES[tree["class"]](**content)
    ((kind, content),) = tree.items()
    if kind == "float":
        return float.fromhex(content)
    if kind == "array":
        return arrays[content]
    if kind == "dict":
        return {key: from_tree(item, arrays) for key, item in content.items()}
    if kind in ("list", "tuple"):
        items = [from_tree(item, arrays) for item in content]
        return tuple(items) if kind == "tuple" else items
    raise ValueError(f"{kind} is no kind of value")


def save(path: Path, value: Any) -> None:
    """Raises TypeError for what is no plain value."""
    arrays: list[np.ndarray] = []
    tree = to_tree(value, arrays)
    np.savez(path, tree=np.array(json.dumps(tree)), **{f"a{k}": array for k, array in enumerate(arrays)})


def load(path: Path) -> Any:
    """Raises OSError, ValueError, KeyError, TypeError or BadZipFile where the file is missing or damaged."""
    with np.load(path, allow_pickle=False) as content:
        arrays = [content[f"a{k}"] for k in range(len(content.files) - 1)]
        return from_tree(json.loads(str(content["tree"])), arrays)
