"""The kind of a `while` loop, from its source: one that waits for another thread, one that works, or one that may do either.

A loop ends by its condition, and by conditions before `break`, `return` and `raise`. If the loop itself changes a variable of
these, it works. If it cannot change one, it waits.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from enum import Enum

#: Functions and methods that change none of the variables which a loop may wait for.
_HARMLESS = frozenset(
    "print len str int float bool abs min max round repr format isinstance type sum range hasattr getattr any all sorted list tuple "
    "info warn warning error debug fatal loginfo logwarn logerr logdebug logfatal loginfo_throttle logwarn_throttle log get_logger "
    "get_clock now to_msg time perf_counter monotonic write flush publish is_shutdown ok get_time is_alive is_set done".split()
)
_BREAKS = (ast.Break, ast.Return, ast.Raise)
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


class LoopKind(Enum):
    """What a loop does in its rounds."""

    #: Only another thread can end it.
    WAITS = "waits"
    #: It ends by itself.
    WORKS = "works"
    #: Calls of the program decide.
    UNKNOWN = "unknown"


def loop_kind(loop: ast.While) -> LoopKind:
    """The kind of a loop."""
    if all(_only_looks(statement) for statement in loop.body):
        return LoopKind.WAITS
    inside = [node for statement in loop.body for node in _walk(statement)]
    if any(isinstance(node, (ast.Await, ast.Yield, ast.YieldFrom)) for node in inside):
        return LoopKind.WORKS
    watched: set[str] = set()
    for condition in (loop.test, *_ends(loop.body)):
        watched |= _variables(condition)
    inside += list(_walk(loop.test))
    if any(_changes(node, watched) for node in inside):
        return LoopKind.WORKS
    is_harmless = all(_name_of(node.func) in _HARMLESS for node in inside if isinstance(node, ast.Call))
    return LoopKind.WAITS if watched and is_harmless else LoopKind.UNKNOWN


def _only_looks(statement: ast.stmt) -> bool:
    """True for a statement that changes nothing while the loop goes on."""
    if isinstance(statement, (ast.Pass, ast.Continue, *_BREAKS)):
        return True
    if isinstance(statement, ast.Expr):
        return isinstance(statement.value, ast.Constant)
    if isinstance(statement, ast.If):
        branches = (statement.body, statement.orelse)
        return all(_only_looks(one) or _leaves(branch) for branch in branches for one in branch)
    return False


def _leaves(branch: list[ast.stmt]) -> bool:
    return bool(branch) and isinstance(branch[-1], _BREAKS)


def _walk(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes below, without those of functions that are only defined there."""
    yield node
    if not isinstance(node, _SCOPES):
        for child in ast.iter_child_nodes(node):
            yield from _walk(child)


def _ends(body: list[ast.stmt]) -> Iterator[ast.expr]:
    """Conditions of the statements that leave a loop."""
    for statement in body:
        if isinstance(statement, ast.If):
            if any(isinstance(node, _BREAKS) for one in (*statement.body, *statement.orelse) for node in _walk(one)):
                yield statement.test
            yield from _ends(statement.body)
            yield from _ends(statement.orelse)
        elif isinstance(statement, (ast.Try, ast.With)):
            yield from _ends(statement.body)


def _path(node: ast.AST) -> str | None:
    """`a.b.c` of a variable or an attribute of one."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        before = _path(node.value)
        return None if before is None else f"{before}.{node.attr}"
    return None


def _variables(condition: ast.expr) -> set[str]:
    """Variables and attributes that decide a condition; of a method, its object."""
    found: set[str] = set()
    waiting: list[ast.AST] = [condition]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Call):
            waiting += [*node.args, *(keyword.value for keyword in node.keywords)]
            if isinstance(node.func, ast.Attribute):
                waiting.append(node.func.value)
            continue
        path = _path(node)
        if path is not None:
            found.add(path)
        else:
            waiting += list(ast.iter_child_nodes(node))
    return found


def _name_of(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _changes(node: ast.AST, watched: set[str]) -> bool:
    """True if a node may change a watched variable: an assignment, a method of it, or a function that gets it."""
    if isinstance(node, (ast.Name, ast.Attribute)) and not isinstance(node.ctx, ast.Load):
        return _is_part(_path(node), watched)
    if isinstance(node, ast.Subscript) and not isinstance(node.ctx, ast.Load):
        return _is_part(_path(node.value), watched)
    if isinstance(node, ast.Call) and _name_of(node.func) not in _HARMLESS:
        # A method of `self` is left to the caller: it may change any attribute.
        owner = _path(node.func.value) if isinstance(node.func, ast.Attribute) else None
        return owner in watched or any(_path(argument) in watched for argument in node.args)
    return False


def _is_part(path: str | None, watched: set[str]) -> bool:
    """True if an assignment to `path` changes a watched variable."""
    return path is not None and any(one == path or one.startswith(f"{path}.") for one in watched)
