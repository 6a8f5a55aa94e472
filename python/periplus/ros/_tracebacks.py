"""Tracebacks that begin at the user's code and name what to do."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import traceback
    from types import FrameType, TracebackType

_FOLDER = os.path.dirname(os.path.abspath(__file__)) + os.sep
_IMPORTLIB = os.path.join(os.path.dirname(os.__file__), "importlib") + os.sep
#: End of the file names of code that these modules generate.
_GENERATED = " of periplus.ros>"
#: Set to 1 to see the frames of Periplus too.
FULL_VARIABLE = "PERIPLUS_FULL_TRACEBACK"


def is_own_file(path: str) -> bool:
    """True for files of these modules and of Python's import machinery."""
    return path.startswith((_FOLDER, "<frozen ", _IMPORTLIB)) or path.endswith(_GENERATED)


def is_library_file(path: str) -> bool:
    """True for files of Python, of installed packages and of Periplus: not the user's own code."""
    if is_own_file(path) or path.startswith("<"):
        return True
    return os.sep + "site-packages" + os.sep in path or path.startswith(os.path.dirname(os.__file__) + os.sep)


def user_frame(frame: FrameType | None) -> FrameType | None:
    """The innermost frame of the user's code at or above `frame`, or None."""
    while frame is not None and is_library_file(frame.f_code.co_filename):
        frame = frame.f_back
    return frame


def location(frame: FrameType | None) -> str:
    """`file:line (function)` of a frame; a path below the current folder is relative."""
    if frame is None:
        return "?"
    return f"{short_path(frame.f_code.co_filename)}:{frame.f_lineno} ({frame.f_code.co_name})"


def short_path(path: str) -> str:
    """`path` relative to the current folder if it is in it."""
    try:
        folder = os.getcwd() + os.sep
    except OSError:
        return path
    return path[len(folder) :] if path.startswith(folder) else path


def format_exception(error: BaseException, trace: TracebackType | None = None) -> str:
    """The traceback as Python prints it, without frames of Periplus, and with a hint if there is one."""
    import traceback

    trace = trace if trace is not None else error.__traceback__
    made = traceback.TracebackException(type(error), error, trace)
    if os.environ.get(FULL_VARIABLE, "") in ("", "0"):
        # The note of a callback that could not be called names its line.
        _strip(made, has_place=bool(getattr(error, "__notes__", ())))
    text = "".join(made.format())
    if sys.version_info < (3, 11):
        # Packages such as `exceptiongroup` print them for Python 3.10.
        text += "".join(f"{note}\n" for note in getattr(error, "__notes__", ()) if f"\n{note}\n" not in text)
    from ._hints import hint

    advice = hint(error)
    return text + (f"{advice}\n" if advice else "")


def _strip(made: traceback.TracebackException, *, has_place: bool) -> None:
    """Removes frames of Periplus, unless no other is left and the error has no other place."""
    import traceback

    seen: set[int] = set()
    waiting = [made]
    while waiting:
        one = waiting.pop()
        if id(one) in seen:
            continue
        seen.add(id(one))
        kept = [frame for frame in one.stack if not is_own_file(frame.filename)]
        if kept or (has_place and one is made) or one.exc_type in (SyntaxError, IndentationError, TabError):
            one.stack = traceback.StackSummary.from_list(kept)
        waiting += [other for other in (one.__cause__, one.__context__) if other is not None]
        waiting += list(getattr(one, "exceptions", None) or [])


def is_end_of_simulation(error: BaseException | None) -> bool:
    """True for the error by which a program notices that its simulation has ended: the interrupt that nothing caught, or
    the call of a node whose context is gone. There is nothing to tell about it."""
    from . import _waiting

    if error is None or not _waiting.has_ended():
        return False
    if error.__cause__ is not None:
        # Wrapped, as by SMACH.
        return is_end_of_simulation(error.__cause__)
    name = type(error).__name__
    if name == "ROSException":
        return "closed topic" in str(error)
    if name == "RCLError":
        return any(text in str(error) for text in ("context is invalid", "rcl_shutdown already called"))
    return name in ("KeyboardInterrupt", "ROSInterruptException", "ExternalShutdownException")


def print_exception(error: BaseException, trace: TracebackType | None = None) -> None:
    """Prints `format_exception` on stderr in one piece."""
    sys.stderr.write(format_exception(error, trace))
    sys.stderr.flush()


def format_stack(frame: FrameType | None) -> str:
    """The stack of a thread, without frames of Periplus above the user's outermost one."""
    import traceback

    lines = traceback.extract_stack(frame)
    kept = [line for line in lines if not is_own_file(line.filename)]
    return "".join(traceback.StackSummary.from_list(kept or list(lines)).format())


def install() -> None:
    """Makes Python print uncaught errors of the main thread and of other threads like that."""
    import threading

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if not is_end_of_simulation(error):
            print_exception(error, trace)

    def thread_hook(arguments: threading.ExceptHookArgs) -> None:
        if arguments.exc_value is None or isinstance(arguments.exc_value, SystemExit):
            return
        if is_end_of_simulation(arguments.exc_value):
            return
        name = arguments.thread.name if arguments.thread is not None else "?"
        sys.stderr.write(f"Exception in thread {name}:\n{format_exception(arguments.exc_value, arguments.exc_traceback)}")
        sys.stderr.flush()

    sys.excepthook = hook
    threading.excepthook = thread_hook
