"""One handler, by the name of its module."""
from launch.event_handlers import OnShutdown  # noqa: F401
