"""Scalar expressions and what is done to them: dependence, values, derivatives, rewriting."""
