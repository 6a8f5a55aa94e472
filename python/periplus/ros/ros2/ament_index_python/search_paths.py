"""Folders with installed packages."""

from __future__ import annotations

import os

from ament_index_python.constants import AMENT_PREFIX_PATH_ENV_VAR


def get_search_paths() -> list[str]:
    """Folders of `AMENT_PREFIX_PATH` that exist; none without the variable."""
    folders = os.environ.get(AMENT_PREFIX_PATH_ENV_VAR, "").split(os.pathsep)
    return [folder for folder in folders if folder and os.path.exists(folder)]
