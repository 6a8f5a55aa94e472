"""Warnings that name the line of the program, not one of these modules."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Any

_FOLDER = os.path.dirname(os.path.abspath(__file__)) + os.sep


def warn(text: str) -> None:
    """Shows a `UserWarning` for the innermost line outside of these modules."""
    level = 2
    frame: Any = sys._getframe(1)
    while frame is not None and frame.f_code.co_filename.startswith(_FOLDER):
        frame = frame.f_back
        level += 1
    warnings.warn(text, stacklevel=level)
