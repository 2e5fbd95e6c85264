"""What a user can put right is said in a sentence; every stage marks such exceptions with `user_error = True`."""

from __future__ import annotations

from collections.abc import Iterable


class UserError(Exception):
    """Something that the caller can put right; the message says what and how."""

    user_error = True


def is_user_error(error: BaseException) -> bool:
    """Whether the message is all that a user needs: refusals of any stage, files that cannot be read, a model or file
    that is larger than the memory."""
    return isinstance(error, OSError | MemoryError) or bool(getattr(error, "user_error", _leads_nowhere(error)))


def _leads_nowhere(error: BaseException) -> bool:
    """Of a symbolic link that leads to itself pathlib makes a RuntimeError up to Python 3.12."""
    return isinstance(error, RuntimeError) and str(error).startswith("Symlink loop from ")


def message_of(error: BaseException) -> str:
    """The message of a user's error; a finding about a model has its place, code and hint."""
    if isinstance(error, OSError) and error.filename:
        return f"error: {error.filename}: {error.strerror}"
    if isinstance(error, MemoryError):
        return f"error: there is not enough memory for this{f': {error}' if str(error) else ''}"
    text = str(error)
    if _leads_nowhere(error):
        return f"error: {text.removeprefix('Symlink loop from ').strip(chr(39))}: a symbolic link that leads to itself"
    return text if "error[" in text.splitlines()[0] or text.startswith("error") else f"error: {text}"


def nearest(name: str, valid: Iterable[str]) -> str:
    """The end of a refusal of `name`: the valid names that may be meant, or else some that there are."""
    from lacuna.suggest import suggestion

    return suggestion(name, valid)
