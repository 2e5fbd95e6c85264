"""Random expressions, functions and event programs, and a plain evaluation in Python that says what they are worth."""
