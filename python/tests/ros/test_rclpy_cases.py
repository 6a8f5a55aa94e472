"""Periplus's rclpy does what real rclpy does, live and in lockstep.

With `PERIPLUS_REAL_RCLPY=/path/to/python` (an interpreter with rclpy from PyPI or a ROS installation) the cases run there too.
"""

import os
from collections.abc import Iterator
from typing import Any

import pytest
import rclpy_cases

CASES = rclpy_cases.load()
MODES = ["live", "lockstep"] + (["real"] if os.environ.get("PERIPLUS_REAL_RCLPY") else [])
#: Cases that cannot run in a mode, with the reason.
EXCEPTIONS: dict[tuple[str, str], str] = {
    ("lockstep", "timer__sim_time"): "publishes /clock itself; in lockstep the time is the simulation's",
}

if not CASES:
    pytest.skip(f"NO CASES: the folder {rclpy_cases.FOLDER} is not here; set PERIPLUS_RCLPY_CASES", allow_module_level=True)


@pytest.fixture(scope="module", params=MODES)
def runner(request: pytest.FixtureRequest) -> Iterator[rclpy_cases.Runner]:
    wanted = {item.callspec.params["case"]["id"] for item in request.session.items if "case" in getattr(getattr(item, "callspec", None), "params", {})}
    made = rclpy_cases.Runner([case for case in CASES if case["id"] in wanted], request.param)
    yield made
    made.close()


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_case(runner: rclpy_cases.Runner, case: dict[str, Any]) -> None:
    reason = EXCEPTIONS.get((runner.mode, case["id"]))
    if reason is not None:
        pytest.skip(reason)
    outcome = runner.outcome(case)
    if runner.mode == "real" and "ModuleNotFoundError: No module named" in outcome.err:
        pytest.skip("the real installation lacks a module: " + outcome.err.strip().splitlines()[-1])
    differences = outcome.differences(case["expect"])
    assert not differences, "\n".join([case["title"], *differences])
