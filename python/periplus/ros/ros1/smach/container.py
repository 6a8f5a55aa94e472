"""Container, under the module name of smach."""

from smach import Container

__all__ = ["Container"]
