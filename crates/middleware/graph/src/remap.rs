//! Remapping of node, topic and service names.
//!
//! Source of the rules: ROS 2's design article "Remapping Names" and `rcl/remap.c`: names are
//! expanded first, the first rule that matches applies, and its result is not remapped again.

use crate::GraphError;
use crate::name;

/// A remapping rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Rule {
    /// For this node only.
    pub(crate) node: Option<String>,
    pub(crate) change: Change,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    Node(String),
    Namespace(String),
    /// A topic, a service or both.
    Name {
        from: String,
        to: String,
        topics: bool,
        services: bool,
    },
}

impl Rule {
    /// Parses `from:=to`, `node:from:=to`, `__node:=name`, `__name:=name`, `__ns:=/namespace`;
    /// `from` may begin with `rostopic://` or `rosservice://`.
    pub(crate) fn read(written: &str) -> Result<Self, GraphError> {
        let fail = |reason: &str| GraphError::Remap { rule: written.into(), reason: reason.into() };
        let (left, to) = written.split_once(":=").ok_or_else(|| fail("has no `:=`"))?;
        let (left, to) = (left.trim(), to.trim());
        if to.is_empty() {
            return Err(fail("has nothing after its `:=`"));
        }
        // The colon of `rostopic://` is not a separator.
        let (node, from) = match left.split_once(':') {
            Some((node, from)) if !from.starts_with("//") => (Some(node), from),
            _ => (None, left),
        };
        if let Some(node) = node {
            name::check_node(node)?;
        }
        let change = match from {
            "" => return Err(fail("has nothing before its `:=`")),
            "__node" | "__name" => {
                name::check_node(to)?;
                Change::Node(to.to_owned())
            }
            "__ns" => {
                let namespace = full_namespace(to);
                name::check_namespace(&namespace)?;
                Change::Namespace(namespace)
            }
            _ if from.contains('*') => {
                return Err(fail("has a wildcard, which ROS 2 does not support"));
            }
            _ => Self::name(from, to),
        };
        Ok(Self { node: node.map(str::to_owned), change })
    }

    /// Rule for topics and services from the two sides of `from:=to`.
    pub(crate) fn name(from: &str, to: &str) -> Change {
        let (from, topics, services) = match from.split_once("://") {
            Some(("rostopic", from)) => (from, true, false),
            Some(("rosservice", from)) => (from, false, true),
            _ => (from, true, true),
        };
        Change::Name { from: from.to_owned(), to: to.to_owned(), topics, services }
    }
}

/// Normalizes a namespace: a leading slash, no trailing slash.
pub(crate) fn full_namespace(written: &str) -> String {
    let trimmed = written.trim_end_matches('/');
    if trimmed.starts_with('/') { trimmed.to_owned() } else { format!("/{trimmed}") }
}
