"""Messages as dictionaries, YAML and CSV."""

from __future__ import annotations

import re
from array import array
from collections import OrderedDict
from typing import Any

from periplus import _native

_PLAIN = re.compile(r"[A-Za-z_/][A-Za-z0-9_/.\- ]*[A-Za-z0-9_/]|[A-Za-z_]")
_WORDS = {"true", "false", "null", "yes", "no", "on", "off", "y", "n"}


def message_to_ordereddict(
    msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> OrderedDict[str, Any]:
    """Message as a dictionary; longer arrays and texts are cut at `truncate_length`."""
    made: OrderedDict[str, Any] = OrderedDict()
    for name, text in msg.get_fields_and_field_types().items():
        made[name] = _value(getattr(msg, name), text, truncate_length, no_arr, no_str)
    return made


def _value(value: Any, type_text: str, limit: int | None, no_arr: bool, no_str: bool) -> Any:
    if isinstance(value, bytes):
        return value if limit is None or len(value) <= limit else "".join(chr(one) for one in value[:limit]) + "..."
    if isinstance(value, str):
        if no_str:
            return f"<string length: <{len(value)}>>"
        return value if limit is None or len(value) <= limit else value[:limit] + "..."
    if hasattr(value, "get_fields_and_field_types"):
        return message_to_ordereddict(value, truncate_length=limit, no_arr=no_arr, no_str=no_str)
    if not isinstance(value, (list, tuple, array)) and not hasattr(value, "dtype"):
        return value
    if hasattr(value, "dtype") and not value.shape:
        return value.item()
    if no_arr:
        if type_text.startswith("sequence"):
            return f"<sequence type: {type_text}, length: {len(value)}>"
        return f"<array type: {type_text}>"
    shown = list(value if limit is None else value[:limit])
    element = type_text.removeprefix("sequence<").partition("[")[0].partition(",")[0].rstrip(">")
    made = [_value(one, element, limit, no_arr, no_str) for one in shown]
    if limit is not None and len(value) > limit:
        made.append("...")
    return made


def message_to_yaml(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Message as YAML, in the format of `ros2 topic echo`."""
    if not (no_arr or no_str or flow_style):
        return _native.message_to_yaml(msg, max_length=truncate_length)
    made = message_to_ordereddict(msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)
    if flow_style:
        return _flow(made) + "\n"
    return "".join(line + "\n" for line in _block(made, ""))


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name}: {_flow(one)}" for name, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(one) for one in value) + "]"
    return _scalar(value)


def _block(value: dict[str, Any], indent: str) -> list[str]:
    lines = []
    for name, one in value.items():
        if isinstance(one, dict) and one:
            lines += [f"{indent}{name}:", *_block(one, indent + "  ")]
        elif isinstance(one, list) and one:
            lines.append(f"{indent}{name}:")
            for element in one:
                if isinstance(element, dict) and element:
                    first, *rest = _block(element, indent + "  ")
                    lines += [f"{indent}- {first[len(indent) + 2 :]}", *rest]
                else:
                    lines.append(f"{indent}- {_flow(element)}")
        else:
            lines.append(f"{indent}{name}: {_flow(one)}")
    return lines


def _scalar(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if value != value:
            return ".nan"
        if value in (float("inf"), float("-inf")):
            return ".inf" if value > 0 else "-.inf"
        return repr(value)
    if isinstance(value, bytes):
        return str(value[0]) if len(value) == 1 else repr(list(value))
    if isinstance(value, str):
        if _PLAIN.fullmatch(value) and value.lower() not in _WORDS:
            return value
        if all(character.isprintable() for character in value):
            return "'" + value.replace("'", "''") + "'"
        import json

        return json.dumps(value)
    return str(value)


def message_to_csv(
    msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> str:
    """Values of a message, separated by commas."""

    def flat(value: Any) -> list[str]:
        if isinstance(value, dict):
            return [one for each in value.values() for one in flat(each)]
        if isinstance(value, list):
            return [one for each in value for one in flat(each)]
        return [str(value)]

    return ",".join(flat(message_to_ordereddict(msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)))
