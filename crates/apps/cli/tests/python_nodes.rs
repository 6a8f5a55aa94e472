//! Users' own nodes in Python, from source trees: `periplus run` and launch files. The interpreter is a
//! script that prints what it is given.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::fs;
use std::io::Write as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use common::Folder;

/// Prints its arguments, the named variables, and the parameter files; answers a line of input.
const INTERPRETER: &str = r#"#!/bin/sh
[ "$1" = -c ] && exit 0
echo "args: $*"
echo "packages: $PERIPLUS_PACKAGES"
echo "real: $PERIPLUS_REAL_ROS, namespace: $ROS_NAMESPACE, seed: $PERIPLUS_SEED $PYTHONHASHSEED"
echo "link: ${PERIPLUS_LOCKSTEP:+yes}, range: $ROS_AUTOMATIC_DISCOVERY_RANGE"
for word in "$@"; do
  case "$word" in *periplus_parameters_*) echo "file: $(cat "$word")";; esac
done
[ -n "$PERIPLUS_ROS1_PARAMETERS" ] && echo "server: $(cat "$PERIPLUS_ROS1_PARAMETERS")"
[ -n "$READS" ] && read line && echo "line: $line"
exit ${CODE:-0}
"#;

const SETUP: &str = "from setuptools import setup\nsetup(name='walls', entry_points={'console_scripts': \
                     ['wall = walls.wall_node:main']})\n";

/// Source tree with a package, and an interpreter.
struct Tree {
    folder: Folder,
}

impl Tree {
    fn new(name: &str) -> Self {
        let tree = Self { folder: Folder::new(name) };
        let interpreter = tree.write("python", INTERPRETER);
        fs::set_permissions(interpreter, fs::Permissions::from_mode(0o755)).unwrap();
        tree.write("ws/src/walls/package.xml", "<package><name>walls</name></package>");
        tree.write("ws/src/walls/setup.py", SETUP);
        tree.write("ws/src/walls/walls/wall_node.py", "def main(): pass\n");
        tree.write("ws/src/mixed/package.xml", "<package><name>mixed</name></package>");
        tree.write("ws/src/mixed/tools/talk.py", "import rclpy\n");
        tree.write("ws/src/mixed/scripts/shell", "#!/bin/sh\n");
        tree
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path
    }

    fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.args(words).current_dir(self.folder.path("ws")).env("NO_COLOR", "1");
        command.env("PERIPLUS_PYTHON", self.folder.path("python"));
        command.env("ROS_DOMAIN_ID", "151").env_remove("AMENT_PREFIX_PATH");
        command.env_remove("ROS_AUTOMATIC_DISCOVERY_RANGE").env_remove("PERIPLUS_PACKAGES");
        command
    }

    fn run(&self, words: &[&str]) -> Output {
        self.command(words).output().unwrap()
    }

    /// Launches a file in the package; returns the success and both outputs.
    fn launch(&self, name: &str, text: &str, words: &[&str]) -> (bool, String) {
        let file = self.write(&format!("ws/src/walls/launch/{name}"), text).display().to_string();
        let output = self.run(&[&["launch", &file], words].concat());
        (output.status.success(), text_of(&output))
    }
}

fn text_of(output: &Output) -> String {
    let texts = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    texts.concat()
}

fn has(text: &str, wanted: &[&str]) {
    for words in wanted {
        assert!(text.contains(words), "no `{words}` in\n{text}");
    }
}

#[test]
fn a_program_of_a_source_tree_runs_in_place_of_the_command() {
    let tree = Tree::new("run_python");
    let output = tree.run(&["run", "walls", "wall", "-h", "7", "--ros-args", "-r", "scan:=s"]);
    assert!(output.status.success());
    let folder = tree.folder.path("ws/src/walls").canonicalize().unwrap();
    let packages = format!("packages: {}", folder.display());
    let args = "args: -m periplus.ros.run walls wall -h 7 --ros-args -r scan:=s";
    has(&text_of(&output), &[args, &packages, "real: ,"]);
    let output = tree.run(&["rosrun", "mixed", "talk.py", "_rate:=5", "scan:=s"]);
    has(&text_of(&output), &["args: -m periplus.ros.run mixed talk.py _rate:=5 scan:=s"]);
    let output = tree.run(&["ros2", "run", "walls", "wall", "--ros-args", "-p", "a:=1"]);
    has(&text_of(&output), &["args: -m periplus.ros.run walls wall --ros-args -p a:=1"]);
}

