"""Installed programs, folders and Python modules of a `CMakeLists.txt`, without CMake.

Understands what packages with Python nodes use: `install(PROGRAMS | FILES | DIRECTORY ... DESTINATION ...)`, `set`, `file(GLOB)`,
`foreach`, `ament_python_install_package`, `catkin_install_python` and `add_executable` (whose programs need a compiler).
"""

from __future__ import annotations

import glob
import os
import re
from dataclasses import dataclass, field

_COMMAND = re.compile(r"(\w+)[ \t]*\(((?:[^()\"]|\"(?:[^\"\\]|\\.)*\"|\([^()]*\))*)\)")
_WORD = re.compile(r"\"((?:[^\"\\]|\\.)*)\"|([^\s\"]+)")
_KEYWORDS = {
    "PROGRAMS", "FILES", "DIRECTORY", "TARGETS", "DESTINATION", "RENAME", "PERMISSIONS", "CONFIGURATIONS", "COMPONENT", "OPTIONAL",
    "PATTERN", "REGEX", "EXCLUDE", "USE_SOURCE_PERMISSIONS", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS", "FILES_MATCHING", "RUNTIME",
    "LIBRARY", "ARCHIVE", "EXPORT", "INCLUDES", "MESSAGE_NEVER", "TYPE", "CODE", "SCRIPT",
}  # fmt: skip


@dataclass
class CmakeInstalls:
    """The parts of a `CMakeLists.txt` that matter for running a source tree."""

    #: Installed name of each script in `lib/<package>` and its source file.
    programs: dict[str, str] = field(default_factory=dict)
    #: Pairs (destination below `share/<package>`, source file or folder).
    shared: list[tuple[str, str]] = field(default_factory=list)
    #: Folders that hold installed Python modules.
    python_paths: list[str] = field(default_factory=list)
    #: Programs that a compiler makes.
    compiled: list[str] = field(default_factory=list)


def read_cmake(folder: str, package: str) -> CmakeInstalls:
    """Reads `CMakeLists.txt` of `folder`; without the file, nothing is installed."""
    result = CmakeInstalls()
    try:
        with open(os.path.join(folder, "CMakeLists.txt"), encoding="utf-8", errors="replace") as file:
            text = re.sub(r"(?m)#[^\n]*", "", file.read())
    except OSError:
        return result
    variables: dict[str, list[str]] = {
        "PROJECT_NAME": [package],
        "CMAKE_CURRENT_SOURCE_DIR": [folder],
        "PROJECT_SOURCE_DIR": [folder],
        "CMAKE_SOURCE_DIR": [folder],
        "CATKIN_PACKAGE_BIN_DESTINATION": [f"lib/{package}"],
        "CATKIN_PACKAGE_SHARE_DESTINATION": [f"share/{package}"],
        "CATKIN_PACKAGE_PYTHON_DESTINATION": ["lib/python"],
        "CATKIN_GLOBAL_BIN_DESTINATION": ["bin"],
    }
    for command, inside in _COMMAND.findall(text):
        words = _expand(inside, variables)
        if not words:
            continue
        command = command.lower()
        if command in ("set", "foreach"):
            values = words[1:]
            if command == "foreach" and values[:2] == ["IN", "LISTS"]:
                values = [item for name in values[2:] for item in variables.get(name, [])]
            elif command == "foreach" and values[:2] == ["IN", "ITEMS"]:
                values = values[2:]
            variables[words[0]] = values
        elif command == "file" and words[0] in ("GLOB", "GLOB_RECURSE") and len(words) > 2:
            patterns = [word for word in words[2:] if word not in ("CONFIGURE_DEPENDS",)]
            if patterns[:1] == ["RELATIVE"]:
                patterns = patterns[2:]
            recursive = words[0] == "GLOB_RECURSE"
            variables[words[1]] = [path for pattern in patterns for path in _glob(folder, pattern, recursive)]
        elif command in ("install", "catkin_install_python"):
            _install(result, folder, package, words)
        elif command == "ament_python_install_package":
            _python_package(result, folder, words)
        elif command in ("add_executable", "cs_add_executable"):
            result.compiled.append(words[0])
    return result


def _expand(text: str, variables: dict[str, list[str]]) -> list[str]:
    words: list[str] = []
    for match in _WORD.finditer(text):
        quoted, plain = match.group(1), match.group(2)
        word = quoted if quoted is not None else plain
        only = re.fullmatch(r"\$\{(\w+)\}", word)
        if only and quoted is None:
            words += variables.get(only.group(1), [])
        else:
            words.append(re.sub(r"\$\{(\w+)\}", lambda m: ";".join(variables.get(m.group(1), [""])), word))
    return words


def _glob(folder: str, pattern: str, recursive: bool) -> list[str]:
    path = os.path.join(folder, pattern)
    if recursive:
        head, tail = os.path.split(path)
        return sorted(glob.glob(os.path.join(head, "**", tail), recursive=True))
    return sorted(glob.glob(path))


def _groups(words: list[str]) -> dict[str, list[str]]:
    groups: dict[str, list[str]] = {}
    key = ""
    for word in words:
        if word in _KEYWORDS:
            key = word
            groups.setdefault(key, [])
        else:
            groups.setdefault(key, []).append(word)
    return groups


def _install(result: CmakeInstalls, folder: str, package: str, words: list[str]) -> None:
    groups = _groups(words)
    destination = os.path.normpath((groups.get("DESTINATION") or [""])[0])
    share = os.path.join("share", package)
    is_program_folder = destination == os.path.join("lib", package)
    for source in groups.get("PROGRAMS", []) + groups.get("FILES", []):
        path = os.path.normpath(os.path.join(folder, source))
        name = (groups.get("RENAME") or [os.path.basename(path)])[0]
        if is_program_folder:
            result.programs[name] = path
        elif destination == share or destination.startswith(share + os.sep):
            result.shared.append((os.path.join(os.path.relpath(destination, share), name), path))
    for source in groups.get("DIRECTORY", []):
        path = os.path.normpath(os.path.join(folder, source))
        name = "" if source.endswith("/") else os.path.basename(path)
        if is_program_folder and os.path.isdir(path):
            for entry in sorted(os.listdir(path)):
                if os.path.isfile(os.path.join(path, entry)):
                    result.programs.setdefault(entry, os.path.join(path, entry))
        elif destination == share or destination.startswith(share + os.sep):
            result.shared.append((os.path.join(os.path.relpath(destination, share), name), path))


def _python_package(result: CmakeInstalls, folder: str, words: list[str]) -> None:
    if "PACKAGE_DIR" in words[:-1]:
        path = os.path.join(folder, words[words.index("PACKAGE_DIR") + 1])
        path = os.path.dirname(os.path.normpath(path))
    else:
        path = folder
    if path not in result.python_paths:
        result.python_paths.append(path)
