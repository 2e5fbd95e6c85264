"""Operators that the passes take apart: homotopy, delay, spatialDistribution."""
