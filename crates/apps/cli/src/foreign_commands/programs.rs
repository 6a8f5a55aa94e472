//! `ros2 run PACKAGE PROGRAM`, `rosrun PACKAGE PROGRAM`, and programs by their names alone.

use periplus_graph::ROS_ARGS;

use super::answers::elsewhere;
use super::{Reading, become_words};

/// Syntax of names and parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    /// `_name:=value`, `__name:=node`, `from:=to`.
    Ros1,
    /// ROS 2 syntax, after `--ros-args`.
    Ros2,
}

/// Program with an equivalent command.
struct Program {
    packages: &'static [&'static str],
    names: &'static [&'static str],
    /// Equivalent command.
    words: &'static [&'static str],
    /// True if the command runs a node that takes `--ros-args`.
    is_node: bool,
    note: &'static str,
}

const fn node(
    packages: &'static [&'static str],
    names: &'static [&'static str],
    words: &'static [&'static str],
    note: &'static str,
) -> Program {
    Program { packages, names, words, is_node: true, note }
}

const fn tool(
    packages: &'static [&'static str],
    names: &'static [&'static str],
    words: &'static [&'static str],
    note: &'static str,
) -> Program {
    Program { packages, names, words, is_node: false, note }
}

const PAGE: &str =
    "the page in the browser replaces RViz and rqt: it has their displays and opens `.rviz` files";
const ACTIVE: &str =
    "it configures and activates itself; with `--managed` it waits for a lifecycle manager";

/// Programs with an equivalent command. All others become `periplus run PACKAGE PROGRAM`.
const PROGRAMS: &[Program] = &[
    tool(&["tf2_tools", "tf"], &["view_frames"], &["tf", "tree"], ""),
    tool(
        &["tf2_tools", "tf"],
        &["view_frames.py"],
        &["tf", "tree", "--output", "frames"],
        "since ROS 2 Galactic it is `view_frames` without `.py`, and its file names contain the date",
    ),
    tool(&["tf2_ros", "tf"], &["tf2_echo", "tf_echo", "tf2_echo.py"], &["tf", "echo"], ""),
    tool(&["tf2_ros", "tf"], &["tf2_monitor", "tf_monitor"], &["tf", "monitor"], ""),
    tool(&["tf2_ros", "tf"], &["static_transform_publisher"], &["tf", "static"], ""),
    tool(&["rqt_tf_tree"], &["rqt_tf_tree"], &["tf", "tree"], ""),
    node(&["nav2_map_server"], &["map_saver_cli", "map_saver"], &["map", "save"], ""),
    node(&["map_server"], &["map_saver"], &["map", "save", "--distro", "noetic"], ""),
    node(&["nav2_map_server"], &["map_server"], &["map", "serve"], ACTIVE),
    node(&["map_server"], &["map_server"], &["map", "serve", "--distro", "noetic"], ""),
    node(&["nav2_amcl"], &["amcl"], &["localize", "--live"], "it configures and activates itself"),
    node(&["amcl"], &["amcl"], &["localize", "--live"], ""),
    node(
        &["slam_toolbox"],
        &["async_slam_toolbox_node"],
        &["slam", "--live", "--node", "async"],
        "",
    ),
    node(&["slam_toolbox"], &["sync_slam_toolbox_node"], &["slam", "--live", "--node", "sync"], ""),
    node(
        &["slam_toolbox"],
        &["localization_slam_toolbox_node"],
        &["slam", "--live", "--node", "localization"],
        "",
    ),
    node(
        &["slam_toolbox"],
        &["lifelong_slam_toolbox_node"],
        &["slam", "--live", "--node", "lifelong"],
        "",
    ),
    node(
        &["gmapping", "slam_gmapping"],
        &["slam_gmapping"],
        &["slam", "--live", "--node", "gmapping"],
        "",
    ),
    node(
        &["teleop_twist_keyboard"],
        &["teleop_twist_keyboard", "teleop_twist_keyboard.py"],
        &["teleop"],
        "",
    ),
    node(&["ros_gz_bridge", "ros_ign_bridge"], &["parameter_bridge"], &["bridge"], ""),
    node(&["rviz2", "rviz"], &["rviz2", "rviz"], &["view"], PAGE),
    node(
        &[
            "rqt_graph",
            "rqt_gui",
            "rqt_image_view",
            "rqt_plot",
            "rqt_topic",
            "rqt_console",
            "rqt_reconfigure",
            "rqt_bag",
        ],
        &[
            "rqt_graph",
            "rqt_gui",
            "rqt_image_view",
            "rqt_plot",
            "rqt_topic",
            "rqt_console",
            "rqt_reconfigure",
            "rqt_bag",
            "rqt",
        ],
        &["view"],
        PAGE,
    ),
    tool(&["urdf_tutorial", "liburdfdom-tools"], &["check_urdf"], &["check"], ""),
    tool(
        &["liburdfdom-tools"],
        &["urdf_to_graphiz", "urdf_to_graphviz"],
        &["check"],
        "it lists links and joints; `periplus tf tree` draws the frames of a running robot",
    ),
];

