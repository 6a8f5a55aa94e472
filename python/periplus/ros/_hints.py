"""Advice for errors that users of ROS nodes meet: Python 2 files, missing packages, wrong names."""

from __future__ import annotations

import re
import sys
from typing import Any

from ._tracebacks import is_library_file, short_path

#: Module and what `pip install` calls it.
_PIP_NAMES = {
    "cv2": "opencv-python-headless",
    "yaml": "pyyaml",
    "PIL": "pillow",
    "sklearn": "scikit-learn",
    "skimage": "scikit-image",
    "serial": "pyserial",
    "usb": "pyusb",
    "zmq": "pyzmq",
    "pykdl_utils": "pykdl-utils",
}
_IMPORTS_MESSAGES = re.compile(r"^\s*(?:from|import)\s+\w+\.(?:msg|srv|action)\b")
_PYTHON_2 = (
    (re.compile(r"Missing parentheses in call to '(print|exec)'"), "the {0} statement"),
    (re.compile(r"multiple exception types must be parenthesized"), "`except Type, name:`"),
    (re.compile(r"invalid hexadecimal literal|leading zeros in decimal integer literals|invalid decimal literal"), ""),
)
_PYTHON_2_LINES = (
    (re.compile(r"^\s*print\s+[^=(\s]|^\s*print\s*>>"), "the print statement"),
    (re.compile(r"^\s*except\s+[\w.()\s,]+,\s*\w+\s*:"), "`except Type, name:`"),
    (re.compile(r"^\s*raise\s+[\w.]+\s*,"), "`raise Type, text`"),
    (re.compile(r"<>"), "the operator `<>`"),
    (re.compile(r"`[^`]+`"), "backquotes"),
    (re.compile(r"^\s*exec\s+['\"\w]"), "the exec statement"),
    (re.compile(r"\b\d+L\b|\b0[0-7]+\b"), "a number such as 10L or 0755"),
    (re.compile(r"\bur['\"]"), "a string such as ur''"),
)


def hint(error: BaseException) -> str | None:
    """Advice for an error that ended a program, or None."""
    if isinstance(error, TabError):
        return f"hint: {_where(error)} mixes tabs and spaces, which Python 2 allowed: use spaces alone"
    if isinstance(error, SyntaxError):
        return _syntax(error)
    if isinstance(error, ModuleNotFoundError):
        return _missing_module(error)
    if isinstance(error, ImportError):
        return _missing_name(error)
    if isinstance(error, (NameError, AttributeError)):
        return _python_2_name(error) or (_attribute(error) if isinstance(error, AttributeError) else None)
    return _qos(error) if isinstance(error, TypeError) else None


def _qos(error: TypeError) -> str | None:
    """Advice for a QoS that is none, or is missing."""
    text = str(error)
    if text.startswith(("Expected QoSProfile or int, but received <class 'function'>", "Expected QoSProfile or int, but received <class 'method'>")):
        return f"hint: {_line_of(error)}the callback comes before the QoS: create_subscription(Type, topic, callback, qos)"
    if text.startswith("Expected QoSProfile or int") or "missing 1 required positional argument: 'qos_profile'" in text:
        return (
            f"hint: {_line_of(error)}the QoS is a depth such as 10, a QoSProfile, or one of rclpy.qos, such as "
            "qos_profile_sensor_data for sensors"
        )
    return None


def _attribute(error: AttributeError) -> str | None:
    """Advice for a missing attribute: fields of messages, members of enumerations, nodes without a constructor."""
    import difflib
    from enum import EnumMeta

    owner, name = getattr(error, "obj", None), getattr(error, "name", None) or ""
    kind: Any = type(owner)
    if owner is None:
        # Python keeps no object for an attribute that cannot be set.
        kind, name = _message_of(str(error))
    if any(base.__module__ == "rclpy.node" for base in kind.__mro__) and "_rcl_destroyed" not in vars(owner):
        return f"hint: {_line_of(error)}{kind.__name__}.__init__ must call super().__init__('NODE_NAME') before it uses the node"
    if isinstance(owner, EnumMeta):
        what, names = owner.__name__, list(owner.__members__)
    elif hasattr(kind, "get_fields_and_field_types"):
        what, names = kind.__name__, list(kind.get_fields_and_field_types())
    elif hasattr(kind, "_slot_types"):
        what, names = kind.__name__, list(kind.__slots__)
    else:
        return None
    near = difflib.get_close_matches(name.lower(), [one.lower() for one in names], 1, 0.6)
    meant = [one for one in names if near and one.lower() == near[0]]
    if meant:
        return f"hint: {_line_of(error)}{what} has {meant[0]!r}"
    return f"hint: {_line_of(error)}{what} has {', '.join(names[:12]) or 'no fields'}" + (" ..." if len(names) > 12 else "")


def _message_of(text: str) -> tuple[Any, str]:
    """Message class and attribute of `'Vector3' object has no attribute 'X'`."""
    match = re.match(r"'(\w+)' object has no attribute '(\w+)'", text)
    if match is None:
        return type(None), ""
    for name, module in list(sys.modules.items()):
        if name.endswith((".msg", ".srv", ".action")) and match.group(1) in dir(module):
            found = getattr(module, match.group(1), None)
            if hasattr(found, "get_fields_and_field_types") or hasattr(found, "_slot_types"):
                return found, match.group(2)
    return type(None), ""


