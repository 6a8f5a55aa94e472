//! Why a wire cannot be.

use std::fmt;

use periplus_graph::GraphError;

/// Why a wire cannot be.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum WireError {
    /// A setting is none.
    Setting {
        /// Which.
        what: String,
        /// What is wrong with it.
        why: String,
    },
    /// The network cannot be joined.
    Network {
        /// By which way it was tried.
        way: String,
        /// What Zenoh says.
        why: String,
    },
    /// It has a graph already.
    Attached,
    /// The graph does not want it.
    Graph(GraphError),
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setting { what, why } => write!(f, "{what} cannot be used for Zenoh: {why}"),
            Self::Network { way, why } => write!(
                f,
                "cannot join Zenoh by way of {way}: {why}; see whether a router runs (`ros2 run \
                 rmw_zenoh_cpp rmw_zenohd`) and whether ZENOH_SESSION_CONFIG_URI and \
                 ZENOH_CONFIG_OVERRIDE are as meant"
            ),
            Self::Attached => write!(f, "the wire has a graph already; open another wire"),
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for WireError {}

impl From<GraphError> for WireError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}
