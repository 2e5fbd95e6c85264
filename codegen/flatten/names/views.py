"""Classes as they are seen from a class that redeclares some of what is inside them (Modelica 3.6, 7.3).

A view is a class of its own: it shares what is written in its `origin`, and looks its names up with other classes in
place of the redeclared ones. So `Medium.density` of a redeclared package, called in a class inherited from elsewhere,
is found by the one look-up of names that there is.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast

Redeclared = dict[str, ast.Class]


def view(
    library: Library,
    cls: ast.Class,
    parent: ast.Class | None,
    redeclared: Redeclared | None = None,
    whole: ast.Class | None = None,
    written: object = None,
) -> ast.Class:
    """`cls` inside `parent`, with `redeclared` in place of its own classes; equal arguments give the same object.

    `whole` is the class that inherits it: constants are taken from there. `written` is the scope in which its
    modifications stand where that is not the class around it.
    """
    origin = cls.origin or cls
    holding = {**cls.redeclared, **(redeclared or {})}
    key = (id(origin), id(parent), tuple((n, id(c)) for n, c in sorted(holding.items())), id(whole), id(written),
           id(cls.constrained), cls.inner, cls.outer)  # fmt: skip
    found = library.views.get(key)
    if found is None:
        found = replace(
            origin, origin=origin, parent=parent, redeclared=holding, whole=whole, written=written or cls.written,
            constrained=cls.constrained, inner=cls.inner, outer=cls.outer,
        )  # fmt: skip
        library.views[key] = found
        found.number = library.count_path(found.path)
        library.kept += [origin, parent, whole, written, holding, cls.constrained]  # their identities name the view
    return found


def member(library: Library, cls: ast.Class, name: str) -> ast.Class | None:
    """The class `name` declared directly in `cls`, which may be a view."""
    if cls.origin is None:
        return library.member(cls, name)
    found = library.member(cls.origin, name)
    return None if found is None else view(library, found, cls)


def is_specialised(cls: ast.Class) -> bool:
    """Does `cls` decide about classes or constants of what it inherits?"""
    own = any(c.redeclares for c in cls.classes.values())
    return own or cls.origin is not None or any(c.redeclares for c in cls.components)


def redeclarations(library: Library, cls: ast.Class, tree: ast.Modification) -> dict[str, tuple[ast.Class, bool]]:
    """What the modification of an extends clause or a short definition in `cls` redeclares among the classes of the
    base, and what `cls` itself declares in their place: the class, and whether `cls` declares it."""
    scope = cls.parent if cls.alias is not None else cls
    found = {}
    for argument in tree.arguments:
        if isinstance(argument.redeclare, ast.Class):
            found[argument.name] = (view(library, argument.redeclare, scope, written=cls.written), False)
    for name, nested in cls.classes.items():
        if nested.redeclares:
            found[name] = (member(library, cls, name), True)
    return found


def modified(library: Library, cls: ast.Class, tree: ast.Modification, written: object, scope: ast.Class) -> ast.Class:
    """`cls` with modifications of its own: a short class definition that nobody wrote. `scope` is the class around."""
    key = (id(cls), id(tree), id(written), id(scope))
    found = library.views.get(key)
    if found is None:
        alias = ast.Alias(tree.span, ast.Ref(tree.span, (cls.name,), (None,)), [], tree, target=cls)
        found = ast.Class(cls.span, cls.kind, cls.name, alias=alias, parent=scope, written=written)
        library.views[key] = found
        found.number = library.count_path(found.path)
        library.kept += [cls, tree, written, scope]
    return found


def _as_far(library: Library, new: ast.Class, old: ast.Class) -> ast.Class:
    """`new` as inner or outer as the `old` that it stands for: a redeclaration cannot say it (7.3)."""
    if (new.inner, new.outer) == (old.inner, old.outer):
        return new
    key = (id(new), old.inner, old.outer, "as far")
    found = library.views.get(key)
    if found is None:
        found = library.views[key] = replace(new, origin=new.origin or new, inner=old.inner, outer=old.outer)
        found.number = library.count_path(found.path)
        library.kept.append(new)
    return found


def constraints_of(cls: ast.Class) -> list[tuple[ast.Modification, ast.Class]]:
    """What constraining clauses say of `cls`, with where it stands: its own, then that of the class it stands for. The
    declared class keeps to its clause as those do that are redeclared in its place (7.3.2)."""
    own = cls.constraint
    found = [(own.modification, cls.parent)] if own is not None and cls.parent is not None else []
    return [*found, *([cls.constrained] if cls.constrained is not None else [])]


def constrain(library: Library, new: ast.Class, old: ast.Class, by_element: bool) -> ast.Class:
    """`new` in place of the replaceable class `old`: the modifications of the constraining clause hold for it.

    Raises R033 where `old` is not replaceable, R037 where one of them only is protected.
    """
    if new.alias is not None and new.alias.target is not None:
        return new
    if old.outer and new.inner and not by_element:
        return new  # what the outer class means
    if (old.origin or old) is (new.origin or new):
        return old  # put there by the base class, which is seen with the same redeclarations
    if not old.replaceable or old.final:
        hint = "declare it with 'replaceable'"
        error = Diagnostic("R033", f"{old.name} is not replaceable", new.span, hint)
        error.notes.append((old.span, "declared here"))
        raise error
    if by_element and new.protected != old.protected:
        hint = "declare both public, or both protected"
        raise Diagnostic("R037", f"{old.name} and what stands for it differ in visibility", new.span, hint)
    if by_element and new.extends_same is not None:
        return new
    new = _as_far(library, new, old)
    first = old
    while first.constraint is None and first.stands_for is not None:
        first = first.stands_for
    clause = first.constraint or first.alias  # a short definition is its own constraining clause (7.3.2)
    if clause is None or not clause.modification.arguments or first.parent is None:
        return new
    key = (id(new), id(first), "constrained")
    found = library.views.get(key)
    if found is None:
        found = replace(new, origin=new.origin or new, constrained=(clause.modification, first.parent))
        library.views[key] = found
        found.number = library.count_path(found.path)
        library.kept += [new, first]
    return found
