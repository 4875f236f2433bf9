"""Mutants: a source text with one small mistake in it."""

import ast
from collections.abc import Iterator
from copy import deepcopy
from typing import NamedTuple

EXCHANGED = {
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.And: (ast.Or,),
    ast.Or: (ast.And,),
}
"""What an operator is mistaken for: its inverse, the same with or without its limit, the opposite."""

NAMES = {"min": "max", "max": "min", "inf": "pi", "plus": "minus", "minus": "plus"}
"""Names that are mistaken for others."""


class Mutant(NamedTuple):
    """A source text with a mistake: where it is, how the statement reads now, and the whole text."""

    line: int
    was: str
    now: str
    text: str


def mutants_of(text: str) -> list[Mutant]:
    """All mutants of a source text, in the order of its lines; comments, docstrings, decorators and annotations have none."""
    tree = ast.parse(text)
    bodies = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    places = [(node, at) for node in [tree, *bodies] for at in range(len(node.body))]
    mutants = {mutant.text: mutant for node, at in places for mutant in _of_statement(tree, node.body, at)}
    mutants.pop(ast.unparse(tree), None)  # 1e300 + 1
    return sorted(mutants.values(), key=lambda mutant: mutant.line)


def _of_statement(tree: ast.Module, body: list[ast.stmt], at: int) -> Iterator[Mutant]:
    """Mutants of the statement at this place of a body, and of those in it."""
    statement = body[at]
    if isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.Import | ast.ImportFrom) or _is_text(statement):
        return
    for line, other in _variants(statement):
        body[at] = ast.fix_missing_locations(other)
        yield Mutant(line, *_where_they_differ(statement, other), ast.unparse(tree))
        body[at] = statement


def _variants(root: ast.stmt) -> Iterator[tuple[int, ast.AST]]:
    """Copies of a statement, each with one change, and its line."""
    for place, node in enumerate(ast.walk(root)):
        for change in _changes(node):
            copy = deepcopy(root)
            found = next(other for k, other in enumerate(ast.walk(copy)) if k == place)
            replaced = change(found)
            yield getattr(node, "lineno", root.lineno), _with(copy, found, replaced)


def _with(root: ast.AST, old: ast.AST, new: ast.AST) -> ast.AST:
    """The tree with a node replaced, which may be its root."""

    class Replace(ast.NodeTransformer):
        def visit(self, node: ast.AST) -> ast.AST:
            return new if node is old else self.generic_visit(node)

    return Replace().visit(root)


def _changes(node: ast.AST) -> list:
    """Functions that change this node, in place or into another one."""
    match node:
        case ast.BinOp(op=op) | ast.AugAssign(op=op) | ast.BoolOp(op=op) if type(op) in EXCHANGED:
            changes = [_set(op=kind()) for kind in EXCHANGED[type(op)]]
        case ast.Compare(ops=[op]) if type(op) in EXCHANGED:
            changes = [_set(ops=[kind()]) for kind in EXCHANGED[type(op)]]
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            changes = [lambda found: found.operand]
        case ast.Constant(value=bool(value)):
            changes = [_set(value=not value)]
        case ast.Constant(value=int(value) | float(value)):
            changes = [_set(value=value + 1), _set(value=2 * value or -1)]
        case ast.Name(id=name) if name in NAMES:
            changes = [_set(id=NAMES[name])]
        case ast.Attribute(attr=name) if name in NAMES:
            changes = [_set(attr=NAMES[name])]
        case ast.If(test=ast.BoolOp()) | ast.IfExp(test=ast.BoolOp()):
            changes = [lambda found: _set(test=ast.UnaryOp(ast.Not(), found.test))(found)]
        case _:
            changes = []
    dropped = isinstance(node, ast.AugAssign | ast.Expr) or (isinstance(node, ast.Assign) and _stores(node))
    return [*changes, lambda found: ast.Pass()] if dropped else changes


def _set(**fields):
    """The function that sets fields of a node."""

    def change(node: ast.AST) -> ast.AST:
        for name, value in fields.items():
            setattr(node, name, value)
        return node

    return change


def _stores(statement: ast.Assign) -> bool:
    """Whether it writes into something: without it the names that follow would all be known still."""
    targets = [target for outer in statement.targets for target in getattr(outer, "elts", [outer])]
    return not any(isinstance(target, ast.Name) for target in targets)


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _where_they_differ(old: ast.AST, new: ast.AST) -> tuple[str, str]:
    """The first lines of two statements that are not the same."""
    pairs = zip(ast.unparse(old).splitlines(), ast.unparse(new).splitlines(), strict=False)
    was, now = next(((was, now) for was, now in pairs if was != now), ("", ""))
    return was.strip(), now.strip()
