"""Models for other tools: an FMU is a generated model with the runtime around it (README.md)."""

from lacuna.fmi.export import Fmu, FmuRequest, export_fmu

__all__ = ["Fmu", "FmuRequest", "export_fmu"]
