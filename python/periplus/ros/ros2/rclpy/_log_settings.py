"""Levels of the loggers."""

from __future__ import annotations

SEVERITIES = {"UNSET": 0, "DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}
NAMES = {number: name for name, number in SEVERITIES.items()}

DEFAULT_LEVEL = 20


class Levels:
    """Levels by the name of the logger; a logger without one has that of its nearest ancestor."""

    def __init__(self) -> None:
        self._given: dict[str, int] = {}
        self.default = DEFAULT_LEVEL
        #: Number of changes, so that loggers can keep their effective level.
        self.revision = 0

    def clear(self) -> None:
        """Forgets all levels."""
        self._given = {}
        self.default = DEFAULT_LEVEL
        self.revision += 1

    def set(self, name: str, level: int) -> None:
        """Sets the level of a logger; '' is the default of all."""
        self.revision += 1
        if name == "":
            self.default = level if level else DEFAULT_LEVEL
        elif level == 0:
            self._given.pop(name, None)
        else:
            self._given[name] = level

    def given(self, name: str) -> int:
        """Level that was set for this very logger, or 0."""
        return self.default if name == "" else self._given.get(name, 0)

    def effective(self, name: str) -> int:
        """Level that counts for a logger."""
        while name:
            level = self._given.get(name, 0)
            if level:
                return level
            name = name.rpartition(".")[0]
        return self.default


class Outputs:
    """Outputs of log messages."""

    def __init__(self) -> None:
        self.console = True
        self.file = False
        self.rosout = True
        self.file_prefix: str | None = None


levels = Levels()
outputs = Outputs()


def configure(ros_arguments: list[str]) -> None:
    """Takes the settings of the words after `--ros-args`, which are valid."""
    outputs.file = True
    words = iter(ros_arguments)
    for word in words:
        if word == "--log-level":
            name, separator, level = next(words, "").rpartition(":=")
            number = SEVERITIES.get(level.upper())
            if number is not None:
                levels.set(name if separator else "", number)
        elif word == "--log-file-name":
            outputs.file_prefix = next(words, None)
        elif word.startswith(("--enable-", "--disable-")) and word.endswith("-logs"):
            is_on = word.startswith("--enable-")
            what = word[: -len("-logs")].split("-", 3)[3]
            if what == "stdout":
                outputs.console = is_on
            elif what == "external-lib":
                outputs.file = is_on
            elif what == "rosout":
                outputs.rosout = is_on