#[test]
fn a_file_has_the_terminal_and_its_exit_code() {
    let tree = Tree::new("run_file");
    let mut command = tree.command(&["run", "--real-ros", "src/mixed/tools/talk.py", "--color"]);
    command.env("READS", "1").env("CODE", "7").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"hello\n").unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(7));
    let args = "args: -m periplus.ros.run src/mixed/tools/talk.py --color";
    has(&text_of(&output), &[args, "real: 1,", "line: hello"]);
}

#[test]
fn errors_name_the_remedy() {
    let tree = Tree::new("run_errors");
    let told = |words: &[&str]| text_of(&tree.run(words));
    has(&told(&["run", "src/mixed/tools/tlak.py"]), &["does not exist", "talk.py"]);
    has(&told(&["run", "walls"]), &["`walls` is not a Python file", "package and one of its"]);
    // The module of the package names the programs that there are.
    has(&told(&["run", "walls", "wal"]), &["args: -m periplus.ros.run walls wal"]);
    has(&told(&["run", "mixed", "shell"]), &["scripts/shell` cannot be started"]);
    let mut command = tree.command(&["run", "walls", "wall"]);
    let output = command.env("PERIPLUS_PYTHON", "no-such-python").output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    has(&text_of(&output), &["no-such-python -m pip install periplus"]);
}

const NODES: &str = r#"<launch>
  <node pkg="walls" exec="wall" name="left" namespace="robot" args="a" ros_args="--log-level debug">
    <param name="gain" value="2.5"/>
    <remap from="scan" to="front"/>
    <env name="CODE" value="0"/>
  </node>
  <node pkg="walls" exec="wall"><param name="text" value="5 m"/></node>
  <executable cmd="python3 src/mixed/tools/talk.py x"/>
  <node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 1 0 0 0 map lamp"/>
  <node pkg="walls" exec="wal"/>
  <node pkg="nowhere" exec="wall"/>
  <node pkg="rviz2" exec="rviz2"/>
</launch>"#;

#[test]
fn nodes_of_a_launch_file_run_in_step_with_the_simulation() {
    let tree = Tree::new("launch_python");
    let (is_success, told) =
        tree.launch("a.launch.xml", NODES, &["--duration", "0.1", "--seed", "4294967301"]);
    // A package is missing.
    assert!(!is_success, "{told}");
    has(
        &told,
        &[
            "+ walls wall: /robot/left: the Python node of ",
            "walls, in step with the simulation",
            "[left] args: -m periplus.ros.run walls wall a --ros-args --log-level debug -r __node:=left \
             -r __ns:=/robot -r scan:=front --params-file ",
            r#"[left] file: {"/robot/left":{"ros__parameters":{"gain":2.5}}}"#,
            "[left] link: yes",
            "seed: 4294967301 5",
            r#"[wall] file: {"/**":{"ros__parameters":{"text":"5 m"}}}"#,
            "args: -m periplus.ros.run ",
            "src/mixed/tools/talk.py x",
            // The module of the package names the programs that there are.
            "[wal] args: -m periplus.ros.run walls wal ",
            "- nowhere wall: `wall` of the package `nowhere` has no built-in replacement, and there is no such package",
        ],
    );
    let files = told.split("--params-file ").skip(1).filter_map(|rest| rest.lines().next());
    let left: Vec<&str> = files.filter(|file| Path::new(file).exists()).collect();
    assert!(left.is_empty(), "{left:?} are left behind");
}

