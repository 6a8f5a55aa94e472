"""Paths of packages, as programs of ROS 1 set them up: there is nothing to do."""

from roslib import message, packages, rostime
from roslib.launcher import load_manifest

__all__ = ["load_manifest", "message", "packages", "rostime"]
