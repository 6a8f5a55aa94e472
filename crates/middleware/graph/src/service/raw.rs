//! Services whose types are known only by name: what wires pass on.

use std::sync::Arc;

use periplus_msgs::EncodeError;

use super::{CallError, Caller, OwnServer, Reply, Request};
use crate::GraphError;
use crate::node::Node;
use crate::payload::Payload;
use crate::registry::TypeOf;

/// A question or an answer. Cloning shares it.
#[derive(Clone)]
pub struct RawMessage(Arc<Payload>);

impl RawMessage {
    /// The message as CDR, with the four bytes in front that say how it is coded.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
    pub fn cdr(&self) -> Result<&[u8], EncodeError> {
        self.0.cdr()
    }
}

/// Calls a service for somebody outside.
pub struct RawClient {
    caller: Caller,
}

impl RawClient {
    /// Asks. `answered` gets the answer, once, from the thread that answers; it keeps what the
    /// outside needs to find its call again.
    pub fn call(
        &self,
        cdr: Vec<u8>,
        answered: impl FnOnce(Result<RawMessage, CallError>) + Send + 'static,
    ) {
        let reply = Reply::new(self.caller.name.clone(), |answer| answered(answer.map(RawMessage)));
        self.caller.call(Payload::raw(cdr), reply);
    }

    /// Whether somebody answers.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.caller.server().is_some()
    }
}

/// The calls of a service that somebody outside answers.
pub struct RawCalls {
    own: OwnServer,
}

impl RawCalls {
    /// The oldest call that waits.
    #[must_use]
    pub fn take(&self) -> Option<RawCall> {
        let Request { payload, reply } = self.own.server.take()?;
        Some(RawCall { request: RawMessage(payload), reply })
    }

    /// Lets `wake` be called, once for each call that comes from now on, from the thread that asks;
    /// it must not wait for anything. Only the first one is taken.
    pub fn on_call(&self, wake: impl Fn() + Send + Sync + 'static) {
        let _ = self.own.server.wake.set(Box::new(wake));
    }
}

/// A call that waits for its answer. If it is dropped, the caller is told that none will come.
#[must_use]
pub struct RawCall {
    /// The question.
    pub request: RawMessage,
    reply: Reply,
}

impl RawCall {
    /// Answers with CDR.
    pub fn answer(self, cdr: Vec<u8>) {
        self.reply.send(Ok(Arc::new(Payload::raw(cdr))));
    }
}

impl Node {
    /// Calls a service whose type is known only by name and, perhaps, by its hash.
    ///
    /// # Errors
    /// As [`Node::client`].
    pub fn raw_client(
        &self,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> Result<RawClient, GraphError> {
        Ok(RawClient { caller: self.0.caller(name, TypeOf::new(type_name, type_hash))? })
    }

    /// Answers a service whose type is known only by name and, perhaps, by its hash.
    ///
    /// # Errors
    /// As [`Node::server`].
    pub fn raw_server(
        &self,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> Result<RawCalls, GraphError> {
        Ok(RawCalls { own: self.0.server(name, TypeOf::new(type_name, type_hash), None)? })
    }
}
