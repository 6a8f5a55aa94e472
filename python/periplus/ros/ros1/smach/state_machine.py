"""StateMachine, under the module name of smach."""

from smach import StateMachine

__all__ = ["StateMachine"]
