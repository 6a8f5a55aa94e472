"""Event handlers."""
from launch.event_handler import _On


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
    def __init__(self, *, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, **_others):
        super().__init__("printed", on_stdout or on_stderr or on_stdin, of=target_action)


class OnShutdown(_On):
    def __init__(self, *, on_shutdown, **_others):
        super().__init__("shutdown", [] if callable(on_shutdown) else on_shutdown)
        self._is_function = callable(on_shutdown)

    def _described(self):
        if self._is_function:
            return {"do": "left", "what": "a function that the file calls at the end"}
        return super()._described()


from . import on_process_exit, on_process_start, on_shutdown  # noqa: E402,F401
