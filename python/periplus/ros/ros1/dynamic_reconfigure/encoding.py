"""Values between dicts and messages."""

from __future__ import annotations

from typing import Any

from dynamic_reconfigure.msg import (
    BoolParameter,
    Config,
    ConfigDescription,
    DoubleParameter,
    Group,
    GroupState,
    IntParameter,
    ParamDescription,
    StrParameter,
)


class Config_(dict):  # type: ignore[type-arg]
    """A dict whose items are attributes too."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def copy(self) -> Config_:
        return Config_(self)


def encode_config(config: dict[str, Any], flat: bool = True) -> Any:
    """Message of a dict."""
    made = Config()
    for key, value in config.items():
        if key == "groups":
            continue
        if isinstance(value, bool):
            made.bools.append(BoolParameter(key, value))
        elif isinstance(value, int):
            made.ints.append(IntParameter(key, value))
        elif isinstance(value, float):
            made.doubles.append(DoubleParameter(key, value))
        else:
            made.strs.append(StrParameter(key, str(value)))
    for one in _groups(config.get("groups")):
        made.groups.append(GroupState(one["name"], bool(one.get("state", True)), one["id"], one["parent"]))
    return made


def _groups(group: Any) -> list[dict[str, Any]]:
    if not group:
        return []
    inner = group.get("groups", [])
    found = [group]
    for one in inner.values() if isinstance(inner, dict) else inner:
        found += _groups(one)
    return found


def decode_config(msg: Any, description: Any = None) -> Config_:
    """Dict of a message."""
    made = Config_()
    for one in (*msg.bools, *msg.ints, *msg.strs, *msg.doubles):
        made[one.name] = one.value
    if description is not None and msg.groups:
        made["groups"] = {
            "name": description["name"],
            "id": description["id"],
            "parent": description["parent"],
            "state": True,
            "type": description["type"],
            "parameters": {},
            "groups": {},
        }
    return made


def encode_description(descr: Any) -> Any:
    """Message that describes the parameters of a configuration module."""
    made = ConfigDescription()
    made.max = encode_config(descr.max)
    made.min = encode_config(descr.min)
    made.dflt = encode_config({**descr.defaults, "groups": descr.config_description})
    for one in _groups(descr.config_description):
        group = Group(name=one["name"], type=one["type"], parent=one["parent"], id=one["id"])
        for each in one["parameters"]:
            group.parameters.append(
                ParamDescription(
                    each["name"], each["type"], each["level"], each["description"], str(each["edit_method"])
                )
            )
        made.groups.append(group)
    return made




def decode_description(msg: Any) -> list[dict[str, Any]]:
    """Parameters of a description, as dicts."""
    low, high, default = decode_config(msg.min), decode_config(msg.max), decode_config(msg.dflt)
    return [
        {
            "name": one.name,
            "min": low[one.name],
            "max": high[one.name],
            "default": default[one.name],
            "type": one.type,
            "level": one.level,
            "description": one.description,
            "edit_method": one.edit_method,
        }
        for group in msg.groups
        for one in group.parameters
    ]


def extract_params(group: dict[str, Any]) -> list[dict[str, Any]]:
    """Parameters of a group and of those inside."""
    return [one for each in _groups(group) for one in each["parameters"]]


