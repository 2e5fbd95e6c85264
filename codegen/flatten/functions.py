from ..errors import Diagnostic
def run(name, args, context, span): raise Diagnostic("F099","todo",span)
def call_function(cls, e, scope): raise Diagnostic("F099","todo",e.span)
def construct_record(cls, e, scope): raise Diagnostic("F099","todo",e.span)
