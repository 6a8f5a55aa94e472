//! What a node is called and what it calls its topics.

use std::collections::BTreeMap;

use periplus_msgs::rcl_interfaces::ParameterValue;

use crate::GraphError;
use crate::arguments::Arguments;
use crate::name;
use crate::remap::{Change, Rule, full_namespace};

/// Name, namespace and remappings of a node that is to be made.
#[derive(Clone, Debug)]
pub struct NodeSettings {
    name: String,
    namespace: String,
    rules: Vec<Result<Rule, GraphError>>,
    parameters: BTreeMap<String, ParameterValue>,
    takes_any_parameter: bool,
    is_bare: bool,
    keeps_names: bool,
}

impl NodeSettings {
    /// A node in the root namespace.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            namespace: "/".into(),
            rules: Vec::new(),
            parameters: BTreeMap::new(),
            takes_any_parameter: false,
            is_bare: false,
            keeps_names: false,
        }
    }

    /// In a namespace, with or without a slash in front; `""` and `/` are the root.
    #[must_use]
    pub fn namespace(mut self, namespace: &str) -> Self {
        self.namespace = full_namespace(namespace);
        self
    }

    /// Another name for a topic or service. Both are read as the node itself would write them, so
    /// `~/out` is its own and `scan` belongs to its namespace. Earlier rules win.
    #[must_use]
    pub fn remap(mut self, from: &str, to: &str) -> Self {
        self.rules.push(if from.trim().is_empty() || to.trim().is_empty() {
            let rule = format!("{from}:={to}");
            Err(GraphError::Remap { rule, reason: "has an empty side".into() })
        } else {
            Ok(Rule { node: None, change: Rule::name(from.trim(), to.trim()) })
        });
        self
    }

    /// A rule as a command line has it: `from:=to`, `node:from:=to`, `__node:=name`,
    /// `__ns:=/namespace`. What is wrong with it is said when the node is made.
    #[must_use]
    pub fn rule(mut self, written: &str) -> Self {
        self.rules.push(Rule::read(written));
        self
    }

    /// The value of a parameter that the node may declare, in place of what arguments say.
    #[must_use]
    pub fn parameter(mut self, name: &str, value: ParameterValue) -> Self {
        self.parameters.insert(name.to_owned(), value);
        self
    }

    /// The node has whatever parameters it is given, and others may set any
    /// (`allow_undeclared_parameters` of ROS 2).
    #[must_use]
    pub fn any_parameters(mut self) -> Self {
        self.takes_any_parameter = true;
        self
    }

    /// Without the services for parameters and without a place on `/parameter_events` and `/rosout`:
    /// for what is no node by itself, such as a wire or a tool that looks for a moment.
    #[must_use]
    pub fn bare(mut self) -> Self {
        self.is_bare = true;
        self
    }

    /// Arguments rename neither the node nor what it uses: it belongs to the program, and others know
    /// it by its name.
    #[must_use]
    pub fn keep_names(mut self) -> Self {
        self.keeps_names = true;
        self
    }

    pub(crate) fn takes_any_parameter(&self) -> bool {
        self.takes_any_parameter
    }

    pub(crate) fn is_bare(&self) -> bool {
        self.is_bare
    }

    /// Names and parameters, with what arguments say.
    pub(crate) fn resolve(
        mut self,
        arguments: &Arguments,
    ) -> Result<(NodeNames, BTreeMap<String, ParameterValue>), GraphError> {
        if !self.keeps_names {
            self.rules.extend(arguments.rules.iter().cloned().map(Ok));
        }
        let parameters = std::mem::take(&mut self.parameters);
        Ok((self.names()?, parameters))
    }

    /// The names that the node will have.
    ///
    /// # Errors
    /// When a name or rule is not valid.
    pub fn names(self) -> Result<NodeNames, GraphError> {
        let rules = self.rules.into_iter().collect::<Result<Vec<_>, _>>()?;
        // Rules for a node mean the name that its program gives it.
        let given = self.name;
        let rules: Vec<Change> = rules
            .into_iter()
            .filter(|rule| rule.node.as_ref().is_none_or(|node| *node == given))
            .map(|rule| rule.change)
            .collect();
        let mut names = NodeNames { name: given, namespace: self.namespace, rules: Vec::new() };
        let name = rules.iter().find_map(|rule| match rule {
            Change::Node(name) => Some(name.clone()),
            _ => None,
        });
        let namespace = rules.iter().find_map(|rule| match rule {
            Change::Namespace(namespace) => Some(namespace.clone()),
            _ => None,
        });
        names.name = name.unwrap_or(names.name);
        names.namespace = namespace.unwrap_or(names.namespace);
        name::check_node(&names.name)?;
        if names.namespace.is_empty() {
            names.namespace = "/".into();
        }
        name::check_namespace(&names.namespace)?;
        for rule in rules {
            if let Change::Name { from, to, topics, services } = rule {
                let from = names.expand("topic", &from)?;
                let to = names.expand("topic", &to)?;
                names.rules.push(FullRule { from, to, topics, services });
            }
        }
        Ok(names)
    }
}

/// The names of a node, ready to resolve others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeNames {
    name: String,
    namespace: String,
    rules: Vec<FullRule>,
}

/// A rule with full names.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FullRule {
    from: String,
    to: String,
    topics: bool,
    services: bool,
}

impl NodeNames {
    /// The name without namespace.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The namespace, with a slash in front; `/` is the root.
    #[must_use]
    pub fn namespace(&self) -> &str {
        &self.namespace
    }

    /// Namespace and name.
    #[must_use]
    pub fn full_name(&self) -> String {
        format!("{}/{}", self.namespace.trim_end_matches('/'), self.name)
    }

    /// The full name of a topic as the node writes it, remappings applied.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn topic(&self, written: &str) -> Result<String, GraphError> {
        let full = self.expand("topic", written)?;
        let rule = self.rules.iter().find(|rule| rule.topics && rule.from == full);
        Ok(rule.map_or(full, |rule| rule.to.clone()))
    }

    /// The full name of a service as the node writes it, remappings applied.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn service(&self, written: &str) -> Result<String, GraphError> {
        let full = self.expand("service", written)?;
        let rule = self.rules.iter().find(|rule| rule.services && rule.from == full);
        Ok(rule.map_or(full, |rule| rule.to.clone()))
    }

    fn expand(&self, what: &'static str, written: &str) -> Result<String, GraphError> {
        name::expand(what, written, &self.name, &self.namespace)
    }
}