/// Splits into package, program and the rest; skips leading options.
pub(super) fn split(words: &[String]) -> Option<(&str, &str, &[String])> {
    let mut words = words;
    loop {
        match words {
            [option, _, rest @ ..] if option == "--prefix" => words = rest,
            [option, rest @ ..] if option.starts_with("--") => words = rest,
            [package, program, rest @ ..] => return Some((package, program, rest)),
            _ => return None,
        }
    }
}

/// Translates a program of a package.
pub(super) fn run(package: &str, program: &str, rest: &[String], dialect: Dialect) -> Reading {
    let words = Words::read(rest, dialect);
    if program == "xacro" || program == "xacro.py" {
        return xacro(rest);
    }
    if matches!(package, "gazebo_ros" | "gazebo") {
        match program {
            "gazebo" | "gzserver" | "gzclient" => return super::gazebo::classic(program, rest),
            "debug" => return super::gazebo::classic("gzserver", rest),
            _ => {}
        }
    }
    if program == "map_server" && words.own.first().is_some_and(|word| word == "-f") {
        return mistaken_saver(package, words);
    }
    if program == "static_transform_publisher" && package == "tf" {
        return with_period(words);
    }
    let known = PROGRAMS
        .iter()
        .find(|known| known.packages.contains(&package) && known.names.contains(&program));
    match known {
        Some(known) if dialect == Dialect::Ros1 => on_ros1(known.reading(words)),
        Some(known) => known.reading(words),
        // A program of ROS 1 reads its own names and parameters.
        None if dialect == Dialect::Ros1 => {
            let told = [package.to_owned(), program.to_owned()];
            become_words(&["run"], told.into_iter().chain(rest.iter().cloned()).collect())
        }
        None => {
            let told = [package.to_owned(), program.to_owned()];
            let rest = told.into_iter().chain(words.own.clone()).chain(words.ros());
            words.remark(become_words(&["run"], rest.collect()))
        }
    }
}

/// A command that uses ROS 1 if a master answers, in place of one that uses ROS 2.
fn on_ros1(reading: Reading) -> Reading {
    let Reading::Words { words, .. } = &reading else { return reading };
    let own: Vec<&str> = words.iter().map(String::as_str).take(2).collect();
    match own.as_slice() {
        ["map", "save" | "serve"] | ["tf", "echo" | "monitor" | "tree"] => reading.on_ros1(2),
        ["localize" | "slam" | "teleop" | "view", ..] => reading.on_ros1(1),
        _ => reading,
    }
}

