"""Programs that tests start in processes of their own."""

import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import periplus

#: Folder of the package `periplus` under test.
PACKAGE_ROOT = str(Path(periplus.__file__).parents[1])
#: ROS 2 domains of tests.
_DOMAINS = range(150, 230)


def environment(**variables: str) -> dict[str, str]:
    """The environment of a program: the package under test, a fixed hash seed and nothing of an outer run."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PERIPLUS", "FAKE", "ROS", "RMW", "RCUTILS", "AMENT"))
    }
    path = os.pathsep.join(entry for entry in (PACKAGE_ROOT, kept.get("PYTHONPATH")) if entry)
    return {**kept, "PYTHONPATH": path, "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1", **variables}


@contextmanager
def own_domain() -> Iterator[dict[str, str]]:
    """Variables of a ROS 2 domain that no other test on this machine uses."""
    folder = Path(tempfile.gettempdir(), "periplus-test-domains")
    folder.mkdir(exist_ok=True)
    for number in _DOMAINS:
        with open(folder / str(number), "w", encoding="ascii") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                continue
            yield {"ROS_DOMAIN_ID": str(number), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
            return
    raise RuntimeError(f"all ROS 2 domains of tests are in use (locks in {folder})")
