"""Runs the checks of the action, and writes their comment.

Settings are environment variables: PROGRAM, FILES, SCENARIOS, MAPS (glob patterns, one a line), STRICT, BASE (commit
whose maps are compared), OUT (folder of results).
"""

import glob
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from comment import Check, Map, Scenario, comment


def matches(patterns: str) -> list[str]:
    """Returns the files of all patterns; a pattern without a file is an error, since it checks nothing."""
    found: list[str] = []
    for pattern in (line.strip() for line in patterns.splitlines()):
        if not pattern:
            continue
        files = sorted(glob.glob(pattern, recursive=True))
        if not files:
            sys.exit(f"::error::no file matches `{pattern}`: correct the pattern, or remove it")
        found += [file for file in files if file not in found]
    return found


def output(command: list[str]) -> tuple[Any, str]:
    """Returns the JSON that a command prints, or None, and its error text."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        return json.loads(done.stdout), done.stderr
    except json.JSONDecodeError:
        return None, done.stderr or f"`{' '.join(command)}` printed no JSON (exit code {done.returncode})"


def check(program: str, files: list[str]) -> Check | None:
    if not files:
        return None
    report, error = output([program, "check", "--json", *files])
    return Check(report, error, os.environ.get("STRICT") == "true")


def scenarios(program: str, files: list[str], out: Path) -> Scenario | None:
    if not files:
        return None
    artifacts = ["--artifacts", str(out / "scenarios"), "--junit", str(out / "scenarios.xml")]
    return Scenario(*output([program, "scenario", "--json", *artifacts, *files]))


def before(base: str, path: str, folder: Path) -> Path | None:
    """Writes a map of a commit into a folder; None if it was not there."""

    def at_base(name: Path) -> bytes | None:
        shown = subprocess.run(["git", "show", f"{base}:./{name}"], capture_output=True, check=False)
        return shown.stdout if shown.returncode == 0 else None

    text = at_base(Path(path))
    if text is None:
        return None
    lines = [line for line in text.decode().splitlines() if line.startswith("image:")]
    image = lines[0].removeprefix("image:").strip().strip("\"'") if lines else ""
    picture = at_base(Path(path).parent / image)
    if picture is None:
        return None
    target = folder / path
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(text)
    (target.parent / image).parent.mkdir(parents=True, exist_ok=True)
    (target.parent / image).write_bytes(picture)
    return target


def maps(program: str, files: list[str], out: Path) -> list[Map]:
    base, found = os.environ.get("BASE", ""), []
    for path in files:
        old = before(base, path, out / "base") if base else None
        if old is None:
            found.append(Map(path, None, "", is_new=True))
            continue
        picture = out / "maps" / (path.replace("/", "_") + ".png")
        picture.parent.mkdir(parents=True, exist_ok=True)
        report, error = output([program, "map", "diff", "--json", "--picture", str(picture), str(old), path])
        found.append(Map(path, report, error))
    return found


def main() -> None:
    program, out = os.environ["PROGRAM"], Path(os.environ["OUT"])
    out.mkdir(parents=True, exist_ok=True)
    wishes = {name: matches(os.environ.get(name, "")) for name in ("FILES", "SCENARIOS", "MAPS")}
    if not any(wishes.values()):
        sys.exit("::error::nothing to do: set `files`, `scenarios` or `maps`")
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    checked = check(program, wishes["FILES"])
    run = scenarios(program, wishes["SCENARIOS"], out)
    compared = maps(program, wishes["MAPS"], out)
    text, passed = comment(version, checked, run, compared)
    file = out / "comment.md"
    file.write_text(text)
    for variable, content in (
        ("GITHUB_STEP_SUMMARY", text),
        ("GITHUB_OUTPUT", f"passed={str(passed).lower()}\ncomment-file={file}\n"),
    ):
        if path := os.environ.get(variable):
            with open(path, "a") as target:
                target.write(content)
    print(text)


if __name__ == "__main__":
    main()
