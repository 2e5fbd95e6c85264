"""Run generated models: load one, simulate it, read and write results."""

from lacuna.runtime.errors import SimulationError, UnknownNameError
from lacuna.runtime.files import read_csv, write_csv, write_mat
from lacuna.runtime.model import Equation, Model, Variable
from lacuna.runtime.result import EventEntry, Failure, Flag, Result
from lacuna.runtime.simulation import SOLVERS, RecordedInput, Session, simulate

__version__ = "0.1.0"
__all__ = [
    "SOLVERS",
    "Equation",
    "EventEntry",
    "Failure",
    "Flag",
    "Model",
    "RecordedInput",
    "Result",
    "Session",
    "SimulationError",
    "UnknownNameError",
    "Variable",
    "read_csv",
    "simulate",
    "write_csv",
    "write_mat",
]
