//! Command-line arguments of nodes: `--ros-args`.
//!
//! Source of the grammar and of the precedence: `rcl/arguments.c`, `rcl_yaml_param_parser` and
//! `rclcpp/parameter_map.cpp`.

mod file;
mod pattern;
mod read;
mod scalar;

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_msgs::rcl_interfaces::ParameterValue;

use crate::log::Level;
use crate::remap::Rule;

pub use file::parameters_to_yaml;
pub use read::{ParameterFileError, ROS_ARGS, split_arguments};
pub use scalar::{InvalidParameter, parameter_from_yaml, parameter_to_yaml};

use pattern::Pattern;

/// Names, parameters and log levels of nodes from a command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arguments {
    pub(crate) rules: Vec<Rule>,
    /// By node pattern, in the order in which the patterns first appeared.
    parameters: Vec<(Pattern, BTreeMap<String, ParameterValue>)>,
    level: Option<Level>,
    /// By logger name.
    levels: BTreeMap<String, Level>,
    enclave: Option<String>,
    no_rosout: bool,
    unknown: Vec<String>,
}

impl Arguments {
    /// Words that are no flag and belong to none.
    #[must_use]
    pub fn unknown_words(&self) -> &[String] {
        &self.unknown
    }

    /// Parameters of a node by its full name. Later ones take precedence; a pattern ranks by its
    /// first appearance, as in `rcl`.
    #[must_use]
    pub fn parameters_of(&self, node: &str) -> BTreeMap<String, ParameterValue> {
        let fitting = self.parameters.iter().filter(|(pattern, _)| pattern.fits(node));
        let all = fitting.flat_map(|(_, parameters)| parameters);
        all.map(|(name, value)| (name.clone(), value.clone())).collect()
    }

    /// Minimum log level of a node by its full name: that of its logger, of the nearest parent
    /// logger, or the global one.
    #[must_use]
    pub fn level_of(&self, node: &str) -> Level {
        let logger = node.trim_start_matches('/').replace('/', ".");
        self.given_level_of(&logger).unwrap_or_default()
    }

    /// Minimum log level that is given for a logger: its own, that of the nearest parent, or the global one.
    #[must_use]
    pub fn given_level_of(&self, logger: &str) -> Option<Level> {
        let mut name = logger;
        loop {
            if let Some(level) = self.levels.get(name) {
                return Some(*level);
            }
            match name.rsplit_once('.') {
                Some((above, _)) => name = above,
                None => return self.level,
            }
        }
    }

    /// True if nodes log to `/rosout`.
    #[must_use]
    pub fn logs_to_rosout(&self) -> bool {
        !self.no_rosout
    }

    /// Security enclave of the program. DDS security is not implemented yet.
    #[must_use]
    pub fn enclave(&self) -> Option<&str> {
        self.enclave.as_deref()
    }

    /// Node patterns that have parameters, as written, with the parameter names.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, impl Iterator<Item = &str>)> {
        let each = self.parameters.iter();
        each.map(|(pattern, all)| (pattern.written(), all.keys().map(String::as_str)))
    }

    /// Warnings about arguments that none of these nodes uses. `has` tests if a node has a
    /// parameter.
    pub(crate) fn unused(&self, nodes: &[&str], has: &dyn Fn(usize, &str) -> bool) -> Diagnostics {
        let mut unused = Diagnostics::new();
        let mut warn = |message: String, near: Option<&str>| {
            let warning = Diagnostic::warning("unused-argument", message);
            unused.push(match near {
                Some(near) => warning.help(format!("did you mean `{near}`?")),
                None => warning,
            });
        };
        for (pattern, parameters) in &self.parameters {
            let written = pattern.written();
            let fitting: Vec<usize> =
                (0..nodes.len()).filter(|node| pattern.fits(nodes[*node])).collect();
            if fitting.is_empty() {
                let near = closest(written, nodes.iter().copied());
                warn(format!("there are parameters for `{written}`, but no such node"), near);
                continue;
            }
            for name in parameters.keys() {
                if !fitting.iter().any(|node| has(*node, name)) {
                    warn(
                        format!("no node that matches `{written}` has a parameter `{name}`"),
                        None,
                    );
                }
            }
        }
        unused
    }

    fn give(&mut self, pattern: Pattern, name: String, value: ParameterValue) {
        let index = self.parameters.iter().position(|(known, _)| *known == pattern);
        let index = index.unwrap_or_else(|| {
            self.parameters.push((pattern, BTreeMap::new()));
            self.parameters.len() - 1
        });
        self.parameters[index].1.insert(name, value);
    }
}
