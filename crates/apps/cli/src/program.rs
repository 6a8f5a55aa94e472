//! `periplus run`.

use std::path::{Path, PathBuf};
use std::process::{Command as Process, ExitCode};

use clap::{Args, Parser as _};
use periplus_diagnostics::plain_words;
use periplus_launch::bringup::{Environment, PythonNode, is_built_in, is_python_file};
use periplus_os::{Machine, shell_word};
use periplus_resources::{EntryKind, Host as _, Store as _};

use crate::error::CliError;
use crate::options::{Command, Options, SearchOptions};
use crate::{launch, own_command, paths, terminal};

/// Run one program: a node in Python, a built-in node, or an installed program
///
/// Takes a Python file, or a package and its program as `ros2 run` and `rosrun` do. Nodes in Python need no ROS
/// installation and no build: the package is found by its package.xml in and around the current folder, and
/// `rclpy`, `rospy`, tf2 and all messages come with the Python package of Periplus. The terminal, signals and
/// the exit code are those of the program.
#[derive(Debug, Args)]
pub(crate) struct RunOptions {
    /// Use the installed ROS for a node in Python
    #[arg(long)]
    real_ros: bool,
    #[command(flatten)]
    search: SearchOptions,
    /// Python file, or package and program; then its arguments, with names and parameters behind `--ros-args`
    #[arg(
        required = true,
        trailing_var_arg = true,
        allow_hyphen_values = true,
        value_name = "FILE.py|PACKAGE PROGRAM"
    )]
    words: Vec<String>,
}

/// Program on the command line.
#[derive(Debug, PartialEq)]
enum Wanted<'a> {
    File { file: &'a str, words: &'a [String] },
    Program { package: &'a str, program: &'a str, words: &'a [String] },
}

impl RunOptions {
    fn wanted(&self) -> Result<Wanted<'_>, CliError> {
        let is_file = |word: &str| {
            word.ends_with(".py") || (word.contains('/') && is_python_file(Path::new(word)))
        };
        match self.words.as_slice() {
            [file, words @ ..] if is_file(file) => Ok(Wanted::File { file, words }),
            [package, program, words @ ..] => Ok(Wanted::Program { package, program, words }),
            words => Err(CliError::usage(format!(
                "`{}` is not a Python file: give a file that ends with `.py`, or a package and one of its \
                 programs, as in `periplus run nav2_costmap_2d nav2_costmap_2d_markers`",
                words.join(" ")
            ))),
        }
    }
}

pub(crate) fn run(options: &RunOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let search = terminal::search(&options.search.resource_path);
    let (package, program, words) = match options.wanted()? {
        Wanted::File { file, words } => {
            let path = PathBuf::from(file);
            if Machine.kind(&path) != Some(EntryKind::File) {
                let near = paths::advice(&path);
                return Err(CliError::failed(format!("file {file} does not exist{near}")));
            }
            return options.run_python(&PythonNode::of_file(path), words, &ros);
        }
        Wanted::Program { package, program, words } => (package, program, words),
    };
    if !is_built_in(package, program) {
        let from = search.working_folder.join("launch");
        let environment = Environment::new();
        let node = PythonNode::of_package(package, program, &search, &from, &environment);
        if let Some(node) = node {
            return options.run_python(&node, words, &ros);
        }
    }
    launched(options, &text(package, program, words, &ros), ros)
}

impl RunOptions {
    /// Runs a node in Python in place of this process.
    fn run_python(
        &self,
        node: &PythonNode,
        words: &[String],
        ros: &[String],
    ) -> Result<ExitCode, CliError> {
        let interpreter = own_command::interpreter();
        let command = node.command(interpreter.command().map_err(CliError::failed)?);
        let search = terminal::search(&self.search.resource_path);
        let mut process = Process::new(&command[0]);
        process.args(&command[1..]).args(words);
        if !ros.is_empty() {
            process.arg("--ros-args").args(ros);
        }
        process.envs(node.environment(&search, self.real_ros));
        replace(process).map_err(|error| {
            CliError::failed(format!("cannot start `{}`: {}", command[0], plain_words(&error)))
        })
    }
}

