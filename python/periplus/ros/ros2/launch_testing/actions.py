"""Actions of test descriptions."""

from launch_testing._placeholders import Recorded


class ReadyToTest(Recorded):
    """Point at which the tests start."""


class GTest(Recorded):
    """Test program in C++."""


class PyTest(Recorded):
    """Test program in Python."""
