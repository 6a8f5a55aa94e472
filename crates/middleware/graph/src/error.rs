//! Errors of the graph.

use std::fmt;

/// Error of a call to the graph. Its text explains the cause and the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GraphError {
    /// A name that ROS 2 does not allow.
    Name {
        /// Kind of the name, such as `topic`.
        what: &'static str,
        /// The name as written.
        name: String,
        /// The rest of the sentence "the name ...".
        reason: String,
        /// A valid name that is similar.
        help: Option<String>,
    },
    /// An invalid remapping.
    Remap {
        /// As written.
        rule: String,
        /// The rest of the sentence "the remapping ...".
        reason: String,
    },
    /// The graph already has a node of this name.
    NodeExists {
        /// Its full name.
        node: String,
    },
    /// The topic or service has another type.
    Type(Box<TypeClash>),
    /// Another node serves this service.
    ServerExists {
        /// Full name of the service.
        service: String,
        /// Full name of the node that serves it.
        node: String,
        /// Full name of the node that requested it.
        asked: String,
    },
    /// An invalid value, such as a timer without a period.
    Value {
        /// Cause and remedy.
        reason: String,
    },
}

/// Two nodes that use different types for one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypeClash {
    /// `topic` or `service`.
    pub what: &'static str,
    /// Its full name.
    pub name: String,
    /// The existing type.
    pub has: String,
    /// The node that defined it.
    pub has_node: String,
    /// The requested type.
    pub asked: String,
    /// The node that requested it.
    pub asked_node: String,
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { what, name, reason, help } => {
                write!(f, "the {what} name `{name}` {reason}")?;
                if let Some(help) = help {
                    write!(f, "; `{help}` is valid")?;
                }
                Ok(())
            }
            Self::Remap { rule, reason } => {
                write!(f, "the remapping `{rule}` {reason}; write `from:=to`, `node:from:=to`, ")?;
                write!(f, "`__node:=name` or `__ns:=/namespace`")
            }
            Self::NodeExists { node } => {
                write!(f, "there is already a node `{node}`; give one of them another name ")?;
                write!(f, "(`__node:=`) or namespace (`__ns:=`)")
            }
            Self::Type(clash) => {
                let TypeClash { what, name, has, has_node, asked, asked_node } = &**clash;
                write!(f, "the {what} `{name}` is a {has} (`{has_node}`), ")?;
                write!(f, "but `{asked_node}` requests a {asked}; ")?;
                write!(f, "rename one of the two with a remapping `{name}:=...`")
            }
            Self::ServerExists { service, node, asked } => {
                write!(f, "`{asked}` cannot serve `{service}`: `{node}` already does; ")?;
                write!(f, "rename one of the two with a remapping `{service}:=...`")
            }
            Self::Value { reason } => f.write_str(reason),
        }
    }
}

impl std::error::Error for GraphError {}
