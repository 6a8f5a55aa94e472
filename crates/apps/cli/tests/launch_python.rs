//! Launch files in Python: imported modules, permitted actions, and the time of evaluation.
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

/// Evaluates a file in a new workspace: the exit code, the plan, and stderr.
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

/// `env` replaces the environment of a process, `additional_env` adds to it or to that of the launch.
#[test]
fn env_replaces_the_environment_and_additional_env_adds_to_it() {
    if !has_python() {
        return;
    }
    let text = "
from launch import LaunchDescription
from launch.actions import ExecuteProcess, SetEnvironmentVariable


def generate_launch_description():
    run = [ARGUMENTS]
    return LaunchDescription([SetEnvironmentVariable('SET', 'by_launch'), *run])
";
    let printed = |name: &str, arguments: &str| {
        let process = format!("ExecuteProcess(cmd=['/usr/bin/env'], output='screen', {arguments})");
        let text = text.replace("ARGUMENTS", &process);
        let folder = workspace(name, &[("a.launch.py", &text)]);
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.arg("launch").arg(folder.join("a.launch.py")).args([
            "--ros2",
            "off",
            "--duration",
            "1",
            "--rtf",
            "1",
        ]);
        command.env("NO_COLOR", "1").env("OWN", "of_the_launch");
        let output = command.output().unwrap();
        let both = [output.stdout, output.stderr].concat();
        String::from_utf8_lossy(&both).into_owned()
    };
    let has = |text: &str, variable: &str| text.contains(variable);
    let told = printed("env_replaces", "env={'ONLY': 'this'}, additional_env={'MORE': 'too'}");
    assert!(has(&told, "ONLY=this") && has(&told, "MORE=too"), "{told}");
    assert!(!has(&told, "OWN=of_the_launch") && !has(&told, "SET=by_launch"), "{told}");
    let told = printed("env_adds", "additional_env={'MORE': 'too'}");
    assert!(has(&told, "MORE=too") && has(&told, "OWN=of_the_launch"), "{told}");
    assert!(has(&told, "SET=by_launch"), "{told}");
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
    assert!(said.contains("actions are nested more than"), "{said}");
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
        said.contains("a.launch.py:2") && said.contains("NO_SUCH_MODEL=VALUE periplus launch"),
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

/// `xacro` is built in, also for launch files that run it as a program and for the programs that they
/// start.
#[test]
#[cfg(unix)]
fn xacro_is_a_program_while_a_file_is_evaluated_and_run() {
    if !has_python() {
        return;
    }
    let text = "
import os, subprocess
from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo


def generate_launch_description():
    file = os.path.join(os.path.dirname(__file__), '..', 'urdf', 'a.urdf.xacro')
    text = subprocess.check_output(['xacro', file, 'size:=7'], universal_newlines=True)
    out = os.path.join(os.path.dirname(__file__), 'made.urdf')
    ended = os.system(f'xacro {file} size:=8 -o {out}')
    wrong = subprocess.run(['xacro', file + '.no'], stderr=subprocess.PIPE)
    return LaunchDescription([
        LogInfo(msg=f'printed {text}'),
        LogInfo(msg=f'ended {ended} {open(out).read()}'),
        LogInfo(msg=f'failed {wrong.returncode} {wrong.stderr.decode()}'),
        ExecuteProcess(cmd=['sh', '-c', f'\"xacro {file} size:=9 > {out}\"'], shell=True),
    ])
";
    let xacro = "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>
  <xacro:arg name='size' default='1'/><link name='link_$(arg size)'/>
</robot>";
    let folder = workspace(
        "xacro_program",
        &[("bot/launch/a.launch.py", text), ("bot/urdf/a.urdf.xacro", xacro)],
    );
    let file = folder.join("bot/launch/a.launch.py");
    // Without the machine's own xacro, if it has one.
    let mut python = Command::new("python3");
    let python = python.args(["-c", "import sys; print(sys.executable)"]).output().unwrap();
    let python = String::from_utf8_lossy(&python.stdout).trim().to_owned();
    let tools = folder.join("tools");
    std::fs::create_dir_all(&tools).unwrap();
    std::os::unix::fs::symlink(python, tools.join("python3")).unwrap();
    std::os::unix::fs::symlink("/bin/sh", tools.join("sh")).unwrap();
    let launch = |words: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.arg("launch").arg(&file).args(words).env("NO_COLOR", "1").env("PATH", &tools);
        let output = command.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (String::from_utf8_lossy(&output.stdout).into_owned(), said)
    };
    let (plan, said) = launch(&["--print"]);
    assert!(plan.contains("printed ") && plan.contains("link_7"), "{plan}{said}");
    assert!(plan.contains("ended 0 ") && plan.contains("link_8"), "{plan}{said}");
    assert!(plan.contains("failed 1 ") && plan.contains("a.urdf.xacro.no"), "{plan}{said}");
    let (_, said) = launch(&["--duration", "2", "--rtf", "1", "--headless", "--ros2", "off"]);
    let made = std::fs::read_to_string(folder.join("bot/launch/made.urdf")).unwrap();
    assert!(made.contains("link_9"), "{made}{said}");
}

