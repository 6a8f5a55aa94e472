"""Time values under their old name."""

from genpy import Duration, Time, TVal

__all__ = ["Duration", "TVal", "Time"]
