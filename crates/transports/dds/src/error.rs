//! Errors of the DDS transport.

use std::fmt;

use periplus_graph::GraphError;

/// Error of the DDS transport.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum DdsError {
    /// The network cannot be joined.
    Network {
        /// Domain id.
        domain_id: u32,
        /// Message of DDS.
        why: String,
    },
    /// A graph is attached already.
    Attached,
    /// The graph refused the transport's node.
    Graph(GraphError),
}

impl fmt::Display for DdsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Network { domain_id, why } => write!(
                f,
                "cannot join the ROS 2 network, domain {domain_id}: {why}; check which interfaces \
                 there are, whether ROS_DOMAIN_ID and CYCLONEDDS_URI are as meant, and whether \
                 more than 60 programs of this domain run on this machine"
            ),
            Self::Attached => {
                write!(f, "the transport already has a graph; open another transport")
            }
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for DdsError {}

impl From<GraphError> for DdsError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}
