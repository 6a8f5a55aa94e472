"""Conditions on actions."""
from launch.events import matches_action  # noqa: F401
