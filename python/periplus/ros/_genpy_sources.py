"""Texts of message packages for ROS 1: those that ship with Periplus and those of the user's source tree."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from difflib import get_close_matches
from functools import cache

from periplus import _native
from periplus.ros import _genpy
from periplus.ros._genpy_types import (
    PRIMITIVES,
    Definition,
    DefinitionError,
    Field,
    base_type,
    from_handle,
    native_text,
    native_type_name,
    parse,
)

#: Packages that come with Periplus: those that only ROS 1 has, then the others.
FOLDERS = tuple(
    os.path.join(os.path.dirname(os.path.abspath(__file__)), *parts) for parts in (("ros1", "interfaces"), ("interfaces",))
)
_KINDS = ("msg", "srv", "action")
#: Packages that are the same everywhere: no source tree is searched for them.
_CORE = frozenset((
    "actionlib", "actionlib_msgs", "builtin_interfaces", "diagnostic_msgs", "dynamic_reconfigure", "geometry_msgs",
    "move_base_msgs", "nav_msgs", "rcl_interfaces", "rosgraph_msgs", "sensor_msgs", "shape_msgs", "std_msgs", "std_srvs",
    "tf2_msgs", "trajectory_msgs", "visualization_msgs",
))  # fmt: skip
#: Number of folders above the program that may hold a package of rosbuild.
_MAX_LEVELS = 5
# Suffixes of the messages that an action stands for, with their texts.
_ACTION_PARTS = {
    "Action": "{0}ActionGoal action_goal\n{0}ActionResult action_result\n{0}ActionFeedback action_feedback\n",
    "ActionGoal": "Header header\nactionlib_msgs/GoalID goal_id\n{0}Goal goal\n",
    "ActionResult": "Header header\nactionlib_msgs/GoalStatus status\n{0}Result result\n",
    "ActionFeedback": "Header header\nactionlib_msgs/GoalStatus status\n{0}Feedback feedback\n",
}

# Texts that are in the native registry: package -> kind -> names of the types.
_loaded: dict[str, dict[str, list[str]]] = {}
_stage: dict[str, str] = {}
_loading: set[str] = set()


class MessageDefinitionError(ImportError):
    """A definition of the user's that cannot be read; the text names its file and line."""


@cache
def _registry() -> dict[str, dict[str, list[str]]]:
    """Types of the native registry: package -> kind -> names."""
    found: dict[str, dict[str, list[str]]] = {}
    for native in (*_native.message_types(), *_native.message_services()):
        package, kind, name = native.split("/")
        if kind == "msg":
            found.setdefault(package, {}).setdefault("msg", []).append(name)
        elif kind == "srv" and not name.endswith(("_Request", "_Response", "_Event")):
            found.setdefault(package, {}).setdefault("srv", []).append(name)
        elif kind == "action" and name.endswith("_Goal"):
            found.setdefault(package, {}).setdefault("action", []).append(name.removesuffix("_Goal"))
    return found


def names(package: str, kind: str) -> list[str]:
    """Names of the messages or services of a package; empty for an unknown package."""
    load(package)
    found = set(_registry().get(package, {}).get(kind, ())) | set(_loaded.get(package, {}).get(kind, ()))
    return sorted(found)


def is_known(package: str) -> bool:
    """True for a package with message types."""
    return package in _registry() or package in _loaded or bool(_folders(package))


def load(package: str) -> None:
    """Reads the texts of a package, and of those that it uses, into the native registry.

    Raises:
        MessageDefinitionError: A definition cannot be read.
    """
    if package in _loaded or package in _loading:
        return
    _loading.add(package)
    try:
        for one in _with_constants(package):
            _genpy.add_definition(one)
        definitions = _read(package)
        if package in _registry() and not definitions:
            _loaded.setdefault(package, {})
            return
        if not definitions:
            return
        for one in definitions:
            for field in one.fields:
                needed = field.type.split("/")[0]
                if "/" in field.type and needed != package:
                    load(needed)
        _check_types(definitions, package)
        for one in definitions:
            kind = one.native.split("/")[1]
            name = one.type.split("/")[1]
            if kind == "srv":
                name = name.removesuffix("Request").removesuffix("Response")
            if name not in _loaded.setdefault(package, {}).setdefault(kind, []):
                _loaded[package][kind].append(name)
            _stage[one.native] = native_text(one)
        _native_load(package)
        for one in definitions:
            _genpy.add_definition(one)
    finally:
        _loading.discard(package)


