"""Lacuna: machines as equations, simulations, health maps, and what the equations leave out."""

from importlib.metadata import version as _version

__version__ = _version("lacuna")