/// Translates a program by its name alone, as typed when its folder is on the PATH.
pub(super) fn alone(program: &str, rest: &[String]) -> Option<Reading> {
    let dialect = Dialect::Ros2;
    Some(match program {
        "xacro" | "xacro.py" => xacro(rest),
        "map_server" => run("map_server", "map_server", rest, Dialect::Ros1),
        "map_saver" => run("map_server", "map_saver", rest, Dialect::Ros1),
        "view_frames"
        | "view_frames.py"
        | "tf2_echo"
        | "tf_echo"
        | "tf2_monitor"
        | "tf_monitor"
        | "static_transform_publisher"
        | "map_saver_cli"
        | "rviz"
        | "rviz2"
        | "rqt"
        | "rqt_graph"
        | "rqt_image_view"
        | "rqt_plot"
        | "rqt_topic"
        | "rqt_console"
        | "rqt_reconfigure"
        | "rqt_bag"
        | "rqt_tf_tree"
        | "teleop_twist_keyboard"
        | "teleop_twist_keyboard.py"
        | "check_urdf"
        | "urdf_to_graphiz"
        | "urdf_to_graphviz"
        | "parameter_bridge"
        | "slam_gmapping"
        | "amcl"
        | "async_slam_toolbox_node"
        | "sync_slam_toolbox_node" => {
            let known = PROGRAMS.iter().find(|known| known.names.contains(&program))?;
            known.reading(Words::read(rest, dialect))
        }
        _ => return None,
    })
}

/// Translates `map_server -f NAME`, which tutorials print where they mean the map saver.
fn mistaken_saver(package: &str, words: Words) -> Reading {
    let saver = if package == "map_server" { "map_saver" } else { "map_saver_cli" };
    let ours: &[&str] = if package == "map_server" {
        &["map", "save", "--distro", "noetic"]
    } else {
        &["map", "save"]
    };
    let rest = words.own.iter().cloned().chain(words.ros()).collect();
    let reading = words
        .remark(become_words(ours, rest))
        .noting(format!("`map_server` serves maps; to save one, `{saver} -f NAME` runs instead"));
    if package == "map_server" { on_ros1(reading) } else { reading }
}

/// `static_transform_publisher` of ROS 1's `tf` ends with a period: 9 words with angles, 10 with a
/// quaternion.
fn with_period(mut words: Words) -> Reading {
    let is_period = |word: &String| word.parse::<f64>().is_ok();
    if words.own.len() >= 9 && words.own.last().is_some_and(is_period) {
        words.own.pop();
    }
    become_words(&["tf", "static"], words.own)
}

fn xacro(rest: &[String]) -> Reading {
    let mut words = Vec::new();
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "-o" => words.extend(["--output".to_owned()].into_iter().chain(rest.next().cloned())),
            // Obsolete options; they request today's default.
            "--inorder" | "-i" | "--check-order" => {}
            _ => words.push(word.clone()),
        }
    }
    if words.is_empty() {
        return elsewhere("`xacro` takes a file, and `name:=value`");
    }
    words.extend(["--to".to_owned(), "urdf".to_owned()]);
    become_words(&["convert"], words)
}

/// Arguments of RViz and rqt as options of `periplus view`, and the unsupported ones. Options of
/// `periplus view` itself are kept.
fn view_arguments(words: &[String]) -> (Vec<String>, Vec<String>) {
    let (mut kept, mut dropped) = (Vec::new(), Vec::new());
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        let (name, mut value) = match word.split_once('=') {
            Some((name, value)) if name.starts_with("--") => (name, Some(value.to_owned())),
            _ => (word.as_str(), None),
        };
        match name {
            "-d" | "--display-config" => {
                value = value.or_else(|| words.next().cloned());
                kept.push("-d".to_owned());
                kept.extend(value);
            }
            "-f" | "--fixed-frame" => {
                value = value.or_else(|| words.next().cloned());
                kept.push("-f".to_owned());
                kept.extend(value);
            }
            "--page" | "--no-browser" => kept.push(word.clone()),
            "--token" | "--resource-path" => {
                kept.push(word.clone());
                if value.is_none() {
                    kept.extend(words.next().cloned());
                }
            }
            // A file may be given without an option; a word after another option is its value.
            _ if !name.starts_with('-') && name.ends_with(".rviz") => {
                kept.extend(["-d".to_owned(), word.clone()]);
            }
            _ => {
                dropped.push(word.clone());
                if name.starts_with('-') && value.is_none() {
                    dropped.extend(words.next_if(|next| !next.starts_with('-')).cloned());
                }
            }
        }
    }
    (kept, dropped)
}

