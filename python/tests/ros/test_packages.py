"""Packages of a source tree are known without a build."""

import os
from pathlib import Path

import pytest
from periplus.ros import _packages


def write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def package_xml(name: str, build_type: str = "ament_python") -> str:
    return f"<package format='3'><name>{name}</name><export><build_type>{build_type}</build_type></export></package>"


SETUP = """
import os
from glob import glob
from setuptools import find_packages, setup
from helper_that_is_not_installed import extras
print('noise on stdout')
package_name = 'bot'
setup(name=package_name, packages=find_packages(exclude=['test']), cmdclass=extras(),
      data_files=[(os.path.join('share', package_name, 'launch'), glob(os.path.join('bringup', '*.launch.py'))),
                  ('share/ament_index/resource_index/packages', ['resource/bot'])],
      entry_points={'console_scripts': ['drive = bot.drive:main', 'stop=bot.stop:Stop.main [extra]']})
"""


@pytest.fixture
def bot(tmp_path: Path) -> Path:
    folder = tmp_path / "ws" / "src" / "bot"
    write(folder, {
        "package.xml": package_xml("bot"), "setup.py": SETUP, "resource/bot": "", "bot/__init__.py": "",
        "bot/drive.py": "def main(): pass", "bringup/a.launch.py": "A", "config/c.yaml": "C",
    })  # fmt: skip
    return folder


def test_entry_points_of_setup_py(bot: Path) -> None:
    package = _packages.read_package(str(bot))
    assert package is not None
    assert {name: item.entry_point for name, item in package.executables.items()} == {
        "drive": "bot.drive:main",
        "stop": "bot.stop:Stop.main",
    }


def test_share_folder_has_the_layout_of_a_build(bot: Path) -> None:
    package = _packages.read_package(str(bot))
    assert package is not None
    share = Path(package.share_folder)
    assert (share / "launch" / "a.launch.py").read_text() == "A"
    assert (share / "config" / "c.yaml").read_text() == "C", "files that are not installed are found too"
    (bot / "bringup" / "a.launch.py").write_text("B")
    assert (share / "launch" / "a.launch.py").read_text() == "B", "an edit needs no build"


def test_share_folder_is_the_source_folder_when_the_layout_is_the_same(tmp_path: Path) -> None:
    cmake = "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME}/)"
    write(tmp_path, {"package.xml": package_xml("p", "ament_cmake"), "CMakeLists.txt": cmake, "launch/a": "", "config/b": ""})
    package = _packages.read_package(str(tmp_path))
    assert package is not None
    assert package.share_folder == str(tmp_path)


def test_the_line_of_an_error_in_setup_py(bot: Path) -> None:
    (bot / "setup.py").write_text("import os\n\nraise ValueError('no version')\n")
    package = _packages.read_package(str(bot))
    assert package is not None
    with pytest.raises(_packages.PackageError, match=r"setup.py:3: ValueError: no version"):
        package.executable("drive")


def test_scripts_that_cmake_installs(tmp_path: Path) -> None:
    cmake = """
    project(cm)  # install(PROGRAMS no.py DESTINATION lib/cm)
    set(SCRIPTS scripts/a.py "scripts/b.py")
    install(PROGRAMS ${SCRIPTS} DESTINATION lib/${PROJECT_NAME})
    install(
      PROGRAMS scripts/c.py
      RENAME sea
      DESTINATION lib/${PROJECT_NAME}
    )
    foreach(script d.py)
      install(PROGRAMS ${CMAKE_CURRENT_SOURCE_DIR}/scripts/${script} DESTINATION lib/${PROJECT_NAME})
    endforeach()
    add_executable(fast src/fast.cpp)
    ament_python_install_package(${PROJECT_NAME} PACKAGE_DIR python/${PROJECT_NAME})
    """
    write(tmp_path, {"package.xml": package_xml("cm", "ament_cmake"), "CMakeLists.txt": cmake})
    write(tmp_path / "scripts", {f"{name}.py": "" for name in "abcd"})
    package = _packages.read_package(str(tmp_path))
    assert package is not None
    assert sorted(package.executables) == ["a.py", "b.py", "d.py", "sea"]
    assert package.executable("a").script == str(tmp_path / "scripts" / "a.py")
    assert str(tmp_path / "python") in package.python_paths
    with pytest.raises(_packages.PackageError, match=r"fast of package cm is a C\+\+ program"):
        package.executable("fast")
    with pytest.raises(_packages.PackageError, match=r"Did you mean 'sea'\? It has: a.py, b.py, d.py, sea"):
        package.executable("see")


