//! Errors of the Zenoh transport.

use std::fmt;

use periplus_graph::GraphError;

/// Error of the Zenoh transport.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum ZenohError {
    /// An invalid setting.
    Setting {
        /// Name of the setting.
        what: String,
        /// Cause.
        why: String,
    },
    /// The network cannot be joined.
    Network {
        /// Router or configuration that was tried.
        way: String,
        /// Message of Zenoh.
        why: String,
    },
    /// A graph is attached already.
    Attached,
    /// The graph refused the transport's node.
    Graph(GraphError),
}

impl fmt::Display for ZenohError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setting { what, why } => write!(f, "{what} is not valid for Zenoh: {why}"),
            Self::Network { way, why } => write!(
                f,
                "cannot join Zenoh through {way}: {why}; check that a router runs (`ros2 run \
                 rmw_zenoh_cpp rmw_zenohd`) and whether ZENOH_SESSION_CONFIG_URI and \
                 ZENOH_CONFIG_OVERRIDE are as meant"
            ),
            Self::Attached => {
                write!(f, "the transport already has a graph; open another transport")
            }
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ZenohError {}

impl From<GraphError> for ZenohError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}
