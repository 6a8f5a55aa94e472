"""Replacement of `launch_testing_ros`: its classes need a runner of tests."""
from launch_testing import _Later

DataRepublisher = MessagePump = LaunchTestRunner = WaitForTopics = EnableRmwIsolation = _Later
basic_stdout_filter = get_default_filtered_patterns = get_default_filtered_prefixes = _Later()
