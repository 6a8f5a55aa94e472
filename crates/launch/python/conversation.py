"""Requests and questions, one line each."""
import importlib.util
import json
import os
import sys
import traceback

from . import objects

_lines_in = None
_lines_out = None


class Refused(Exception):
    """What the program that evaluates the file has to say against it."""


def _send(message):
    _lines_out.write(json.dumps(message) + "\n")
    _lines_out.flush()


def ask(question, **details):
    """Asks the program, and answers what it asks meanwhile."""
    _send({"question": question, **details})
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


def run(lines_in, lines_out):
    global _lines_in, _lines_out
    _lines_in, _lines_out = lines_in, lines_out
    for line in lines_in:
        _send(_answered(json.loads(line)))


def _answered(request):
    try:
        return _do(request)
    except Refused as refused:
        return {"error": _place(refused) + str(refused)}
    except BaseException as problem:  # a launch file may raise anything, even SystemExit
        return {"error": _place(problem) + "".join(
            traceback.format_exception_only(type(problem), problem)
        ).strip()}


def _place(problem):
    """`file:line: ` of the launch file, where the problem came from."""
    frames = traceback.extract_tb(problem.__traceback__)
    own = [frame for frame in frames if not frame.filename.startswith("<")]
    if isinstance(problem, SyntaxError) and problem.filename:
        return f"{problem.filename}:{problem.lineno}: "
    return f"{own[-1].filename}:{own[-1].lineno}: " if own else ""


def _do(request):
    from launch import LaunchContext

    context = LaunchContext._of(request.get("context", {}))
    kind = request["ask"]
    if kind == "load":
        return {"answer": _load(request["file"], context)}
    subject = objects.get(request["id"])
    if kind == "perform":
        with context._active():
            answer = str(subject.perform(context))
    elif kind == "holds":
        with context._active():
            answer = bool(subject(context) if callable(subject) else subject.evaluate(context))
    elif kind in ("call", "for_each"):
        with context._active():
            made = subject(context)
            answer = [objects.described(action) for action in objects.flat(made)]
    else:
        raise Refused(f"`{kind}` is no request")
    return {"answer": answer, **context._changes()}


def _load(file, context):
    folder = os.path.dirname(file)
    spec = importlib.util.spec_from_file_location("launch_file_" + str(abs(hash(file))), file)
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    sys.path.insert(0, folder)
    try:
        with context._active():
            spec.loader.exec_module(module)
            if not hasattr(module, "generate_launch_description"):
                raise Refused("the file has no function `generate_launch_description`")
            made = module.generate_launch_description()
            return [objects.described(action) for action in objects.flat(made)]
    finally:
        sys.path.remove(folder)
