"""Checks, expands and converts robot files."""

from pathlib import Path

from periplus import FileError, World, check, convert, expand_xacro

XACRO = """<?xml version="1.0"?>
<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="size" default="0.4"/>
  <link name="base_link">
    <inertial><mass value="5"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="$(arg size) 0.3 0.2"/></geometry></collision>
  </link>
</robot>
"""


def main() -> None:
    path = Path("cart.urdf.xacro")
    path.write_text(XACRO)
    assert '<box size="0.6 0.3 0.2"/>' in expand_xacro(path, {"size": 0.6})
    sdf = convert(path, to="sdf")
    assert "<model name=" in sdf and "0.4 0.3 0.2" in sdf
    print(f"{len(sdf.splitlines())} lines of SDF")

    broken = Path("broken.urdf")
    broken.write_text("<robot name='cart'>\n  <link nam='base_link'/>\n</robot>\n")
    for finding in check(broken):
        print(f"{finding.file}:{finding.line}:{finding.column}: {finding.message}")
    assert any(finding.line == 2 for finding in check(broken))

    try:
        World.load(broken)
    except FileError as error:
        print(f"line {error.line}: {error}")
        assert error.line == 2
    else:
        raise AssertionError("a broken robot was loaded")


if __name__ == "__main__":
    main()
