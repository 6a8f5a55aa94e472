"""Scenarios in Python: the builder, reports, and errors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import periplus
from periplus.scenarios import Scenario, ScenarioFailed, load, schema

ROOT = Path(__file__).parents[2]
WORLD = ROOT / "worlds" / "demo_room.sdf"
ROBOT = ROOT / "robots" / "sam_bot" / "urdf" / "sam_bot.urdf.xacro"


def drive(**values: object) -> Scenario:
    """Two seconds straight ahead at 0.3 m/s, without physics."""
    made = Scenario(WORLD, ROBOT, physics="kinematic", timeout=2.5, name="drive", **values)  # type: ignore[arg-type]
    return made.drive([{"at": 0, "until": 2, "linear": 0.3}, {"at": 2}])


def test_a_scenario_passes_and_has_scores() -> None:
    report = drive().reached((0.6, 0.0), within=0.05).no_collision().rate("/scan", 5).check()
    assert report.passed and report.failures == []
    assert report.scores["length_m"] == pytest.approx(0.6, abs=0.03)
    assert [one.passed for one in report.assertions] == [True, True, True]


def test_a_scenario_that_fails_says_why_and_keeps_its_artifacts(tmp_path: Path) -> None:
    scenario = drive().fault("dropout", topic="/scan", probability=0.8).rate("/scan", 5)
    with pytest.raises(ScenarioFailed, match=r"Hz on `/scan` \(wanted 5 Hz\)") as failure:
        scenario.check(artifacts=tmp_path / "run")
    report = failure.value.report
    assert report.artifacts == tmp_path / "run"
    names = {path.name for path in report.artifacts.iterdir()}
    assert {"run.mcap", "run.png", "log.txt", "report.json", "scenario.yaml"} <= names
    # The copy is a whole scenario: the command that runs it again names it.
    assert str(report.artifacts / "scenario.yaml") in report.replay
    again = load(report.artifacts / "scenario.yaml")
    assert again.failures == report.failures


def test_the_same_seed_gives_the_same_bytes() -> None:
    scenario = drive().fault("latency", topic="/scan", mean=0.1, jitter=0.03).no_collision()
    digests = [scenario.run(seed=seed, digest=True).digest for seed in (1, 1, 2)]
    assert digests[0] == digests[1] != digests[2]


def test_events_have_conditions() -> None:
    scenario = drive().teleport((1.0, -1.0), near=(0.3, 0.0, 0.05), name="jump")
    scenario.remove("cube", after="jump", delay=0.2).reached((1.0, -1.0), within=0.02)
    assert scenario.run().passed
    with pytest.raises(TypeError, match="conditions are name, at"):
        drive().remove("cube", when=3)


def test_mistakes_are_located() -> None:
    with pytest.raises(periplus.FileError, match="there is no fault `dropuot`") as error:
        drive().fault("dropuot", topic="/scan").no_collision().run()
    assert error.value.line is not None and "scenario.yaml" in str(error.value)


def test_variables_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    values = drive().reached((0.3, 0.0), within=0.2, before=2).to_dict()
    values["variables"] = {"start": 0}
    values["robot"]["pose"] = ["$(start)", 0, 0]
    path.write_text(json.dumps(values))
    assert load(path).passed
    assert not load(path, variables={"start": -1}).passed
    with pytest.raises(periplus.FileError, match="no variable `stat`"):
        load(path, variables={"stat": 1})


def test_the_schema_has_every_assertion_of_the_builder() -> None:
    words = schema()["properties"]["assertions"]["items"]["anyOf"][0]["properties"]
    for word in words:
        assert callable(getattr(Scenario, word)), word
