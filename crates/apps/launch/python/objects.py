"""Objects of launch files as JSON, and those that only Python can evaluate by number."""
import ast
import itertools
import linecache
import os
import sys

# The folder of Python's own modules.
_LIBRARY = os.path.dirname(os.__file__) + os.sep
_numbers = itertools.count(1)
_kept = {}


def keep(subject):
    """A number by which the subject can be asked for later."""
    number = getattr(subject, "_number", None)
    if number is None:
        number = next(_numbers)
        try:
            subject._number = number
        except AttributeError:
            pass  # a function of C; it gets a number each time
    _kept[number] = subject
    return number


def get(number):
    return _kept[number]


def is_own(file):
    """Returns true for a file of the user, not of this interpreter."""
    is_installed = file.startswith(_LIBRARY) or "-packages/" in file
    return not file.startswith("<") and not is_installed


def is_caught(file, line, problems):
    """Returns true if a line of a file is in a `try` that handles one of the problems."""
    try:
        tree = ast.parse("".join(linecache.getlines(file)))
    except (SyntaxError, ValueError, RecursionError):
        return False
    return any(
        isinstance(node, ast.Try)
        and node.body[0].lineno <= line <= node.body[-1].end_lineno
        and any(_names(handler.type) & problems for handler in node.handlers)
        for node in ast.walk(tree)
    )


def _names(caught):
    if caught is None:
        return {"BaseException"}
    named = caught.elts if isinstance(caught, ast.Tuple) else [caught]
    return {getattr(each, "attr", getattr(each, "id", "")) for each in named}


def written():
    """`file:line` of the launch file's line that is being evaluated."""
    frame = sys._getframe(1)
    while frame is not None:
        if is_own(frame.f_code.co_filename):
            return f"{frame.f_code.co_filename}:{frame.f_lineno}"
        frame = frame.f_back
    return None


def flat(made):
    """Actions, however they are put together."""
    from launch import LaunchDescription

    if made is None:
        return
    if isinstance(made, LaunchDescription):
        yield from flat(made.entities)
    elif isinstance(made, (list, tuple)) or (hasattr(made, "__iter__") and not isinstance(made, str)):
        for each in made:
            yield from flat(each)
    else:
        yield made


def described(action):
    from launch.action import Action

    from launch.event_handler import EventHandler

    if isinstance(action, EventHandler):
        return {"place": getattr(action, "_written", None), **action._described()}
    if not isinstance(action, Action):
        raise TypeError(f"{action!r} is not a launch action")
    return action._described()


def text(value):
    """Text or substitutions, as a list of parts."""
    from launch.substitution import Substitution

    if value is None:
        return None
    if isinstance(value, Substitution):
        return [value._described()]
    if isinstance(value, (list, tuple)):
        return [part for each in value for part in text(each)]
    if isinstance(value, (str, int, float)) or hasattr(value, "__fspath__"):
        return [str(value)]
    raise TypeError(f"{value!r} is neither a text nor a substitution")


def pairs(value):
    """A dict, or a list of pairs, of texts."""
    if value is None:
        return []
    entries = value.items() if hasattr(value, "items") else value
    return [[text(a), text(b)] for a, b in entries if b is not None]
