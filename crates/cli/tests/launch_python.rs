//! Launch files in Python: modules that they import, what they may do, and when.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn workspace(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("launch_python_{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    for (path, text) in files {
        let path = folder.join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

fn launch(file: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("launch").arg(file).arg("--print").args(words).env("NO_COLOR", "1");
    command.env_remove("AMENT_PREFIX_PATH").env_remove("ROS_DISTRO");
    command.output().unwrap()
}

/// What a file in a workspace of its own gives: the exit code, the plan, and what was said.
fn check(name: &str, text: &str, words: &[&str]) -> (Option<i32>, String, String) {
    let folder = workspace(name, &[("src/bot/launch/a.launch.py", text)]);
    let output = launch(&folder.join("src/bot/launch/a.launch.py"), words);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn has_python() -> bool {
    let has = Command::new("python3").arg("--version").output().is_ok();
    if !has {
        eprintln!("SKIPPED: launch files in Python need a python3");
    }
    has
}

#[test]
fn submodules_import_as_from_the_real_packages() {
    if !has_python() {
        return;
    }
    let text = "
from launch.launch_description import LaunchDescription
from launch.actions.opaque_function import OpaqueFunction
from launch.conditions.if_condition import IfCondition
from launch.events.matchers import matches_action
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitutions.launch_configuration import LaunchConfiguration
from launch_ros.actions.node import Node
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from ros_gz_bridge.actions import RosGzBridge
from ros_gz_sim.actions import GzServer
from controller_manager.launch_utils import generate_load_controller_launch_description
from nav2_common.launch.rewritten_yaml import RewrittenYaml
import launch_pal.include_utils, launch_testing.actions, osrf_pycommon.process_utils, xacro
try:
    import launch.actions.no_such_module
except ModuleNotFoundError:
    missing = True


def generate_launch_description():
    return LaunchDescription([
        GzServer(world_sdf_file='w.sdf'), RosGzBridge(bridge_name='b', config_file='c'),
        Node(package='p', executable='e', name='missing' if missing else 'found'),
        *generate_load_controller_launch_description('arm').entities,
    ])
";
    let (code, plan, said) = check("imports", text, &[]);
    assert_eq!(code, Some(0), "{said}");
    for wanted in ["gz_server.launch.py", "ros_gz_bridge.launch.py", "missing", "spawner"] {
        assert!(plan.contains(wanted), "{wanted}: {plan}");
    }
}

#[test]
fn packages_of_the_workspace_import_from_their_sources() {
    if !has_python() {
        return;
    }
    let launch_file = "
from helpers.words import word
from launch import LaunchDescription
from launch.actions import LogInfo


def generate_launch_description():
    return LaunchDescription([LogInfo(msg=word())])
";
    let folder = workspace(
        "sources",
        &[
            ("src/a/.git/HEAD", ""),
            ("src/a/bot/package.xml", "<package><name>bot</name></package>"),
            ("src/a/bot/launch/a.launch.py", launch_file),
            ("src/b/.git/HEAD", ""),
            ("src/b/helpers/package.xml", "<package><name>helpers</name></package>"),
            ("src/b/helpers/setup.py", "setup(package_dir={'': 'code'})"),
            ("src/b/helpers/code/helpers/__init__.py", ""),
            ("src/b/helpers/code/helpers/words.py", "def word():\n    return 'from the sources'\n"),
        ],
    );
    let output = launch(&folder.join("src/a/bot/launch/a.launch.py"), &[]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(plan.contains("from the sources"), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn functions_for_the_end_are_not_called_while_planning() {
    if !has_python() {
        return;
    }
    let text = "
import os
from launch import LaunchDescription
from launch.actions import OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnShutdown


def generate_launch_description():
    gone = OpaqueFunction(function=lambda _: os.remove('/no/such/file'))
    return LaunchDescription([RegisterEventHandler(OnShutdown(on_shutdown=[gone]))])
";
    let (code, _, said) = check("shutdown", text, &[]);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn what_does_not_end_is_ended() {
    if !has_python() {
        return;
    }
    let itself = "
from launch import LaunchDescription
from launch.actions import OpaqueFunction


def again(context):
    return [OpaqueFunction(function=again)]


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=again)])
";
    let (code, _, said) = check("itself", itself, &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("contain each other more than"), "{said}");
    let hangs = "
def generate_launch_description():
    while True:
        pass
";
    let (code, _, said) = check("hangs", hangs, &["--evaluation-limit", "0.5"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("--evaluation-limit"), "{said}");
}

#[test]
fn no_code_runs_none() {
    let text = "raise SystemExit('it ran')";
    let (code, _, said) = check("no_code", text, &["--no-code"]);
    assert_eq!(code, Some(1));
    assert!(said.contains("--no-code") && !said.contains("it ran"), "{said}");
}

#[test]
fn variables_set_in_python_are_in_the_plan_and_missing_ones_are_named() {
    if !has_python() {
        return;
    }
    let text = "
import os
from launch import LaunchDescription
from launch.actions import LogInfo

os.environ['GAZEBO_MODEL_PATH'] = '/my/models'
os.environ['AMENT_PREFIX_PATH'].split(':')


def generate_launch_description():
    return LaunchDescription([LogInfo(msg=os.environ['ROS_DISTRO'])])
";
    let (code, plan, said) = check("environment", text, &[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(plan.contains("/my/models") && plan.contains("a.launch.py"), "{plan}");
    let (code, _, said) = check("variable", "import os\nos.environ['NO_SUCH_MODEL']\n", &[]);
    assert_eq!(code, Some(1));
    assert!(
        said.contains("a.launch.py:2") && said.contains("export NO_SUCH_MODEL=VALUE"),
        "{said}"
    );
}

#[test]
fn xacro_is_the_built_in_one() {
    if !has_python() {
        return;
    }
    let text = "
import os, xacro
from launch import LaunchDescription
from launch.actions import LogInfo


def generate_launch_description():
    file = os.path.join(os.path.dirname(__file__), 'a.xacro')
    one = xacro.process_file(file, mappings={'name': 'one'}).documentElement.getAttribute('name')
    document = xacro.parse(open(file))
    xacro.process_doc(document, mappings={'name': 'two'})
    two = document.documentElement.getAttribute('name')
    return LaunchDescription([LogInfo(msg=one + ' and ' + two)])
";
    let robot = "<robot xmlns:xacro='http://ros.org/wiki/xacro' name='$(arg name)'>\
                 <xacro:arg name='name' default='none'/><link name='base'/></robot>";
    let folder = workspace("xacro", &[("launch/a.launch.py", text), ("launch/a.xacro", robot)]);
    let output = launch(&folder.join("launch/a.launch.py"), &[]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(plan.contains("one and two"), "{}", String::from_utf8_lossy(&output.stderr));
}
