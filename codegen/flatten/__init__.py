"""Classes to one flat model. `flatten` is the list of passes."""

from lacuna.codegen.flatten.model import flatten

__all__ = ["flatten"]
