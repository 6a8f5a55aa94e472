//! Faults of a transform tree.

use std::fmt;

/// Fault of a transform tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TreeFault {
    /// Loop: each frame is a child of the next, and the last of the first.
    Circle(Vec<String>),
    /// More than one root: frames of different trees cannot be transformed into each other.
    SeveralTrees(Vec<String>),
    /// Frame with several parents.
    SeveralParents {
        /// Child frame.
        child: String,
        /// Parents, the latest first.
        parents: Vec<String>,
    },
}

fn quoted(names: &[String], between: &str) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(between)
}

impl fmt::Display for TreeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Circle(frames) => {
                let back = frames.first().map_or("", String::as_str);
                write!(f, "frames form a loop: {} -> `{back}`", quoted(frames, " -> "))
            }
            Self::SeveralTrees(roots) => {
                let count = roots.len();
                write!(f, "{count} disconnected trees with the roots {}", quoted(roots, ", "))
            }
            Self::SeveralParents { child, parents } => {
                write!(f, "`{child}` has more than one parent: {}", quoted(parents, ", "))
            }
        }
    }
}
