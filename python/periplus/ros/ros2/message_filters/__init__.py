"""Synchronization of messages by their stamps."""

from message_filters._filters import (
    Cache as Cache,
    Chain as Chain,
    SimpleFilter as SimpleFilter,
    Subscriber as Subscriber,
)
from message_filters._synchronizers import (
    ApproximateTimeSynchronizer as ApproximateTimeSynchronizer,
    TimeSynchronizer as TimeSynchronizer,
)

__all__ = ["ApproximateTimeSynchronizer", "Cache", "Chain", "SimpleFilter", "Subscriber", "TimeSynchronizer"]
