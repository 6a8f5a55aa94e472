"""Optional packages."""

from importlib import import_module


def require(name: str, message: str) -> None:
    """Raises ``ModuleNotFoundError`` with a message if a package cannot be imported."""
    try:
        import_module(name)
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(message, name=name) from error
