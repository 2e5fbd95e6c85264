"""Names in expressions, and what they refer to."""
