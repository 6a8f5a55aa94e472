"""Programs that tests start in processes of their own."""

import os
from pathlib import Path

import periplus

#: Folder of the package `periplus` under test.
PACKAGE_ROOT = str(Path(periplus.__file__).parents[1])


def environment(**variables: str) -> dict[str, str]:
    """The environment of a program: the package under test, a fixed hash seed and nothing of an outer run."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PERIPLUS", "FAKE", "ROS", "RMW", "RCUTILS", "AMENT"))
    }
    path = os.pathsep.join(entry for entry in (PACKAGE_ROOT, kept.get("PYTHONPATH")) if entry)
    return {**kept, "PYTHONPATH": path, "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1", **variables}
