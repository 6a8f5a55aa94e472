"""Events that a file can send, and conditions on actions."""
from launch.event import Event


class Shutdown(Event):
    def __init__(self, *, reason="reason not given", due_to_sigint=False, **_others):
        self.reason, self.due_to_sigint = reason, due_to_sigint


class TimerEvent(Event):
    pass


class ExecutionComplete(Event):
    def __init__(self, *, action=None):
        self.action = action


class IncludeLaunchDescription(Event):
    def __init__(self, launch_description):
        self.launch_description = launch_description


class _Matcher:
    """Matches one action."""

    def __init__(self, action):
        self.action = action

    def __call__(self, action):
        return action is self.action


def matches_action(target):
    return _Matcher(target)


from . import process  # noqa: E402,F401
