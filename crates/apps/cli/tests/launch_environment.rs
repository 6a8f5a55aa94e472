//! Environment, working directory and processes of a launch file apply to the world that it starts: files
//! that are found through them, and the errors without them.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use common::Folder;

/// A package with a world that includes a model, and the model in another folder.
struct Machine {
    folder: Folder,
}

const WORLD: &str = "<sdf version='1.9'><world name='w'><include><uri>model://crate</uri></include>\
                     </world></sdf>";
const MODEL: &str = "<sdf version='1.9'><model name='crate'><static>true</static><link name='link'>\
                     <collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>\
                     </link></model></sdf>";

impl Machine {
    fn new(name: &str) -> Self {
        let machine = Self { folder: Folder::new(name) };
        machine.write("far/things/crate/model.config", CONFIG);
        machine.write("far/things/crate/model.sdf", MODEL);
        machine.write("ws/pkg/package.xml", "<package><name>pkg</name></package>");
        machine.write("ws/pkg/worlds/w.sdf", WORLD);
        machine
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let top = self.folder.0.canonicalize().unwrap();
        fs::write(&path, text.replace("TOP", &top.display().to_string())).unwrap();
        path
    }

    /// Exit status of the launch, and its stderr.
    fn launch(&self, name: &str, text: &str) -> (bool, String) {
        let file = self.write(&format!("ws/pkg/launch/{name}"), text);
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.arg("launch").arg(file).args(["--duration", "0.01", "--headless"]);
        command.current_dir(&self.folder.0).env("NO_COLOR", "1").env_remove("SDF_PATH");
        for variable in ["GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "AMENT_PREFIX_PATH"] {
            command.env_remove(variable);
        }
        let output = command.output().unwrap();
        (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
    }

    fn finds(&self, name: &str, text: &str) {
        let (is_success, told) = self.launch(name, text);
        assert!(is_success, "{name}: {told}");
    }

    fn misses(&self, name: &str, text: &str, hint: &str) {
        let (is_success, told) = self.launch(name, text);
        assert!(!is_success && told.contains(hint), "{name}: `{hint}` is not in {told}");
    }
}

const CONFIG: &str = "<model><name>crate</name><sdf version='1.9'>model.sdf</sdf></model>";

fn has_python() -> bool {
    let has = Command::new("python3").arg("--version").output().is_ok();
    if !has {
        eprintln!("SKIPPED: launch files in Python need a python3");
    }
    has
}

/// A launch file in Python with these actions.
fn python(actions: &str) -> String {
    format!(
        "import os\n\
         from launch import LaunchDescription\n\
         from launch.actions import *\n\
         from launch.event_handlers import *\n\n\n\
         def generate_launch_description():\n    {}\n",
        actions.trim().replace('\n', "\n    ")
    )
}

const GAZEBO: &str = "ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'TOP/ws/pkg/worlds/w.sdf'])";

#[test]
fn variables_that_a_file_in_python_sets() {
    if !has_python() {
        return;
    }
    let machine = Machine::new("environment_python");
    let with = |before: &str| {
        python(&format!("return LaunchDescription([\n    {before}\n    {GAZEBO},\n])"))
    };
    machine.misses("none.launch.py", &with(""), "no line of the launch files sets a search path");
    machine.misses("none.launch.py", &with(""), "none.launch.py:10");
    let set = "SetEnvironmentVariable('GZ_SIM_RESOURCE_PATH', 'TOP/far/things'),";
    machine.finds("set.launch.py", &with(set));
    let append = "AppendEnvironmentVariable('SDF_PATH', 'TOP/far/things'),";
    machine.finds("append.launch.py", &with(append));
    let other = "SetEnvironmentVariable('GZ_SIM_RESOURCE_PATH', 'TOP/far'),";
    machine.misses("other.launch.py", &with(other), "set at");
    machine.misses("other.launch.py", &with(other), "other.launch.py:9");
    // A group has its own environment.
    let scoped = format!("GroupAction([{set} LogInfo(msg='in')], scoped=True),");
    machine.misses("scoped.launch.py", &with(&scoped), "has no effect where the world is started");
    let late = python(&format!(
        "return LaunchDescription([\n    {GAZEBO},\n    {set}\n    LogInfo(msg='late'),\n])"
    ));
    machine.misses("late.launch.py", &late, "set it before");
    let of_process = GAZEBO
        .replace("w.sdf'])", "w.sdf'], additional_env={'GZ_SIM_RESOURCE_PATH': 'TOP/far/things'})");
    machine.finds("own.launch.py", &python(&format!("return LaunchDescription([{of_process}])")));
    let of_python = format!(
        "os.environ['GZ_SIM_RESOURCE_PATH'] = 'TOP/far/things'\nreturn LaunchDescription([{GAZEBO}])"
    );
    machine.finds("environ.launch.py", &python(&of_python));
}

#[test]
fn variables_that_files_in_xml_set() {
    let machine = Machine::new("environment_xml");
    let ros2 = |before: &str| {
        format!("<launch>{before}<executable cmd='gz sim -r -s TOP/ws/pkg/worlds/w.sdf'/></launch>")
    };
    machine.misses("none.launch.xml", &ros2(""), "no line of the launch files sets");
    let set = "<set_env name='GZ_SIM_RESOURCE_PATH' value='TOP/far/things'/>";
    machine.finds("set.launch.xml", &ros2(set));
    let ros1 = |before: &str| {
        format!(
            "<launch>{before}<include file='$(find gazebo_ros)/launch/empty_world.launch'>\
             <arg name='world_name' value='TOP/ws/pkg/worlds/w.sdf'/></include></launch>"
        )
    };
    machine.misses("none.launch", &ros1(""), "<env name=\"GAZEBO_MODEL_PATH\"");
    machine.finds("set.launch", &ros1("<env name='GAZEBO_MODEL_PATH' value='TOP/far/things'/>"));
}

#[test]
fn folders_that_packages_export() {
    let machine = Machine::new("environment_exports");
    let launch = "<launch><executable cmd='gz sim -r -s TOP/ws/pkg/worlds/w.sdf'/></launch>";
    machine.misses("a.launch.xml", launch, "`model://crate` is not found");
    machine.write("ws/models_pkg/package.xml", "<package><name>models_pkg</name></package>");
    machine.write("ws/models_pkg/assets/deep/crate/model.config", CONFIG);
    machine.write("ws/models_pkg/assets/deep/crate/model.sdf", MODEL);
    machine.misses("a.launch.xml", launch, "`model://crate` is not found");
    machine.write(
        "ws/models_pkg/hooks/models_pkg.dsv.in",
        "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share/@PROJECT_NAME@/assets/deep",
    );
    machine.finds("a.launch.xml", launch);
}

#[test]
fn the_working_directory_of_a_process() {
    if !has_python() {
        return;
    }
    let machine = Machine::new("environment_cwd");
    machine.write("ws/pkg/worlds/plain.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
    let gazebo = |cwd: &str| {
        python(&format!(
            "return LaunchDescription([ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'plain.sdf']\
             {cwd})])"
        ))
    };
    machine.misses("none.launch.py", &gazebo(""), "world plain.sdf does not exist");
    machine.finds("cwd.launch.py", &gazebo(", cwd='TOP/ws/pkg/worlds'"));
    // The world waits for the process: a run as short as this one would interrupt it.
    let process = |cwd: &str| {
        python(&format!(
            "first = ExecuteProcess(cmd=['sh', '-c', 'pwd > there'], cwd='{cwd}')\n\
             gazebo = ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'TOP/ws/pkg/worlds/plain.sdf'])\n\
             then = RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[gazebo]))\n\
             return LaunchDescription([first, then])"
        ))
    };
    machine.finds("process.launch.py", &process("TOP/far"));
    let there = fs::read_to_string(machine.folder.path("far/there")).unwrap();
    assert!(there.trim_end().ends_with("/far"), "{there}");
    machine.misses("gone.launch.py", &process("TOP/nowhere"), "`cwd`");
}

/// A world written by other processes, which end before it is loaded.
#[test]
fn processes_that_make_the_world() {
    if !has_python() {
        return;
    }
    let machine = Machine::new("environment_made");
    machine.write(
        "ws/pkg/worlds/w.sdf.xacro",
        "<sdf version='1.9' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:arg name='name' \
         default='none'/><world name='$(arg name)'/></sdf>",
    );
    let xacro = "make = ExecuteProcess(cmd=['xacro', '-o', 'TOP/made.sdf', 'name:=ours', \
                 'TOP/ws/pkg/worlds/w.sdf.xacro'])";
    let gazebo = |file: &str| format!("ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', '{file}'])");
    let side_by_side =
        format!("{xacro}\nreturn LaunchDescription([make, {}])", gazebo("TOP/made.sdf"));
    machine.finds("beside.launch.py", &python(&side_by_side));
    let made = fs::read_to_string(machine.folder.path("made.sdf")).unwrap();
    assert!(made.contains("\"ours\""), "{made}");
    // In a chain, through commands that take their time.
    let chain = format!(
        "{xacro}\n\
         copy = ExecuteProcess(cmd=['sleep 0.3 && cp TOP/made.sdf TOP/half.sdf'], shell=True)\n\
         change = ExecuteProcess(cmd=['sed', '-i', 's/ours/theirs/', 'TOP/half.sdf'])\n\
         gazebo = {}\n\
         return LaunchDescription([\n\
         \x20   make,\n\
         \x20   RegisterEventHandler(OnProcessExit(target_action=make, on_exit=[copy])),\n\
         \x20   RegisterEventHandler(OnProcessExit(target_action=copy, on_exit=[change])),\n\
         \x20   RegisterEventHandler(OnProcessExit(target_action=change, on_exit=[gazebo])),\n\
         ])",
        gazebo("TOP/half.sdf")
    );
    machine.finds("chain.launch.py", &python(&chain));
    let half = fs::read_to_string(machine.folder.path("half.sdf")).unwrap();
    assert!(half.contains("\"theirs\""), "{half}");
    // A maker that fails is the error, not the world that is not there.
    let failing = side_by_side.replace("w.sdf.xacro", "gone.xacro").replace("made", "never");
    machine.misses("failing.launch.py", &python(&failing), "`xacro ...` failed");
}
