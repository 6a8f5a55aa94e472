"""Packages of a source tree: what `ros2 run` and the share directories know after a build, without the build."""

from __future__ import annotations

import os
import re
import sys
from collections import deque
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ._cmake_installs import CmakeInstalls, read_cmake

#: Environment variable with folders to search first, separated as in PATH.
SEARCH_VARIABLE = "PERIPLUS_PACKAGES"
_IGNORE_MARKERS = {"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"}
#: The only one of them that catkin reads. Branches of both generations of ROS hide their packages of ROS 1 from colcon.
_CATKIN_MARKER = "CATKIN_IGNORE"
_SKIPPED = {"build", "install", "log", "devel", "logs", "__pycache__", "node_modules", "venv", "site-packages"}
#: Limits of one search; a current folder such as / must not take seconds.
_MAX_DEPTH = 6
_MAX_FOLDERS = 4000
_SETUP_TIMEOUT_S = 30


class PackageError(ValueError):
    """A package, or a program of it, that cannot be found or read; the text has the remedy."""


@dataclass(frozen=True)
class Executable:
    """One program of a package."""

    name: str
    #: Script to run, or None for an entry point.
    script: str | None = None
    #: `module:function` of an entry point, or None.
    entry_point: str | None = None


@dataclass(frozen=True)
class Package:
    """A folder with a `package.xml`."""

    name: str
    folder: str
    #: `ament_python`, `ament_cmake`, `catkin`, ... of `package.xml`.
    build_type: str

    @cached_property
    def setup(self) -> dict[str, Any]:
        """Keywords of `setup()` in `setup.py`; {} without the file.

        Raises:
            PackageError: `setup.py` fails; the text has its line.
        """
        if not os.path.isfile(os.path.join(self.folder, "setup.py")):
            return {}
        return _run_setup(self.folder)

    @cached_property
    def cmake(self) -> CmakeInstalls:
        """Parts of `CMakeLists.txt`; empty without the file."""
        return read_cmake(self.folder, self.name)

    @property
    def _has_cmake(self) -> bool:
        return self.build_type in ("ament_cmake", "catkin", "cmake")

    @property
    def python_paths(self) -> list[str]:
        """Folders that a build would put the Python modules of, in the order of the search."""
        paths = []
        # ament_cmake does not run `setup.py`.
        roots = (self.setup.get("package_dir") or {}) if self.build_type != "ament_cmake" else {}
        if "" in roots:
            paths.append(os.path.normpath(os.path.join(self.folder, roots[""])))
        for name, root in roots.items():
            if name:
                paths.append(os.path.dirname(os.path.normpath(os.path.join(self.folder, root))))
        paths += self.cmake.python_paths
        if self.build_type == "catkin" and os.path.isdir(os.path.join(self.folder, "src")):
            paths.append(os.path.join(self.folder, "src"))
        paths.append(self.folder)
        return list(dict.fromkeys(paths))

    @property
    def executables(self) -> dict[str, Executable]:
        """Programs by the name that `ros2 run` (or `rosrun`) takes."""
        found: dict[str, Executable] = {}
        # CMake installs what `setup.cfg` names together with the Python modules; it does not run `setup.py`.
        points = _setup_cfg_scripts(self.folder) if not self._has_cmake or self.cmake.python_paths else {}
        if not self._has_cmake:
            points = {**self._console_scripts(), **points}
        for name, target in points.items():
            found[name] = Executable(name, entry_point=target)
        if not self._has_cmake or self.build_type == "catkin":
            for script in self.setup.get("scripts") or []:
                path = os.path.normpath(os.path.join(self.folder, script))
                found.setdefault(os.path.basename(path), Executable(os.path.basename(path), script=path))
        for name, path in self.cmake.programs.items():
            if os.path.isfile(path):
                found.setdefault(name, Executable(name, script=path))
        if self.build_type == "catkin":
            for path in _catkin_scripts(self.folder):
                found.setdefault(os.path.basename(path), Executable(os.path.basename(path), script=path))
        return found

    def _console_scripts(self) -> dict[str, str]:
        points = self.setup.get("entry_points") or {}
        if isinstance(points, str):
            points = _ini_section(points, "console_scripts")
            return dict(points)
        return _entry_lines(points.get("console_scripts") or [])

    @property
    def shared_files(self) -> list[tuple[str, str]]:
        """Pairs (path below `share/<package>`, source file or folder) that a build would install."""
        share = os.path.join("share", self.name)
        pairs = list(self.cmake.shared)
        for entry in [] if self._has_cmake else self.setup.get("data_files") or []:
            if not isinstance(entry, list) or len(entry) != 2:
                continue
            destination = os.path.normpath(str(entry[0]))
            if destination != share and not destination.startswith(share + os.sep):
                continue
            for source in entry[1]:
                path = os.path.normpath(os.path.join(self.folder, source))
                pairs.append((os.path.normpath(os.path.join(os.path.relpath(destination, share), os.path.basename(path))), path))
        return [(os.path.normpath(target), source) for target, source in pairs]

    @property
    def share_folder(self) -> str:
        """Folder used as `share/<package>`: the source folder, or links to it where a build changes the layout."""
        from ._share import share_folder

        return share_folder(self)

    def executable(self, name: str) -> Executable:
        """The program `name`; its extension `.py` may be left out.

        Raises:
            PackageError: There is none; the text lists those there are.
        """
        programs = self.executables
        for candidate in (name, name + ".py", name.removesuffix(".py")):
            if candidate in programs:
                return programs[candidate]
        if name in self.cmake.compiled:
            raise PackageError(
                f"{name} of package {self.name} is a C++ program: {self.folder} has to be built for it (colcon build), "
                "then source install/setup.bash"
            )
        raise PackageError(_no_program(self, name, sorted(programs)))


