"""Names of all types."""

from __future__ import annotations

from collections.abc import Iterable

from periplus.ros import _rosidl_modules


def get_interface_packages() -> dict[str, str]:
    """Names of the packages with types; the values are empty, as the types need no files."""
    return {name: "" for name in sorted(_rosidl_modules.packages())}


def _of_kind(kind: str, package_names: Iterable[str]) -> dict[str, list[str]]:
    known = _rosidl_modules.packages()
    found: dict[str, list[str]] = {}
    for package in sorted(package_names or known):
        if package not in known:
            raise LookupError(f"Unknown package '{package}'")
        names = known[package].get(kind, [])
        wholes = [name for name in names if kind == "msg" or f"{package}/{kind}/{name}" in _rosidl_modules._wholes]
        if wholes:
            found[package] = wholes
    return found


def get_message_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Names of the messages by package."""
    return _of_kind("msg", package_names)


def get_service_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Names of the services by package."""
    return _of_kind("srv", package_names)


def get_action_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Names of the actions by package."""
    return _of_kind("action", package_names)


def get_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Names of all types by package, with their kinds, such as `msg/String`."""
    found: dict[str, list[str]] = {}
    for kind in ("msg", "srv", "action"):
        for package, names in _of_kind(kind, package_names).items():
            found.setdefault(package, []).extend(f"{kind}/{name}" for name in names)
    return found