/// Findings of a robot whose text has no file name the topic that it came on, and the line of the
/// launch file that spawns it.
#[test]
fn findings_of_spawned_robots_name_their_topic_and_line() {
    if !has_python() {
        return;
    }
    let text = "
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

URDF = '''<robot name='r'>
  <link name='base'><inertial><mass value='1'/>
    <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>
  <gazebo><plugin name='p' filename='libentirely_unknown.so'/></gazebo>
</robot>'''


def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['gazebo']),
        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': URDF}]),
        Node(package='gazebo_ros', executable='spawn_entity.py',
             arguments=['-entity', 'r', '-topic', 'robot_description']),
    ])
";
    let folder = workspace("spawned", &[("src/bot/launch/a.launch.py", text)]);
    let file = folder.join("src/bot/launch/a.launch.py");
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("launch").arg(&file).args(["--duration", "0.2"]).env("NO_COLOR", "1");
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("robot_description.xml:4"), "{said}");
    assert!(said.contains("a.launch.py:18)"), "{said}");
    assert!(!said.contains("spawned.xml"), "{said}");
}

/// Lists of flags from a launch file are values of string array parameters.
#[test]
fn lists_of_flags_are_read() {
    if !has_python() {
        return;
    }
    let text = "
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='robot_localization', executable='ekf_node', name='ekf', parameters=[
            {'odom0': 'odom', 'odom0_config': [False] * 6 + [True] * 3 + [False] * 6,
             'use_control': False, 'control_config': [True, False, False, False, False, True]}]),
    ])
";
    let folder = workspace("flags", &[("src/bot/launch/a.launch.py", text)]);
    let file = folder.join("src/bot/launch/a.launch.py");
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("launch").arg(&file).args(["--duration", "0.2"]).env("NO_COLOR", "1");
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(!said.contains("the value"), "{said}");
}

/// A missing package leaves its part of the plan empty, with the lines of the launch file and of the
/// description; a run does not start.
#[test]
fn descriptions_that_need_absent_packages_are_empty_in_the_plan_and_end_a_run() {
    if !has_python() {
        return;
    }
    let text = "
import os, xacro
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description():
    file = os.path.join(os.path.dirname(__file__), 'a.xacro')
    direct = xacro.process_file(file).toxml()
    return LaunchDescription([
        Node(package='p', executable='e', name='one', parameters=[{'text': direct}]),
        Node(package='robot_state_publisher', executable='robot_state_publisher', parameters=[
            {'robot_description': ParameterValue(Command(['xacro ', file]), value_type=str)}]),
    ])
";
    let robot = "<robot xmlns:xacro='http://ros.org/wiki/xacro' name='r'>
  <xacro:include filename='$(find no_such_arm)/urdf/arm.xacro'/>
  <xacro:arm length='${arm_length}'/>
</robot>";
    let files = [("bot/launch/a.launch.py", text), ("bot/launch/a.xacro", robot)];
    let folder = workspace("absent_package", &files);
    let file = folder.join("bot/launch/a.launch.py");
    let output = launch(&file, &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        plan.contains("\"text\": \"\"") && plan.contains("\"robot_description\": \"\""),
        "{plan}"
    );
    for wanted in [
        "warning[launch-missing-package]",
        "a.launch.py:11",
        "a.launch.py:14",
        "a.xacro:2:30",
        "there is no package `no_such_arm`",
        "--resource-path FOLDER",
    ] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("launch").arg(&file).args(["--duration", "1", "--ros2", "off"]);
    let ran = command.env("NO_COLOR", "1").output().unwrap();
    let said = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert_eq!(ran.status.code(), Some(1), "{said}");
    assert!(said.contains("error[launch-missing-package]"), "{said}");
    assert!(said.contains("2 of its inputs are not on this machine"), "{said}");
    assert!(!said.contains("robot_state_publisher: "), "{said}");
    // A description that is wrong itself still ends the plan.
    let wrong = robot.replace("<xacro:arm", "<link name='${1 +}'/><xacro:arm");
    std::fs::write(folder.join("bot/launch/a.xacro"), wrong).unwrap();
    let output = launch(&file, &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("a.xacro:3:"), "{said}");
}

/// Without the file, a typing error in `${...}` or an undefined macro is an error.
#[test]
fn descriptions_with_undefined_names_are_errors() {
    if !has_python() {
        return;
    }
    let text = "
import os
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node


def generate_launch_description():
    file = os.path.join(os.path.dirname(__file__), 'a.xacro')
    return LaunchDescription([
        Node(package='p', executable='e', parameters=[{'text': Command(['xacro ', file])}]),
    ])
";
    let robot = "<robot xmlns:xacro='http://ros.org/wiki/xacro' name='${no_such}'/>";
    let files = [("bot/launch/a.launch.py", text), ("bot/launch/a.xacro", robot)];
    let folder = workspace("undefined_names", &files);
    let output = launch(&folder.join("bot/launch/a.launch.py"), &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("`no_such` is not defined") && said.contains("a.xacro:1:"), "{said}");
}

