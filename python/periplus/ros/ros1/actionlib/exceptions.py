"""Exceptions of actionlib."""


class ActionException(Exception):
    """Wrong use of an action."""
