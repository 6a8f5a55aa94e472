"""Menus of interactive markers, of both generations of ROS."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any


def _messages() -> Any:
    """Messages of the generation that the program uses, whose modules are on the path of users' programs only."""
    return importlib.import_module("visualization_msgs.msg")


# `MenuEntry.FEEDBACK` of both generations.
_FEEDBACK = 0


class MenuHandler:
    """A tree of menu entries with their functions."""

    NO_CHECKBOX = 0
    CHECKED = 1
    UNCHECKED = 2

    def __init__(self) -> None:
        self._entries: dict[int, dict[str, Any]] = {}
        self._markers: set[str] = set()

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = _FEEDBACK,
        command: str = "",
        callback: Callable[[Any], Any] | None = None,
    ) -> int:
        """Adds an entry; returns its number."""
        number = len(self._entries) + 1
        self._entries[number] = {
            "title": title,
            "parent": parent or 0,
            "type": command_type,
            "command": command,
            "callback": callback,
            "visible": True,
            "check": self.NO_CHECKBOX,
        }
        return number

    def setVisible(self, handle: int, visible: bool) -> bool:  # noqa: N802
        return self._change(handle, "visible", visible)

    def setCheckState(self, handle: int, check_state: int) -> bool:  # noqa: N802
        return self._change(handle, "check", check_state)

    def getCheckState(self, handle: int) -> int | None:  # noqa: N802
        return self._entries[handle]["check"] if handle in self._entries else None

    def _change(self, handle: int, key: str, value: Any) -> bool:
        if handle not in self._entries:
            return False
        self._entries[handle][key] = value
        return True

    def getTitle(self, handle: int) -> str | None:  # noqa: N802
        return self._entries[handle]["title"] if handle in self._entries else None

    def apply(self, server: Any, marker_name: str) -> bool:
        """Gives the menu to a marker of a server."""
        marker = server.get(marker_name)
        if marker is None:
            return False
        marker.menu_entries = []
        for number, one in self._entries.items():
            if one["visible"]:
                mark = {self.CHECKED: "[x] ", self.UNCHECKED: "[ ] "}.get(one["check"], "")
                entry = _messages().MenuEntry(
                    id=number,
                    parent_id=one["parent"],
                    title=mark + one["title"],
                    command=one["command"],
                    command_type=one["type"],
                )
                marker.menu_entries.append(entry)
        server.insert(marker)
        server.setCallback(marker_name, self._selected, _messages().InteractiveMarkerFeedback.MENU_SELECT)
        self._markers.add(marker_name)
        return True

    def reApply(self, server: Any) -> bool:  # noqa: N802
        """Gives the menu to all its markers again."""
        return all([self.apply(server, one) for one in sorted(self._markers)])

    def _selected(self, feedback: Any) -> None:
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry["callback"] is not None:
            entry["callback"](feedback)
