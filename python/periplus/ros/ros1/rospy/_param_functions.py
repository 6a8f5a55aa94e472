"""Functions of the parameters."""

from __future__ import annotations

from typing import Any

from rospy import core, names
from rospy._params import service as parameters

_unset = object()


def get_param(param_name: str, default: Any = _unset) -> Any:
    """Value of a parameter; a dict for a subtree.

    Raises:
        KeyError: It is not set and there is no default.
    """
    name = _parameter(param_name)
    try:
        return parameters.get(name)
    except KeyError:
        if default is _unset:
            raise KeyError(param_name) from None
        return default


def get_param_cached(param_name: str, default: Any = _unset) -> Any:
    """Value of a parameter, as `get_param` returns it."""
    return get_param(param_name, default)


def set_param(param_name: str, param_value: Any) -> None:
    """Sets a parameter in all nodes."""
    parameters.set(_parameter(param_name), param_value)


def has_param(param_name: str) -> bool:
    """True if a parameter is set."""
    return parameters.has(_parameter(param_name))


def delete_param(param_name: str) -> None:
    """Deletes a parameter or a subtree. Raises `KeyError` if it is not set."""
    try:
        parameters.delete(_parameter(param_name))
    except KeyError:
        raise KeyError(param_name) from None


def search_param(param_name: str) -> str | None:
    """Full name of a parameter in the namespace of the node, or in the nearest one around it; None without one."""
    if names.is_global(param_name) or names.is_private(param_name):
        full = _parameter(param_name)
        return full if parameters.has(full) else None
    first, _, _ = param_name.partition("/")
    scope = core.get_name()
    while True:
        if parameters.has(f"{scope}/{first}"):
            return f"{scope}/{param_name}"
        if not scope:
            return None
        scope = scope.rpartition("/")[0]


def get_param_names() -> list[str]:
    """Names of all parameters."""
    return parameters.names()


def _parameter(name: str) -> str:
    if not name:
        raise ValueError("param_name cannot be empty")
    if name.startswith("~") and not core.is_initialized():
        return names.resolve_name(name)
    return names.remap_name(name)
