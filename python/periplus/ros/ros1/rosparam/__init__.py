"""Parameters and files of parameters."""

from __future__ import annotations

from typing import Any

import rospy


class RosParamException(Exception):
    """A parameter that is not set, or a file that cannot be read."""


def get_param(param: str) -> Any:
    """Value of a parameter."""
    try:
        return rospy.get_param(param)
    except KeyError:
        raise RosParamException(f"Parameter [{param}] is not set") from None


def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:
    """Sets a parameter to a value."""
    rospy.set_param(param, value)


def set_param(param: str, value: str, verbose: bool = False) -> None:
    """Sets a parameter to the value of a YAML text."""
    from rospy._yaml import load

    rospy.set_param(param, load(value))


def delete_param(param: str, verbose: bool = False) -> None:
    """Deletes a parameter."""
    try:
        rospy.delete_param(param)
    except KeyError:
        raise RosParamException(f"Parameter [{param}] is not set") from None


def list_params(ns: str) -> list[str]:
    """Names of the parameters below a namespace."""
    prefix = ns.rstrip("/") + "/"
    return [one for one in rospy.get_param_names() if one.startswith(prefix)]


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:
    """Sets the parameters of a dict in a namespace."""
    if ns in ("", "/") and not isinstance(values, dict):
        raise RosParamException("global / can only be set to a dictionary")
    if isinstance(values, dict):
        for key, value in values.items():
            rospy.set_param(key if str(key).startswith("/") else f"{ns.rstrip('/')}/{key}", value)
    else:
        rospy.set_param(ns, values)


def load_file(filename: str, default_namespace: str | None = None, verbose: bool = False) -> list[tuple[Any, str]]:
    """Values of a YAML file with their namespace."""
    with open(filename, encoding="utf-8") as file:
        return load_str(file.read(), filename, default_namespace)


def load_str(
    text: str, filename: str, default_namespace: str | None = None, verbose: bool = False
) -> list[tuple[Any, str]]:
    """Values of a YAML text with their namespace. Needs PyYAML."""
    try:
        import yaml
    except ImportError:
        raise RosParamException(f"{filename}: reading YAML needs PyYAML; install it by `pip install pyyaml`") from None
    return [(one, default_namespace or rospy.get_namespace()) for one in yaml.safe_load_all(text) if one is not None]
