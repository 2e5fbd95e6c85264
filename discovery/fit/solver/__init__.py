"""Weighted nonlinear least squares."""
