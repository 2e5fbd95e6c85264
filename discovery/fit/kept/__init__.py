"""Expensive results on disk, as plain data."""
