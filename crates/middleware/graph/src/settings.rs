//! Names and remappings of a node.

use std::collections::BTreeMap;

use periplus_msgs::rcl_interfaces::ParameterValue;

use crate::GraphError;
use crate::arguments::Arguments;
use crate::name;
use crate::remap::{Change, Rule, full_namespace};

/// Name, namespace and remappings of a node to create.
#[derive(Clone, Debug)]
pub struct NodeSettings {
    name: String,
    namespace: String,
    rules: Vec<Result<Rule, GraphError>>,
    parameters: BTreeMap<String, ParameterValue>,
    takes_any_parameter: bool,
    read_parameters: Vec<String>,
    is_bare: bool,
    keeps_names: bool,
    shares_name: bool,
    confinement: Option<String>,
}

/// Names that the nodes of all robots share.
const SHARED_NAMES: [&str; 4] = ["/clock", "/rosout", "/parameter_events", "/diagnostics"];

impl NodeSettings {
    /// Starts with a node in the root namespace.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            namespace: "/".into(),
            rules: Vec::new(),
            parameters: BTreeMap::new(),
            takes_any_parameter: false,
            read_parameters: Vec::new(),
            is_bare: false,
            keeps_names: false,
            shares_name: false,
            confinement: None,
        }
    }

    /// Sets the namespace, with or without a leading slash; `""` and `/` are the root.
    #[must_use]
    pub fn namespace(mut self, namespace: &str) -> Self {
        self.namespace = full_namespace(namespace);
        self
    }

    /// Remaps a topic or service. Both names are expanded like names written by the node: `~/out`
    /// is private, `scan` is relative to its namespace. Earlier rules take precedence.
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

    /// Puts the topics and services of the node into a namespace, also those that are written with a leading slash or
    /// remapped outside of it; only what all robots share, such as `/clock`, remains. For copies of a robot whose
    /// description has such names.
    #[must_use]
    pub fn confine(mut self, namespace: &str) -> Self {
        self.confinement = Some(full_namespace(namespace)).filter(|full| full != "/");
        self
    }

    /// Adds a rule in command-line syntax: `from:=to`, `node:from:=to`, `__node:=name`,
    /// `__ns:=/namespace`. Errors are reported when the node is created.
    #[must_use]
    pub fn rule(mut self, written: &str) -> Self {
        self.rules.push(Rule::read(written));
        self
    }

    /// Overrides a parameter that the node may declare; takes precedence over arguments.
    #[must_use]
    pub fn parameter(mut self, name: &str, value: ParameterValue) -> Self {
        self.parameters.insert(name.to_owned(), value);
        self
    }

    /// Accepts any parameter, declared or not (`allow_undeclared_parameters` of ROS 2).
    #[must_use]
    pub fn any_parameters(mut self) -> Self {
        self.takes_any_parameter = true;
        self
    }

    /// Names a parameter that the program reads from the arguments, and that the node does not declare:
    /// [`Graph::unused_arguments`](crate::Graph::unused_arguments) does not report it.
    #[must_use]
    pub fn reads(mut self, parameter: &str) -> Self {
        self.read_parameters.push(parameter.to_owned());
        self
    }

    pub(crate) fn read_parameters(&self) -> Vec<String> {
        self.read_parameters.clone()
    }

    /// Omits the parameter services and the publishers of `/parameter_events` and `/rosout`, for
    /// internal nodes of transports and short-lived tools.
    #[must_use]
    pub fn bare(mut self) -> Self {
        self.is_bare = true;
        self
    }

    /// Ignores remappings from arguments, for nodes that belong to the program and are known by
    /// name.
    #[must_use]
    pub fn keep_names(mut self) -> Self {
        self.keeps_names = true;
        self
    }

    /// Allows another node of the same name, as ROS 2 does. Only the first one is listed.
    #[must_use]
    pub fn share_name(mut self) -> Self {
        self.shares_name = true;
        self
    }

    pub(crate) fn shares_name(&self) -> bool {
        self.shares_name
    }

    /// Adds the names and remappings of a command line, after those that were added before.
    #[must_use]
    pub fn with_arguments(mut self, arguments: &Arguments) -> Self {
        self.rules.extend(arguments.rules.iter().cloned().map(Ok));
        self
    }

    pub(crate) fn takes_any_parameter(&self) -> bool {
        self.takes_any_parameter
    }

    pub(crate) fn is_bare(&self) -> bool {
        self.is_bare
    }

    /// Resolves names and parameters with the arguments.
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

    /// Returns the names that the node will have.
    ///
    /// # Errors
    /// When a name or rule is not valid.
    pub fn names(self) -> Result<NodeNames, GraphError> {
        let rules = self.rules.into_iter().collect::<Result<Vec<_>, _>>()?;
        // Rules with a node prefix match the name that the program gives it.
        let given = self.name;
        let rules: Vec<Change> = rules
            .into_iter()
            .filter(|rule| rule.node.as_ref().is_none_or(|node| *node == given))
            .map(|rule| rule.change)
            .collect();
        let mut names = NodeNames {
            name: given,
            namespace: self.namespace,
            rules: Vec::new(),
            confinement: self.confinement,
        };
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

/// Names of a node, to resolve relative names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeNames {
    name: String,
    namespace: String,
    rules: Vec<FullRule>,
    confinement: Option<String>,
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
    /// Name without namespace.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Namespace with a leading slash; `/` is the root.
    #[must_use]
    pub fn namespace(&self) -> &str {
        &self.namespace
    }

    /// Namespace and name.
    #[must_use]
    pub fn full_name(&self) -> String {
        format!("{}/{}", self.namespace.trim_end_matches('/'), self.name)
    }

    /// Full name of a topic as written by the node, with remappings applied.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn topic(&self, written: &str) -> Result<String, GraphError> {
        let full = self.expand("topic", written)?;
        let rule = self.rules.iter().find(|rule| rule.topics && rule.from == full);
        Ok(self.confined(rule.map_or(full, |rule| rule.to.clone())))
    }

    /// Full name of a service as written by the node, with remappings applied.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn service(&self, written: &str) -> Result<String, GraphError> {
        let full = self.expand("service", written)?;
        let rule = self.rules.iter().find(|rule| rule.services && rule.from == full);
        Ok(self.confined(rule.map_or(full, |rule| rule.to.clone())))
    }

    /// The name within the confinement.
    fn confined(&self, full: String) -> String {
        match &self.confinement {
            Some(around)
                if !SHARED_NAMES.contains(&full.as_str())
                    && full.strip_prefix(around).is_none_or(|rest| !rest.starts_with('/')) =>
            {
                format!("{around}{full}")
            }
            _ => full,
        }
    }

    /// Full name of a topic as written by the node, without remappings.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn expanded_topic(&self, written: &str) -> Result<String, GraphError> {
        self.expand("topic", written)
    }

    /// Full name of a service as written by the node, without remappings.
    ///
    /// # Errors
    /// When ROS 2 would refuse it.
    pub fn expanded_service(&self, written: &str) -> Result<String, GraphError> {
        self.expand("service", written)
    }

    fn expand(&self, what: &'static str, written: &str) -> Result<String, GraphError> {
        name::expand(what, written, &self.name, &self.namespace)
    }
}
