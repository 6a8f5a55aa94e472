//! Arguments of a program: its own, remappings and parameters.

use crate::Identity;
use periplus_graph::split_arguments;

/// Parsed arguments of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ProgramArguments {
    /// Own arguments.
    pub(crate) own: Vec<String>,
    /// Arguments after `--ros-args`, with `a:=b` of ROS 1 and old ROS 2 as rules.
    pub(crate) ros: Vec<String>,
    /// Node name set by a rule.
    pub(crate) name: Option<String>,
    /// Namespace set by a rule.
    pub(crate) namespace: Option<String>,
}

/// Parses the arguments of a program.
///
/// `_name:=value` is a ROS 1 parameter, `__name:=` and `__ns:=` rename the node, `from:=to` remaps
/// a topic. `__log:=` and similar arguments of `roslaunch` are ignored.
pub(crate) fn read(words: &[String], ros_words: &[String]) -> ProgramArguments {
    let (mixed, mut ros) = split_arguments(words.iter().cloned());
    ros.extend(ros_words.iter().filter(|word| *word != "--ros-args").cloned());
    let mut told = ProgramArguments::default();
    for word in mixed {
        let Some((from, to)) = word.split_once(":=").filter(|(from, _)| is_name(from)) else {
            told.own.push(word);
            continue;
        };
        let rule = match from {
            "__name" | "__node" => ["-r".to_owned(), format!("__node:={to}")],
            "__ns" => ["-r".to_owned(), format!("__ns:={to}")],
            _ if from.starts_with("__") => continue,
            _ => match from.strip_prefix('_') {
                Some(name) => ["-p".to_owned(), format!("{name}:={to}")],
                None => ["-r".to_owned(), word],
            },
        };
        ros.extend(rule);
    }
    for rule in ros.iter().filter_map(|word| word.split_once(":=")) {
        match rule {
            ("__node" | "__name", to) => told.name = Some(to.to_owned()),
            ("__ns", to) => told.namespace = Some(to.to_owned()),
            _ => {}
        }
    }
    told.ros = ros;
    told
}

/// Returns true if it can be the left side of a rule; expressions and paths with `:=` cannot.
fn is_name(word: &str) -> bool {
    let is_letter = |letter: char| letter.is_ascii_alphanumeric() || "_~/.".contains(letter);
    !word.is_empty() && word.chars().all(is_letter)
}

/// Full name of a node.
pub(crate) fn full_name(identity: &Identity, told: &ProgramArguments, usual: &str) -> String {
    let name = told.name.as_deref().or(identity.name.as_deref()).unwrap_or(usual);
    let namespace = told.namespace.as_deref().or(identity.namespace.as_deref()).unwrap_or("/");
    let namespace = namespace.trim_matches('/');
    if namespace.is_empty() { format!("/{name}") } else { format!("/{namespace}/{name}") }
}

/// Value of an option `-name value`, `--name value`, `-name=value` or `--name=value`.
pub(crate) fn option<'a>(words: &'a [String], name: &str) -> Option<&'a str> {
    let mut words = words.iter();
    while let Some(word) = words.next() {
        let Some(bare) = word.strip_prefix("--").or_else(|| word.strip_prefix('-')) else {
            continue;
        };
        if bare == name {
            return words.next().map(String::as_str);
        }
        if let Some(value) = bare.strip_prefix(name).and_then(|rest| rest.strip_prefix('=')) {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn words_of_all_generations() {
        let told = read(
            &words(
                "-x 1 voxel_grid:=/local/voxel_grid _rate:=5 __name:=me __log:=/tmp/a --ros-args -p b:=2 -- end",
            ),
            &words("--log-level info"),
        );
        assert_eq!(told.own, words("-x 1 end"));
        let ros =
            "-p b:=2 --log-level info -r voxel_grid:=/local/voxel_grid -p rate:=5 -r __node:=me";
        assert_eq!(told.ros, words(ros));
        assert_eq!(told.name.as_deref(), Some("me"));
    }

    #[test]
    fn options_have_a_value_behind_a_blank_or_an_equals_sign() {
        let line = words("-file a.sdf --name=b -x=-1 -unpause");
        assert_eq!(option(&line, "file"), Some("a.sdf"));
        assert_eq!(option(&line, "name"), Some("b"));
        assert_eq!(option(&line, "x"), Some("-1"));
        assert_eq!(option(&line, "z"), None);
    }
}
