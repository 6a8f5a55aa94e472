"""Decorators of test descriptions."""

from __future__ import annotations

from typing import TypeVar

_T = TypeVar("_T")


def keep_alive(test_description: _T) -> _T:
    """Lets the tests go on when no process is left."""
    test_description.__keep_alive__ = True  # type: ignore[attr-defined]
    return test_description
