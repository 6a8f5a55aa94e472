"""Write the type stubs of the built-in messages, services and actions: `python/periplus/msgs/<package>/*.pyi`.

    python python/tools/make_msgs_stubs.py [FOLDER]

A test compares the stubs with what this program writes.
"""

from __future__ import annotations

import keyword
import re
import sys
from pathlib import Path

from periplus import _native
from periplus.msgs import get_message

KINDS = ("action", "msg", "srv")
DTYPES = {"boolean": "bool_", "float": "float32", "double": "float64", "octet": "uint8"}
ARRAY = re.compile(r"^sequence<(?P<element>[^,]*?(<\d+>)?)(, \d+)?>$|^(?P<fixed>.*)\[\d+\]$")


class Names:
    """Imports of a stub."""

    def __init__(self, package: str, kind: str) -> None:
        self.package = package
        self.kind = kind
        self.modules: set[tuple[str, str]] = set()
        self.numpy = False

    def message(self, name: str) -> str:
        parts = name.split("/")
        package, kind = parts[0], parts[1] if len(parts) == 3 else "msg"
        if (package, kind) == (self.package, self.kind):
            return parts[-1]
        self.modules.add((package, kind))
        return f"_{package}_{kind}.{parts[-1]}"

    def dtype(self, element: str) -> str:
        self.numpy = True
        return f"npt.NDArray[np.{DTYPES.get(element, element)}]"


def is_number(element: str) -> bool:
    return element in DTYPES or bool(re.match(r"^u?int(8|16|32|64)$", element))


def types_of(text: str, names: Names) -> tuple[str, str]:
    """Types of a field when it is read, and when it is set."""
    found = ARRAY.match(text)
    if found:
        element = found["element"] or found["fixed"]
        if is_number(element):
            return names.dtype(element), "npt.ArrayLike"
        one = types_of(element, names)[0]
        return f"list[{one}]", f"Iterable[{one}]"
    if text == "boolean":
        return "bool", "bool"
    if text in ("float", "double"):
        return "float", "float"
    if text == "octet":
        return "bytes", "bytes | int"
    if is_number(text):
        return "int", "int"
    if text.startswith(("string", "wstring")):
        return "str", "str"
    name = names.message(text)
    return name, name


def constant(value: object) -> str:
    return type(value).__name__


def message_stub(type_name: str, names: Names) -> list[str]:
    cls = get_message(type_name)
    handle = cls.__type_handle__
    lines = [f"class {cls.__name__}(Message):"]
    for name, value in handle.constants.items():
        lines.append(f"    {name}: ClassVar[{constant(value)}]")
    fields = [(name, *types_of(text, names)) for name, text in handle.fields]
    for name, read, write in fields:
        if keyword.iskeyword(name):
            continue
        if read == write:
            lines.append(f"    {name}: {read}")
        else:
            lines.append("    @property")
            lines.append(f"    def {name}(self) -> {read}: ...")
            lines.append(f"    @{name}.setter")
            lines.append(f"    def {name}(self, value: {write}) -> None: ...")
    given = [f"{name}: {write} = ..." for name, _read, write in fields if not keyword.iskeyword(name)]
    star = ["*", *given] if given else []
    lines.append(f"    def __init__({', '.join(['self', *star])}) -> None: ...")
    return lines


def service_stub(package: str, kind: str, name: str, indent: str = "") -> list[str]:
    del package, kind
    lines = [f"{indent}class {name.split('.')[-1]}(Service):"]
    stem = name.replace(".", "")
    for part in ("Request", "Response", "Event"):
        lines.append(f"{indent}    {part} = {stem}_{part}")
    return lines


def action_stub(name: str, names: Names) -> list[str]:
    lines = [f"class {name}(Action):"]
    for part in ("Goal", "Result", "Feedback"):
        lines.append(f"    {part} = {name}_{part}")
    lines.append("    class Impl:")
    for part in ("SendGoal", "GetResult"):
        lines.append(f"        class {part}Service(Service):")
        for half in ("Request", "Response", "Event"):
            lines.append(f"            {half} = {name}_{part}_{half}")
    cancel = names.message("action_msgs/srv/CancelGoal")
    status = names.message("action_msgs/msg/GoalStatusArray")
    lines.append(f"        FeedbackMessage = {name}_FeedbackMessage")
    lines.append(f"        CancelGoalService = {cancel}")
    lines.append(f"        GoalStatusMessage = {status}")
    return lines


def stubs() -> dict[str, str]:
    """Texts of all stubs by their paths in `periplus/msgs`."""
    services = set(_native.message_services())
    made: dict[tuple[str, str], list[str]] = {}
    for type_name in sorted({*_native.message_types(), *services}):
        package, kind, _name = type_name.split("/")
        made.setdefault((package, kind), []).append(type_name)
    texts: dict[str, str] = {}
    for (package, kind), type_names in sorted(made.items()):
        names = Names(package, kind)
        body: list[str] = []
        later: list[str] = []
        for type_name in type_names:
            name = type_name.split("/")[2]
            if type_name not in services:
                body += ["", *message_stub(type_name, names)]
            elif kind == "srv":
                later += ["", *service_stub(package, kind, name)]
            else:
                later += ["", *action_stub(name, names)]
        body += later
        text = "\n".join(body)
        bases = [base for base in ("Action", "Message", "Service") if f"({base})" in text]
        head = []
        if "Iterable[" in text:
            head.append("from collections.abc import Iterable")
        if "ClassVar[" in text:
            head.append("from typing import ClassVar")
        if head:
            head.append("")
        if "np." in text:
            head.append("import numpy as np")
        if "npt." in text:
            head.append("import numpy.typing as npt")
        if "np" in "".join(head[-2:]):
            head.append("")
        for other, other_kind in sorted(names.modules):
            head.append(f"import periplus.msgs.{other}.{other_kind} as _{other}_{other_kind}")
        head.append(f"from periplus.msgs import {', '.join(bases)}")
        public = sorted(type_name.split("/")[2] for type_name in type_names)
        listed = "\n".join(["", "__all__ = [", *(f'    "{name}",' for name in public), "]"])
        texts[f"{package}/{kind}.pyi"] = "\n".join(head) + "\n" + listed + "\n" + text + "\n"
    for package in sorted({package for package, _kind in made}):
        kinds = [kind for kind in KINDS if (package, kind) in made]
        lines = [f"from periplus.msgs.{package} import {kind} as {kind}" for kind in kinds]
        listed = ", ".join(f'"{kind}"' for kind in kinds)
        texts[f"{package}/__init__.pyi"] = "\n".join([*lines, "", f"__all__ = [{listed}]"]) + "\n"
    return texts


def main() -> None:
    default = Path(__file__).parent.parent / "periplus" / "msgs"
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else default
    for path, text in stubs().items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)


if __name__ == "__main__":
    main()
