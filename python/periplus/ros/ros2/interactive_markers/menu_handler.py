"""Menus of interactive markers."""

from periplus.ros._marker_menus import MenuHandler

__all__ = ["MenuHandler"]
