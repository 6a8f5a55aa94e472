//! Parser for `--ros-args`.

use std::fmt;
use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap, Span, closest};

use super::scalar::parameter_from_yaml;
use super::{Arguments, Pattern, file};
use crate::log::Level;
use crate::remap::Rule;

/// Flag that starts the arguments for nodes, which end at `--` or the end of the line.
pub const ROS_ARGS: &str = "--ros-args";

/// Every flag of ROS 2.
const FLAGS: [&str; 17] = [
    "-r",
    "--remap",
    "-p",
    "--param",
    "--params-file",
    "-e",
    "--enclave",
    "--log-level",
    "--log-config-file",
    "--log-file-name",
    "--enable-rosout-logs",
    "--disable-rosout-logs",
    "--enable-stdout-logs",
    "--disable-stdout-logs",
    "--enable-external-lib-logs",
    "--disable-external-lib-logs",
    ROS_ARGS,
];

/// Splits a command line into the arguments of the program and those for nodes, between
/// `--ros-args` and `--` or the end. Several such sections are allowed.
///
/// ```
/// use periplus_graph::split_arguments;
///
/// let words = ["sim", "--ros-args", "-r", "a:=b", "--", "world.sdf"].map(str::to_owned);
/// let (own, ros) = split_arguments(words);
/// assert_eq!(own, ["sim", "world.sdf"]);
/// assert_eq!(ros, ["-r", "a:=b"]);
/// ```
#[must_use]
pub fn split_arguments(words: impl IntoIterator<Item = String>) -> (Vec<String>, Vec<String>) {
    let (mut own, mut ros) = (Vec::new(), Vec::new());
    let mut is_ros = false;
    for word in words {
        match word.as_str() {
            ROS_ARGS => is_ros = true,
            "--" if is_ros => is_ros = false,
            _ if is_ros => ros.push(word),
            _ => own.push(word),
        }
    }
    (own, ros)
}

/// Reason for which a parameter file was not read. Its text completes the sentence "the file ...".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterFileError {
    /// There is no such file.
    Missing,
    /// The file cannot be read, with the reason.
    Unreadable(String),
    /// The file is not UTF-8 text.
    NotText,
}

impl fmt::Display for ParameterFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => write!(f, "does not exist"),
            Self::Unreadable(reason) => write!(f, "cannot be read: {reason}"),
            Self::NotText => write!(f, "is not UTF-8 text"),
        }
    }
}

impl std::error::Error for ParameterFileError {}

impl Arguments {
    /// Parses the arguments after `--ros-args`. Parameter files are read with `read`.
    ///
    /// Invalid arguments give findings; the rest is used.
    #[must_use]
    pub fn read(
        words: &[String],
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
        read: &mut dyn FnMut(&Path) -> Result<String, ParameterFileError>,
    ) -> Self {
        let mut arguments = Self::default();
        let mut words = words.iter();
        while let Some(flag) = words.next() {
            let mut value = |what: &str| {
                let value = words.next().cloned();
                if value.is_none() {
                    let message = format!("`{flag}` needs {what} after it");
                    diagnostics.push(Diagnostic::error("ros-args", message));
                }
                value
            };
            match flag.as_str() {
                "-r" | "--remap" => {
                    if let Some(rule) = value("a rule, `from:=to`") {
                        match Rule::read(&rule) {
                            Ok(rule) => arguments.rules.push(rule),
                            Err(error) => {
                                diagnostics.push(Diagnostic::error("ros-args", error.to_string()));
                            }
                        }
                    }
                }
                "-p" | "--param" => {
                    if let Some(rule) = value("a parameter, `name:=value`") {
                        arguments.parameter(&rule, sources, diagnostics);
                    }
                }
                "--params-file" => {
                    if let Some(path) = value("a parameter file") {
                        match read(Path::new(&path)) {
                            Ok(text) => {
                                let id = sources.add(path, text);
                                file::read(&mut arguments, id, sources, diagnostics);
                            }
                            Err(reason) => {
                                let message = format!("the parameter file `{path}` {reason}");
                                diagnostics.push(Diagnostic::error("ros-args", message));
                            }
                        }
                    }
                }
                "-e" | "--enclave" => arguments.enclave = value("an enclave name"),
                "--log-level" => {
                    if let Some(rule) = value("a level, or `logger:=level`") {
                        arguments.log_level(&rule, diagnostics);
                    }
                }
                "--log-config-file" | "--log-file-name" => {
                    let _ = value("a file");
                    diagnostics.push(ignored(flag));
                }
                "--disable-rosout-logs" => arguments.no_rosout = true,
                "--enable-rosout-logs" => arguments.no_rosout = false,
                // Nodes write neither files nor to the terminal.
                "--enable-stdout-logs"
                | "--disable-stdout-logs"
                | "--enable-external-lib-logs"
                | "--disable-external-lib-logs" => diagnostics.push(ignored(flag)),
                _ => {
                    arguments.unknown.push(flag.clone());
                    diagnostics.push(unknown(flag));
                }
            }
        }
        arguments
    }