#[test]
fn a_dry_run_lists_what_each_node_becomes() {
    let tree = Tree::new("dry_run");
    let (is_success, told) = tree.launch("a.launch.xml", NODES, &["--dry-run"]);
    assert!(is_success, "{told}");
    let interpreter = format!(", by {}", tree.folder.path("python").display());
    has(
        &told,
        &[
            "+ walls wall: /robot/left: the Python node of ",
            &interpreter,
            "+ python3 ...: the Python node of ",
            "+ tf2_ros static_transform_publisher: /static_transform_publisher: ",
            "- nowhere wall: ",
            "= rviz2 rviz2: ",
        ],
    );
    assert!(!told.contains("args: "), "{told}");
}

#[test]
fn nodes_of_ros_1_get_the_parameter_server() {
    let tree = Tree::new("launch_ros1");
    let file = r#"<launch>
      <param name="use_sim_time" value="true"/>
      <group ns="robot">
        <node pkg="mixed" type="talk.py" name="talk" args="_rate:=5">
          <rosparam>{pid: {p: 1}}</rosparam>
          <remap from="cmd" to="raw"/>
        </node>
      </group>
    </launch>"#;
    let (is_success, told) = tree.launch("a.launch", file, &["--duration", "0.1"]);
    assert!(is_success, "{told}");
    has(
        &told,
        &[
            "[talk] args: -m periplus.ros.run mixed talk.py _rate:=5 __name:=talk cmd:=raw",
            "namespace: /robot",
            r#"[talk] server: {"/robot/talk/pid/p":1,"/use_sim_time":true}"#,
        ],
    );
}

#[test]
fn a_package_of_rosbuild_is_a_source_tree_too() {
    let tree = Tree::new("launch_rosbuild");
    tree.write("ws/src/basics/manifest.xml", "<package><depend package='rospy'/></package>");
    tree.write("ws/src/basics/src/server.py", "#! /usr/bin/env python\nimport rospy\n");
    let file = r#"<launch><node pkg="basics" type="server.py" name="server"/></launch>"#;
    let (is_success, told) = tree.launch("a.launch", file, &["--duration", "0.1"]);
    assert!(is_success, "{told}");
    has(&told, &["[server] args: -m periplus.ros.run basics server.py __name:=server"]);
    let output = tree.run(&["rosrun", "basics", "server.py"]);
    has(&text_of(&output), &["args: -m periplus.ros.run basics server.py"]);
}

#[test]
fn a_command_gets_no_more_than_its_own_arguments() {
    let tree = Tree::new("launch_ros2_run");
    let file = r#"<launch><executable cmd="ros2 run walls wall a 1" output="screen"/></launch>"#;
    let (is_success, told) = tree.launch("a.launch.xml", file, &["--duration", "0.1"]);
    assert!(is_success, "{told}");
    has(&told, &["args: -m periplus.ros.run walls wall a 1\n"]);
}

#[test]
fn nodes_respawn_and_required_ones_end_the_launch() {
    let tree = Tree::new("respawn");
    let file = r#"<launch>
      <node pkg="mixed" type="talk.py" name="again" respawn="true" respawn_delay="0.2"/>
      <node pkg="mixed" type="talk.py" name="needed" required="true"/>
    </launch>"#;
    let (_, told) = tree.launch("a.launch", file, &["--duration", "1"]);
    has(&told, &["[needed] has ended", "`mixed talk.py` has ended and is required"]);
    let file = file.replace(r#" required="true""#, "");
    let (_, told) = tree.launch("b.launch", &file, &["--duration", "1"]);
    let starts = told.matches("[again] args: ").count();
    assert!((3..=6).contains(&starts), "{starts} starts in\n{told}");
}

#[test]
fn a_live_run_gives_its_network_to_the_nodes() {
    let tree = Tree::new("launch_live");
    let words = ["--duration", "0.1", "--ros2", "loopback"];
    let (_, told) = tree.launch("a.launch.xml", NODES, &words);
    has(&told, &["[left] link: , range: LOCALHOST"]);
    assert!(!told.contains("in step"), "{told}");
}
