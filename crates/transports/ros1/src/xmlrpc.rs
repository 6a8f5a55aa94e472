//! XML-RPC: values, requests and responses, as ROS 1 uses them.
//!
//! Source: `xmlrpc.com/spec`. As `XmlRpc++` of roscpp and `xmlrpc.client` of Python do, a value without a type is a
//! string, and both `i4` and `int` are integers.

mod http;
mod read;
mod value;
mod write;

pub(crate) use http::{HttpError, read_body, read_head};
pub use read::{MalformedXmlRpc, read_call, read_response};
pub use value::XmlRpcValue;
pub use write::{write_call, write_fault, write_response};

/// A request.
#[derive(Clone, Debug, PartialEq)]
pub struct RpcCall {
    /// Name of the method, such as `registerPublisher`.
    pub method: String,
    /// Its parameters.
    pub params: Vec<XmlRpcValue>,
}

/// A refused request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RpcFault {
    /// Number of the error.
    pub code: i32,
    /// Its text.
    pub text: String,
}
