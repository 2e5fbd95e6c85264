"""Comparison: one model, many solvers (or another tool's file), every signal set against a reference."""
