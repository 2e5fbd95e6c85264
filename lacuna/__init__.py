"""Lacuna: machines as equations, simulations, health maps, and what the equations leave out.

    import lacuna
    model = lacuna.load("Actuators.EccentricBldc")
    result = model.simulate(stop=0.5, parameters={"zeta": 0.3})
    result["rotor.w"]          # rad/s
    result.plot("rotor.w")

Every name below is loaded when it is first used: `import lacuna` itself needs nothing but Python.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lacuna.campaigns import Sweep, sweep
    from lacuna.checking import Finding, check
    from lacuna.comparisons import Agreement, Comparison, compare, compare_with_file
    from lacuna.degradation import degradation_laws
    from lacuna.diagnoses import Case, Explanation, Verdict, explain, open_case
    from lacuna.drafts import Drafted, convert, new_case
    from lacuna.editor import format_file, format_model, serve_editor
    from lacuna.errors import UserError, is_user_error, message_of, nearest
    from lacuna.examples import copy_examples
    from lacuna.faults import (
        Assessment,
        CombinedMap,
        OperatingMap,
        assess,
        combined_maps,
        default_settings,
        growing_map,
        maps,
    )
    from lacuna.fleets import fleet
    from lacuna.fmus import ExportedFmu, export_fmu
    from lacuna.history import export_history, refresh, remember
    from lacuna.inputs import Input, recorded
    from lacuna.listings import Entry, list_effects, list_models, list_solvers
    from lacuna.models import Model, dump, load
    from lacuna.prognosis import Prognosis, forecast
    from lacuna.progress import Progress
    from lacuna.results import IncompleteRun, Result
    from lacuna.verification import ELSEWHERE, Verification, record_making, verify
    from lacuna.watching import watch

    __version__: str

_HOMES = {
    "campaigns": ("Sweep", "sweep"),
    "comparisons": ("Agreement", "Comparison", "compare", "compare_with_file"),
    "diagnoses": ("Case", "Explanation", "Verdict", "explain", "open_case"),
    "drafts": ("Drafted", "convert", "new_case"),
    "editor": ("format_file", "format_model", "serve_editor"),
    "errors": ("UserError", "is_user_error", "message_of", "nearest"),
    "examples": ("copy_examples",),
    "faults": (
        "Assessment",
        "CombinedMap",
        "OperatingMap",
        "assess",
        "combined_maps",
        "default_settings",
        "growing_map",
        "maps",
    ),
    "fleets": ("fleet",),
    "fmus": ("ExportedFmu", "export_fmu"),
    "history": ("export_history", "refresh", "remember"),
    "inputs": ("Input", "recorded"),
    "listings": ("Entry", "list_effects", "list_models", "list_solvers"),
    "checking": ("Finding", "check"),
    "models": ("Model", "dump", "load"),
    "progress": ("Progress",),
    "degradation": ("degradation_laws",),
    "prognosis": ("Prognosis", "forecast"),
    "results": ("IncompleteRun", "Result"),
    "verification": ("ELSEWHERE", "Verification", "record_making", "verify"),
    "watching": ("watch",),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "ELSEWHERE",
    "Agreement",
    "Assessment",
    "Case",
    "CombinedMap",
    "Comparison",
    "Drafted",
    "Entry",
    "Explanation",
    "ExportedFmu",
    "Finding",
    "IncompleteRun",
    "Input",
    "Model",
    "OperatingMap",
    "Prognosis",
    "Progress",
    "Result",
    "Sweep",
    "UserError",
    "Verdict",
    "Verification",
    "assess",
    "check",
    "combined_maps",
    "compare",
    "compare_with_file",
    "convert",
    "copy_examples",
    "default_settings",
    "degradation_laws",
    "dump",
    "explain",
    "export_fmu",
    "export_history",
    "fleet",
    "forecast",
    "format_file",
    "format_model",
    "growing_map",
    "is_user_error",
    "list_effects",
    "list_models",
    "list_solvers",
    "load",
    "maps",
    "message_of",
    "nearest",
    "new_case",
    "open_case",
    "record_making",
    "recorded",
    "refresh",
    "remember",
    "serve_editor",
    "sweep",
    "verify",
    "watch",
]


def __getattr__(name: str) -> object:
    """The public names, each from its module when it is first used."""
    if name == "__version__":
        found: object = import_module("importlib.metadata").version("lacuna")
    elif name in _HOME_OF:
        found = getattr(import_module(f"lacuna.{_HOME_OF[name]}"), name)
    else:
        raise AttributeError(f"module 'lacuna' has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
