"""The action as it runs, in a repository of its own; needs the program, by `PERIPLUS_PROGRAM`."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ACTION = Path(__file__).parent
ROBOT = """<robot name="bot">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>
"""
MAP = "image: room.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"


def picture(wall: int) -> bytes:
    """Free cells with a frame of walls, and one column of walls inside."""
    size = 20
    edge = (0, size - 1)
    cells = [0 if x in edge or y in edge or x == wall else 254 for y in range(size) for x in range(size)]
    return b"P5\n20 20\n255\n" + bytes(cells)


@unittest.skipUnless("PERIPLUS_PROGRAM" in os.environ, "PERIPLUS_PROGRAM is not set")
class RunTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write("bot.urdf", ROBOT.encode())
        self.write("maps/room.yaml", MAP.encode())
        self.write("maps/room.pgm", picture(10))
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "base")

    def write(self, name: str, content: bytes) -> None:
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)

    def git(self, *words: str) -> str:
        done = subprocess.run(["git", *words], cwd=self.folder, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def run_action(self, **settings: str) -> tuple[int, str, str]:
        """Returns the exit code, the output of the step, and the comment."""
        out = self.folder / "out"
        environment = {
            "PATH": os.environ["PATH"],
            "PROGRAM": os.environ["PERIPLUS_PROGRAM"],
            "OUT": str(out),
            "GITHUB_OUTPUT": str(self.folder / "step"),
            "BASE": self.git("rev-parse", "HEAD"),
            **settings,
        }
        command = [sys.executable, str(ACTION / "run.py")]
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        step, text = self.folder / "step", out / "comment.md"
        read = [path.read_text() if path.exists() else "" for path in (step, text)]
        return done.returncode, read[0] + done.stderr, read[1]

    def test_a_changed_map_is_compared_with_the_base(self) -> None:
        self.write("maps/room.pgm", picture(5))
        self.write("maps/new.yaml", MAP.encode())
        code, step, text = self.run_action(FILES="*.urdf", MAPS="maps/*.yaml")
        self.assertEqual(code, 0, step)
        self.assertIn("passed=true\n", step)
        self.assertIn("### Files: ✅ 1 file, 0 errors", text)
        self.assertIn("| `maps/new.yaml` | new: the base branch does not have it |", text)
        self.assertRegex(text, r"\| `maps/room.yaml` \| [6-9]\d\.\d % \|")

    def test_an_error_fails(self) -> None:
        self.write("bot.urdf", b"<robot name='bot'><link name='a'/><link name='b'/></robot>")
        _, step, text = self.run_action(FILES="*.urdf")
        self.assertIn("passed=false\n", step)
        self.assertIn("the links are not one tree", text)

    def test_a_pattern_without_files_is_an_error(self) -> None:
        code, step, _ = self.run_action(FILES="*.sdf")
        self.assertEqual(code, 1)
        self.assertIn("no file matches `*.sdf`", step)


if __name__ == "__main__":
    unittest.main()
