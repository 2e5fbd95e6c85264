"""What keeps a model from becoming an FMU."""

from __future__ import annotations


class FmuError(Exception):
    """Something that the caller can put right; the message says what and how."""

    user_error = True
