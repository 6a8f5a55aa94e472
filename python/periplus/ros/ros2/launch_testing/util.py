"""Actions of test descriptions."""

from launch_testing._placeholders import Recorded


class KeepAliveProc(Recorded):
    """Process that does nothing until the end."""
