"""Writes the reference of the package from its docstrings: ``python make_reference.py docs/python-reference.md``.

With ``--check`` it only compares, and fails if the page is not up to date.
"""

from __future__ import annotations

import argparse
import inspect
import re
import sys
from pathlib import Path
from typing import Any

import periplus
import periplus.gym
import periplus.gym.wrappers
import periplus.navigation
import periplus.scenarios

# Parts of the page, in order: title, introduction, names. A name in none of them is an error.
PARTS: list[tuple[str, str, list[str]]] = [
    (
        "Simulation",
        "Worlds and robots from files, stepped from Python.",
        ["World", "Simulation", "Snapshot", "Model", "Contact", "Sensor", "Scan", "PointCloud", "Image", "Subscription"],
    ),
    ("Poses and transforms", "", ["Pose", "TfBuffer", "Transform*"]),
    ("Rays", "Exact rays against meshes, shapes and worlds.", ["RayScene", "RayHits"]),
    (
        "Mapping and localization",
        "Estimators alone, with numpy in and out.",
        ["Slam*", "PoseGraph*", "LaserScanner", "Amcl*", "Ekf*", "scan_*", "ScanMatch"],
    ),
    ("Maps", "", ["OccupancyGrid", "MapComparison", "Frontier", "frontiers"]),
    ("Costmaps", "", ["Costmap*", "inflate"]),
    (
        "Messages and bags",
        "Messages are classes of `periplus.msgs`, such as `periplus.msgs.sensor_msgs.msg.LaserScan`.",
        ["serialize", "deserialize", "*message*", "to_*", "from_*", "open_bag", "*Bag*", "*bag*"],
    ),
    ("Files of robots and worlds", "", ["*"]),
    ("Errors", "", ["FileError"]),
]

# Modules after them, each with its own introduction.
MODULES = [
    ("Navigation", periplus.navigation),
    ("Environments", periplus.gym),
    ("Observations of environments", periplus.gym.wrappers),
    ("Scenarios", periplus.scenarios),
]


def names_of(patterns: list[str], left: list[str]) -> list[str]:
    """Names that match the patterns, in the order of the patterns."""
    found: list[str] = []
    for pattern in patterns:
        matcher = re.compile(re.escape(pattern).replace(r"\*", ".*") + "$")
        found.extend(name for name in left if matcher.match(name) and name not in found)
    return found


def markdown(text: str) -> str:
    """Markdown of a docstring in numpy's format."""
    lines = inspect.cleandoc(text).replace("``", "`").splitlines()
    out: list[str] = []
    is_code = False
    index = 0
    while index < len(lines):
        line = lines[index]
        is_example = line.startswith((">>>", "..."))
        if is_example and not is_code:
            out.extend(["", "```python"])
            is_code = True
        if is_code and not line.strip():
            out.extend(["```", ""])
            is_code = False
        is_title = index + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[index + 1].strip() or " ")
        if is_title and not is_code:
            out.extend(["", f"*{line.strip()}*", ""])
            index += 2
            continue
        entry = re.fullmatch(r"([\w, *]+) : (.+)", line)
        if entry and not is_code:
            words = []
            while index + 1 < len(lines) and lines[index + 1].startswith("    "):
                index += 1
                words.append(lines[index].strip())
            names = ", ".join(f"`{name.strip()}`" for name in entry.group(1).split(","))
            out.append(f"- {names} ({entry.group(2)}): {' '.join(words)}")
        else:
            out.append(line)
        index += 1
    if is_code:
        out.append("```")
    return re.sub(r"\n{3,}", "\n\n", "\n".join(out)).strip()


def signature(value: Any) -> str:
    """Signature without types, which the stubs have."""
    try:
        shown = str(inspect.signature(value))
    except (TypeError, ValueError):
        return ""
    shown = re.sub(r"^\((self|cls|\$self)(, /)?(, )?", "(", shown)
    return re.sub(r" -> .*$", "", shown).replace("(/, ", "(")


def member_lines(name: str, key: str, member: Any) -> list[str]:
    """Lines of a method or property."""
    target = member.__func__ if isinstance(member, (staticmethod, classmethod)) else member
    text = inspect.getdoc(target) or ""
    call = signature(target) if callable(target) else ""
    return [f"#### `{name}.{key}{call}`", "", markdown(text), ""]


def object_lines(name: str, value: Any) -> list[str]:
    """Lines of a class or function."""
    call = signature(value) if not (inspect.isclass(value) and issubclass(value, Exception)) else ""
    out = [f"### `{name}{call}`", "", markdown(inspect.getdoc(value) or ""), ""]
    if inspect.isclass(value):
        for key, member in sorted(vars(value).items()):
            is_shown = callable(member) or isinstance(member, (property, staticmethod, classmethod))
            if key.startswith("_") or not (is_shown or inspect.isdatadescriptor(member)):
                continue
            out.extend(member_lines(name, key, member))
    return out


def page() -> str:
    """The whole page."""
    out = [
        "# Python reference",
        "",
        "All public names of the package `periplus`. Types are in its stubs, which editors and mypy read.",
        "This page is made from the docstrings.",
        "",
    ]
    public = [name for name in periplus.__all__ if not name.startswith("__")]
    claimed = {name for _, _, patterns in PARTS for name in names_of([p for p in patterns if p != "*"], public)}
    left = list(public)
    for title, introduction, patterns in PARTS:
        known = left if patterns != ["*"] else [name for name in left if name not in claimed]
        names = names_of(patterns, known)
        left = [name for name in left if name not in names]
        if not names:
            continue
        out.extend([f"## {title}", ""])
        if introduction:
            out.extend([introduction, ""])
        for name in names:
            out.extend(object_lines(name, getattr(periplus, name)))
    if left:
        raise SystemExit(f"names in no part of the page: {left}")
    for title, module in MODULES:
        short = module.__name__.removeprefix("periplus.")
        out.extend([f"## {title}", "", markdown(inspect.getdoc(module) or ""), ""])
        for name in module.__all__:
            out.extend(object_lines(f"{short}.{name}", getattr(module, name)))
    return re.sub(r"\n{3,}", "\n\n", "\n".join(out)).rstrip() + "\n"


def main() -> int:
    """Write or compare the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("path", type=Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    text = page()
    if not options.check:
        options.path.write_text(text, encoding="utf-8")
        return 0
    if options.path.exists() and options.path.read_text(encoding="utf-8") == text:
        return 0
    print(f"{options.path} is not up to date: run `cargo xtask python --update`", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
