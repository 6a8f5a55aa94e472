//! What is wrong with a tree of frames.

use std::fmt;

/// What keeps frames from being one tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Each of these frames is said to be in the next one, and the last in the first.
    Circle(Vec<String>),
    /// Frames without a parent, more than one: what is below one cannot be placed in another.
    SeveralTrees(Vec<String>),
    /// A frame is said to be in one frame and in others too.
    SeveralParents {
        /// The frame.
        child: String,
        /// The frames it is said to be in, the last one first.
        parents: Vec<String>,
    },
}

fn quoted(names: &[String], between: &str) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(between)
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Circle(frames) => {
                let back = frames.first().map_or("", String::as_str);
                write!(f, "frames run in a circle: {} -> `{back}`", quoted(frames, " -> "))
            }
            Self::SeveralTrees(roots) => {
                let count = roots.len();
                write!(f, "{count} trees that are not connected, below {}", quoted(roots, ", "))
            }
            Self::SeveralParents { child, parents } => {
                write!(f, "`{child}` has more than one parent: {}", quoted(parents, ", "))
            }
        }
    }
}
