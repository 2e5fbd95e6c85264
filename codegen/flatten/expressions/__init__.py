"""Expressions of the source to scalar values."""
