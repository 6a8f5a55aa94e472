//! Why a call has no answer.

use std::fmt;

/// Why a call has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CallError {
    /// Nobody answers this service.
    NoServer {
        /// Its full name.
        service: String,
        /// The service that may be meant.
        near: Option<String>,
    },
    /// Who answers it went away, or let the call fall.
    Unanswered {
        /// Full name of the service.
        service: String,
    },
    /// The question or the answer is no such message.
    Undecodable {
        /// Full name of the service.
        service: String,
        /// What is wrong with it.
        reason: String,
    },
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoServer { service, near } => {
                write!(f, "nobody answers the service `{service}`")?;
                match near {
                    Some(near) => write!(f, ", did you mean `{near}`?"),
                    None => Ok(()),
                }
            }
            Self::Unanswered { service } => {
                write!(f, "who answers the service `{service}` went away without an answer")
            }
            Self::Undecodable { service, reason } => {
                write!(f, "a message of the service `{service}` cannot be read: {reason}")
            }
        }
    }
}

impl std::error::Error for CallError {}
