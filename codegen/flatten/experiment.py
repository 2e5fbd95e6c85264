"""annotation(experiment(...)): what a run does when nothing else is said (18.4)."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.expressions.constants import evaluate
from lacuna.codegen.flatten.expressions.lower import lower_scalar
from lacuna.codegen.flatten.names.annotations import warn, warn_of_slips
from lacuna.codegen.flatten.names.modifiers import Modifier, from_tree
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast

_FIELDS = {"StartTime": "start_time", "StopTime": "stop_time", "Tolerance": "tolerance", "Interval": "interval"}
_INTERVALS = "NumberOfIntervals"  # of other tools, in place of Interval
_END = {
    _INTERVALS: (float("inf"), "above 0"),
    "Tolerance": (1.0, "above 0 and below 1"),
    "Interval": (float("inf"), "above 0"),
}  # what it stays below


def experiment_of(top: Instance) -> flat.Experiment:
    """Of the model, or of the nearest base class that has one. Raises R030 for an entry that is given twice, R020 for a
    tolerance, an interval or an end that no run can have. Names that mean nothing are warned of; those of other tools
    begin with two underscores (18.1)."""
    result = flat.Experiment()
    for cls in top.classes:
        warn_of_slips(cls.annotation, ["experiment"], top.context)
        found = [a for a in cls.annotation.arguments if a.name == "experiment"] if cls.annotation else []
        if found:
            entries = from_tree(ast.Modification(found[0].span, arguments=found), Scope(top.context, cls, top))
            said = entries.children["experiment"].children
            known = (*_FIELDS, _INTERVALS)
            unknown = [a for a in found[0].modification.arguments if a.name not in known and a.name[:2] != "__"]
            warn(unknown, "an experiment has no {}", list(_FIELDS), top.context)
            for name, entry in said.items():
                if name in _FIELDS and entry.value is not None:
                    setattr(result, _FIELDS[name], _number(name, entry, top))
            if "StopTime" in said:
                _refuse_backwards(result, found[0])
            if _INTERVALS in said and "Interval" not in said and result.stop_time > result.start_time:
                span = result.stop_time - result.start_time
                result.interval = span / _number(_INTERVALS, said[_INTERVALS], top)
            return result
    return result


def _refuse_backwards(given: flat.Experiment, annotation: ast.Argument) -> None:
    if given.stop_time < given.start_time:
        what = f"the experiment stops at {given.stop_time:g} s, before it starts at {given.start_time:g} s"
        raise Diagnostic("R020", what, annotation.span, "give a StopTime after the StartTime")


def _number(name: str, entry: Modifier, top: Instance) -> float:
    value = lower_scalar(entry.value, entry.scope, ex.REAL)
    number = float(evaluate(value, top.context, entry.span, name).value)
    end, bounds = _END.get(name, (0.0, ""))
    if bounds and not 0 < number < end:
        raise Diagnostic("R020", f"{name} of the experiment is {number:g}", entry.span, f"it is {bounds}")
    return number
