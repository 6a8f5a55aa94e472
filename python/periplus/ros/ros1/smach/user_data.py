"""UserData and Remapper, under the module name of smach."""

from smach import UserData, Remapper

__all__ = ["UserData", "Remapper"]
