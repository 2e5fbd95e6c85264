"""Classes to one flat model. `flatten` is the list of passes."""

from lacuna.codegen.flatten import calls, references  # noqa: F401  (they enter how calls and names are lowered)
from lacuna.codegen.flatten.model import flatten

__all__ = ["flatten"]