def _where(error: SyntaxError) -> str:
    return f"{short_path(error.filename or '?')}:{error.lineno or '?'}"


def _syntax(error: SyntaxError) -> str | None:
    construct = None
    for pattern, text in _PYTHON_2:
        match = pattern.search(error.msg or "")
        if match and text:
            construct = text.format(*match.groups())
    line = error.text or ""
    if construct is None:
        construct = next((text for pattern, text in _PYTHON_2_LINES if pattern.search(line)), None)
    if construct is None:
        return None
    return (
        f"hint: {_where(error)} is Python 2 ({construct}); this is Python {sys.version_info.major}.{sys.version_info.minor}. "
        f"Convert the file: `2to3 -w {short_path(error.filename or 'FILE')}` (of Python 3.12 or older)"
    )


def _line_of(error: BaseException) -> str:
    """`file:line: ` of the user's innermost frame."""
    trace, found = error.__traceback__, ""
    while trace is not None:
        path = trace.tb_frame.f_code.co_filename
        if not is_library_file(path):
            found = f"{short_path(path)}:{trace.tb_lineno}: "
        trace = trace.tb_next
    return found


def _source_line(error: BaseException) -> str:
    """The line of the user's innermost frame."""
    import linecache

    trace, line = error.__traceback__, ""
    while trace is not None:
        path = trace.tb_frame.f_code.co_filename
        if not is_library_file(path):
            line = linecache.getline(path, trace.tb_lineno)
        trace = trace.tb_next
    return line


def _missing_module(error: ModuleNotFoundError) -> str | None:
    name = error.name or ""
    top = name.split(".")[0]
    # Message packages: the error of the import hook is complete.
    if not top or "PERIPLUS_PACKAGES" in str(error):
        return None
    start = f"hint: {_line_of(error)}"
    if top in ("Tkinter", "ConfigParser", "Queue", "urllib2", "StringIO", "cPickle", "commands", "exceptions", "thread", "httplib"):
        return f"{start}the module {top} is Python 2's; convert the file with `2to3 -w` (of Python 3.12 or older)"
    if _IMPORTS_MESSAGES.search(_source_line(error)):
        near = _near_package(top)
        if near:
            return f"{start}Did you mean {near!r}?"
        return (
            f"{start}no message package {top} is known, and no folder with its package.xml was found. Put the package "
            "beside your own, or name its folder in PERIPLUS_PACKAGES"
        )
    if top == "tkinter":
        return f"{start}tkinter comes with the system's Python: `apt install python3-tk`"
    from . import _packages

    if top in sys.modules and "." in name:
        return _missing_submodule(start, name)
    package = _packages.find_package(top)
    if package is not None:
        return f"{start}package {top} is at {package.folder}, but has no Python module {name}"
    near = _near_package(top)
    if near:
        return f"{start}Did you mean {near!r}?"
    if top in ("gazebo_ros", "moveit_commander", "PyKDL", "smach", "smach_ros", "py_trees_ros", "rosgraph", "rosnode", "xacro"):
        return f"{start}{top} is a ROS package that Periplus does not have; clone its source into your workspace"
    return f"{start}`{sys.executable} -m pip install {_PIP_NAMES.get(top, top)}` installs it, if it is a package of PyPI; a package of your workspace needs a package.xml"


def _near_package(name: str) -> str | None:
    """The package with nearly this name."""
    import difflib

    from . import _packages, _rosidl_modules

    near = difflib.get_close_matches(name, [*_rosidl_modules.packages(), *_packages.known_packages()], 1, 0.8)
    return near[0] if near else None


def _missing_submodule(start: str, name: str) -> str | None:
    """Advice for a module that its package lacks."""
    import difflib
    import pkgutil

    parent, _, last = name.rpartition(".")
    names = [module.name for module in pkgutil.iter_modules(getattr(sys.modules.get(parent), "__path__", None) or [])]
    near = difflib.get_close_matches(last, [one for one in names if not one.startswith("_")], 1, 0.7)
    return f"{start}{parent} has the module {near[0]!r}" if near else None


def _missing_name(error: ImportError) -> str | None:
    match = re.match(r"cannot import name '(\w+)' from '([\w.]+)'", str(error))
    if match is None:
        return None
    import difflib

    wanted, module_name = match.groups()
    module = sys.modules.get(module_name)
    if module is None or "Did you mean" in str(error):
        return None
    near = difflib.get_close_matches(wanted, [name for name in dir(module) if not name.startswith("_")], 1, 0.7)
    return f"hint: {_line_of(error)}{module_name} has {near[0]!r}" if near else None


def _python_2_name(error: NameError | AttributeError) -> str | None:
    name = getattr(error, "name", None)
    if isinstance(error, NameError) and name in ("raw_input", "unicode", "xrange", "long", "reduce", "basestring", "unichr", "file"):
        modern = {"raw_input": "input", "unicode": "str", "xrange": "range", "long": "int", "reduce": "functools.reduce",
                  "basestring": "str", "unichr": "chr", "file": "open"}[name]  # fmt: skip
        return f"hint: {_line_of(error)}{name} is Python 2's; write {modern}, or convert the file with `2to3 -w` (of Python 3.12 or older)"
    if isinstance(error, AttributeError) and name in ("has_key", "iteritems", "itervalues", "iterkeys"):
        return f"hint: {_line_of(error)}{name} is Python 2's; convert the file with `2to3 -w` (of Python 3.12 or older)"
    return None
