"""Concurrence, under the module name of smach."""

from smach import Concurrence

__all__ = ["Concurrence"]
