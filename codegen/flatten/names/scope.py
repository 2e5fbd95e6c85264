"""Where names are looked up: loop variables and function locals, components, then enclosing classes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.names.component import Component
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.flatten.names.views import constrain, is_specialised, member, modified, redeclarations, view
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.predefined import PREDEFINED, PRIMITIVES
from lacuna.codegen.library.search_path import WITHOUT_MODELICA
from lacuna.codegen.library.versions import not_in_copy
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


@dataclass(slots=True)
class Scope:
    context: Context
    cls: ast.Class
    instance: Component | None = None
    locals: dict[str, Value] = field(default_factory=dict)
    end: Value | None = None  # the value of `end` inside subscripts
    index_types: dict[str, tuple] = field(default_factory=dict)  # of the dimensions of a function's variables
    in_function: bool = False
    initial: bool = False  # in an initial section
    conditional: bool = False  # under a condition not known yet: what cannot be computed may never be asked for
    message: list[Expr] | None = None  # in the text of an assert: what varies in it
    loop: Callable[..., Value] | None = None  # makes one of a reduction at run time
    pure: bool = False  # where no impure function may be called: lasting equations, functions that are not impure

    def within(self, cls: ast.Class) -> Scope:
        """The scope of what is written in `cls`."""
        return self if cls is self.cls else replace(self, cls=cls)

    def with_locals(self, **values: Value) -> Scope:
        return replace(self, locals={**self.locals, **values})


def own_or_inherited(library: Library, cls: ast.Class, name: str, depth: int = 0) -> ast.Class | None:
    """The class `name` among those declared in `cls`, its base classes and its imports."""
    found = member(library, cls, name)
    if found is None and depth <= 30:
        for base in base_classes(library, cls):
            found = own_or_inherited(library, base, name, depth + 1)
            if found is not None:
                break
    if found is not None and name in cls.redeclared:
        return constrain(library, cls.redeclared[name], found, by_element=False)
    return found


def base_classes(library: Library, cls: ast.Class) -> list[ast.Class]:
    """Classes that `cls` extends or is an alias of; primitive types are left out."""
    known = library.bases.get(id(cls))
    if known is None:
        found = [base_class(library, cls, *clause) for clause in base_clauses(cls)]
        known = [f for f in found if f is not None]
        _refuse_circle(library, cls, known if cls.alias is not None else [])
        if len(known) == len(found):
            library.bases[id(cls)] = known
            library.kept.append(cls)
    return known


def _refuse_circle(library: Library, cls: ast.Class, bases: list[ast.Class]) -> None:
    """Raises R011 where short definitions lead back to `cls` (5.6)."""
    one = id(cls.origin or cls)
    if one in library.defining:
        raise Diagnostic("R011", f"{cls.name} is defined by itself", cls.span, "break the circle")
    library.defining.add(one)
    try:
        for base in (b for b in bases if b.alias is not None):
            base_classes(library, base)
    finally:
        library.defining.discard(one)


def base_clauses(cls: ast.Class) -> list[tuple[ast.Ref, ast.Modification]]:
    """What `cls` extends or is a short definition of, primitive types left out, with the modifications."""
    clauses = [(e.base, e.modification) for e in cls.extends]
    if cls.extends_same is not None:
        clauses.insert(0, (ast.Ref(cls.span, (cls.name,), (None,)), cls.extends_same))
    if cls.alias is not None:
        clauses.append((cls.alias.base, cls.alias.modification))
    return [(base, tree) for base, tree in clauses if str(base) not in PRIMITIVES]


def base_class(library: Library, cls: ast.Class, ref: ast.Ref, tree: ast.Modification) -> ast.Class | None:
    """The class that a clause of `cls` names, seen with what `cls` and the modifications there redeclare."""
    if cls.extends_same is not None and tree is cls.extends_same:
        base = _same_of_bases(library, cls)
    elif cls.alias is not None and cls.alias.target is not None:
        base = cls.alias.target
    else:
        base = _named_base(library, cls, ref)
    if base is None:
        return None
    redeclared = {n: new for n, (new, _) in redeclarations(library, cls, tree).items()} | cls.redeclared
    for argument in tree.arguments:
        parts = argument.redeclare is None and argument.modification.arguments
        plain = own_or_inherited(library, base, argument.name) if parts else None
        if plain is not None and argument.name not in redeclared:
            redeclared[argument.name] = modified(library, plain, argument.modification, cls.written, cls)
    redeclared = {n: _in_place_of(library, new, base, n) for n, new in redeclared.items()}
    if not redeclared and not (is_specialised(cls) or (base.kind == "package" and tree.arguments)):
        return base
    return view(library, base, base.parent, redeclared, cls.whole or cls)


def _in_place_of(library: Library, new: ast.Class, base: ast.Class, name: str) -> ast.Class:
    """A class redeclared in a modification: protected where what it stands for is, and bound by its constraining type
    where it has none of its own (7.3)."""
    old = own_or_inherited(library, base, name) if not (new.redeclares or new.stands_for) else None
    if old is None or (old.origin or old) is (new.origin or new) or (new.alias and new.alias.target):
        return new
    old = old.stands_for or old.origin or old
    key = (id(new), id(old), "in place")
    found = library.views.get(key)
    if found is None:
        hidden = new.protected or old.protected
        found = library.views[key] = replace(new, origin=new.origin or new, protected=hidden, stands_for=old)
        found.number = library.count_path(found.path)
        library.kept += [new, old]
    return found


def _named_base(library: Library, cls: ast.Class, ref: ast.Ref) -> ast.Class | None:
    """The class of an extends clause (looked up among what `cls` declares and outside of it) or of a short definition
    (looked up outside of it)."""
    if id(cls) in library.resolving:
        raise Diagnostic("R011", f"{cls.name} is defined by itself", ref.span, "break the circle")
    library.resolving.add(id(cls))
    try:
        if cls.alias is not None and cls.parent is not None:
            if cls.encapsulated and not ref.absolute:
                return PREDEFINED.get(ref.names[0])  # nothing outside is seen (4.5.2)
            return find_class(library, cls.parent, ref)
        return find_class(library, cls, ref, of_base=True)
    finally:
        library.resolving.discard(id(cls))


def _same_of_bases(library: Library, cls: ast.Class) -> ast.Class | None:
    """The inherited class that `model extends NAME` is an extension of."""
    for base in base_classes(library, cls.parent) if cls.parent is not None else ():
        plain = replace(base, redeclared={n: c for n, c in base.redeclared.items() if n != cls.name})
        found = own_or_inherited(library, plain, cls.name)
        if found is not None:
            if not found.replaceable:
                hint = "declare it with 'replaceable'"
                raise Diagnostic("R033", f"{found.name} is not replaceable", cls.span, hint)
            return found
    return None


def _imported(library: Library, cls: ast.Class, name: str) -> ast.Class | None:
    """The class that an import of `cls` brings in as `name`: a qualified one first (5.3.1). Raises R075."""
    for item in cls.imports:
        if not item.every and (item.alias or item.path.names[-1]) == name:
            return imported_class(library, item)
    found = None
    for item in cls.imports:
        if not item.every:
            continue
        package = imported_class(library, item)
        if package is None or (new := own_or_inherited(library, package, name)) is None or new.protected:
            continue
        if found is not None and found is not new:
            hint = "name the one that is meant by its full name, or import it by name"
            raise Diagnostic("R075", f"two imports bring in {name}", item.span, hint)
        found = new
    return found


def imported_class(library: Library, item: ast.Import) -> ast.Class | None:
    """The class that an import names; None where its last name is no class (a constant of a package).

    Raises R002 and R075: only packages and their public elements are imported (13.2.1).
    """
    cls = library.root
    for at, name in enumerate(item.path.names):
        found = own_or_inherited(library, cls, name)
        if found is None:
            if at and at == len(item.path.names) - 1 and not item.every:
                return None
            otherwise = WITHOUT_MODELICA if (at, name) == (0, "Modelica") else "declare it, or import its package"
            hint = did_you_mean(name, library.members(cls), not_in_copy(library, cls, name) or otherwise)
            where = f" in {cls.path}" if cls.name else ""
            raise Diagnostic("R002", f"import: there is no class {name}{where}", item.span, hint)
        last = at == len(item.path.names) - 1
        if found.protected:
            raise Diagnostic("R017", f"{name} is protected in {cls.name}", item.span, "make it public to import it")
        seen = found.encapsulated and (not last or item.every or found.kind == "package" or found.operator)
        hidden = bool(at) and not seen and not is_package_like(library, cls)
        if hidden or (last and item.every and found.kind != "package"):
            hint = "import a package, or an element of one"
            raise Diagnostic("R075", f"import: {cls.name if hidden else found.name} is no package", item.span, hint)
        cls = found
    return cls


def find_first(
    library: Library, cls: ast.Class, name: str, of_base: bool = False, outermost: bool = True
) -> ast.Class | None:
    """The class that the single name `name` means inside `cls`, looking outwards, up to the `outermost` packages."""
    key = (id(cls), name, of_base, outermost)
    found = library.meanings.get(key)
    if found is None:
        found = _look_outwards(library, cls, name, of_base, outermost)
        if found is not None and not _is_open(library, cls.parent):
            library.meanings[key] = found
            library.kept.append(cls)
    return found


def _is_open(library: Library, cls: ast.Class | None) -> bool:
    """Are the bases of the class or of one around it being looked up? What it inherits has no meaning yet (5.6.1)."""
    while cls is not None and library.resolving:
        if id(cls) in library.resolving:
            return True
        cls = cls.parent
    return False


def _look_outwards(library: Library, cls: ast.Class, name: str, of_base: bool, outermost: bool) -> ast.Class | None:
    current: ast.Class | None = cls
    while current is not None:
        if (current is cls and of_base) or (id(current) in library.resolving and current.alias is None):
            found = member(library, current, name)
        else:
            found = own_or_inherited(library, current, name)
        found = found or _imported(library, current, name)
        if found is not None:
            return found
        if current.name == name:
            return current
        if current.encapsulated:
            return PREDEFINED.get(name)
        current = current.parent
    return library.member(library.root, name) if outermost else None


def find_class(library: Library, cls: ast.Class, ref: ast.Ref, of_base: bool = False) -> ast.Class | None:
    """The class that `ref` means inside `cls`, or None."""
    if ref.absolute:
        found = library.member(library.root, ref.names[0])
    else:
        found = find_first(library, cls, ref.names[0], of_base)
    for name in ref.names[1:]:
        if found is None:
            return None
        found = class_inside(library, found, name, ref)
    return found


def class_inside(library: Library, cls: ast.Class, name: str, ref: ast.Ref) -> ast.Class | None:
    """The class `name` as `cls.name` names it from outside (5.3.2). Raises R017 and R075 for what is not to be seen."""
    found = own_or_inherited(library, cls, name)
    if found is None:
        return None
    refuse_protected(library, cls, found, ref)
    if cls.partial:
        hint = f"name it in a class that extends {cls.name}"
        raise Diagnostic("R075", f"{cls.name} is partial, {name} cannot be named in it (5.3.2)", ref.span, hint)
    if not found.encapsulated and not is_package_like(library, cls):
        hint = f"declare {name} in a package, or write 'encapsulated' before it"
        raise Diagnostic("R075", f"{cls.name} is no package, {name} cannot be named from outside", ref.span, hint)
    return found


def refuse_protected(library: Library, cls: ast.Class, found: ast.Class, ref: ast.Ref) -> None:
    """Raises R017 for a class of `cls` that is protected, or inherited by a protected extends clause (4.1, 7.1.2)."""
    if found.protected or _hidden_by_extends(library, cls, found.name):
        message, hint = f"{found.name} is protected in {cls.name}", "make it public to use it here"
        error = Diagnostic("R017", message, ref.span, hint)
        error.notes.append((found.span, "declared here"))
        raise error


def _hidden_by_extends(library: Library, cls: ast.Class, name: str, depth: int = 0) -> bool:
    """Does a class of that name come to `cls` by protected extends clauses only?"""
    if depth > 30 or not cls.extends or member(library, cls, name) is not None:
        return False
    bases = [(e.protected, base_class(library, cls, e.base, e.modification)) for e in cls.extends]
    having = [(p, b) for p, b in bases if b is not None and own_or_inherited(library, b, name) is not None]
    return bool(having) and all(p or _hidden_by_extends(library, b, name, depth + 1) for p, b in having)


def is_package_like(library: Library, cls: ast.Class, depth: int = 0) -> bool:
    """Does `cls` hold nothing but classes and constants (4.7)?"""
    if cls.kind in ("package", "operator") or depth > 20:
        return True
    plain = all(c.variability == "constant" for c in cls.components) and not cls.sections
    return plain and all(is_package_like(library, b, depth + 1) for b in base_classes(library, cls))
