"""The part of YAML that parameter files and command lines use: mappings, lists, scalars, comments."""

from __future__ import annotations

import re
from typing import Any

_BOOLEANS = {
    **dict.fromkeys(("true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"), True),
    **dict.fromkeys(("false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"), False),
}
_NULLS = ("", "~", "null", "Null", "NULL")
_INTEGER = re.compile(r"[-+]?(0|[1-9][0-9_]*)|0x[0-9a-fA-F_]+|0b[01_]+|0[0-7_]+")
_FLOAT = re.compile(r"[-+]?([0-9][0-9_]*\.[0-9_]*|\.[0-9][0-9_]*)([eE][-+][0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_ESCAPES = {"n": "\n", "t": "\t", '"': '"', "\\": "\\", "r": "\r", "0": "\0", "/": "/"}


def scalar(text: str) -> Any:
    """Value of a scalar."""
    text = text.strip()
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    if text in _NULLS:
        return None
    if _INTEGER.fullmatch(text):
        digits = text.replace("_", "")
        if re.fullmatch(r"0[0-7]+", digits):
            return int(digits, 8)
        return int(digits, 0)
    if _FLOAT.fullmatch(text):
        return float(text.replace("_", "").replace(".inf", "inf").replace(".Inf", "inf").replace(".INF", "inf").replace(".nan", "nan").replace(".NaN", "nan").replace(".NAN", "nan"))
    return text


def scalar_or_list(text: str) -> Any:
    """Value of a text on one line; the text itself if it is no YAML."""
    try:
        flow = _Flow(text)
        value = flow.value("")
        return text if flow.rest().strip() else value
    except ValueError:
        return text


class _Flow:
    """Reader of values on one line: scalars, quoted texts, `[...]` and `{...}`."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0

    def rest(self) -> str:
        return self._text[self._at :]

    def _skip(self) -> str:
        while self._at < len(self._text) and self._text[self._at] in " \t\n":
            self._at += 1
        return self._text[self._at : self._at + 1]

    def value(self, ends: str) -> Any:
        first = self._skip()
        if first == "[":
            return self._items("]")
        if first == "{":
            return self._pairs()
        if first in ("'", '"') and first:
            return self._quoted(first)
        start = self._at
        while self._at < len(self._text) and self._text[self._at] not in ends:
            if ends and self._text[self._at] == ":" and self._text[self._at + 1 : self._at + 2] in (" ", ""):
                break
            self._at += 1
        return scalar(self._text[start : self._at])

    def _items(self, end: str) -> list[Any]:
        self._at += 1
        found: list[Any] = []
        while True:
            if self._skip() == end:
                self._at += 1
                return found
            found.append(self.value(",]"))
            after = self._skip()
            if after == ",":
                self._at += 1
            elif after != end:
                raise ValueError("a list without its end")

    def _pairs(self) -> dict[Any, Any]:
        self._at += 1
        found: dict[Any, Any] = {}
        while True:
            if self._skip() == "}":
                self._at += 1
                return found
            key = self.value(",}:")
            if self._skip() == ":":
                self._at += 1
                found[key] = self.value(",}")
            else:
                found[key] = None
            after = self._skip()
            if after == ",":
                self._at += 1
            elif after != "}":
                raise ValueError("a mapping without its end")

    def _quoted(self, quote: str) -> str:
        self._at += 1
        found: list[str] = []
        while self._at < len(self._text):
            one = self._text[self._at]
            self._at += 1
            if one == quote:
                if quote == "'" and self._text[self._at : self._at + 1] == "'":
                    self._at += 1
                else:
                    return "".join(found)
            elif one == "\\" and quote == '"':
                one = _ESCAPES.get(self._text[self._at : self._at + 1], "")
                self._at += 1
            found.append(one)
        raise ValueError("a quoted text without its end")


_KEY = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^']|'')*'|[^\s#\[\]{},"'][^#]*?)\s*:(?=\s|$)""")


def load(text: str) -> Any:
    """Value of a file. Raises `ValueError` with the line for what is not understood."""
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        stripped = _without_comment(line).rstrip()
        if stripped.strip() and stripped.strip() not in ("---", "..."):
            lines.append((len(stripped) - len(stripped.lstrip()), stripped.strip(), number))
    if not lines:
        return None
    value, at = _block(lines, 0, lines[0][0])
    if at < len(lines):
        raise ValueError(f"line {lines[at][2]}: unexpected indentation")
    return value


def _without_comment(line: str) -> str:
    quote = ""
    for index, one in enumerate(line):
        if quote:
            quote = "" if one == quote else quote
        elif one in "'\"" and (index == 0 or line[index - 1] in " \t[{,:"):
            quote = one
        elif one == "#" and (index == 0 or line[index - 1] in " \t"):
            return line[:index]
    return line


def _inline(text: str, lines: list[tuple[int, str, int]], at: int) -> tuple[Any, int]:
    """Value of the rest of a line; flow lists may go on in the next lines."""
    while text.count("[") > text.count("]") or text.count("{") > text.count("}"):
        if at >= len(lines):
            break
        text += " " + lines[at][1]
        at += 1
    return scalar_or_list(text), at


def _block(lines: list[tuple[int, str, int]], at: int, indent: int) -> tuple[Any, int]:
    if lines[at][1].startswith("- ") or lines[at][1] == "-":
        return _list(lines, at, indent)
    if _KEY.match(lines[at][1]) is None:
        return _inline(lines[at][1], lines, at + 1)
    found: dict[Any, Any] = {}
    while at < len(lines) and lines[at][0] == indent:
        match = _KEY.match(lines[at][1])
        if match is None:
            raise ValueError(f"line {lines[at][2]}: expected `name: value`")
        key = scalar_or_list(match.group(1))
        rest = lines[at][1][match.end() :].strip()
        at += 1
        if rest:
            found[key], at = _inline(rest, lines, at)
        elif at < len(lines) and (lines[at][0] > indent or (lines[at][0] == indent and lines[at][1][:1] == "-")):
            found[key], at = _block(lines, at, lines[at][0])
        else:
            found[key] = None
    return found, at


def _list(lines: list[tuple[int, str, int]], at: int, indent: int) -> tuple[Any, int]:
    found: list[Any] = []
    while at < len(lines) and lines[at][0] == indent and (lines[at][1].startswith("- ") or lines[at][1] == "-"):
        rest = lines[at][1][1:].strip()
        if not rest:
            at += 1
            value, at = _block(lines, at, lines[at][0]) if at < len(lines) and lines[at][0] > indent else (None, at)
        elif _KEY.match(rest):
            inner = indent + len(lines[at][1]) - len(rest)
            nested = [*lines[:at], (inner, rest, lines[at][2]), *lines[at + 1 :]]
            value, at = _block(nested, at, inner)
        else:
            value, at = _inline(rest, lines, at + 1)
        found.append(value)
    return found, at
