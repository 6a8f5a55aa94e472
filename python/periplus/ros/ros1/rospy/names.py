"""Names of ROS 1: namespaces, private names and remapping by the command line."""

from __future__ import annotations

import os
import re
import sys

SEP = "/"
PRIV_NAME = "~"
REMAP = ":="
TOPIC_ANYTYPE = "*"
SERVICE_ANYTYPE = "*"
_NAME = re.compile(r"^[A-Za-z_/~][\w/]*$")


class _Names:
    """Names of this process."""

    def __init__(self) -> None:
        self.namespace = _with_slashes(os.environ.get("ROS_NAMESPACE", "/"))
        self.node = self.namespace + "unnamed"
        #: Words `a:=b` of the command line, as they are written.
        self.mappings: dict[str, str] = load_mappings(sys.argv)
        #: The same with full names.
        self.resolved: dict[str, str] = {}


def _with_slashes(namespace: str) -> str:
    text = "/" + namespace.strip("/")
    return text if text == "/" else text + "/"


def load_mappings(argv: list[str]) -> dict[str, str]:
    """Words ``from:=to`` of a command line, up to ``--ros-args``."""
    found: dict[str, str] = {}
    for word in argv:
        if word == "--ros-args":
            break
        left, sep, right = word.partition(REMAP)
        if sep and left:
            found[left.strip()] = right.strip()
    return found


_names = _Names()


def get_mappings() -> dict[str, str]:
    """Remappings of the command line."""
    return dict(_names.mappings)


get_resolved_mappings = get_mappings


def initialize_mappings(node_name: str) -> None:
    """Resolves the remappings for a node."""
    _names.node = node_name
    _names.resolved = {
        resolve_name_without_node_name(left): resolve_name_without_node_name(right)
        for left, right in _names.mappings.items()
        if not left.startswith("_")
    }


def canonicalize_name(name: str) -> str:
    """Name without empty parts: ``/a//b/`` is ``/a/b``."""
    if not name or name == SEP:
        return name
    parts = [part for part in name.split(SEP) if part]
    return (SEP if name[0] == SEP else "") + SEP.join(parts)


def global_name(name: str) -> str:
    """Name with a leading slash."""
    return canonicalize_name(name if name.startswith(SEP) else SEP + name)


is_global = lambda name: name.startswith(SEP)  # noqa: E731
is_private = lambda name: name.startswith(PRIV_NAME)  # noqa: E731


def is_legal_name(name: str) -> bool:
    """True for a name with the characters that ROS permits."""
    return name == "" or bool(_NAME.match(name)) and "//" not in name


def is_legal_base_name(name: str) -> bool:
    return bool(re.match(r"^[A-Za-z]\w*$", name))


def ns_join(ns: str, name: str) -> str:
    """Name in a namespace."""
    if is_private(name) or is_global(name):
        return name
    if ns == PRIV_NAME:
        return PRIV_NAME + name
    return f"{ns.rstrip(SEP)}{SEP}{name}" if ns else name


def namespace(name: str) -> str:
    """Namespace of a full name, with a slash at its end."""
    return name.rstrip(SEP).rpartition(SEP)[0] + SEP


def resolve_name(name: str, caller_id: str | None = None) -> str:
    """Full name, without remapping. ``~x`` is in the namespace of the node."""
    node = caller_id or _names.node
    if not name:
        return namespace(node)
    name = canonicalize_name(name)
    if is_global(name):
        return name
    if is_private(name):
        return canonicalize_name(f"{node}{SEP}{name[1:]}")
    return canonicalize_name(namespace(node) + name)


resolve_name_without_node_name = resolve_name


def remap_name(name: str, caller_id: str | None = None, resolved: bool = True) -> str:
    """Full name after remapping."""
    full = resolve_name(name, caller_id)
    return _names.resolved.get(full, full if resolved else name)


def scoped_name(caller_id: str, name: str) -> str:
    """Name relative to the namespace of a node."""
    prefix = namespace(caller_id)
    return name[len(prefix) :] if name.startswith(prefix) else name


def anonymous_name(id: str) -> str:
    """Name with a suffix that no other process has."""
    import socket
    import time

    host = re.sub(r"\W", "_", socket.gethostname())
    return f"{id}_{host}_{os.getpid()}_{int(time.time() * 1000)}"


def get_caller_id() -> str:
    """Full name of this node."""
    return _names.node


get_name = get_caller_id


def get_namespace() -> str:
    """Namespace of this node, with a slash at its end."""
    return namespace(_names.node) if _names.node.count(SEP) > 1 else _names.namespace
