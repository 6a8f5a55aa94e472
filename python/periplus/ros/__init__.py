"""The Python modules of ROS (`rclpy`, `tf2_ros`, `rospy`, the message packages) without a ROS installation.

`import periplus.ros` alone changes nothing. `activate()` makes `import rclpy` find the modules of Periplus; `periplus run`,
launch files and the pytest plugin call it before the first line of the user's program.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass

__all__ = ["Activation", "activate", "installed_ros"]

_FOLDER = os.path.dirname(os.path.abspath(__file__))
# Root module of each ROS generation.
_ROOTS = {1: "rospy", 2: "rclpy"}


@dataclass(frozen=True)
class Activation:
    """The outcome of `activate()`."""

    #: ROS generation of the program: 2 (`rclpy`) or 1 (`rospy`).
    generation: int
    #: True if the modules of Periplus are used, False for an installed ROS.
    own: bool
    #: Folder of the installed `rclpy` or `rospy`, or None without one.
    installed: str | None

    def __str__(self) -> str:
        root = _ROOTS[self.generation]
        if not self.own:
            return f"{root} of the installed ROS ({self.installed})"
        if self.installed is None:
            return f"{root} of Periplus"
        return f"{root} of Periplus; the installed one ({self.installed}) is not used (--real-ros uses it)"


_active: Activation | None = None


def _own_folders(generation: int) -> list[str]:
    first, second = ("ros2", "ros1") if generation == 2 else ("ros1", "ros2")
    return [os.path.join(_FOLDER, first), os.path.join(_FOLDER, second)]


def installed_ros(generation: int = 2) -> str | None:
    """Folder of the `rclpy` (generation 1: `rospy`) that a plain import would find, or None without one."""
    root = _ROOTS[generation]
    own = set(_own_folders(generation))
    for entry in sys.path:
        folder = os.path.join(entry or os.getcwd(), root)
        if entry not in own and os.path.isfile(os.path.join(folder, "__init__.py")):
            return folder
    return None


def activate(*, real_ros: bool = False, generation: int = 2, quiet: bool = False) -> Activation:
    """Makes `import rclpy`, `import rospy` and the message packages find the modules of Periplus.

    The change is in `sys.path` of this process alone. An installed ROS that is hidden by it is named on stderr once
    (`quiet=True`: not at all). With `real_ros=True`, or `PERIPLUS_REAL_ROS=1` in the environment, nothing changes and the
    installed ROS is used.

    Args:
        real_ros: Use the installed ROS (default False).
        generation: 2 for `rclpy` (default), 1 for `rospy`: decides whose `std_msgs`, `message_filters` and so on come first.
        quiet: Print nothing (default False).

    Raises:
        ModuleNotFoundError: `real_ros` is asked for and there is no installed ROS.
        RuntimeError: Modules of an installed ROS were imported before.
    """
    global _active
    if generation not in _ROOTS:
        raise ValueError(f"generation must be 1 (rospy) or 2 (rclpy), not {generation!r}")
    root = _ROOTS[generation]
    real_ros = real_ros or os.environ.get("PERIPLUS_REAL_ROS", "") not in ("", "0")
    own_folders = _own_folders(generation)
    installed = installed_ros(generation)
    if real_ros:
        if installed is None:
            raise ModuleNotFoundError(
                f"No installed {root} on sys.path. Source your ROS (or install ros-jazzy-{root}), or leave out --real-ros",
                name=root,
            )
        sys.path[:] = [entry for entry in sys.path if entry not in own_folders]
        _active = Activation(generation, False, installed)
        return _active
    _refuse_mixture(own_folders)
    if _active is not None and _active.own and _active.generation == generation and own_folders[0] in sys.path:
        return _active
    sys.path[:] = own_folders + [entry for entry in sys.path if entry not in own_folders]
    _install_messages(generation)
    _active = Activation(generation, True, installed)
    if installed is not None and not quiet:
        print(f"periplus: {_active}", file=sys.stderr)
    return _active


def _refuse_mixture(own_folders: list[str]) -> None:
    """Refuses a process in which modules of another ROS are loaded already."""
    for name in ("rclpy", "rospy", "std_msgs", "rosidl_parser", "tf2_ros"):
        module = sys.modules.get(name)
        file = getattr(module, "__file__", None)
        if file is not None and not os.path.abspath(file).startswith(_FOLDER + os.sep):
            raise RuntimeError(
                f"{name} was imported from {os.path.dirname(file)} before periplus.ros.activate(). "
                "Call activate() first, or use the installed ROS alone"
            )


def _install_messages(generation: int) -> None:
    """Installs the import hook of the message packages of a generation, instead of the other one."""
    import importlib

    for name, wanted in (("_rosidl_modules", 2), ("_genpy_modules", 1)):
        if wanted == generation:
            importlib.import_module(f".{name}", __name__).install()
        elif f"{__name__}.{name}" in sys.modules:
            sys.modules[f"{__name__}.{name}"].uninstall()
