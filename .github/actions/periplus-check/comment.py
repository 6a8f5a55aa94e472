"""The comment of the action, in Markdown."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: First line, by which a later run finds the comment.
MARK = "<!-- periplus-check -->"

#: Maximum number of findings in the comment; GitHub allows 65,536 characters.
MAX_FINDINGS = 50

#: Maximum length of an error text [characters].
MAX_ERROR = 2_000


@dataclass
class Check:
    """Output of `periplus check --json`, or its error."""

    report: Any
    error: str
    is_strict: bool = False


@dataclass
class Scenario:
    """Output of `periplus scenario --json`, or its error."""

    report: Any
    error: str


@dataclass
class Map:
    """Output of `periplus map diff --json`, or its error."""

    path: str
    report: Any
    error: str
    is_new: bool = False


def comment(version: str, check: Check | None, scenario: Scenario | None, maps: list[Map]) -> tuple[str, bool]:
    """Returns the comment, and whether nothing failed."""
    sections, outcomes = [], []
    for section, passed in [
        *([_check(check)] if check else []),
        *([_scenarios(scenario)] if scenario else []),
        *([_maps(maps)] if maps else []),
    ]:
        sections.append(section)
        outcomes.append(passed)
    passed = all(outcomes)
    title = f"## Periplus: {'passed' if passed else 'failed'}"
    return "\n\n".join([MARK, title, *sections, f"<sub>{version}</sub>"]) + "\n", passed


def _mark(passed: bool) -> str:
    return "✅" if passed else "❌"


def _cell(text: str) -> str:
    """Text of a table cell."""
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")


def _failed(title: str, error: str) -> tuple[str, bool]:
    # A fence that is longer than those in the text.
    return f"### {title}: ❌\n\n````text\n{error.strip()[:MAX_ERROR]}\n````", False


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'' if number == 1 else 's'}"


def _short(path: str) -> str:
    """A path relative to the working folder, if it is in it."""
    try:
        return str(Path(path).resolve().relative_to(Path.cwd()))
    except ValueError:
        return path


def _check(check: Check) -> tuple[str, bool]:
    if check.report is None:
        return _failed("Files", check.error)
    files = check.report["files"]
    errors = sum(file["errors"] for file in files)
    warnings = sum(file["warnings"] for file in files)
    passed = check.report["ok"] and errors == 0 and not (check.is_strict and warnings)
    counts = f"{_count(len(files), 'file')}, {_count(errors, 'error')}, {_count(warnings, 'warning')}"
    lines = [f"### Files: {_mark(passed)} {counts}"]
    findings = [finding for file in files for finding in file["findings"] if finding["severity"] != "hint"]
    if findings:
        lines += ["", "| | Where | Finding | Help |", "|---|---|---|---|"]
    for finding in findings[:MAX_FINDINGS]:
        where = _short(finding.get("file") or "")
        if finding.get("line"):
            where += f":{finding['line']}"
        help_text = "<br>".join(_cell(text) for text in finding["help"])
        severity = {"error": "❌", "warning": "⚠️"}[finding["severity"]]
        lines.append(f"| {severity} | `{where}` | {_cell(finding['message'])} | {help_text} |")
    if len(findings) > MAX_FINDINGS:
        lines += ["", f"{len(findings) - MAX_FINDINGS} more findings are in the log of the job."]
    return "\n".join(lines), passed


def _scenarios(scenario: Scenario) -> tuple[str, bool]:
    if scenario.report is None:
        return _failed("Scenarios", scenario.error)
    reports = scenario.report
    good = [report for report in reports if report["passed"]]
    passed = len(good) == len(reports)
    lines = [f"### Scenarios: {_mark(passed)} {len(good)} of {len(reports)} passed", ""]
    lines += ["| | Scenario | Assertions |", "|---|---|---|"]
    for report in reports:
        texts = [f"{_mark(it['passed'])} {_cell(it['message'])}" for it in report["assertions"]]
        texts += [f"❌ {_cell(str(problem))}" for problem in report["problems"]]
        lines.append(f"| {_mark(report['passed'])} | {_cell(report['name'])} | {'<br>'.join(texts)} |")
    return "\n".join(lines), passed


def _maps(maps: list[Map]) -> tuple[str, bool]:
    passed = all(it.is_new or it.report is not None for it in maps)
    lines = [f"### Maps: {_mark(passed)} {_count(len(maps), 'map')}", ""]
    lines += ["| Map | Walls in both | Known cells in both | Shift | Rotation |", "|---|---|---|---|---|"]
    for it in maps:
        if it.is_new:
            lines.append(f"| `{_cell(it.path)}` | new: the base branch does not have it | | | |")
        elif it.report is None:
            lines.append(f"| `{_cell(it.path)}` | ❌ {_cell(it.error.strip()[:MAX_ERROR])} | | | |")
        else:
            alignment = it.report["alignment"] or {"x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0}
            shift_m = (alignment["x_m"] ** 2 + alignment["y_m"] ** 2) ** 0.5
            lines.append(
                f"| `{_cell(it.path)}` | {100 * it.report['walls_nearby']['iou']:.1f} % "
                f"| {100 * it.report['known']['iou']:.1f} % | {shift_m:.3f} m | {alignment['yaw_rad']:.4f} rad |"
            )
    return "\n".join(lines), passed
