"""Protocol of the objects that can be destroyed."""

from __future__ import annotations

from typing import Any, Protocol


class DestroyableType(Protocol):
    """Object with a lifetime."""

    def __enter__(self) -> None: ...
    def __exit__(self, exc_type: Any, exc_val: Any, exctb: Any) -> None: ...
    def destroy_when_not_in_use(self) -> None: ...
