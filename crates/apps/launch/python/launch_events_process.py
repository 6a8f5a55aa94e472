"""Events of processes."""
from launch.event import Event


class RunningProcessEvent(Event):
    """Result of a process that succeeded."""

    def __init__(self, *, action=None, name="", cmd=(), cwd=None, env=None, pid=0, **_others):
        self.action, self.cmd, self.cwd, self.env, self.pid = action, list(cmd), cwd, env, pid
        self.process_name = name
        self.execute_process_action = action


class ProcessStarted(RunningProcessEvent):
    pass


class ProcessExited(RunningProcessEvent):
    def __init__(self, *, returncode=0, **details):
        super().__init__(**details)
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    def __init__(self, *, text=b"", fd=1, **details):
        super().__init__(**details)
        self.text, self.fd = text, fd
        self.from_stdin, self.from_stdout, self.from_stderr = (fd == each for each in range(3))


class ProcessStdin(ProcessIO):
    pass


class ProcessStdout(ProcessIO):
    pass


class ProcessStderr(ProcessIO):
    pass


class ProcessTargetedEvent(Event):
    def __init__(self, *, process_matcher=None):
        self.process_matcher = process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    pass


class SignalProcess(ProcessTargetedEvent):
    def __init__(self, *, signal_number, process_matcher=None):
        super().__init__(process_matcher=process_matcher)
        self.signal = signal_number


def matches_name(name):
    return lambda action: getattr(action, "name", None) == name


def matches_pid(pid):
    return lambda action: False


def matches_executable(executable):
    return lambda action: False