def _no_program(package: Package, name: str, programs: list[str]) -> str:
    import difflib

    text = f"package {package.name} ({package.folder}) has no program {name!r}."
    close = difflib.get_close_matches(name, programs, 1)
    if close:
        text += f" Did you mean {close[0]!r}?"
    if programs:
        return text + " It has: " + ", ".join(programs)
    where = "entry_points in setup.py" if package.build_type == "ament_python" else "install(PROGRAMS ...) in CMakeLists.txt"
    return text + f" It has none: programs come from {where}"


def find_packages(roots: list[str]) -> dict[str, Package]:
    """Packages below `roots`, by name. The first of a name counts: earlier roots, then smaller depth, then alphabetical order."""
    found: dict[str, Package] = {}
    seen: set[str] = set()
    left = _MAX_FOLDERS
    for root in roots:
        queue = deque([(os.path.abspath(root), 0)])
        while queue and left > 0:
            folder, depth = queue.popleft()
            if folder in seen:
                continue
            seen.add(folder)
            left -= 1
            try:
                entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
            except OSError:
                continue
            names = {entry.name for entry in entries}
            is_ignored = bool(names & _IGNORE_MARKERS) and depth > 0
            if "package.xml" in names or "manifest.xml" in names:
                package = read_package(folder)
                if package is not None:
                    if not is_ignored or (package.build_type == "catkin" and _CATKIN_MARKER not in names):
                        found.setdefault(package.name, package)
                    continue
            if is_ignored:
                continue
            if depth < _MAX_DEPTH:
                for entry in entries:
                    if entry.name.startswith(".") or entry.name in _SKIPPED:
                        continue
                    if entry.is_dir():
                        queue.append((entry.path, depth + 1))
    return found


def read_package(folder: str) -> Package | None:
    """The package of a folder with `package.xml` (or rosbuild's `manifest.xml`), or None if the file is not of ROS."""
    text = _read_xml(os.path.join(folder, "package.xml"))
    if text is None:
        text = _read_xml(os.path.join(folder, "manifest.xml"))
        if text is None or "<package" not in text:
            return None
        # rosbuild: the name is that of the folder.
        folder = os.path.abspath(folder)
        return Package(os.path.basename(folder), folder, "catkin")
    name = re.search(r"<name>\s*([A-Za-z][\w.-]*)\s*</name>", text)
    if name is None:
        return None
    # A build type with a condition follows the ROS version: the one for ROS 2, otherwise the first.
    kinds = re.findall(r"<build_type([^>]*)>\s*([^<\s]+)\s*</build_type>", text)
    build_type = next((kind for condition, kind in kinds if re.search(r"ROS_VERSION\s*==\s*[\"']?2", condition)), "")
    if not build_type and kinds:
        build_type = kinds[0][1]
    if not build_type:
        # Without an export: catkin packages name their build tool.
        build_type = "catkin" if re.search(r"<buildtool_depend[^>]*>\s*catkin\s*<", text) else ""
    return Package(name.group(1), os.path.abspath(folder), build_type)


