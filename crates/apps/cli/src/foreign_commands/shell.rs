//! Installing, building, and shell commands.

use super::Reading;
use super::answers::{elsewhere, needless, with_packages};

const NOT_BUILT: &str = "nothing needs building: packages are found by their package.xml below the working \
                         folder and on --resource-path; packages found";

/// Environment variables that Periplus reads.
const VARIABLES: [&str; 14] = [
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "ROS_PACKAGE_PATH",
    "AMENT_PREFIX_PATH",
    "ROS_DOMAIN_ID",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_STATIC_PEERS",
    "ROS_LOCALHOST_ONLY",
    "CYCLONEDDS_URI",
    "RMW_IMPLEMENTATION",
    "NO_COLOR",
    "CLICOLOR_FORCE",
];

pub(super) fn read(program: &str, rest: &[String]) -> Option<Reading> {
    let verb = rest.iter().find(|word| !word.starts_with('-')).map_or("", String::as_str);
    Some(match program {
        "colcon"
        | "catkin_make"
        | "catkin_make_isolated"
        | "catkin"
        | "ament"
        | "cmake"
        | "make"
        | "rosmake" => with_packages(NOT_BUILT),
        "rosdep" | "vcs" | "rosinstall" | "wstool" => needless(format!(
            "nothing needs installing: the dependencies that `{program}` installs are built in"
        )),
        "apt" | "apt-get" | "snap" | "brew" | "dnf" | "pacman" | "aptitude" | "dpkg"
        | "apt-key" | "add-apt-repository" => installed(verb, rest),
        "sudo" => match rest.split_first() {
            Some((program, rest)) => read(program, rest)?,
            None => return None,
        },
        "pip" | "pip3" | "conda" | "mamba" | "pixi" => installed(verb, rest),
        "source" | "." => needless(
            "nothing needs to be sourced: Periplus has no setup file; type the next command",
        ),
        "export" | "set" | "setenv" => exported(rest),
        "unset" | "alias" | "echo" | "cd" | "mkdir" | "git" | "code" | "nano" | "gedit" | "vim"
        | "vi" | "emacs" | "touch" | "cp" | "mv" | "rm" | "ls" | "cat" | "chmod" | "wget"
        | "curl" | "unzip" | "tar" | "pwd" | "less" | "head" | "tail" | "evince" | "xdg-open"
        | "eog" | "killall" | "kill" | "ps" | "which" | "python" | "python3" | "bash" | "sh" => {
            let line = [&[program.to_owned()], rest].concat().join(" ");
            elsewhere(format!("`{program}` is a shell command: type `{line}` without `periplus`"))
        }
        _ => return None,
    })
}

fn installed(verb: &str, rest: &[String]) -> Reading {
    if !matches!(verb, "install" | "update" | "upgrade" | "reinstall" | "full-upgrade" | "" | "-i")
    {
        return elsewhere("this is a command of the package manager: type it without `periplus`");
    }
    let wanted: Vec<&str> = rest
        .iter()
        .skip_while(|word| *word != "install")
        .skip(1)
        .filter(|word| !word.starts_with('-'))
        .map(String::as_str)
        .collect();
    let built_in = |name: &&str| {
        ["ros-", "gz-", "ignition-", "gazebo", "libgazebo", "ros_", "python3-colcon", "colcon"]
            .iter()
            .any(|start| name.starts_with(start))
    };
    let others: Vec<&str> = wanted.iter().copied().filter(|name| !built_in(name)).collect();
    let mut text = String::from(
        "nothing needs installing: simulator, SLAM, localization, costmaps, bridge and viewer are built \
         in",
    );
    if !others.is_empty() {
        text += &format!("; to install {}, type the command without `periplus`", others.join(", "));
    }
    needless(text)
}

fn exported(rest: &[String]) -> Reading {
    let assignment = rest.join(" ");
    let name = assignment.split('=').next().unwrap_or_default().trim();
    let line = format!("type `export {assignment}` without `periplus`");
    if VARIABLES.contains(&name) {
        return elsewhere(format!("variables are set in the shell: {line}; Periplus reads {name}"));
    }
    if name == "TURTLEBOT3_MODEL" {
        return elsewhere(format!(
            "variables are set in the shell: {line}; launch files read {name}"
        ));
    }
    elsewhere(format!("variables are set in the shell: {line}; Periplus does not read {name}"))
}
