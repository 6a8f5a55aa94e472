"""Parameters and groups that a `.cfg` file declares."""

from __future__ import annotations

from typing import Any

bool_t, int_t, double_t, str_t = "bool", "int", "double", "str"
_DEFAULTS: dict[str, Any] = {"bool": False, "int": 0, "double": 0.0, "str": ""}
_LIMITS: dict[str, tuple[Any, Any]] = {
    "bool": (False, True),
    "int": (-(2**31) + 1, 2**31 - 1),
    "double": (float("-inf"), float("inf")),
    "str": ("", ""),
}
_TYPES: dict[str, Any] = {"bool": bool, "int": int, "double": float, "str": str}


class ParameterGenerator:
    """Collects what a `.cfg` file declares."""

    #: Generators whose `generate` was called while a file runs, with the name of the configuration.
    finished: list[tuple[ParameterGenerator, str]] = []

    def __init__(self) -> None:
        self._constants: dict[str, Any] = {}
        self.group = Group(self, "Default", "", True, 0, 0, None)
        self.groups = [self.group]

    def const(self, name: str, type: str, value: Any, descr: str) -> dict[str, Any]:
        """Declares a constant of an enumeration."""
        self._constants[name] = value
        return {"name": name, "type": type, "value": value, "description": descr, "srcline": 0, "srcfile": ""}

    def enum(self, constants: list[dict[str, Any]], description: str) -> str:
        """Declares an enumeration."""
        return repr({"enum": constants, "enum_description": description})

    def add_group(self, name: str, type: str = "", state: bool = True) -> Group:
        """Declares a group."""
        return self.group.add_group(name, type, state)

    def add(self, *args: Any, **kwargs: Any) -> None:
        """Declares a parameter."""
        self.group.add(*args, **kwargs)

    def generate(self, pkgname: str, nodename: str, name: str) -> int:
        """Ends the declarations."""
        ParameterGenerator.finished.append((self, name))
        return 0


class Group:
    """A group of parameters."""

    def __init__(
        self,
        generator: ParameterGenerator,
        name: str,
        kind: str,
        state: bool,
        number: int,
        parent: int,
        parent_group: Group | None,
    ) -> None:
        self.generator = generator
        self.name, self.type, self.state = name, kind, state
        self.id, self.parent = number, parent
        self.parameters: list[dict[str, Any]] = []
        self.groups: list[Group] = []

    def add_group(self, name: str, type: str = "", state: bool = True) -> Group:
        """Declares a group inside this one."""
        made = Group(self.generator, name, type, state, len(self.generator.groups), self.id, self)
        self.groups.append(made)
        self.generator.groups.append(made)
        return made

    def add(
        self,
        name: str,
        paramtype: str,
        level: int,
        description: str,
        default: Any = None,
        min: Any = None,
        max: Any = None,
        edit_method: Any = "",
    ) -> None:
        """Declares a parameter: type, level, description, default and limits."""
        if paramtype not in _TYPES:
            raise ValueError(f"parameter {name}: type {paramtype!r} is none of {sorted(_TYPES)}")
        kind = _TYPES[paramtype]
        low, high = _LIMITS[paramtype]
        entry = {
            "name": name,
            "type": paramtype,
            "level": level,
            "description": description,
            "default": kind(_DEFAULTS[paramtype] if default is None else default),
            "min": low if min is None else kind(min),
            "max": high if max is None else kind(max),
            "edit_method": edit_method or "",
            "srcline": 0,
            "srcfile": "",
            "cconsttype": "",
            "ctype": {"bool": "bool", "int": "int", "double": "double", "str": "std::string"}[paramtype],
        }
        if paramtype in ("int", "double") and not entry["min"] <= entry["default"] <= entry["max"]:
            raise ValueError(
                f"parameter {name}: default {entry['default']} is not between {entry['min']} and {entry['max']}"
            )
        self.parameters.append(entry)

    def to_dict(self) -> dict[str, Any]:
        """Description of the group, as programs read it."""
        return {
            "name": self.name,
            "type": self.type,
            "state": self.state,
            "id": self.id,
            "parent": self.parent,
            "cstate": "true" if self.state else "false",
            "parameters": self.parameters,
            "groups": [one.to_dict() for one in self.groups],
        }
