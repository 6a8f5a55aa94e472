"""State and CBState, under the module name of smach."""

from smach import State, CBState

__all__ = ["State", "CBState"]
