"""Requests and questions, one line each."""
import builtins
import importlib.util
import io
import json
import math
import os
import re
import sys
import traceback

from . import objects

_lines_in = None
_lines_out = None
_folders = {}
# Files of packages that are not on this machine, of the request that is being answered.
_missing = []
_open = open


class Refused(Exception):
    """Error reported by the program that evaluates the file."""


def _send(message):
    _lines_out.write(json.dumps(message) + "\n")
    _lines_out.flush()


def ask(question, **details):
    """Asks the program, and answers what it asks meanwhile."""
    _send({"question": question, "line": objects.written(), **details})
    while True:
        line = _lines_in.readline()
        if not line:
            sys.exit(0)
        message = json.loads(line)
        if "ask" in message:
            _send(_answered(message))
        elif "error" in message:
            raise Refused(message["error"])
        else:
            return message["answer"]


def module_folder(name):
    """The folder in which a package of the workspace has a Python module of that name."""
    if name not in _folders:
        _folders[name] = ask("module", name=name)
    return _folders[name]


def note_missing(path):
    """Reports a file of a package that is not on this machine. True for such a file."""
    path = os.fspath(path)
    if not isinstance(path, str) or not path.startswith("package:/"):
        return False
    path = "package://" + path[len("package:/"):].lstrip("/")
    _missing.append(path)
    ask("missing", path=path)
    return True


def _open_in_sources(file, mode="r", *args, **options):
    """As `open`; a file that a build would install is read where its package has it, and one of a package
    that is not on this machine is empty."""
    try:
        return _open(file, mode, *args, **options)
    except FileNotFoundError:
        if not isinstance(file, (str, os.PathLike)) or set(mode) & set("wax+"):
            raise
        if note_missing(file):
            # No values, for a reader of YAML or JSON.
            text = "{}" if os.fspath(file).endswith((".yaml", ".yml", ".json")) else ""
            return io.BytesIO(text.encode()) if "b" in mode else io.StringIO(text)
        path = os.path.abspath(file)
        source = ask("in_sources", path=path)
        if source == path:
            raise
        return _open(source, mode, *args, **options)


def run(lines_in, lines_out):
    global _lines_in, _lines_out
    _lines_in, _lines_out = lines_in, lines_out
    builtins.open = io.open = _open_in_sources
    for line in lines_in:
        _send(_answered(json.loads(line)))


def _answered(request):
    _missing.clear()
    try:
        return _do(request)
    except Refused as refused:
        return {"error": str(refused), "line": _line(refused)}
    except BaseException as problem:  # a launch file may raise anything, even SystemExit
        message = "".join(traceback.format_exception_only(type(problem), problem)).strip()
        if _missing and _comes_of_empty(problem):
            message = f"this needs {_missing[-1]}, which is not on this machine ({message})"
        return {"error": message, "line": _line(problem), "help": _help(problem)}


def _line(problem):
    """`file:line` of the launch file, where the problem came from."""
    if isinstance(problem, SyntaxError) and problem.filename:
        return f"{problem.filename}:{problem.lineno}"
    frames = traceback.extract_tb(problem.__traceback__)
    own = [frame for frame in frames if objects.is_own(frame.filename)]
    return f"{own[-1].filename}:{own[-1].lineno}" if own else None


def _help(problem):
    """Suggested correction of a problem, if known."""
    if isinstance(problem, ModuleNotFoundError) and problem.name:
        top = problem.name.partition(".")[0]
        return (
            f"the Python module `{top}` is neither in a package of this workspace nor on this "
            f"machine: name the folder of its package, `--resource-path FOLDER`, or install it"
        )
    frames = traceback.extract_tb(problem.__traceback__)
    if isinstance(problem, KeyError) and frames and frames[-1].filename.endswith(("os>", "os.py")):
        name = problem.args[0]
        return (
            f"the environment has no variable `{name}`: set it for the launch, "
            f"`{name}=VALUE periplus launch ...`"
        )
    if isinstance(problem, FileNotFoundError) and frames and _is_start(frames[-1]):
        program = problem.filename
        return f"the program `{program}` is not on this machine: install it, or put it on the PATH"
    texts = " ".join([str(problem), *_missing[-1:]])
    package = re.search(r"package:/+([\w-]+)", texts)
    if package:
        package = package[1]
        return (
            f"the package `{package}` is not on this machine: name its folder, "
            f"`--resource-path FOLDER`"
        )
    if isinstance(problem, MemoryError):
        return "a launch file may take only so much memory while it is evaluated"
    return None


def _is_start(frame):
    """Returns true if a frame is the one in which Python's library starts a program."""
    return os.path.basename(frame.filename) == "subprocess.py"


def _comes_of_empty(problem):
    """Returns true if a problem may come from a file that is taken to be empty."""
    if isinstance(problem, (ImportError, NameError, OSError, SyntaxError)):
        return False
    top = type(problem).__module__.partition(".")[0]
    return top in ("builtins", "json", "xml", "yaml")


def _do(request):
    from launch import LaunchContext

    context = LaunchContext._of(request.get("context", {}))
    kind = request["ask"]
    if kind == "load":
        # What a module sets in `os.environ` holds for everything behind it.
        with context._active():
            answer = _load(request["file"])
        return {"answer": answer, **context._changes()}
    if kind == "expression":
        return {"answer": str(eval(request["expression"], {}, {**vars(math), "math": math}))}
    subject = objects.get(request["id"])
    with context._active():
        if kind == "perform":
            answer = str(subject.perform(context))
        elif kind == "holds":
            answer = bool(subject(context) if callable(subject) else subject.evaluate(context))
        elif kind in ("call", "for_each"):
            answer = [objects.described(action) for action in objects.flat(subject(context))]
        else:
            raise Refused(f"`{kind}` is not a request")
    return {"answer": answer, **context._changes()}


def _load(file):
    folder = os.path.dirname(file)
    name = "launch_file_" + str(abs(hash(file)))
    spec = importlib.util.spec_from_file_location(name, file)
    module = importlib.util.module_from_spec(spec)
    # Dataclasses and pickles look their module up.
    sys.modules[name] = module
    sys.path.insert(0, folder)
    try:
        spec.loader.exec_module(module)
        if not hasattr(module, "generate_launch_description"):
            return _of_tests(module)
        made = module.generate_launch_description()
        return [objects.described(action) for action in objects.flat(_first(made))]
    finally:
        sys.path.remove(folder)


def _of_tests(module):
    """The description of a file of `launch_testing`."""
    made = getattr(module, "generate_test_description", None)
    if made is None:
        raise Refused(
            f"{module.__file__} has no function `generate_launch_description`: it is no launch file"
        )
    import inspect

    wanted = [
        parameter.name
        for parameter in inspect.signature(made).parameters.values()
        if parameter.default is parameter.empty
        and parameter.kind not in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL)
    ]
    given = {"ready_fn": lambda: None}
    given.update({name: value for name, value in getattr(made, "_first_values", {}).items()})
    unknown = [name for name in wanted if name not in given]
    if unknown:
        raise Refused(
            f"`generate_test_description` takes `{unknown[0]}`, which only its test runner gives"
        )
    made = made(**{name: given[name] for name in given if name in wanted})
    return [objects.described(action) for action in objects.flat(_first(made))]


def _first(made):
    """A description that comes with its context, as tests give it."""
    from launch import LaunchDescription

    if isinstance(made, tuple) and made and isinstance(made[0], LaunchDescription):
        return made[0]
    return made
