"""Programs run as with `python FILE.py` and `ros2 run`; errors name the user's line and what to do."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from ros_programs import environment


def run(folder: Path, *words: str, **variables: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-m", "periplus.ros.run", *words],
        cwd=folder, env=environment(**variables), capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip


def write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        path = folder / name.replace("__", "/").replace("_py", ".py").replace("_xml", ".xml")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture
def bot(tmp_path: Path) -> Path:
    write(
        tmp_path,
        bot__package_xml="<package><name>bot</name><export><build_type>ament_python</build_type></export></package>",
        bot__setup_py="from setuptools import setup\nsetup(name='bot', packages=['bot'], entry_points={'console_scripts': ["
        "'drive = bot.drive:main', 'gone = bot.drive:run']})",
        bot__bot__drive_py="import sys\nfrom bot import wheels\nfrom bot_tools import answer\n"
        "def main(args=None):\n    print(sys.argv[1:], wheels.__name__, __name__)\n    return answer\n",
        bot__bot__wheels_py="",
        tools__package_xml="<package><name>bot_tools</name></package>",
    )
    (tmp_path / "bot" / "bot" / "__init__.py").write_text("")
    (tmp_path / "tools" / "bot_tools.py").write_text("answer = 7\n")
    return tmp_path


def test_a_script_is_main(tmp_path: Path) -> None:
    write(tmp_path, deep__a_py="import sys, b\nprint(__name__, __file__, sys.argv, sys.path[0], sys.modules['__main__'].x if 'x' in globals() else '')\n",
          deep__b_py="")  # fmt: skip
    done = run(tmp_path, "deep/a.py", "one", "--ros-args", "-r", "a:=b")
    file = tmp_path / "deep" / "a.py"
    assert done.stdout.split() == ["__main__", str(file), "['deep/a.py',", "'one',", "'--ros-args',", "'-r',", "'a:=b']", str(file.parent)], done.stderr
    assert done.returncode == 0


def test_an_entry_point_runs_with_its_workspace(bot: Path) -> None:
    done = run(bot, "bot", "drive", "x")
    assert (done.returncode, done.stdout) == (7, "['x'] bot.wheels bot.drive\n"), done.stderr


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["bat", "drive"], "no package 'bat' (folder with a package.xml of this name) in {0}. Did you mean 'bot'?"),
        (["bot"], "which program of package bot? It has: drive, gone"),
        (["bot", "driver"], "package bot ({0}/bot) has no program 'driver'. Did you mean 'drive'? It has: drive, gone"),
        (["bot/bot/drove.py"], "no file bot/bot/drove.py. Did you mean bot/bot/drive.py?"),
        (["bot", "gone"], "{0}/bot/bot/drive.py has no run, which setup.py of {0}/bot names as the program (bot.drive:run). It has: main"),
    ],
)
def test_what_is_not_there(bot: Path, words: list[str], text: str) -> None:
    done = run(bot, *words)
    assert done.stderr == f"periplus run: {text.format(bot)}\n"
    assert done.returncode == 2


def test_a_module_of_an_entry_point_that_is_not_there(bot: Path) -> None:
    setup = bot / "bot/setup.py"
    setup.write_text(setup.read_text().replace("bot.drive:run", "bot.drove:main"))
    done = run(bot, "bot", "gone")
    assert done.stderr == (
        f"periplus run: there is no Python module bot.drove, in which setup.py of {bot}/bot has the program (bot.drove:main). "
        "Did you mean bot.drive?\n"
    )
    (bot / "bot/bot/drive.py").write_text("import bot.wheel\n")
    done = run(bot, "bot", "drive")
    assert f'File "{bot}/bot/bot/drive.py", line 1' in done.stderr and "No module named 'bot.wheel'" in done.stderr


@pytest.mark.parametrize(
    ("script", "lines"),
    [
        ("def f():\n    1 / 0\nf()", ['  File "{0}", line 3, in <module>', '  File "{0}", line 2, in f', "ZeroDivisionError: division by zero"]),
        ("def f(:\n    pass", ['  File "{0}", line 1', "SyntaxError: invalid syntax"]),
        ("import os\nprint 'x'", ['  File "{0}", line 2', "hint: a.py:2 is Python 2 (the print statement)"]),
        ("import os\nexcept_ = 1\ntry:\n    pass\nexcept ValueError, e:\n    pass", ["hint: a.py:5 is Python 2 (`except Type, name:`)"]),
        ("if True:\n\tx = 1\n        y = 2", ["hint: a.py:3 mixes tabs and spaces"]),
        ("x = raw_input()", ["hint: a.py:1: raw_input is Python 2's; write input"]),
        ("\nimport cv2_that_is_missing", ["hint: a.py:2: `{1} -m pip install cv2_that_is_missing` installs it"]),
        ("\nfrom std_msgs.msg import Strin", ["hint: a.py:2: std_msgs.msg has 'String'"]),
        ("\nimport std_msg.msg", ["Did you mean 'std_msgs'?"]),
        ("import threading\nt = threading.Thread(target=lambda: [][1], name='t1')\nt.start(); t.join(); raise SystemExit(1)",
         ["Exception in thread t1:", '  File "{0}", line 2, in <lambda>']),
    ],
)  # fmt: skip
def test_errors_begin_at_the_users_line(tmp_path: Path, script: str, lines: list[str]) -> None:
    (tmp_path / "a.py").write_text(script)
    done = run(tmp_path, "a.py")
    assert done.returncode == 1
    for line in lines:
        assert line.format(tmp_path / "a.py", sys.executable) in done.stderr, done.stderr
    assert "periplus/ros" not in done.stderr
    assert "periplus.ros" not in done.stderr


def test_an_error_in_an_imported_file_of_the_users(tmp_path: Path) -> None:
    write(tmp_path, a_py="import b", b_py="\n\ndef f(x):\nreturn x\n")
    done = run(tmp_path, "a.py")
    assert f'  File "{tmp_path}/b.py", line 4' in done.stderr
    assert f'  File "{tmp_path}/a.py", line 1, in <module>' in done.stderr
    assert "periplus/ros" not in done.stderr


def test_exit_codes(tmp_path: Path) -> None:
    for text, code in (("", 0), ("import sys; sys.exit(3)", 3), ("raise SystemExit('text')", 1)):
        (tmp_path / "a.py").write_text(text)
        assert run(tmp_path, "a.py").returncode == code


def test_an_installed_ros_is_not_hidden_silently(tmp_path: Path) -> None:
    (tmp_path / "site" / "rclpy").mkdir(parents=True)
    (tmp_path / "site" / "rclpy" / "__init__.py").write_text("print('the installed one')")
    (tmp_path / "a.py").write_text("import sys\nprint([path for path in sys.path if path.endswith('ros2')] != [])\n"
                                   "if '--show' in sys.argv: import rclpy\n")  # fmt: skip
    path = environment()["PYTHONPATH"] + os.pathsep + str(tmp_path / "site")
    ours = run(tmp_path, "a.py", PYTHONPATH=path)
    assert ours.stdout == "True\n"
    assert f"periplus: rclpy of Periplus; the installed one ({tmp_path}/site/rclpy) is not used" in ours.stderr
    real = run(tmp_path, "--real-ros", "a.py", "--show", PYTHONPATH=path)
    assert (real.stdout, real.stderr) == ("False\nthe installed one\n", "")


def test_real_ros_without_one(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("import rclpy")
    done = run(tmp_path, "--real-ros", "a.py")
    assert done.returncode == 2
    assert done.stderr.startswith("periplus run: No installed rclpy on sys.path. Source your ROS")
