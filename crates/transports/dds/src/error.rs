//! Why a wire cannot be.

use std::fmt;

use periplus_graph::GraphError;

/// Why a wire cannot be.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum WireError {
    /// The network cannot be joined.
    Network {
        /// Number of the domain.
        domain_id: u32,
        /// What DDS says.
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
            Self::Network { domain_id, why } => write!(
                f,
                "cannot join the ROS 2 network, domain {domain_id}: {why}; see which interfaces \
                 there are, whether ROS_DOMAIN_ID and CYCLONEDDS_URI are as meant, and whether \
                 more than 60 programs of this domain run on this machine"
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