impl Program {
    fn reading(&self, words: Words) -> Reading {
        let mut own = words.own.clone();
        let mut ours: Vec<&str> = self.words.to_vec();
        let mut unheard = Vec::new();
        if self.words == ["view"] {
            (own, unheard) = view_arguments(&words.own);
        }
        if self.words == ["tf", "tree", "--output", "frames"]
            && own.iter().any(|word| word == "-o" || word.starts_with("--output"))
        {
            ours.truncate(2);
        }
        if self.is_node {
            own.extend(words.ros());
        } else {
            for (flag, value) in &words.ros {
                match (flag.as_str(), value.split_once(":=")) {
                    ("-r", Some((from, to))) if self.words.starts_with(&["tf", "tree"]) => {
                        let flag = match from.trim_start_matches('/') {
                            "tf" => "--tf-topic",
                            "tf_static" => "--tf-static-topic",
                            _ => continue,
                        };
                        own.extend([flag.to_owned(), to.to_owned()]);
                    }
                    _ => unheard.push(format!("{flag} {value}")),
                }
            }
        }
        let mut reading = words.remark(become_words(&ours, own));
        reading = super::ros2::without(reading, &unheard);
        if !self.note.is_empty() {
            reading = reading.noting(self.note);
        }
        reading
    }
}

/// Arguments of a program: its own, and those that set names and parameters.
#[derive(Clone, Debug, Default)]
struct Words {
    own: Vec<String>,
    /// Flag and value, as after `--ros-args`.
    ros: Vec<(String, String)>,
    /// True if some use ROS 1 syntax, which ROS 2 would ignore.
    is_old: bool,
}

impl Words {
    fn read(words: &[String], dialect: Dialect) -> Self {
        let mut read = Self::default();
        let mut is_ros = false;
        let mut words = words.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                ROS_ARGS => is_ros = true,
                "--" if is_ros => is_ros = false,
                _ if is_ros => {
                    let takes = !word.starts_with("--enable") && !word.starts_with("--disable");
                    let value = if takes {
                        words.next().cloned().unwrap_or_default()
                    } else {
                        String::new()
                    };
                    read.ros.push((word.clone(), value));
                }
                _ => match old_style(word) {
                    Some(pair) => {
                        read.is_old = dialect == Dialect::Ros2;
                        read.ros.push(pair);
                    }
                    None => read.own.push(word.clone()),
                },
            }
        }
        read
    }

    /// The arguments for `--ros-args`.
    fn ros(&self) -> Vec<String> {
        if self.ros.is_empty() {
            return Vec::new();
        }
        let pairs = self.ros.iter().flat_map(|(flag, value)| [flag.clone(), value.clone()]);
        let all = [ROS_ARGS.to_owned()].into_iter().chain(pairs);
        all.filter(|word| !word.is_empty()).collect()
    }

    fn remark(&self, reading: Reading) -> Reading {
        if self.is_old {
            return reading.noting(
                "`from:=to` is the syntax of ROS 1, which ROS 2 programs ignore; `--ros-args -r from:=to` is \
                 used instead",
            );
        }
        reading
    }
}

/// ROS 2 form of `__name:=n`, `_parameter:=value` and `from:=to`.
fn old_style(word: &str) -> Option<(String, String)> {
    let (from, to) = word.split_once(":=")?;
    let is_name = |letter: char| letter.is_alphanumeric() || "_/~".contains(letter);
    if from.is_empty() || !from.chars().all(is_name) {
        return None;
    }
    let pair = match from {
        "__name" => ("-r", format!("__node:={to}")),
        "__ns" => ("-r", word.to_owned()),
        // There is no log file and no master.
        "__log" | "__master" | "__ip" | "__hostname" => return None,
        _ => match from.strip_prefix('_') {
            Some(parameter) => ("-p", format!("{parameter}:={to}")),
            None => ("-r", word.to_owned()),
        },
    };
    Some((pair.0.to_owned(), pair.1))
}
