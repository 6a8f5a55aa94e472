"""Scenarios: a world, a robot, nodes, events, faults and assertions, run in simulated time.

The engine is that of the command ``periplus scenario``: a :class:`Scenario` is written as its YAML file, and
:func:`load` reads one. A scenario gives the same report in every run.

>>> from periplus.scenarios import Scenario
>>> scenario = Scenario("worlds/house.sdf", "robot.urdf.xacro", nodes=["slam", "navigation"], timeout=60)
>>> scenario.goal((3, 0)).fault("dropout", topic="/scan", probability=0.5, at=5, until=3)
Scenario('scenario', 2 events, 0 assertions)
>>> scenario.reached(within=0.3).no_collision().min_clearance(0.1).rate("/scan", 10)
Scenario('scenario', 2 events, 4 assertions)
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

from periplus import _native
from periplus._types import StrPath

__all__ = ["AssertionResult", "Scenario", "ScenarioFailed", "ScenarioReport", "load", "schema"]

Position = Sequence[float]
"""``(x, y)`` or ``(x, y, yaw)`` in the world [m, rad]."""


class ScenarioFailed(AssertionError):
    """Assertions of a scenario do not hold. ``report`` has the result."""

    def __init__(self, report: ScenarioReport) -> None:
        """Take the report of a run that failed."""
        self.report = report
        super().__init__(report.summary())


@dataclass(frozen=True)
class AssertionResult:
    """Result of an assertion.

    >>> from periplus.scenarios import AssertionResult
    >>> AssertionResult("no_collision", "room.yaml:9:5", True, 0.0, "", "touched nothing").passed
    True
    """

    assertion: str
    """Assertion as text, such as ``min_clearance(distance=0.2)``."""
    location: str
    """File, line and column."""
    passed: bool
    """True if it holds."""
    measured: Optional[float]
    """Measured value; None if there is none."""
    unit: str
    """Unit of the measured value."""
    message: str
    """Result in a sentence."""


class ScenarioReport:
    """Report of a scenario.

    >>> from periplus.scenarios import ScenarioReport
    >>> report = ScenarioReport({"name": "room", "seed": 0, "passed": True, "outcome": "complete", "assertions": []})
    >>> report.passed, report.failures
    (True, [])
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        """Take the report as ``periplus scenario --json`` prints it."""
        self.values: dict[str, Any] = dict(values)

    @property
    def name(self) -> str:
        """Name of the scenario."""
        return str(self.values["name"])

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return int(self.values["seed"])

    @property
    def passed(self) -> bool:
        """True if all assertions hold, and no event or fault failed."""
        return bool(self.values["passed"])

    @property
    def duration_s(self) -> float:
        """Simulated time of the run [s]."""
        return float(self.values.get("duration_s", 0.0))

    @property
    def assertions(self) -> list[AssertionResult]:
        """Results of the assertions."""
        return [AssertionResult(**one) for one in self.values["assertions"]]

    @property
    def scores(self) -> dict[str, float]:
        """Scores of the run by name, with their units in the names."""
        return dict(self.values.get("scores", {}))

    @property
    def digest(self) -> Optional[str]:
        """Digest of all messages; None if it was not requested."""
        return self.values.get("digest")

    @property
    def artifacts(self) -> Optional[Path]:
        """Folder of the artifacts; None if none are kept."""
        folder = self.values.get("artifacts")
        return None if folder is None else Path(folder)

    @property
    def replay(self) -> str:
        """Command that runs the scenario again."""
        return str(self.values.get("replay", ""))

    @property
    def failures(self) -> list[str]:
        """Sentences about all that failed."""
        texts = []
        if self.values["outcome"] not in ("complete", "time limit"):
            texts.append(f"the run ended: {self.values['outcome']}")
        texts += self.values.get("problems", [])
        texts += [f"{one.assertion}: {one.message}" for one in self.assertions if not one.passed]
        return texts

    def summary(self) -> str:
        """Return the result as text: what failed, where the artifacts are, and the command that runs it again."""
        word = "passed" if self.passed else "failed"
        lines = [f"scenario {self.name!r} {word} (seed {self.seed}, {self.duration_s:.3f} s simulated)"]
        lines += [f"  {text}" for text in self.failures]
        if self.artifacts is not None:
            lines.append(f"  artifacts: {self.artifacts}")
        if not self.passed:
            lines.append(f"  run it again: {self.replay}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<ScenarioReport {self.summary()}>"


class Scenario:
    """A scenario that is built in Python.

    The methods that add an event or an assertion return the scenario itself. Files are relative to the working folder.

    >>> from periplus.scenarios import Scenario
    >>> Scenario("room.sdf").drive([{"goto": [1, 0]}]).odometry_error(0.05).to_dict()["assertions"]
    [{'odometry_error': {'max': 0.05}}]
    """

    def __init__(
        self,
        world: StrPath,
        robot: Optional[StrPath] = None,
        *,
        pose: Position = (0.0, 0.0, 0.0),
        arguments: Optional[Mapping[str, Any]] = None,
        nodes: Union[Sequence[str], Mapping[str, Any]] = (),
        parameters: Optional[Mapping[str, Mapping[str, Any]]] = None,
        seed: int = 0,
        physics: str = "rigid",
        timeout: float = 60.0,
        region: Optional[Sequence[float]] = None,
        name: str = "scenario",
    ) -> None:
        """Begin a scenario: a world and a robot at a pose, with nodes beside it (``slam``, ``localization``,
        ``costmaps``, ``navigation``), which ends after ``timeout`` simulated seconds, or when all goals have ended."""
        self._path: Optional[Path] = None
        self._values: dict[str, Any] = {
            "name": name,
            "world": _absolute(world),
            "seed": seed,
            "physics": physics,
            "timeout": timeout,
            "nodes": dict(nodes) if isinstance(nodes, Mapping) else list(nodes),
            "faults": [],
            "events": [],
            "assertions": [],
        }
        if robot is not None:
            self._values["robot"] = {"file": _absolute(robot), "pose": list(pose)}
            if arguments:
                texts = {name: _argument(value) for name, value in arguments.items()}
                self._values["robot"]["arguments"] = texts
        if parameters:
            self._values["parameters"] = {name: dict(own) for name, own in parameters.items()}
        if region is not None:
            self._values["region"] = list(region)

    # ---- events

    def goal(self, pose: Position, **when: Any) -> Scenario:
        """Send the robot to a goal with ``navigate_to_pose``. Goals follow each other.

        ``when`` is the condition of this and of every other event: ``at`` a time [s], ``near`` a position
        (``(x, y)`` or ``(x, y, radius)``), ``on`` a message of a topic (``count``: the Nth), ``after`` another event by
        its ``name``; and a ``delay`` [s]."""
        return self._event("goal", {"pose": list(pose)}, when)

    def teleport(self, pose: Position, *, model: Optional[str] = None, **when: Any) -> Scenario:
        """Put a model, by default the robot, at another pose."""
        return self._event("teleport", {"pose": list(pose), "model": model}, when)

    def spawn(
        self, file: StrPath, pose: Position = (0.0, 0.0, 0.0), *, model: Optional[str] = None, **when: Any
    ) -> Scenario:
        """Insert a model from a file, with this name."""
        return self._event("spawn", {"file": _absolute(file), "pose": list(pose), "name": model}, when)

    def remove(self, model: str, **when: Any) -> Scenario:
        """Remove a model."""
        return self._event("remove", {"model": model}, when)

    def set_parameter(self, node: str, parameter: str, value: Any, **when: Any) -> Scenario:
        """Set a parameter of a running node."""
        values = {"node": node, "parameter": parameter, "value": value}
        return self._event("set_parameter", values, when)

    def publish(self, topic: str, type: str, message: Mapping[str, Any], **when: Any) -> Scenario:
        """Publish a message, given by its fields."""
        values = {"topic": topic, "type": type, "message": dict(message)}
        return self._event("publish", values, when)

    def fault(self, kind: str, **values: Any) -> Scenario:
        """Add a fault, such as ``fault("latency", topic="/scan", mean=0.2)``. Its window ``from_`` to ``until`` [s]
        counts from the start, or from the condition of the event, if there is one."""
        when = {name: values.pop(name) for name in _TRIGGERS if name in values}
        own = {("from" if name == "from_" else name): value for name, value in values.items()}
        if when:
            return self._event("fault", {kind: _plain(own)}, when)
        self._values["faults"].append({kind: _plain(own)})
        return self

    def drive(self, commands: Sequence[Mapping[str, Any]]) -> Scenario:
        """Drive by a script: velocities by time, or points to drive to."""
        self._values["drive"] = [dict(command) for command in commands]
        return self

    # ---- assertions

    def reached(
        self,
        goal: Optional[Position] = None,
        *,
        within: float = 0.3,
        before: Optional[float] = None,
    ) -> Scenario:
        """Assert that the robot comes within a distance [m] of a point; without one, of every goal, with success."""
        point = None if goal is None else list(goal)[:2]
        return self._assertion("reached", {"goal": point, "within": within, "before": before})

    def no_collision(self) -> Scenario:
        """Assert that the robot touches nothing but the floor."""
        return self._assertion("no_collision", {})

    def min_clearance(self, distance: float) -> Scenario:
        """Assert the smallest distance between footprint and obstacles [m]."""
        return self._assertion("min_clearance", {"distance": distance})

    def map_iou(self, min: float, **options: Any) -> Scenario:
        """Assert that the map of SLAM agrees with the true one, 0 to 1."""
        return self._assertion("map_iou", {"min": min, **options})

    def tracking_error(self, max: float, **options: Any) -> Scenario:
        """Assert that the robot stays on the planned path, to a distance [m]."""
        return self._assertion("tracking_error", {"max": max, **options})

    def localization_error(self, max: float, **options: Any) -> Scenario:
        """Assert that the estimated position in the map is right, to a distance [m]."""
        return self._assertion("localization_error", {"max": max, **options})

    def odometry_error(self, max: float, **options: Any) -> Scenario:
        """Assert that the position by odometry is right, to a distance [m]."""
        return self._assertion("odometry_error", {"max": max, **options})

    def rate(self, topic: str, hz: float, **options: Any) -> Scenario:
        """Assert that messages are published at a rate [Hz]."""
        return self._assertion("rate", {"topic": topic, "hz": hz, **options})

    def latency(self, topic: str, max: float) -> Scenario:
        """Assert that stamped messages arrive in time [s]."""
        return self._assertion("latency", {"topic": topic, "max": max})

    def in_order(self, topic: str) -> Scenario:
        """Assert that stamped messages arrive in order, each once."""
        return self._assertion("in_order", {"topic": topic})

    def path_ratio(self, max: float) -> Scenario:
        """Assert that the driven path is not longer than a factor of the straight lines to the goals."""
        return self._assertion("path_ratio", {"max": max})

    def spl(self, min: float, **options: Any) -> Scenario:
        """Assert that the goals are reached on short paths: success weighted by path length, 0 to 1."""
        return self._assertion("spl", {"min": min, **options})

    # ---- runs

    def to_dict(self) -> dict[str, Any]:
        """Return the content of the scenario's file."""
        return {name: value for name, value in self._values.items() if value not in ([], {})}

    def to_yaml(self) -> str:
        """Return the scenario's file as text; JSON is YAML."""
        return json.dumps(self.to_dict(), indent=1)

    def run(
        self,
        *,
        seed: Optional[int] = None,
        artifacts: Optional[StrPath] = None,
        keep: bool = False,
        digest: bool = False,
        threads: int = 1,
    ) -> ScenarioReport:
        """Run the scenario to its end and return the report, whether its assertions hold or not.

        Artifacts of a run that fails are written to the folder ``artifacts``, with ``keep`` those of every run."""
        path = "scenario.yaml" if artifacts is None else str(Path(artifacts) / "scenario.yaml")
        return _run(self.to_yaml(), path, seed, {}, artifacts, keep, digest, threads)

    def check(self, **options: Any) -> ScenarioReport:
        """Run as :meth:`run` does, and raise :class:`ScenarioFailed` if an assertion does not hold."""
        report = self.run(**options)
        if not report.passed:
            raise ScenarioFailed(report)
        return report

    def _event(self, action: str, values: Mapping[str, Any], when: Mapping[str, Any]) -> Scenario:
        unknown = set(when) - set(_TRIGGERS)
        if unknown:
            known = ", ".join(_TRIGGERS)
            raise TypeError(f"an event has no {', '.join(sorted(unknown))}; its conditions are {known}")
        self._values["events"].append({**_plain(when), action: _plain(values)})
        return self

    def _assertion(self, word: str, values: Mapping[str, Any]) -> Scenario:
        own = _plain(values)
        self._values["assertions"].append({word: own} if own else word)
        return self

    def __repr__(self) -> str:
        events = len(self._values["events"])
        assertions = len(self._values["assertions"])
        return f"Scenario({self._values['name']!r}, {events} events, {assertions} assertions)"


_TRIGGERS = ("name", "at", "near", "on", "count", "after", "delay")


def load(
    path: StrPath,
    *,
    seed: Optional[int] = None,
    variables: Optional[Mapping[str, Any]] = None,
    artifacts: Optional[StrPath] = None,
    keep: bool = False,
    digest: bool = False,
    threads: int = 1,
) -> ScenarioReport:
    """Run a scenario file to its end and return the report.

    >>> from periplus.scenarios import load
    >>> load("missing.yaml")
    Traceback (most recent call last):
    FileNotFoundError: [Errno 2] No such file or directory: 'missing.yaml'
    """
    text = Path(path).read_text(encoding="utf-8")
    return _run(text, str(path), seed, variables or {}, artifacts, keep, digest, threads)


def schema() -> dict[str, Any]:
    """Return the JSON schema of scenario files.

    >>> from periplus.scenarios import schema
    >>> schema()["title"]
    'Periplus scenario'
    """
    values: dict[str, Any] = json.loads(_native.scenario_schema())
    return values


def _run(
    text: str,
    path: str,
    seed: Optional[int],
    variables: Mapping[str, Any],
    artifacts: Optional[StrPath],
    keep: bool,
    digest: bool,
    threads: int,
) -> ScenarioReport:
    report = _native.run_scenario(
        text,
        path,
        seed=seed,
        variables=[(name, _argument(value)) for name, value in variables.items()],
        artifacts=None if artifacts is None else str(artifacts),
        keep=keep,
        digest=digest,
        threads=threads,
    )
    values = json.loads(report)
    return ScenarioReport(values)


def _absolute(path: StrPath) -> str:
    """Path of a file that is there from the root, so that a copy of the scenario finds it."""
    return str(Path(path).resolve()) if Path(path).exists() else str(path)


def _argument(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _plain(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values without those that are not set; tuples become lists."""
    given = {name: value for name, value in values.items() if value is not None}
    return {name: list(value) if isinstance(value, tuple) else value for name, value in given.items()}