def _check_types(definitions: list[Definition], package: str) -> None:
    """Refuses fields of types that do not exist, and messages that contain themselves."""
    own = {one.type: one for one in definitions}
    known = set(own) | {f"{package}/{name}" for name in _registry().get(package, {}).get("msg", ())}
    for one in definitions:
        for field in one.fields:
            base = base_type(field.type)
            owner = base.split("/")[0]
            if not field.place or base in PRIMITIVES or base in known or owner != package and owner in _loading:
                continue
            others = {f"{owner}/{name}" for name in names(owner, "msg")} if owner != package else known
            if base in others or f"{owner}/{native_type_name(base.split('/')[1])}" in others:
                continue
            written = base.removeprefix(package + "/")
            near = get_close_matches(written, [one.removeprefix(package + "/") for one in others | PRIMITIVES], 1, 0.7)
            if near:
                advice = f"did you mean `{near[0]}`?"
            else:
                advice = f"{owner!r} has no such message" if others else f"there is no message package {owner!r}"
            raise _unreadable(package, f"{field.place}: the type `{written}` is unknown: {advice}")
        circle = _circle(one, own, [])
        if circle:
            raise _unreadable(package, f"{circle[-1].place}: `{one.type}` contains itself through the field `{circle[-1].name}`")


def _circle(start: Definition, own: dict[str, Definition], path: list[Field]) -> list[Field] | None:
    """Fields that lead from a type of the package back to it, or None."""
    for field in (path and own[base_type(path[-1].type)] or start).fields:
        base = base_type(field.type)
        if base == start.type:
            return [*path, field]
        if base in own and all(base != base_type(one.type) for one in path):
            found = _circle(start, own, [*path, field])
            if found:
                return found
    return None


def _unreadable(package: str, text: str) -> MessageDefinitionError:
    return MessageDefinitionError(f"message package {package!r} cannot be read:\n{text}", name=package)


def package_folder(package: str) -> str | None:
    """Folder of a package of the source trees, or None. Packages of rosbuild, which have a manifest.xml, count too."""
    from periplus.ros import _packages

    tree = _packages.find_package(package)
    if tree is not None:
        return tree.folder
    paths = [one for one in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if one]
    if paths:
        tree = _packages.find_packages(paths).get(package)
        if tree is not None:
            return tree.folder
    script = getattr(sys.modules.get("__main__"), "__file__", None) or (sys.argv[0] if sys.argv else "")
    for start in (*paths, os.path.dirname(os.path.abspath(script)), os.getcwd()):
        folder = os.path.abspath(start)
        for _ in range(_MAX_LEVELS):
            for one in (folder, os.path.join(folder, package)):
                if os.path.basename(one) == package and os.path.isfile(os.path.join(one, "manifest.xml")):
                    return one
            folder = os.path.dirname(folder)
    return None


def add_texts(texts: dict[str, str]) -> None:
    """Adds types by their text, such as those of a recording, unless they are known."""
    made = []
    for name, text in texts.items():
        package, _, short = name.partition("/")
        if short not in names(package, "msg"):
            made.append(parse(text, package, short, "msg", name))
    for one in made:
        package, short = one.type.split("/")
        _loaded.setdefault(package, {}).setdefault("msg", []).append(short)
        _stage[one.native] = native_text(one)
    if made:
        _native_load(made[0].type.split("/")[0])
    for one in made:
        _genpy.add_definition(one)


def _folders(package: str) -> list[str]:
    """Folders with texts of a package: the user's own first."""
    found = []
    own = package_folder(package) if package not in _CORE else None
    if own is not None:
        found.append(own)
    found += [os.path.join(folder, package) for folder in FOLDERS]
    return [one for one in found if any(os.path.isdir(os.path.join(one, kind)) for kind in _KINDS)]