    /// Parses `name:=value` or `node:name:=value`.
    fn parameter(&mut self, rule: &str, sources: &mut SourceMap, diagnostics: &mut Diagnostics) {
        let whole = {
            let file = sources.add("-p", rule);
            sources.whole(file)
        };
        let mut fail = |at: Span, message: String, help: &str| {
            diagnostics.push(Diagnostic::error("ros-args", message).at(at).help(help.to_owned()));
        };
        let Some((left, right)) = rule.split_once(":=") else {
            return fail(whole, "a parameter has no `:=`".into(), "write `name:=value`");
        };
        let (node, name) = match left.rsplit_once(':') {
            Some((node, name)) => (Some(node), name),
            None => (None, left),
        };
        let pattern = match node {
            None => Ok(Pattern::all()),
            Some(node) if node.contains('/') => Pattern::read(node),
            // A bare name matches the node in any namespace.
            Some(node) => Pattern::read(node),
        };
        let pattern = match pattern {
            Ok(pattern) => pattern,
            Err(reason) => {
                let node = node.unwrap_or_default();
                let at = whole.part(0, node.len());
                return fail(
                    at,
                    format!("the node name `{node}` {reason}"),
                    "write `node:name:=value`",
                );
            }
        };
        if name.is_empty() {
            return fail(
                whole.part(0, left.len()),
                "a parameter has no name".into(),
                "write `name:=value`",
            );
        }
        match parameter_from_yaml(right) {
            Ok(value) => self.give(pattern, name.to_owned(), value),
            Err(reason) => {
                let at = whole.part(left.len() + 2, rule.len());
                let help = "values are YAML: `5`, `0.5`, `true`, `word`, `[1.0, 2.0]`";
                fail(at, format!("`{name}`: the value {reason}"), help);
            }
        }
    }

    /// Parses `level` or `logger:=level`.
    fn log_level(&mut self, rule: &str, diagnostics: &mut Diagnostics) {
        let (logger, word) = match rule.split_once(":=") {
            Some((logger, word)) => (Some(logger), word),
            None => (None, rule),
        };
        let Some(level) = Level::named(word) else {
            let names = Level::ALL.map(|level| level.to_string().to_ascii_lowercase());
            let near = closest(&word.to_ascii_lowercase(), names.iter().map(String::as_str));
            let help = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("write one of {}", names.join(", ")),
            };
            let message = format!("`{word}` is not a log level");
            return diagnostics.push(Diagnostic::error("ros-args", message).help(help));
        };
        match logger {
            None => self.level = Some(level),
            Some(logger) => {
                let name = logger.trim_start_matches('/').replace('/', ".");
                self.levels.insert(name, level);
            }
        }
    }
}

fn ignored(flag: &str) -> Diagnostic {
    let message = format!("`{flag}` has no effect: nodes log to `/rosout`");
    Diagnostic::warning("ros-args", message)
}

