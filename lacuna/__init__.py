"""Lacuna: machines as equations, simulations, health maps, and what the equations leave out."""

from importlib.metadata import version as _version

__version__ = _version("lacuna")


def __getattr__(name: str):
    """Names of the face that bring a stage with them: imported when first asked for."""
    if name == "forecast":
        from lacuna.prognosis import forecast

        return forecast
    raise AttributeError(f"module 'lacuna' has no attribute {name!r}")
