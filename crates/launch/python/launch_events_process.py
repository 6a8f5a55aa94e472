"""Events of processes."""
from launch.event import Event


class _OfProcess(Event):
    def __init__(self, *, action=None, process_matcher=None, **_others):
        self.action, self.process_matcher = action, process_matcher
        self.process_name = ""
        self.returncode = 0


class ProcessStarted(_OfProcess):
    pass


class ProcessExited(_OfProcess):
    pass


class ProcessIO(_OfProcess):
    text = b""


class ShutdownProcess(_OfProcess):
    pass


class SignalProcess(_OfProcess):
    pass
