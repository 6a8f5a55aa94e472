"""Robot files: check, convert, xacro."""

from __future__ import annotations

import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import periplus

XACRO = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="radius" default="0.1"/>
  <xacro:arg name="with_mast" default="false"/>
  <xacro:property name="r" value="$(arg radius)"/>
  <link name="base_link">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="${2 * r}"/></geometry></collision>
  </link>
  <xacro:if value="$(arg with_mast)"><link name="mast"/></xacro:if>
</robot>
"""


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    path = tmp_path / "cart.urdf.xacro"
    path.write_text(XACRO)
    return path


def test_xacro_is_expanded(cart: Path) -> None:
    robot = ET.fromstring(periplus.expand_xacro(cart))
    assert [link.get("name") for link in robot.iter("link")] == ["base_link"]
    sphere = robot.find(".//sphere")
    assert sphere is not None and sphere.get("radius") == "0.2"
    robot = ET.fromstring(periplus.expand_xacro(cart, {"radius": 0.5, "with_mast": True}))
    assert [link.get("name") for link in robot.iter("link")] == ["base_link", "mast"]
    sphere = robot.find(".//sphere")
    assert sphere is not None and sphere.get("radius") == "1.0"


def test_an_unknown_argument_is_refused(cart: Path) -> None:
    with pytest.raises(TypeError, match="no argument `radus`, did you mean `radius`"):
        periplus.expand_xacro(cart, {"radus": 1})
    with pytest.raises(TypeError):
        periplus.expand_xacro(cart, {1: 1})  # type: ignore[dict-item]


def test_formats_convert(cart: Path) -> None:
    assert ET.fromstring(periplus.load_robot(cart)).find("model") is not None
    assert ET.fromstring(periplus.convert(cart, to="sdf")).tag == "sdf"
    assert json.loads(periplus.convert(cart, "json"))["models"][0]["name"] == "cart"
    sdf = cart.with_name("cart.sdf")
    sdf.write_text(periplus.load_robot(cart))
    assert ET.fromstring(periplus.convert(sdf, to="urdf")).get("name") == "cart"
    with pytest.raises(ValueError, match="urdf"):
        periplus.convert(cart, to="usd")
    with pytest.raises(periplus.FileError, match="no model"):
        periplus.convert(sdf, to="sdf", model="boat")


def test_missing_files() -> None:
    for call in (periplus.check, periplus.load_robot, periplus.expand_xacro):
        with pytest.raises(FileNotFoundError):
            call("/no/such/robot.urdf")
    with pytest.raises(FileNotFoundError):
        periplus.convert("/no/such/robot.urdf", "sdf")


def test_errors_have_places(cart: Path) -> None:
    cart.write_text(XACRO.replace("${2 * r}", "${2 * rr}"))
    with pytest.raises(periplus.FileError) as caught:
        periplus.expand_xacro(cart)
    error = caught.value
    assert error.file is not None and error.file.endswith("cart.urdf.xacro")
    assert error.line == 7 and error.column is not None


def test_findings_are_those_of_the_command(tmp_path: Path) -> None:
    path = tmp_path / "cart.urdf"
    path.write_text("<robot name='cart'>\n<link name='a'/>\n<lnk name='b'/></robot>")
    findings = periplus.check(path)
    first = findings[0]
    assert (first.severity, first.code, first.line, first.column) == ("warning", "unknown-element", 3, 2)
    assert str(first).endswith(f"3:2: {first.message}") and repr(first).startswith("Finding(")
    command = [sys.executable, "-m", "periplus", "check", "--json", str(path)]
    report = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    told = report["files"][0]["findings"]
    names = ("severity", "code", "message", "line", "column", "help")
    assert [{name: getattr(one, name) for name in names} for one in findings] == [
        {name: one.get(name) for name in names} for one in told
    ]


def test_a_map_becomes_walls(tmp_path: Path) -> None:
    (tmp_path / "room.pgm").write_bytes(b"P5 3 3 255\n" + bytes([0, 0, 0, 0, 254, 0, 0, 0, 0]))
    text = "image: room.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"
    (tmp_path / "room.yaml").write_text(text)
    world = ET.fromstring(periplus.convert(tmp_path / "room.yaml", "sdf", wall_height=1.5))
    sizes = [size.text for size in world.iterfind(".//box/size")]
    assert sizes and all(size is not None and size.split()[2] == "1.5" for size in sizes)
    with pytest.raises(ValueError, match="wall_height"):
        periplus.convert(tmp_path / "room.yaml", "sdf", wall_height=float("nan"))


@given(text=st.one_of(st.text(max_size=200), st.binary(max_size=200), st.sampled_from([XACRO[:n] for n in range(0, 600, 40)])))
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_any_text_gives_findings_or_a_file_error(tmp_path: Path, text: Any) -> None:
    path = tmp_path / "any.urdf"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    assert isinstance(periplus.check(path), list)
    for call in (periplus.load_robot, periplus.expand_xacro):
        try:
            call(path)
        except periplus.FileError:
            pass
