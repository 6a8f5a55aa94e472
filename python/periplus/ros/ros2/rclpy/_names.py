"""Rules for the names of nodes, namespaces, topics and substitutions.

Each function returns None for a valid name, else the error and the index of the first wrong character.
"""

from __future__ import annotations

import re

Problem = tuple[str, int]

_WORD = re.compile(r"[A-Za-z0-9_]*")
_FULL = re.compile(r"[A-Za-z0-9_/]*")
_TOPIC = re.compile(r"[A-Za-z0-9_/~{}]*")
_NODE_LIMIT = 255
_NAMESPACE_LIMIT = 245
_TOPIC_LIMIT = 247

RESERVED_SUBSTITUTIONS = ("node", "ns", "namespace")


def node_problem(name: str) -> Problem | None:
    """Error of the name of a node."""
    if not name:
        return "node name must not be empty", 0
    end = _end(_WORD, name)
    if end < len(name):
        return "node name must not contain characters other than alphanumerics or '_'", end
    if name[0].isdigit():
        return "node name must not start with a number", 0
    if len(name) > _NODE_LIMIT:
        return f"node name length should not exceed '{_NODE_LIMIT}'", _NODE_LIMIT - 1
    return None


def _end(pattern: re.Pattern[str], name: str) -> int:
    match = pattern.match(name)
    return match.end() if match is not None else 0


def _path_problem(name: str, what: str) -> Problem | None:
    """Error of a full name: of a namespace or of an expanded topic."""
    if not name:
        return f"{what} must not be empty", 0
    if name[0] != "/":
        return f"{what} must be absolute, it must lead with a '/'", 0
    if len(name) > 1 and name[-1] == "/":
        only = ", unless only a '/'" if what == "namespace" else ""
        return f"{what} must not end with a '/'{only}", len(name) - 1
    end = _end(_FULL, name)
    if end < len(name):
        return f"{what} must not contain characters other than alphanumerics, '_', or '/'", end
    double = name.find("//")
    if double >= 0:
        return f"{what} must not contain repeated '/'", double + 1
    number = re.search(r"/[0-9]", name)
    if number is not None:
        return f"{what} must not have a token that starts with a number", number.start() + 1
    return None


def namespace_problem(name: str) -> Problem | None:
    """Error of a namespace."""
    problem = _path_problem(name, "namespace")
    if problem is None and len(name) > _NAMESPACE_LIMIT:
        return "namespace should not exceed 'RMW_NAMESPACE_MAX_NAME_LENGTH'", _NAMESPACE_LIMIT - 1
    return problem


def full_topic_problem(name: str) -> Problem | None:
    """Error of an expanded name of a topic or a service."""
    if name == "/":
        return "topic name must not end with a '/'", 0
    problem = _path_problem(name, "topic name")
    if problem is None and len(name) > _TOPIC_LIMIT:
        return "topic length should not exceed '255U - 8U'", _TOPIC_LIMIT - 1
    return problem


def topic_problem(name: str) -> Problem | None:
    """Error of the name of a topic or a service as a program gives it, with `~` and substitutions."""
    if not name:
        return "topic name must not be empty string", 0
    if name[0].isdigit():
        return "topic name token must not start with a number", 0
    if name[-1] == "/":
        return "topic name must not end with a forward slash", len(name) - 1
    open_at = -1
    for index, character in enumerate(name):
        if character == "{":
            if open_at >= 0:
                return _unbalanced(open_at)
            open_at = index
        elif character == "}":
            if open_at < 0:
                return _unbalanced(index)
            if index == open_at + 1:
                open_at = -1
                continue
            open_at = -1
        elif character == "~":
            if index > 0:
                return "topic name must not have tilde '~' unless it is the first character", index
        elif _WORD.fullmatch(character) is None:
            if open_at >= 0:
                return "substitution name must not contain characters other than alphanumerics or '_'", index
            if character != "/":
                return "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'", index
        elif open_at == index - 1 >= 0 and character.isdigit():
            return "substitution name must not start with a number", index
    if open_at >= 0:
        return _unbalanced(open_at)
    number = re.search(r"/[0-9]", name)
    if number is not None:
        return "topic name token must not start with a number", number.start() + 1
    return None


def _unbalanced(index: int) -> Problem:
    return "topic name must not have unmatched (unbalanced) curly braces '{}'", index


def expand(name: str, node_name: str, namespace: str) -> str:
    """Full name of a valid name. Raises `ValueError` for an unknown substitution."""
    inside = namespace.rstrip("/")

    def substitute(match: re.Match[str]) -> str:
        word = match.group(1)
        if word not in RESERVED_SUBSTITUTIONS:
            raise ValueError(f"unknown substitution: {{{word}}}")
        return node_name if word == "node" else inside

    name = re.sub(r"\{(\w*)\}", substitute, name)
    if name[:1] == "~":
        name = f"{inside}/{node_name}{name[1:]}"
    if name[:1] != "/":
        name = f"{inside}/{name}"
    return name
