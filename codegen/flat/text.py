"""A flat model as readable text, close to Modelica: for dumps, golden files and messages."""

from __future__ import annotations

from collections.abc import Iterator

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import TRUE, Expr, to_text


def dump_flat(model: flat.FlatModel) -> str:
    """Declarations, equations, statements and functions of `model`, one a line, in order."""
    lines = [f"class {model.name}" + _quoted(model.description)]
    lines += ["  " + _declaration(v) for v in model.variables.values()]
    for title, equations in (("initial equation", model.initial_equations), ("equation", model.equations)):
        if equations:
            lines.append(title)
            lines += [f"  {equation_text(e)};{_place(e)}" for e in equations]
    for when in model.whens:
        lines += _indent(_statement(when))
    lines += ["  " + line for a in model.asserts for line in _statement(a)]
    for algorithm in model.algorithms:
        lines.append("algorithm")
        lines += [line for s in algorithm.statements for line in _indent(_statement(s))]
    for function in model.functions.values():
        lines += _function(function)
    lines.append(f"end {model.name};")
    return "\n".join(lines) + "\n"


def equation_text(e: flat.Equation) -> str:
    """left = right"""
    left = to_text(e.lhs)
    return f"({left}) = {to_text(e.rhs)}" if e.lhs.op == "if" else f"{left} = {to_text(e.rhs)}"


def _quoted(text: str) -> str:
    return ' "' + text.replace("\\", "\\\\").replace('"', '\\"') + '"' if text else ""


def _place(e: flat.Equation) -> str:
    where = f"  // {e.span.line}"
    return f"{where} in {e.origin}" if e.origin else where


def _declaration(v: flat.Variable) -> str:
    prefix = ""
    if v.variability in (flat.CONSTANT, flat.PARAMETER) or (v.variability == flat.DISCRETE and v.type == "Real"):
        prefix = v.variability + " "
    if v.final:
        prefix = "final " + prefix
    if v.causality != "local":
        prefix = v.causality + " " + prefix
    attributes = [f"{k} = {to_text(e)}" for k in ("start", "fixed", "min", "max", "nominal") if (e := getattr(v, k))]
    attributes += [f'{k} = "{text}"' for k in ("unit", "quantity") if (text := getattr(v, k))]
    if v.state_select != "default":
        attributes.append(f"stateSelect = StateSelect.{v.state_select}")
    text = f"{prefix}{v.type} {v.name}"
    text += f"({', '.join(attributes)})" if attributes else ""
    text += f" = {to_text(v.binding)}" if v.binding is not None else ""
    return text + _quoted(v.description) + ";" + ("  // structural" if v.evaluated else "")


def _indent(lines: list[str]) -> list[str]:
    return ["  " + line for line in lines]


def _body(statements: list[flat.Statement]) -> list[str]:
    return [line for s in statements for line in _indent(_statement(s))]


def _branches(first: str, then: str, other: str, branches: list[tuple[Expr, list[flat.Statement]]]) -> Iterator[str]:
    for number, (condition, body) in enumerate(branches):
        if number and condition is TRUE:
            yield "else"
        else:
            yield f"{other if number else first} {to_text(condition)} {then}"
        yield from _body(body)


def _statement(s: flat.Statement) -> list[str]:
    match s:
        case flat.Assign():
            return [f"{s.target} := {to_text(s.value)};"]
        case flat.AssignCall():
            return [f"({', '.join(t or '' for t in s.targets)}) := {to_text(s.value)};"]
        case flat.AssignElement():
            return [f"{s.target}[{', '.join(map(to_text, s.indices))}] := {to_text(s.value)};"]
        case flat.Reinit():
            return [f"reinit({s.target}, {to_text(s.value)});"]
        case flat.Assert():
            level = ", AssertionLevel.warning" if s.level == "warning" else ""
            return [f"assert({to_text(s.condition)},{_quoted(s.message)}{level});"]
        case flat.Terminate():
            return [f"terminate({_quoted(s.message).strip()});"]
        case flat.If():
            return [*_branches("if", "then", "elseif", s.branches), "end if;"]
        case flat.When():
            return [*_branches("when", "then", "elsewhen", s.branches), "end when;"]
        case flat.While():
            return [f"while {to_text(s.condition)} loop", *_body(s.body), "end while;"]
        case flat.For():
            bounds = ":".join(map(to_text, (s.first, s.step, s.last)))
            return [f"for {s.variable} in {bounds} loop", *_body(s.body), "end for;"]
        case flat.Native():
            return [f"{s.function}({', '.join(s.inputs + s.outputs)});"]
        case flat.Foreign():
            said = ", ".join(repr(what) if kind == "text" else str(what) for kind, what in s.arguments)
            return [f"{s.result + ' := ' if s.result else ''}{s.function}({said});"]
        case flat.Return():
            return ["return;"]
        case flat.Break():
            return ["break;"]
    raise TypeError(s)


def _function(f: flat.Function) -> list[str]:
    lines = [f"function {f.name}"]
    for name, kind in f.types.items():
        role = "input " if name in f.inputs else "output " if name in f.outputs else ""
        size = "[" + ", ".join(map(str, f.shapes[name])) + "]" if f.shapes[name] else ""
        default = f" := {to_text(f.defaults[name])}" if name in f.defaults else ""
        lines.append(f"  {role}{kind} {name}{size}{default};")
    return [*lines, "algorithm", *_body(f.body), f"end {f.name};"]
