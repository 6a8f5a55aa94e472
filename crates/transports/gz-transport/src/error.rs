//! What can go wrong.

use std::fmt;
use std::net::Ipv4Addr;

use periplus_graph::GraphError;

/// Why a wire cannot be.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum WireError {
    /// The network cannot be joined.
    Network {
        /// By which address.
        address: Ipv4Addr,
        /// What the system says.
        why: String,
    },
    /// A name that Gazebo does not allow.
    Name {
        /// Which.
        name: String,
        /// Why not.
        why: &'static str,
    },
    /// The graph does not want it.
    Graph(GraphError),
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Network { address, why } => write!(
                f,
                "cannot join the network of Gazebo at {address}: {why}; see whether GZ_IP or IGN_IP \
                 is an address of this machine, and who else uses the ports 10317 and 10318"
            ),
            Self::Name { name, why } => {
                write!(f, "`{name}` cannot be a name in Gazebo Transport: {why}")
            }
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

/// Why a call has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CallError {
    /// Nobody answers a service of this name and these types.
    Nobody,
    /// Who answers it did not in time.
    Late,
    /// It was refused.
    Refused,
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nobody => "nobody answers a service of this name and these types",
            Self::Late => "there was no answer in time",
            Self::Refused => "the call was refused",
        })
    }
}

impl std::error::Error for CallError {}
