"""Classes to one flat model. `flatten` is the list of passes."""

from .model import flatten

__all__ = ["flatten"]
