"""Numeric constants."""

#: Nanoseconds in a second.
S_TO_NS = 1000 * 1000 * 1000