/// Replaces this process by another one, which gets its terminal and signals.
#[cfg(unix)]
fn replace(mut process: Process) -> std::io::Result<ExitCode> {
    Err(std::os::unix::process::CommandExt::exec(&mut process))
}

/// Runs a process to its end. Ctrl-C reaches both.
#[cfg(not(unix))]
fn replace(mut process: Process) -> std::io::Result<ExitCode> {
    let _ = periplus_session::stop::on_signal();
    let code = process.status()?.code().unwrap_or(1);
    Ok(u8::try_from(code).map_or(ExitCode::FAILURE, ExitCode::from))
}

/// Launches a single node, so that the same programs are built in as for `periplus launch`.
fn launched(options: &RunOptions, text: &str, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let folder = std::env::temp_dir().join(format!("periplus_run_{}", std::process::id()));
    let file = folder.join("run.launch.xml");
    let written = std::fs::create_dir_all(&folder).map_err(|error| plain_words(&error));
    let written =
        written.and_then(|()| Machine.replace(&file, text.as_bytes()).map_err(String::from));
    if let Err(why) = written {
        return Err(CliError::failed(format!("cannot write {}: {why}", file.display())));
    }
    let mut words = vec!["periplus".into(), "launch".into(), file.into_os_string()];
    for folder in &options.search.resource_path {
        words.extend(["--resource-path".into(), folder.clone().into_os_string()]);
    }
    let outcome = match Options::try_parse_from(words).map(|options| options.command) {
        Ok(Some(Command::Launch(options))) => launch::run(&options, ros, "periplus run".to_owned()),
        _ => Ok(ExitCode::FAILURE),
    };
    let _ = std::fs::remove_dir_all(folder);
    outcome
}

/// Launch file with this single node. `--ros-args` belong to the node: some nodes, such as a
/// lifecycle manager, are configured by their parameters.
fn text(package: &str, program: &str, words: &[String], ros: &[String]) -> String {
    let line =
        |words: &[String]| words.iter().map(|word| shell_word(word)).collect::<Vec<_>>().join(" ");
    let attribute = |text: &str| {
        let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        // Prevents substitutions.
        text.replace("$(", "\\$(")
    };
    let ros = match ros {
        [] => String::new(),
        words => format!(" ros_args=\"{}\"", attribute(&line(words))),
    };
    format!(
        "<launch>\n  <node pkg=\"{}\" exec=\"{}\" output=\"screen\" args=\"{}\"{ros}/>\n\
         </launch>\n",
        attribute(package),
        attribute(program),
        attribute(&line(words)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_is_written_as_a_launch_file() {
        let (package, program) = ("nav2_costmap_2d", "nav2_costmap_2d_markers");
        let without = text(package, program, &["a \"b\"".into()], &[]);
        assert!(without.contains("args=\"'a &quot;b&quot;'\"/>"), "{without}");
        let ros = ["-p".into(), "node_names:=[\"a\", b]".into()];
        let with = text(package, program, &[], &ros);
        assert!(with.contains("ros_args=\"-p 'node_names:=[&quot;a&quot;, b]'\""), "{with}");
    }

    #[test]
    fn arguments_that_look_like_options_are_those_of_the_program() {
        let read = |line: &str| {
            let words = line.split_whitespace().map(String::from);
            match Options::try_parse_from(words).unwrap().command {
                Some(Command::Run(options)) => options,
                other => panic!("{other:?}"),
            }
        };
        let options = read("periplus run --real-ros a.py --real-ros -h --color never");
        assert!(options.real_ros);
        let words: Vec<String> = ["--real-ros", "-h", "--color", "never"].map(String::from).into();
        assert_eq!(options.wanted().unwrap(), Wanted::File { file: "a.py", words: &words });
        let options = read("periplus run pkg node -x");
        let words = ["-x".to_owned()];
        let wanted = Wanted::Program { package: "pkg", program: "node", words: &words };
        assert_eq!(options.wanted().unwrap(), wanted);
        assert!(read("periplus run pkg").wanted().is_err());
    }
}