fn unknown(word: &str) -> Diagnostic {
    let wrong = |message: String| Diagnostic::error("ros-args", message);
    if word.contains(":=") {
        // The syntax of ROS 1 and the first ROS 2.
        return wrong(format!("`{word}` has no flag before it"))
            .help(format!("write `-r {word}` for a remapping, `-p {word}` for a parameter"));
    }
    let wrong = wrong(format!("`{word}` is not a flag of `{ROS_ARGS}`"));
    match closest(word, FLAGS) {
        Some(near) => wrong.help(format!("did you mean `{near}`?")),
        None => wrong.help("write `--` to end the arguments for nodes"),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use periplus_diagnostics::{RenderStyle, render};

    use super::*;
    use crate::arguments::parameter_to_yaml;

    const FILE: &str = "\
/**:
  ros__parameters:
    rate: 1
    plugin: {radius: 0.5}
demo:
  scan:
    ros__parameters: {rate: 2, frames: [a, b]}
/*/scan:
  ros__parameters:
    rate: 3
";

    fn read(line: &str) -> (Arguments, String) {
        let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let arguments =
            Arguments::read(
                &words,
                &mut sources,
                &mut diagnostics,
                &mut |path| match path.to_str() {
                    Some("p.yaml") => Ok(FILE.into()),
                    Some("wrong.yaml") => Ok(WRONG.into()),
                    _ => Err(ParameterFileError::Missing),
                },
            );
        let text =
            diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
        (arguments, text)
    }

    fn summary(arguments: &Arguments, node: &str) -> String {
        let all = arguments.parameters_of(node);
        let each = all.iter().map(|(name, value)| format!("{name}={}", parameter_to_yaml(value)));
        each.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn later_patterns_win() {
        let (arguments, wrong) = read("--params-file p.yaml");
        assert_eq!(wrong, "");
        assert_eq!(summary(&arguments, "/demo/scan"), "frames=[a, b] plugin.radius=0.5 rate=3");
        assert_eq!(summary(&arguments, "/scan"), "plugin.radius=0.5 rate=1");
        // `-p` means all nodes, `/**`, which the file names first: the more specific pattern wins.
        let (arguments, _) = read("--params-file p.yaml -p rate:=9");
        assert_eq!(summary(&arguments, "/scan"), "plugin.radius=0.5 rate=9");
        assert_eq!(summary(&arguments, "/demo/scan"), "frames=[a, b] plugin.radius=0.5 rate=3");
        let (arguments, _) = read("--params-file p.yaml -p scan:rate:=9 -p /demo/scan:on:=yes");
        assert_eq!(summary(&arguments, "/scan"), "plugin.radius=0.5 rate=9");
        // The name of a node without a slash is that of a node without a namespace, as in `rcl`.
        assert_eq!(
            summary(&arguments, "/demo/scan"),
            "frames=[a, b] on=true plugin.radius=0.5 rate=3"
        );
    }

    #[test]
    fn levels_go_down_to_loggers_below() {
        let (arguments, wrong) = read("--log-level warn --log-level demo:=DEBUG --enclave /x");
        assert_eq!(wrong, "");
        assert_eq!(arguments.level_of("/scan"), Level::Warn);
        assert_eq!(arguments.level_of("/demo/scan"), Level::Debug);
        assert_eq!(arguments.enclave(), Some("/x"));
    }

    const WRONG: &str = "\
scan:
  rate: 1
ros__parameters: {}
/sc*n: {ros__parameters: {a: 1}}
/**:
  ros__parameters:
    limits: [1.5, 2]
    nothing:
    deep: [{a: 1}]
";

    fn check(line: &str, expected: Expect) {
        expected.assert_eq(&read(line).1);
    }

    #[test]
    fn errors_in_files_are_reported_with_their_position() {
        check(
            "--params-file wrong.yaml",
            expect![[r#"
                error[bad-parameter-file]: a number where a node name is expected
                 --> wrong.yaml:2:9
                  |
                2 |   rate: 1
                  |         ^
                  |
                  = help: write the node name (or `/**` for all), below it `ros__parameters`, below that the parameters
                error[bad-parameter-file]: `ros__parameters` must be below a node name
                 --> wrong.yaml:3:1
                  |
                3 | ros__parameters: {}
                  | ^^^^^^^^^^^^^^^
                  |
                  = help: write `/**` above it for all nodes
                error[bad-parameter-file]: the node name `/sc*n` has a wildcard inside `sc*n`; `*` matches a whole part of a name, `**` any number of parts
                 --> wrong.yaml:4:9
                  |
                4 | /sc*n: {ros__parameters: {a: 1}}
                  |         ^^^^^^^^^^^^^^^
                error[bad-parameter]: `limits`: the value is a list of numbers with an integer in it; all must be of one type: write `2.0`
                 --> wrong.yaml:7:19
                  |
                7 |     limits: [1.5, 2]
                  |                   ^
                error[bad-parameter]: `nothing`: the value is null; write `""` for an empty string
                 --> wrong.yaml:8:12
                  |
                8 |     nothing:
                  |            ^
                error[bad-parameter]: `deep`: the value is a list of lists or mappings; the items must be values
                 --> wrong.yaml:9:12
                  |
                9 |     deep: [{a: 1}]
                  |            ^^^^^^
            "#]],
        );
    }

    #[test]
    fn errors_on_the_command_line_are_reported() {
        check(
            "x:=1 --parms-file a -r -p a -p b:=[1 --log-level wran -r a:= --params-file gone.yaml --log-config-file x -p",
            expect![[r#"
                error[ros-args]: `x:=1` has no flag before it
                 |
                 = help: write `-r x:=1` for a remapping, `-p x:=1` for a parameter
                error[ros-args]: `--parms-file` is not a flag of `--ros-args`
                 |
                 = help: did you mean `--params-file`?
                error[ros-args]: `a` is not a flag of `--ros-args`
                 |
                 = help: write `--` to end the arguments for nodes
                error[ros-args]: the remapping `-p` has no `:=`; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`
                error[ros-args]: `b`: the value cannot be read: this is not YAML: while parsing a flow sequence, expected ',' or ']'
                 --> -p:1:4
                  |
                1 | b:=[1
                  |    ^^
                  |
                  = help: values are YAML: `5`, `0.5`, `true`, `word`, `[1.0, 2.0]`
                error[ros-args]: `wran` is not a log level
                 |
                 = help: did you mean `warn`?
                error[ros-args]: the remapping `a:=` has nothing after its `:=`; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`
                error[ros-args]: the parameter file `gone.yaml` does not exist
                warning[ros-args]: `--log-config-file` has no effect: nodes log to `/rosout`
                error[ros-args]: `-p` needs a parameter, `name:=value` after it
            "#]],
        );
    }
}
