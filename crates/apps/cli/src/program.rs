//! `periplus run`.

use std::process::ExitCode;

use clap::{Args, Parser as _};
use periplus_diagnostics::plain_words;
use periplus_os::Machine;
use periplus_resources::Store as _;

use crate::error::CliError;
use crate::launch;
use crate::options::{Command, Options};

/// Run one program of a package, as `ros2 run` does: a built-in node, or an installed program
///
/// It launches one node, so the same programs are built in as for `periplus launch`.
#[derive(Debug, Args)]
pub(crate) struct RunOptions {
    /// Package, such as nav2_costmap_2d
    package: String,
    /// Program, such as nav2_costmap_2d_markers
    program: String,
    /// Arguments of the program; names and parameters follow `--ros-args`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "WORD")]
    words: Vec<String>,
}

pub(crate) fn run(options: &RunOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let folder = std::env::temp_dir().join(format!("periplus_run_{}", std::process::id()));
    let file = folder.join("run.launch.xml");
    let written = std::fs::create_dir_all(&folder).map_err(|error| plain_words(&error));
    let written = written.and_then(|()| {
        Machine.replace(&file, text(options, &ros).as_bytes()).map_err(String::from)
    });
    if let Err(why) = written {
        return Err(CliError::failed(format!("cannot write {}: {why}", file.display())));
    }
    let words = ["periplus".into(), "launch".into(), file.into_os_string()];
    let outcome = match Options::try_parse_from(words).map(|options| options.command) {
        Ok(Some(Command::Launch(options))) => launch::run(&options, ros),
        _ => Ok(ExitCode::FAILURE),
    };
    let _ = std::fs::remove_dir_all(folder);
    outcome
}

/// Launch file with this single node. `--ros-args` belong to the node: some nodes, such as a
/// lifecycle manager, are configured by their parameters.
fn text(options: &RunOptions, ros: &[String]) -> String {
    let line =
        |words: &[String]| words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
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
        attribute(&options.package),
        attribute(&options.program),
        attribute(&line(&options.words)),
    )
}

/// Quotes a word for the shell.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./:=@,+~".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[test]
fn a_node_is_written_as_a_launch_file() {
    let options = RunOptions {
        package: "nav2_costmap_2d".into(),
        program: "nav2_costmap_2d_markers".into(),
        words: vec!["a \"b\"".into()],
    };
    let without = text(&options, &[]);
    assert!(without.contains("args=\"'a &quot;b&quot;'\"/>"), "{without}");
    let with = text(&options, &["-p".into(), "node_names:=[\"a\", b]".into()]);
    assert!(with.contains("ros_args=\"-p 'node_names:=[&quot;a&quot;, b]'\""), "{with}");
}
