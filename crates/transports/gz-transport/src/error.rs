//! Errors of the Gazebo transport.

use std::fmt;
use std::net::Ipv4Addr;

use periplus_graph::GraphError;

/// Error of the Gazebo transport.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum GzTransportError {
    /// The network cannot be joined.
    Network {
        /// Address of the interface.
        address: Ipv4Addr,
        /// Message of the system.
        why: String,
    },
    /// A name that Gazebo does not allow.
    Name {
        /// The name.
        name: String,
        /// Cause.
        why: &'static str,
    },
    /// The graph refused an endpoint.
    Graph(GraphError),
}

impl fmt::Display for GzTransportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Network { address, why } => write!(
                f,
                "cannot join the network of Gazebo at {address}: {why}; check that GZ_IP or IGN_IP \
                 is an address of this machine, and which programs use the ports 10317 and 10318"
            ),
            Self::Name { name, why } => {
                write!(f, "`{name}` is not a valid name in Gazebo Transport: {why}")
            }
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for GzTransportError {}

impl From<GraphError> for GzTransportError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}

/// Reason for which a call has no response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServiceCallError {
    /// There is no service of this name and these types.
    Nobody,
    /// The server did not respond in time.
    Late,
    /// The server returned failure.
    Refused,
}

impl fmt::Display for ServiceCallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nobody => "there is no service of this name and these types",
            Self::Late => "there was no response in time",
            Self::Refused => "the service returned failure",
        })
    }
}

impl std::error::Error for ServiceCallError {}
