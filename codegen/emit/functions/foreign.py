"""A call of external C in the generated file: values in the types that C has for them, and a way out of it."""

from __future__ import annotations

from collections.abc import Callable
import math

from lacuna.codegen import flat
from lacuna.codegen.emit.text.c_text import LONGEST, c_string
from lacuna.codegen.flat.foreign import Foreign, ForeignCode
from lacuna.codegen.symbolic.expr import REAL

UTILITIES = """\
/* What ModelicaUtilities.h declares (Modelica 3.6, 12.9.7): messages go to stderr, an error ends the call. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static _Thread_local jmp_buf mdl_escape;

_Noreturn void ModelicaError(const char *text);
_Noreturn void ModelicaFormatError(const char *format, ...);
_Noreturn void ModelicaVFormatError(const char *format, va_list arguments);
void ModelicaMessage(const char *text);
void ModelicaFormatMessage(const char *format, ...);
void ModelicaVFormatMessage(const char *format, va_list arguments);
void ModelicaWarning(const char *text);
void ModelicaFormatWarning(const char *format, ...);
void ModelicaVFormatWarning(const char *format, va_list arguments);
char *ModelicaAllocateString(size_t length);
char *ModelicaAllocateStringWithErrorReturn(size_t length);
char *ModelicaDuplicateString(const char *text);

#define MDL_SAY(name, prefix, leave) \\
  void Modelica##name(const char *text) { \\
    fprintf(stderr, prefix "%s\\n", text); \\
    leave \\
  } \\
  void ModelicaVFormat##name(const char *format, va_list arguments) { \\
    fputs(prefix, stderr); \\
    vfprintf(stderr, format, arguments); \\
    fputc('\\n', stderr); \\
    leave \\
  } \\
  void ModelicaFormat##name(const char *format, ...) { \\
    va_list arguments; \\
    va_start(arguments, format); \\
    ModelicaVFormat##name(format, arguments); \\
    va_end(arguments); \\
    leave \\
  }
MDL_SAY(Error, "error: ", longjmp(mdl_escape, 1);)
MDL_SAY(Warning, "warning: ", )
MDL_SAY(Message, "", )

char *ModelicaAllocateStringWithErrorReturn(size_t length) { return calloc(length + 1, 1); }

char *ModelicaAllocateString(size_t length) {
  char *text = ModelicaAllocateStringWithErrorReturn(length);
  if (!text) ModelicaError("out of memory");
  return text;
}

char *ModelicaDuplicateString(const char *text) {
  return strcpy(ModelicaAllocateString(strlen(text)), text);
}"""


def foreign_texts(code: ForeignCode) -> list[str]:
    """What stands at the head of the file; nothing where no external C is called."""
    return [UTILITIES, *code.texts] if code.spans else []


def foreign_lines(s: Foreign, f: flat.Function, c_name: Callable[[str], str], failed: str) -> list[str]:
    """The call, in a block of its own; `failed` is what to do where it ends in an error."""
    before: list[str] = []
    after: list[str] = []
    arguments, types = [], []
    for number, (kind, what) in enumerate(s.arguments):
        if kind != "variable":
            arguments.append(_c_text(str(what)) if kind == "text" else str(what))
            types.append("const char *" if kind == "text" else "int")
            continue
        name, base = str(what), _c_type(f, str(what))
        own, shape, set_ = f"arg_{number}", f.shapes[name], name in s.places
        if not shape and not set_:
            arguments.append(f"({base}){c_name(name)}")
            types.append(base)
        elif not shape:
            before.append(f"{base} {own} = ({base}){c_name(name)};")
            after.append(f"{c_name(name)} = {own};")
            arguments.append(f"&{own}")
            types.append(f"{base} *")
        else:
            count = math.prod(shape)
            before.append(f"{base} {own}[{max(1, count)}];")
            before.append(f"for (int i = 0; i < {count}; ++i) {own}[i] = ({base}){c_name(name)}[i];")
            if set_:
                after.append(f"for (int i = 0; i < {count}; ++i) {c_name(name)}[i] = {own}[i];")
            arguments.append(own)
            types.append(f"{'' if set_ else 'const '}{base} *")
    call = f"{s.function}({', '.join(arguments)})"
    returned = "void" if s.result is None else _c_type(f, s.result)
    declaration = [] if s.declared else [f"extern {returned} {s.function}({', '.join(types) or 'void'});"]
    stored = call if s.result is None else f"{c_name(s.result)} = {call}"
    if s.result is not None and f.types[s.result] == "Boolean":
        stored = f"{c_name(s.result)} = {call} != 0"
    inner = [*declaration, *before, f"if (setjmp(mdl_escape)) {{ {failed} }}", f"{stored};", *after]
    return ["{", *(f"  {line}" for line in inner), "}"]


def _c_text(text: str) -> str:
    """A literal of any length, in pieces that are not cut."""
    pieces = [text[k : k + LONGEST] for k in range(0, len(text), LONGEST)] or [""]
    return " ".join(map(c_string, pieces))


def _c_type(f: flat.Function, name: str) -> str:
    return "double" if f.types[name] == REAL else "int"
