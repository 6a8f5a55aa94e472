"""Loops that wait for a variable: `while not self.scan: pass`.

Live, another thread sets the variable. In lockstep, no other thread can run before the loop gives its turn up, so each such
loop of the user's code gets a call of `_waiting.poll` when it is compiled, and one that may wait gets a call that counts
less. Files and line numbers stay as they are.
"""

from __future__ import annotations

import ast
import builtins
import re
from importlib.machinery import SourceFileLoader
from typing import TYPE_CHECKING, Any, cast

from . import _tracebacks, _waiting
from ._loop_kinds import LoopKind, loop_kind

if TYPE_CHECKING:
    from types import CodeType

#: Names of the calls among the builtins. They end with underscores, so that classes do not mangle them.
_CALLS = {LoopKind.WAITS: "__periplus_poll__", LoopKind.UNKNOWN: "__periplus_round__"}
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
    setattr(builtins, _CALLS[LoopKind.WAITS], _waiting.poll)
    setattr(builtins, _CALLS[LoopKind.UNKNOWN], _waiting.round_of_loop)
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
    """Adds a call to each loop that waits, or may do so; True if there is one."""
    found = False
    for node in ast.walk(tree):
        if isinstance(node, ast.While):
            name = _CALLS.get(loop_kind(node))
            if name is not None:
                call = ast.Expr(ast.Call(ast.Name(name, ast.Load()), [], []))
                node.body.insert(0, call)
                ast.copy_location(call, node)
                ast.fix_missing_locations(call)
                found = True
    return found
