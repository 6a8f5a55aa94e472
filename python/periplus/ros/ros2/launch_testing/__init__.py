"""Tests of running nodes: `python -m launch_testing FILE`.

The file has a function `generate_test_description` and `unittest` classes. The launch runs by `periplus launch`. Standard
output and standard error of a process are one stream here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from launch_testing import actions as actions, asserts as asserts, markers as markers, util as util
from launch_testing._records import (
    IoHandler as IoHandler,
    NoMatchingProcessException as NoMatchingProcessException,
    ProcInfoHandler as ProcInfoHandler,
)

ActiveIoHandler = IoHandler
ActiveProcInfoHandler = ProcInfoHandler

_T = TypeVar("_T")


def post_shutdown_test() -> Callable[[_T], _T]:
    """Decorator of test classes that run after all processes have ended."""

    def mark(subject: _T) -> _T:
        subject.__post_shutdown_test__ = True  # type: ignore[attr-defined]
        return subject

    return mark


def parametrize(argnames: Any, argvalues: Any) -> Callable[[_T], _T]:
    """Decorator of `generate_test_description`: one launch for each value."""
    names = [one.strip() for one in argnames.split(",")] if isinstance(argnames, str) else list(argnames)

    def mark(subject: _T) -> _T:
        subject.__parameters__ = [  # type: ignore[attr-defined]
            dict(zip(names, values if len(names) > 1 else [values])) for values in argvalues
        ]
        return subject

    return mark


def ready_to_test_action_timeout(timeout: float) -> Callable[[_T], _T]:
    """Decorator of `generate_test_description`: time for the start of all processes [s]."""

    def mark(subject: _T) -> _T:
        subject.__ready_timeout_s__ = timeout  # type: ignore[attr-defined]
        return subject

    return mark
