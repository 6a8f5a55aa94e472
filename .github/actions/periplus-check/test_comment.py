"""Tests of the comment, with outputs of the program as samples: `python3 -m unittest` in this folder."""

import json
import unittest
from pathlib import Path

from comment import MARK, MAX_FINDINGS, Check, Map, Scenario, comment

SAMPLES = Path(__file__).parent / "samples"


def sample(name: str) -> object:
    return json.loads((SAMPLES / name).read_text())


class CommentTest(unittest.TestCase):
    def test_findings_have_place_and_help(self) -> None:
        text, passed = comment("periplus 1", Check(sample("check.json"), ""), None, [])
        self.assertFalse(passed)
        self.assertTrue(text.startswith(MARK + "\n\n## Periplus: failed"))
        self.assertIn("### Files: ❌ 2 files, 2 errors, 1 warning", text)
        row = "| ❌ | `odd.urdf:365` | this `inertial` has no `inertia` | write &lt;inertia ixx="
        self.assertIn(row, text)

    def test_warnings_fail_only_if_strict(self) -> None:
        report = sample("check.json")
        for file in report["files"]:
            file["errors"] = 0
        report["ok"] = True
        self.assertTrue(comment("", Check(report, ""), None, [])[1])
        self.assertFalse(comment("", Check(report, "", is_strict=True), None, [])[1])

    def test_many_findings_are_cut(self) -> None:
        report = sample("check.json")
        report["files"][0]["findings"] *= MAX_FINDINGS
        text, _ = comment("", Check(report, ""), None, [])
        self.assertEqual(text.count("| ❌ |") + text.count("| ⚠️ |"), MAX_FINDINGS)
        self.assertIn("more findings are in the log", text)

    def test_a_scenario_shows_its_assertions(self) -> None:
        reports = sample("scenario.json")
        text, passed = comment("", None, Scenario(reports, ""), [])
        self.assertTrue(passed)
        self.assertIn("1 of 1 passed", text)
        self.assertIn("smallest clearance 0.527 m (limit 0.1)", text)
        reports[0]["passed"] = False
        self.assertIn("### Scenarios: ❌ 0 of 1 passed", comment("", None, Scenario(reports, ""), [])[0])

    def test_a_map_is_compared_or_new(self) -> None:
        maps = [Map("a/map.yaml", sample("map.json"), ""), Map("b|c.yaml", None, "", is_new=True)]
        text, passed = comment("", None, None, maps)
        self.assertTrue(passed)
        self.assertIn("| `a/map.yaml` | 87.8 % | 80.3 % | 0.006 m | 0.0036 rad |", text)
        self.assertIn("| `b\\|c.yaml` | new:", text)

    def test_a_program_that_fails_is_shown(self) -> None:
        text, passed = comment("", Check(None, "no such file"), None, [Map("m.yaml", None, "bad map")])
        self.assertFalse(passed)
        self.assertIn("no such file", text)
        self.assertIn("❌ bad map", text)


if __name__ == "__main__":
    unittest.main()
