"""Iterator, under the module name of smach."""

from smach import Iterator

__all__ = ["Iterator"]
