"""Hashes of types."""

from __future__ import annotations


class TypeHash:
    """Hash of a type's definition."""

    __slots__ = ["_version", "_value"]

    def __init__(self, version: int = -1, value: bytes = bytes(32)) -> None:
        self.version = version
        self.value = value

    @property
    def version(self) -> int:
        """Version of the hash; -1 for none."""
        return self._version

    @version.setter
    def version(self, value: int) -> None:
        assert isinstance(value, int)
        self._version = value

    @property
    def value(self) -> bytes:
        """The 32 bytes."""
        return self._value

    @value.setter
    def value(self, value: bytes) -> None:
        assert isinstance(value, bytes)
        self._value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TypeHash) and (self._version, self._value) == (other._version, other._value)

    def __str__(self) -> str:
        if self._version <= 0 or len(self._value) != 32:
            return "INVALID"
        return f"RIHS{self._version:02}_{self._value.hex()}"

    @classmethod
    def _from_text(cls, text: str | None) -> TypeHash:
        """Hash of its text, such as `RIHS01_...`."""
        if not text or not text.startswith("RIHS") or "_" not in text:
            return cls()
        version, _, digits = text[4:].partition("_")
        try:
            return cls(int(version), bytes.fromhex(digits))
        except ValueError:
            return cls()
