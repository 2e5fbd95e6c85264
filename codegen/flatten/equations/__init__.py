"""Sections of equations and algorithms to scalar equations and statements."""
