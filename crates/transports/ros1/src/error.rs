//! Errors.

use std::fmt;

use crate::rpc::RpcError;

/// Reason for which ROS 1 cannot be joined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ros1Error {
    /// A port cannot be opened.
    Port {
        /// Address with the port.
        address: String,
        /// Error of the system.
        why: String,
    },
    /// The master does not answer.
    Master {
        /// Its address.
        uri: String,
        /// The reason.
        why: RpcError,
    },
    /// `ROS_MASTER_URI` is no address.
    MasterUri(String),
    /// The graph refused a name.
    Graph(String),
    /// A graph is attached already.
    Attached,
}

impl fmt::Display for Ros1Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Port { address, why } => write!(f, "ROS 1: cannot listen at {address}: {why}"),
            Self::Master { uri, why } => write!(
                f,
                "ROS 1: the master {uri} does not answer ({why}); start it with `roscore`, or unset ROS_MASTER_URI: \
                 then a master on this machine is started if there is none"
            ),
            Self::MasterUri(uri) => write!(
                f,
                "ROS 1: ROS_MASTER_URI is `{uri}`, which is no address such as http://localhost:11311"
            ),
            Self::Graph(why) => write!(f, "ROS 1: {why}"),
            Self::Attached => f.write_str("ROS 1: a graph is attached already"),
        }
    }
}

impl std::error::Error for Ros1Error {}

impl From<periplus_graph::GraphError> for Ros1Error {
    fn from(error: periplus_graph::GraphError) -> Self {
        Self::Graph(error.to_string())
    }
}
