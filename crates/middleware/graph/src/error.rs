//! What can be wrong with a call to the graph.

use std::fmt;

/// Why a graph refuses something. The text says what is wrong and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GraphError {
    /// A name that ROS 2 does not allow.
    Name {
        /// What it should name, such as `topic`.
        what: &'static str,
        /// The name as written.
        name: String,
        /// The rest of the sentence "the name ...".
        reason: String,
        /// A name that would do.
        help: Option<String>,
    },
    /// A remapping that cannot be read.
    Remap {
        /// As written.
        rule: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The graph has a node of this name.
    NodeExists {
        /// Its full name.
        node: String,
    },
    /// A topic or service has another type.
    Type(Box<TypeClash>),
    /// Another node answers this service.
    ServerExists {
        /// Full name of the service.
        service: String,
        /// Full name of the node that answers it.
        node: String,
        /// Full name of the node that wants to.
        asked: String,
    },
    /// A timer without a period, or the like.
    Value {
        /// What is wrong with it and what to do.
        reason: String,
    },
}

/// Two nodes that mean different types by one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypeClash {
    /// `topic` or `service`.
    pub what: &'static str,
    /// Its full name.
    pub name: String,
    /// The type that it has.
    pub has: String,
    /// The node that brought it.
    pub has_node: String,
    /// The type that was asked for.
    pub asked: String,
    /// The node that asked for it.
    pub asked_node: String,
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { what, name, reason, help } => {
                write!(f, "the name `{name}` of a {what} {reason}")?;
                if let Some(help) = help {
                    write!(f, "; `{help}` would do")?;
                }
                Ok(())
            }
            Self::Remap { rule, reason } => {
                write!(f, "the remapping `{rule}` {reason}; write `from:=to`, `node:from:=to`, ")?;
                write!(f, "`__node:=name` or `__ns:=/namespace`")
            }
            Self::NodeExists { node } => {
                write!(f, "there is a node `{node}` already; give one of them another name ")?;
                write!(f, "(`__node:=`) or namespace (`__ns:=`)")
            }
            Self::Type(clash) => {
                let TypeClash { what, name, has, has_node, asked, asked_node } = &**clash;
                write!(f, "the {what} `{name}` is a {has} (`{has_node}`), ")?;
                write!(f, "and `{asked_node}` wants it to be a {asked}; ")?;
                write!(f, "rename one of the two with a remapping `{name}:=...`")
            }
            Self::ServerExists { service, node, asked } => {
                write!(f, "`{asked}` cannot answer the service `{service}`: `{node}` does; ")?;
                write!(f, "rename one of the two with a remapping `{service}:=...`")
            }
            Self::Value { reason } => f.write_str(reason),
        }
    }
}

impl std::error::Error for GraphError {}