def _read_xml(path: str) -> str | None:
    """Text of a file without its comments, or None without the file."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return re.sub(r"<!--.*?-->", "", file.read(), flags=re.S)
    except OSError:
        return None


def package_of(path: str) -> Package | None:
    """The package that a file or folder belongs to: the nearest folder above it with one."""
    folder = os.path.abspath(path)
    while True:
        if any(os.path.isfile(os.path.join(folder, name)) for name in ("package.xml", "manifest.xml")):
            package = read_package(folder)
            if package is not None:
                return package
        parent = os.path.dirname(folder)
        if parent == folder:
            return None
        folder = parent


def search_roots(script: str | None = None) -> list[str]:
    """Folders to search: PERIPLUS_PACKAGES, the workspace of the script, the workspace of the current folder."""
    roots = [entry for entry in os.environ.get(SEARCH_VARIABLE, "").split(os.pathsep) if entry]
    for start in ([os.path.dirname(os.path.abspath(script))] if script else []) + [os.getcwd()]:
        own = package_of(start)
        if own is None:
            roots.append(start)
        else:
            roots.append(own.folder)
            # Packages that are used together are siblings, or below the src of one workspace.
            parent = os.path.dirname(own.folder)
            roots.append(_workspace(parent) or parent)
    return list(dict.fromkeys(os.path.abspath(root) for root in roots))


def _workspace(folder: str) -> str | None:
    """The nearest folder `src` above: sources of a workspace."""
    while True:
        parent, name = os.path.split(folder)
        if name == "src":
            return folder
        if parent == folder:
            return None
        folder = parent


_known: dict[str, Package] | None = None
_known_key: tuple[str, ...] = ()
_script: str | None = None


def set_script(script: str | None) -> None:
    """Sets the program of this process: its workspace is searched first."""
    global _script, _known
    _script, _known = script, None


def known_packages() -> dict[str, Package]:
    """Packages of the source trees of this process; the trees are searched once."""
    global _known, _known_key
    roots = tuple(search_roots(_script))
    if _known is None or roots != _known_key:
        _known, _known_key = find_packages(list(roots)), roots
    return _known


def find_package(name: str) -> Package | None:
    """The package `name` of the source trees of this process, or None."""
    return known_packages().get(name)


def _run_setup(folder: str) -> dict[str, Any]:
    import json
    import subprocess

    reader = os.path.join(os.path.dirname(os.path.abspath(__file__)), "_setup_reader.py")
    environment = {key: value for key, value in os.environ.items() if key != "PERIPLUS_LOCKSTEP"}
    setup_py = os.path.join(folder, "setup.py")
    try:
        run = subprocess.run(
            [sys.executable, "-B", reader, folder],
            env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            timeout=_SETUP_TIMEOUT_S, check=False,
        )  # fmt: skip
        result = json.loads(run.stdout or b"{}")
    except subprocess.TimeoutExpired:
        raise PackageError(f"{setup_py}: did not end within {_SETUP_TIMEOUT_S} s") from None
    except ValueError:
        raise PackageError(f"{setup_py}: exit code {run.returncode}: {run.stderr.decode(errors='replace').strip()[-300:]}") from None
    if "error" in result:
        line = f":{result['line']}" if result.get("line") else ""
        raise PackageError(f"{setup_py}{line}: {result['error']}")
    assert isinstance(result, dict)
    return result


def _entry_lines(lines: Any) -> dict[str, str]:
    if isinstance(lines, str):
        lines = lines.splitlines()
    found = {}
    for line in lines:
        name, separator, target = str(line).partition("=")
        if separator:
            found[name.strip()] = target.split("[")[0].strip()
    return found


def _ini_section(text: str, section: str) -> dict[str, str]:
    match = re.search(rf"^\s*\[{re.escape(section)}\]\s*$(.*?)(?=^\s*\[|\Z)", text, re.M | re.S)
    return _entry_lines(match.group(1)) if match else {}


def _setup_cfg_scripts(folder: str) -> dict[str, str]:
    import configparser

    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        parser.read(os.path.join(folder, "setup.cfg"), encoding="utf-8")
        return _entry_lines(parser.get("options.entry_points", "console_scripts", fallback=""))
    except configparser.Error:
        return {}


def _catkin_scripts(folder: str) -> list[str]:
    """Files that `rosrun` would find: executable files of the package and Python files in the usual folders."""
    found = []
    for root, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _SKIPPED)
        usual = os.path.relpath(root, folder).split(os.sep)[0] in ("scripts", "nodes", "bin", "src", "script", "node")
        for name in sorted(files):
            path = os.path.join(root, name)
            if usual and (name.endswith(".py") or _has_python_shebang(path)) or (os.access(path, os.X_OK) and _has_python_shebang(path)):
                found.append(path)
    return found


def _has_python_shebang(path: str) -> bool:
    try:
        with open(path, "rb") as file:
            line = file.readline(120)
    except OSError:
        return False
    return line.startswith(b"#!") and b"python" in line
