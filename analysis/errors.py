"""The one exception of this stage: a recording, a setting or a map that cannot be used."""


class AnalysisError(Exception):
    """Something the user can put right; the message says what and where."""

    user_error = True