def test_scripts_of_a_catkin_package(tmp_path: Path) -> None:
    setup = (
        "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\n"
        "setup(**generate_distutils_setup(packages=['cat'], package_dir={'': 'src'}))\n"
    )
    write(tmp_path, {
        "package.xml": "<package><name>cat</name><buildtool_depend>catkin</buildtool_depend></package>", "setup.py": setup,
        "nodes/purr": "#!/usr/bin/env python\n", "scripts/mew.py": "", "src/cat/__init__.py": "", "README": "",
    })  # fmt: skip
    package = _packages.read_package(str(tmp_path))
    assert package is not None
    assert package.build_type == "catkin"
    assert package.executable("purr").script == str(tmp_path / "nodes" / "purr")
    assert package.executable("mew").script == str(tmp_path / "scripts" / "mew.py")
    assert package.python_paths[0] == str(tmp_path / "src")


def test_a_package_of_rosbuild_has_the_name_of_its_folder(tmp_path: Path) -> None:
    write(tmp_path / "old", {"manifest.xml": "<package><depend package='rospy'/></package>", "nodes/run.py": ""})
    write(tmp_path / "other", {"manifest.xml": "<manifest package='org.android'/>"})
    assert list(_packages.find_packages([str(tmp_path)])) == ["old"]
    package = _packages.package_of(str(tmp_path / "old" / "nodes"))
    assert package is not None
    assert package.executable("run").script == str(tmp_path / "old" / "nodes" / "run.py")


def test_catkin_reads_its_own_marker_alone(tmp_path: Path) -> None:
    marks = {"shown": "COLCON_IGNORE", "hidden": "CATKIN_IGNORE"}
    for name, mark in marks.items():
        write(tmp_path / name, {"package.xml": package_xml(name, "catkin"), mark: ""})
    write(tmp_path / "new", {"package.xml": package_xml("new"), "COLCON_IGNORE": ""})
    assert list(_packages.find_packages([str(tmp_path)])) == ["shown"]


def test_siblings_in_a_workspace_are_found(bot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    workspace = bot.parent.parent
    write(workspace, {
        "src/more/bot_msgs/package.xml": package_xml("bot_msgs", "ament_cmake"),
        "src/ignored/COLCON_IGNORE": "", "src/ignored/package.xml": package_xml("ignored"),
        "install/bot/package.xml": package_xml("bot"),
    })  # fmt: skip
    monkeypatch.chdir(bot / "bot")
    assert {name: item.folder for name, item in _packages.known_packages().items()} == {
        "bot": str(bot),
        "bot_msgs": str(bot.parent / "more" / "bot_msgs"),
    }
    monkeypatch.chdir(workspace)
    assert sorted(_packages.known_packages()) == ["bot", "bot_msgs"]
    assert _packages.package_of(str(bot / "bot" / "drive.py")) == _packages.find_package("bot")


def test_a_large_folder_does_not_take_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_packages, "_MAX_FOLDERS", 50)
    visited: list[str] = []
    scandir = os.scandir
    monkeypatch.setattr(os, "scandir", lambda path: visited.append(path) or scandir(path))
    _packages.find_packages(["/usr"])
    assert len(visited) <= 50
