"""Executors under test in the original."""

from rclpy.experimental.events_executor import EventsExecutor

__all__ = ["EventsExecutor"]
