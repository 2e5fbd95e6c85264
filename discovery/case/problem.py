"""What is wrong with a case."""


class CaseError(Exception):
    """A case that cannot be read: the message names the file and, where there is one, the column and the line."""

    user_error = True
