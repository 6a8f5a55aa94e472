"""Loops that wait for a variable: `while not self.scan: pass`.

Live, another thread sets the variable. In lockstep, no other thread can run before the loop gives its turn up, so each such
loop of the user's code gets a call of `_waiting.poll` when it is compiled. Files and line numbers stay as they are.
"""

from __future__ import annotations

import ast
import builtins
import re
from importlib.machinery import SourceFileLoader
from typing import TYPE_CHECKING, Any, cast

from . import _tracebacks, _waiting

if TYPE_CHECKING:
    from types import CodeType

#: Name of the call among the builtins. It ends with underscores, so that classes do not mangle it.
_POLL = "__periplus_poll__"
#: Sources without a match have no such loop; most files are not parsed twice.
_CANDIDATE = re.compile(rb"\bwhile\b")


def compile_source(source: bytes, path: str) -> CodeType:
    """Compiles a file; its waiting loops give their turn up.

    Raises:
        SyntaxError: As `compile` does.
    """
    tree: Any = source
    if _CANDIDATE.search(source):
        tree = compile(source, path, "exec", ast.PyCF_ONLY_AST, dont_inherit=True)
        _add_polls(tree)
    return compile(tree, path, "exec", dont_inherit=True)


def install() -> list[tuple[Any, str, Any]]:
    """Makes imported modules of the user's give their turn up too. Returns (owner, name, replacement) of the patches."""
    setattr(builtins, _POLL, _waiting.poll)
    real_get_code: Any = SourceFileLoader.get_code

    def get_code(self: SourceFileLoader, fullname: str) -> CodeType | None:
        path = self.get_filename(fullname)
        if not _tracebacks.is_library_file(path):
            try:
                source = self.get_data(path)
                if _CANDIDATE.search(source):
                    tree = ast.parse(source, path)
                    if _add_polls(tree):
                        # Not through the cache of Python, which live runs read.
                        code: CodeType = compile(cast(Any, tree), path, "exec", dont_inherit=True)
                        return code
            except (OSError, SyntaxError, ValueError):
                pass  # Python names the fault.
        return real_get_code(self, fullname)  # type: ignore[no-any-return]

    return [(SourceFileLoader, "get_code", get_code)]


def _add_polls(tree: Any) -> bool:
    """Adds a call to each loop that only waits; True if there is one."""
    found = False
    for node in ast.walk(tree):
        if isinstance(node, ast.While) and all(_only_looks(statement) for statement in node.body):
            call = ast.Expr(ast.Call(ast.Name(_POLL, ast.Load()), [], []))
            node.body.insert(0, call)
            ast.copy_location(call, node)
            ast.fix_missing_locations(call)
            found = True
    return found


def _only_looks(statement: ast.stmt) -> bool:
    """True for a statement of a loop that changes nothing while the loop goes on."""
    if isinstance(statement, (ast.Pass, ast.Continue, ast.Break, ast.Return, ast.Raise)):
        return True
    if isinstance(statement, ast.Expr):
        return isinstance(statement.value, ast.Constant)
    if isinstance(statement, ast.If):
        return all(_only_looks(one) or _leaves(branch) for branch in (statement.body, statement.orelse) for one in branch)
    return False


def _leaves(branch: list[ast.stmt]) -> bool:
    return bool(branch) and isinstance(branch[-1], (ast.Break, ast.Return, ast.Raise))