def _with_constants(package: str) -> list[Definition]:
    """Types of the registry with constants, for which Periplus ships a text, too: it has the types of the constants.

    The registry has the values only, and the checksum of ROS 1 needs both.
    """
    made = []
    for name in _registry().get(package, {}).get("msg", ()):
        paths = [os.path.join(folder, package, "msg", f"{name}.msg") for folder in FOLDERS]
        path = next((one for one in paths if os.path.isfile(one)), None)
        if path is None:
            continue
        known = from_handle(_genpy.genpy_handle(f"{package}/msg/{name}"))
        (text,) = _read_file(path, package, "msg", name)
        if known.constant_lines is None and [(one.name, one.type) for one in known.fields] == [
            (one.name, one.type) for one in text.fields
        ]:
            known.constant_lines = text.constant_lines
            made.append(known)
    return made


def _read(package: str) -> list[Definition]:
    made: list[Definition] = []
    known = _registry().get(package, {})
    read: set[tuple[str, str]] = set()
    for folder in _folders(package):
        for kind in _KINDS:
            path = os.path.join(folder, kind)
            for file in sorted(os.listdir(path)) if os.path.isdir(path) else ():
                if not file.endswith("." + kind):
                    continue
                name = file[: -len(kind) - 1]
                if (kind, name) in read or name in known.get(kind, ()) and kind != "action":
                    continue
                read.add((kind, name))
                made += _read_file(os.path.join(path, file), package, kind, name)
    for name in known.get("action", ()):
        if ("action", name) not in read:
            made += _registry_action(package, name)
    return made


def _read_file(path: str, package: str, kind: str, name: str) -> list[Definition]:
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    try:
        if kind == "msg":
            return [parse(text, package, name, "msg", path)]
        parts = _parts(text)
        if kind == "srv":
            _expect(parts, 2, path)
            return [
                parse(part, package, f"{name}_{ending}", "srv", path)
                for part, ending in zip(parts, ("Request", "Response"), strict=True)
            ]
        _expect(parts, 3, path)
        made = [
            parse(part, package, name + ending, "msg", path)
            for part, ending in zip(parts, ("Goal", "Result", "Feedback"), strict=True)
        ]
        return made + _action_topics(package, name)
    except DefinitionError as error:
        raise MessageDefinitionError(f"message package {package!r} cannot be read:\n{error}", name=package) from None


def _parts(text: str) -> list[str]:
    """Parts between the lines of three dashes, with the lines before them empty so that line numbers are kept."""
    parts, current = [], [""]
    lines = text.splitlines()
    current = []
    for number, line in enumerate(lines):
        if line.strip().startswith("---"):
            parts.append(current)
            current = [""] * (number + 1)
        else:
            current.append(line)
    parts.append(current)
    return ["\n".join(part) for part in parts]


def _expect(parts: list[str], count: int, path: str) -> None:
    if len(parts) != count:
        raise DefinitionError(f"{path}: {len(parts)} parts between lines `---`, where {count} are expected")


def _action_topics(package: str, name: str) -> list[Definition]:
    return [
        parse(text.format(f"{package}/{name}"), package, name + ending, "msg") for ending, text in _ACTION_PARTS.items()
    ]


def _registry_action(package: str, name: str) -> list[Definition]:
    """Messages of ROS 1 for an action that the registry has as one of ROS 2."""
    made = []
    for ending in ("Goal", "Result", "Feedback"):
        definition = from_handle(_genpy.genpy_handle(f"{package}/action/{name}_{ending}"))
        definition.type = f"{package}/{name}{ending}"
        definition.native = f"{package}/msg/{name}{ending}"
        definition.handle = None
        made.append(definition)
    return made + _action_topics(package, name)


def _native_load(package: str) -> None:
    """Gives all texts that were read so far to the native registry; the types of one may be used by another."""
    folder = tempfile.mkdtemp(prefix="periplus-messages-")
    try:
        written: dict[str, str] = {}
        for native, text in _stage.items():
            owner, kind, name = native.split("/")
            if kind == "srv":
                whole, _, ending = name.rpartition("_")
                key = f"{owner}/srv/{whole}.srv"
                written[key] = written.get(key, "") + (text if ending == "Request" else f"---\n{text}")
            else:
                written[f"{owner}/{kind}/{name}.{kind}"] = text
        for key, text in written.items():
            path = os.path.join(folder, key)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        _native.load_messages(folder)
    except _native.FileError as error:
        raise MessageDefinitionError(
            f"message package {package!r} cannot be read:\n{str(error).replace(folder + os.sep, '')}", name=package
        ) from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)
