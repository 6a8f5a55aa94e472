"""Sequence, under the module name of smach."""

from smach import Sequence

__all__ = ["Sequence"]
