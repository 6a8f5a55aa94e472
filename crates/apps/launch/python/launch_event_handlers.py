"""Event handlers."""
from launch.event_handler import EventHandler, _On


class OnProcessStart(_On):
    def __init__(self, *, on_start, target_action=None, **_others):
        super().__init__("started", on_start, of=target_action)


class OnProcessExit(_On):
    def __init__(self, *, on_exit, target_action=None, **_others):
        super().__init__("ended", on_exit, of=target_action)


class OnExecutionComplete(_On):
    def __init__(self, *, on_completion, target_action=None, **_others):
        super().__init__("ended", on_completion, of=target_action)


class OnProcessIO(_On):
    """Handles what a process prints; functions that read it have nothing to read before it runs."""

    def __init__(self, *, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, **_others):
        super().__init__("printed", on_stdout or on_stderr or on_stdin, of=target_action)

    def _described(self):
        if callable(self._reactions):
            return {"do": "left", "what": "a function that reads what a process prints"}
        return super()._described()


class OnShutdown(_On):
    def __init__(self, *, on_shutdown, **_others):
        super().__init__("shutdown", on_shutdown)


class OnIncludeLaunchDescription(EventHandler):
    """Included files are read when the plan is made."""

    def __init__(self, **_others):
        super().__init__()


OnActionEventBase = _On


def event_named(event_name):
    return lambda event: getattr(event, "name", None) == event_name