/// Files that Python code reads from a missing package are empty, and an error that this causes names the
/// file.
#[test]
fn python_reads_files_of_absent_packages_as_empty() {
    if !has_python() {
        return;
    }
    let text = |read: &str| {
        format!(
            "
import os, yaml
from ament_index_python.packages import get_package_share_directory, get_search_paths
from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    share = get_package_share_directory('absent_bot')
    with open(os.path.join(share, 'urdf', 'bot.urdf')) as file:
        urdf = file.read()
    with open(os.path.join(share, 'config', 'a.yaml')) as file:
        values = yaml.safe_load(file)
    {read}
    moveit = MoveItConfigsBuilder('absent').robot_description().to_moveit_configs()
    return LaunchDescription([
        Node(package='p', executable='e', parameters=[values, {{'text': urdf}}, moveit.to_dict()]),
    ])
"
        )
    };
    let (code, plan, said) = check("absent_files", &text("pass"), &[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(plan.contains("\"text\": \"\""), "{plan}");
    for wanted in [
        "package://absent_bot/urdf/bot.urdf cannot be read: the package `absent_bot`",
        "a.launch.py:11",
        "package://absent_bot/config/a.yaml",
        "package://absent_moveit_config/config/absent.srdf",
    ] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    let (code, _, said) = check("absent_files_needed", &text("values['speed']"), &[]);
    assert_eq!(code, Some(1), "{said}");
    for wanted in ["a.launch.py:15", "needs package://absent_bot/config/a.yaml", "--resource-path"]
    {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

/// MoveIt's builder finds files where a build would install them from, as `open` does.
#[test]
fn parameter_builders_read_files_that_a_build_would_install() {
    if !has_python() {
        return;
    }
    let text = "
from launch import LaunchDescription
from launch_param_builder import ParameterBuilder
from launch_ros.actions import Node


def generate_launch_description():
    limits = ParameterBuilder('arm').yaml('config/limits.yaml').to_dict()
    return LaunchDescription([Node(package='p', executable='e', parameters=[limits])])
";
    let manifest = "<package format='3'><name>arm</name><version>0.0.1</version></package>";
    let folder = workspace(
        "builder_sources",
        &[
            ("src/arm/package.xml", manifest),
            (
                "src/arm/CMakeLists.txt",
                "project(arm)\ninstall(DIRECTORY cfg/ DESTINATION share/arm/config)\n",
            ),
            ("src/arm/cfg/limits.yaml", "speed_m_s: 0.25\n"),
            ("src/arm/launch/a.launch.py", text),
        ],
    );
    let output = launch(&folder.join("src/arm/launch/a.launch.py"), &[]);
    let (plan, said) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(plan.contains("speed_m_s") && plan.contains("0.25"), "{plan}");
}

/// A missing module is an error where it is used, not where it is imported.
#[test]
fn absent_modules_are_missed_where_they_are_used() {
    if !has_python() {
        return;
    }
    let text = |expression: &str| {
        format!(
            "
import no_such_module
import no_such_module.parts as parts
from no_such_package.inner import Thing
from launch import LaunchDescription
from launch_ros.actions import Node
try:
    import no_such_option
    name = 'wrong'
except ImportError:
    name = 'without_option'


def helper():
    return no_such_module.call(Thing())


def generate_launch_description():
    value = {expression}
    return LaunchDescription([
        Node(package='p', executable='e', name=name, arguments=[value]),
    ])
"
        )
    };
    let (code, plan, said) = check("unused_modules", &text("'v'"), &[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(plan.contains("without_option"), "{plan}");
    for used in
        ["Thing()", "str(parts.VALUE)", "parts.NUMBER + 1", "f'{Thing}'", "parts.deep.inner"]
    {
        let (code, plan, said) = check("used_modules", &text(used), &[]);
        assert_eq!(code, Some(1), "{used}: {plan}");
        for wanted in ["a.launch.py:19", "is not on this machine", "--resource-path"] {
            assert!(said.contains(wanted), "{used}: {wanted}: {said}");
        }
    }
}

/// `PythonExpression` supports all of Python.
#[test]
fn expressions_are_those_of_python() {
    if !has_python() {
        return;
    }
    let xml = "<launch><let name='a' value=\"$(eval &quot;len(list(set('x_y'.split('_')).\
               intersection(['y', 'z'])))&quot;)\"/>\
               <node pkg='p' exec='e' name='n$(var a)'/></launch>";
    let folder = workspace("expressions", &[("launch/a.launch.xml", xml)]);
    let output = launch(&folder.join("launch/a.launch.xml"), &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("\"n1\""), "{said}");
}
