"""YAML of command lines: scalars, and lists and dicts in brackets."""

from __future__ import annotations

import re
from typing import Any

_INTEGER = re.compile(r"[-+]?(0|[1-9][0-9]*)$")
_OTHER_INTEGER = re.compile(r"[-+]?(0[0-7]+|0x[0-9a-fA-F]+|0b[01]+)$")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$")
_SPECIAL: dict[str, Any] = {
    **dict.fromkeys(("true", "yes", "on"), True),
    **dict.fromkeys(("false", "no", "off"), False),
    ".inf": float("inf"),
    "+.inf": float("inf"),
    "-.inf": float("-inf"),
    ".nan": float("nan"),
}


def load(text: str) -> Any:
    """Value of a text; the text itself if it is no YAML of this kind.

    >>> load("[1, 2.5, {a: yes}]")
    [1, 2.5, {'a': True}]
    """
    stripped = text.strip()
    if stripped[:1] in ("[", "{"):
        try:
            value, at = _collection(stripped, 0)
            if stripped[at:].strip() == "":
                return value
        except (ValueError, IndexError):
            pass
        return text
    return scalar(stripped)


def scalar(text: str) -> Any:
    """Value of a plain or quoted scalar."""
    if len(text) >= 2 and text[0] == text[-1] and text[0] in "'\"":
        return text[1:-1].replace("''", "'") if text[0] == "'" else text[1:-1]
    if _INTEGER.match(text):
        return int(text)
    if _OTHER_INTEGER.match(text):
        sign = -1 if text[0] == "-" else 1
        digits = text.lstrip("+-")
        return sign * (int(digits, 0) if digits[1] in "xXbB" else int(digits, 8))
    if _FLOAT.match(text):
        return float(text)
    special = _SPECIAL.get(text.lower(), text)
    # YAML has `null`, which no parameter can be.
    return "" if text in ("~", "null", "Null", "NULL") else special


def _collection(text: str, at: int) -> tuple[Any, int]:
    if text[at] == "[":
        items: list[Any] = []
        at = _skip(text, at + 1)
        while text[at] != "]":
            item, at = _value(text, at, ",]")
            items.append(item)
            at = _skip(text, at)
            if text[at] == ",":
                at = _skip(text, at + 1)
        return items, at + 1
    found: dict[str, Any] = {}
    at = _skip(text, at + 1)
    while text[at] != "}":
        key, at = _value(text, at, ":}")
        at = _skip(text, at)
        if text[at] != ":":
            raise ValueError(text)
        found[str(key)], at = _value(text, _skip(text, at + 1), ",}")
        at = _skip(text, at)
        if text[at] == ",":
            at = _skip(text, at + 1)
    return found, at + 1


def _value(text: str, at: int, ends: str) -> tuple[Any, int]:
    if text[at] in "[{":
        return _collection(text, at)
    if text[at] in "'\"":
        end = text.index(text[at], at + 1)
        return scalar(text[at : end + 1]), end + 1
    end = at
    while text[end] not in ends:
        end += 1
    return scalar(text[at:end].strip()), end


def _skip(text: str, at: int) -> int:
    while text[at].isspace():
        at += 1
    return at
