"""Replacement of `launch_testing`: descriptions of tests are read, tests are not run."""
from launch.action import Action
from launch.actions import ExecuteProcess

NO_CMD_ARGS = ""
EXIT_OK, EXIT_SIGINT, EXIT_SIGQUIT, EXIT_SIGKILL, EXIT_SIGSEGV = 0, 130, 131, 137, 139


class ReadyToTest(Action):
    """Start of the tests of a description; runs nothing."""

    def _deed(self):
        return {"do": "group", "actions": [], "is_scoped": False}


class GTest(ExecuteProcess):
    def __init__(self, *, path, timeout=None, **others):
        super().__init__(cmd=[path], **others)


class PyTest(ExecuteProcess):
    def __init__(self, *, path, timeout=None, **others):
        super().__init__(cmd=["python3", "-m", "pytest", path], **others)


class KeepAliveProc(ExecuteProcess):
    """A process that does nothing until everything ends."""

    def __init__(self, **others):
        super().__init__(cmd=["python3", "-c", "import signal; signal.pause()"], **others)


class _Later:
    """Something that only the runner of tests knows."""

    def __init__(self, *_args, **_others):
        pass

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _Later()

    def __call__(self, *_args, **_others):
        return _Later()


ActiveIoHandler = ActiveProcInfoHandler = IoHandler = ProcInfoHandler = ReadyAggregator = _Later
StdoutReadyListener = SequentialTextChecker = NoMatchingProcessException = _Later
LaunchTestRunner = LaunchTestService = _Later
assertDefaultStream = assertExitCodes = assertInStderr = assertInStdout = _Later()
assertInStream = assertSequentialStdout = resolveProcesses = _Later()
basicReportTestName = CmdArgsFilter = _Later()


def post_shutdown_test():
    return lambda subject: subject


def ready_to_test_action_timeout(_seconds):
    return lambda subject: subject


def keep_alive(subject):
    return subject


def retry_on_failure(*, times, delay=None):
    return lambda subject: subject


def parametrize(argnames, argvalues):
    """A description for each of some values: the plan is that of the first."""

    def decorated(function):
        names = [name.strip() for name in argnames.split(",") if name.strip()]
        values = list(argvalues)
        first = values[0] if values else ()
        first = first if isinstance(first, tuple) else (first,)
        function._first_values = {**getattr(function, "_first_values", {}), **dict(zip(names, first))}
        return function

    return decorated


from . import actions, asserts, event_handlers, legacy, markers, tools, util  # noqa: E402,F401
