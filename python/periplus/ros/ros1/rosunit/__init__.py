"""Tests of programs."""

from __future__ import annotations

import sys
import unittest
from typing import Any


def unitrun(package: str, test_name: str, test: Any, sysargs: list[str] | None = None, coverage_packages: Any = None) -> None:
    """Runs a test case and ends the program with its result."""
    case = unittest.defaultTestLoader.loadTestsFromName(test) if isinstance(test, str) else _suite(test)
    result = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(case)
    ok = result.wasSuccessful()
    counts = f"{result.testsRun} tests, {len(result.failures)} failures, {len(result.errors)} errors"
    print(f"[ROSUNIT] {package}/{test_name}: {counts}")
    if not ok:
        sys.exit(1)


def _suite(test: Any) -> unittest.TestSuite:
    if isinstance(test, type) and issubclass(test, unittest.TestSuite):
        return test()
    return unittest.defaultTestLoader.loadTestsFromTestCase(test)
