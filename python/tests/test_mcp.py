"""`periplus mcp`, driven by the client of the protocol's own SDK through a whole task."""

import asyncio
import base64
import sys
from pathlib import Path
from typing import Any

import pytest

mcp = pytest.importorskip("mcp", reason="the SDK of the Model Context Protocol is not installed")

DRIVE = """\
- {at: 0.0, linear: 0.3, angular: 0.0}
- {at: 3.0, linear: 0.2, angular: 0.6}
- {at: 8.0, linear: 0.3, angular: 0.0}
"""


def with_client(folder: Path, task: Any, *options: str) -> None:
    """Starts the server for a folder and runs `task(session)`."""

    async def main() -> None:
        words = ["-m", "periplus", "mcp", "--folder", str(folder), *options]
        server = mcp.StdioServerParameters(command=sys.executable, args=words)
        async with mcp.stdio_client(server) as (read, write):
            async with mcp.ClientSession(read, write) as session:
                await session.initialize()
                await task(session)

    asyncio.run(main())


def structured(result: Any) -> dict[str, Any]:
    content: dict[str, Any] = result.model_dump(by_alias=True)["structuredContent"]
    return content


def is_error(result: Any) -> bool:
    return bool(result.model_dump(by_alias=True)["isError"])


def text_of(result: Any) -> str:
    return "\n".join(part.text for part in result.content if part.type == "text")


def pictures_of(result: Any) -> list[bytes]:
    return [base64.b64decode(part.data) for part in result.content if part.type == "image"]


def test_a_robot_with_a_mistake_is_repaired_driven_mapped_and_reported(tmp_path: Path) -> None:
    async def task(session: Any) -> None:
        made = await session.call_tool("new_robot", {"name": "scout"})
        assert not is_error(made), text_of(made)
        made = await session.call_tool("new_world", {"name": "room"})
        assert not is_error(made), text_of(made)

        # A wheel joint with another name than that of the drive.
        robot = tmp_path / "scout.urdf.xacro"
        sound = robot.read_text()
        broken = sound.replace("<left_joint>left_wheel_joint<", "<left_joint>left_wheel<")
        assert broken != sound
        robot.write_text(broken)
        found = await session.call_tool("check", {"file": [robot.name]})
        assert is_error(found)
        findings = text_of(found)
        assert "left_wheel_joint" in findings, findings
        robot.write_text(broken.replace("left_wheel<", "left_wheel_joint<"))
        found = await session.call_tool("check", {"file": [robot.name], "strict": True})
        assert not is_error(found), text_of(found)

        seen = await session.call_tool("look", {"file": [robot.name], "output": "scout.png"})
        assert not is_error(seen), text_of(seen)
        [picture] = pictures_of(seen)
        assert picture.startswith(b"\x89PNG") and picture == (tmp_path / "scout.png").read_bytes()

        (tmp_path / "drive.yaml").write_text(DRIVE)
        run = await session.call_tool(
            "sim",
            {
                "world": ["room.sdf"],
                "robot": [robot.name],
                "cmd": "drive.yaml",
                "duration": 10,
                "record": "run.mcap",
                "record_truth": True,
            },
        )
        assert not is_error(run), text_of(run)
        assert "run.mcap" in structured(run)["files"]

        mapped = await session.call_tool("slam", {"log": "run.mcap", "out": "map"})
        assert not is_error(mapped), text_of(mapped)
        assert {"map/map.yaml", "map/map.pgm"} <= set(structured(mapped)["files"])
        assert pictures_of(mapped), "the trajectory is a picture"

        info = await session.call_tool("map_info", {"path": "map/map.yaml"})
        assert not is_error(info), text_of(info)

        report = await session.call_tool("report", {"run": "run.mcap", "output": "run.html"})
        assert not is_error(report), text_of(report)
        assert structured(report)["files"] == ["run.html"]

    with_client(tmp_path, task)


def test_tools_have_schemas_and_refuse_what_does_not_fit(tmp_path: Path) -> None:
    async def task(session: Any) -> None:
        tools = {tool.name for tool in (await session.list_tools()).tools}
        assert tools == {"check", "sim"}
        wrong = await session.call_tool("check", {"files": ["a.sdf"]})
        assert is_error(wrong)
        assert "`check` has no argument `files`; it has file" in text_of(wrong)
        missing = await session.call_tool("check", {"file": ["none.sdf"]})
        assert is_error(missing) and structured(missing)["exit_code"] == 1

    with_client(tmp_path, task, "--tools", "check,sim")


def test_a_run_without_an_end_is_stopped_and_writes_its_report(tmp_path: Path) -> None:
    async def task(session: Any) -> None:
        await session.call_tool("new_world", {"name": "room"})
        run = await session.call_tool("sim", {"world": ["room.sdf"], "timeout_s": 2})
        assert not is_error(run), text_of(run)
        assert "stopped after 2 s" in text_of(run)
        assert structured(run)["output"] is not None

    with_client(tmp_path, task)
