//! Errors of service calls.

use std::fmt;

/// Reason for which a call has no response.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CallError {
    /// The service has no server.
    NoServer {
        /// Its full name.
        service: String,
        /// An existing service with a similar name.
        near: Option<String>,
    },
    /// The server was removed or dropped the request.
    Unanswered {
        /// Full name of the service.
        service: String,
    },
    /// The request or the response cannot be decoded.
    Undecodable {
        /// Full name of the service.
        service: String,
        /// Cause.
        reason: String,
    },
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoServer { service, near } => {
                write!(f, "no server for the service `{service}`")?;
                match near {
                    Some(near) => write!(f, ", did you mean `{near}`?"),
                    None => Ok(()),
                }
            }
            Self::Unanswered { service } => {
                write!(f, "the server of `{service}` was removed before it responded")
            }
            Self::Undecodable { service, reason } => {
                write!(f, "a message of the service `{service}` cannot be decoded: {reason}")
            }
        }
    }
}

impl std::error::Error for CallError {}
