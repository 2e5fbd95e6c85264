"""Run generated models: load one, simulate it, read and write results."""

from lacuna.runtime.errors import SimulationError, UnknownNameError
from lacuna.runtime.files import metadata, write_csv, write_parquet
from lacuna.runtime.model import Equation, Model, Variable
from lacuna.runtime.modelica_mat import write_mat
from lacuna.runtime.result import EventEntry, Failure, Flag, Result
from lacuna.runtime.simulation import ADAPTIVE, FIXED_STEP, SOLVERS, RecordedInput, Session, simulate

__all__ = [
    "ADAPTIVE",
    "FIXED_STEP",
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
    "metadata",
    "simulate",
    "write_csv",
    "write_mat",
    "write_parquet",
]
